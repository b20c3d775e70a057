// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelegateImage.h"

#include "OpenGLFunctions.h"
#include "vtkCamera.h"
#include "vtkFrameBufferObjectBase.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderPass.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

namespace penumbra
{

namespace
{

/// While it lives the renderer looks through a wider copy of its camera. The renderer's own camera
/// is never touched, and the lights that follow it see no difference.
class WiderCamera
{
public:
  WiderCamera(vtkRenderer* renderer, const ScreenView& view)
    : Renderer(renderer),
      Saved(renderer->GetActiveCamera())
  {
    vtkSmartPointer<vtkCamera> wide = vtkSmartPointer<vtkCamera>::Take(this->Saved->NewInstance());
    wide->DeepCopy(this->Saved);
    vtkNew<vtkMatrix4x4> projection;
    projection->DeepCopy(view.Projection.data());
    wide->SetExplicitProjectionTransformMatrix(projection);
    wide->UseExplicitProjectionTransformMatrixOn();
    renderer->SetActiveCamera(wide);
  }
  ~WiderCamera() { this->Renderer->SetActiveCamera(this->Saved); }
  WiderCamera(const WiderCamera&) = delete;
  void operator=(const WiderCamera&) = delete;

private:
  vtkRenderer* Renderer;
  vtkSmartPointer<vtkCamera> Saved;
};

}

DelegateImage::DelegateImage() = default;
DelegateImage::~DelegateImage() = default;

void DelegateImage::Prepare(vtkOpenGLRenderWindow* window)
{
  const auto isRight = [&](vtkTextureObject* texture) {
    return texture && texture->GetContext() == window &&
      static_cast<int>(texture->GetWidth()) == this->View.Width &&
      static_cast<int>(texture->GetHeight()) == this->View.Height;
  };
  const auto create = [&](vtkSmartPointer<vtkTextureObject>& texture) {
    texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(window);
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
  };
  if (!isRight(this->Color))
  {
    create(this->Color);
    this->Color->Allocate2D(this->View.Width, this->View.Height, 4, VTK_UNSIGNED_CHAR);
  }
  if (!isRight(this->Depth))
  {
    create(this->Depth);
    this->Depth->AllocateDepth(this->View.Width, this->View.Height, vtkTextureObject::Float32);
  }
  if (!this->Framebuffer || this->Framebuffer->GetContext() != window)
  {
    this->Framebuffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->Framebuffer->SetContext(window);
  }
}

int DelegateImage::Draw(const vtkRenderState* state, vtkRenderPass* delegate, const int margin[2])
{
  vtkRenderer* renderer = state->GetRenderer();
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  this->Viewport[0] = this->Viewport[1] = 0;
  if (vtkFrameBufferObjectBase* outer = state->GetFrameBuffer())
  {
    outer->GetLastSize(this->Viewport + 2);
  }
  else
  {
    renderer->GetTiledSizeAndOrigin(
      this->Viewport + 2, this->Viewport + 3, this->Viewport, this->Viewport + 1);
  }
  if (this->Viewport[2] < 1 || this->Viewport[3] < 1)
  {
    return -1;
  }
  this->Margin[0] = margin[0];
  this->Margin[1] = margin[1];
  this->View = ScreenView::Of(renderer, this->Viewport + 2, margin);
  this->Prepare(window);

  vtkOpenGLState* gl = window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(gl);
  vtkOpenGLState::ScopedglScissor scissor(gl);
  vtkOpenGLState::ScopedglEnableDisable scissorTest(gl, GL_SCISSOR_TEST);
  gl->PushFramebufferBindings();
  this->Framebuffer->Bind();
  this->Framebuffer->AddColorAttachment(0, this->Color);
  this->Framebuffer->AddDepthAttachment(this->Depth);
  this->Framebuffer->ActivateDrawBuffer(0);
  int props = -1;
  if (this->Framebuffer->StartNonOrtho(this->View.Width, this->View.Height))
  {
    gl->vtkglViewport(0, 0, this->View.Width, this->View.Height);
    gl->vtkglScissor(0, 0, this->View.Width, this->View.Height);
    gl->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->vtkglDepthMask(GL_TRUE);
    gl->vtkglEnable(GL_DEPTH_TEST);
    gl->vtkglDepthFunc(GL_LEQUAL);
    gl->vtkglClearColor(0.f, 0.f, 0.f, 0.f);
    gl->vtkglClearDepth(1.0);
    gl->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);

    vtkRenderState inner(renderer);
    inner.SetPropArrayAndCount(state->GetPropArray(), state->GetPropArrayCount());
    inner.SetFrameBuffer(this->Framebuffer);
    const WiderCamera wider(renderer, this->View);
    delegate->Render(&inner);
    props = delegate->GetNumberOfRenderedProps();
  }
  this->Framebuffer->RemoveColorAttachments(1);
  this->Framebuffer->RemoveDepthAttachment();
  gl->PopFramebufferBindings();
  return props;
}

void DelegateImage::ReleaseGraphicsResources(vtkWindow* window)
{
  for (vtkTextureObject* texture : { this->Color.Get(), this->Depth.Get() })
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
    }
  }
  if (this->Framebuffer)
  {
    this->Framebuffer->ReleaseGraphicsResources(window);
  }
  this->Color = nullptr;
  this->Depth = nullptr;
  this->Framebuffer = nullptr;
}

}
