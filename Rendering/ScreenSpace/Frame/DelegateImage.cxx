// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelegateImage.h"

#include "OpenGLFunctions.h"
#include "ScopedCamera.h"
#include "Textures.h"
#include "vtkFrameBufferObjectBase.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderPass.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace penumbra
{

namespace
{

vtkSmartPointer<vtkTextureObject> NewTexture(vtkOpenGLRenderWindow* window, int samples)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetSamples(samples > 1 ? static_cast<unsigned int>(samples) : 0);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  return texture;
}

}

bool FillTextures(vtkOpenGLFramebufferObject* framebuffer, vtkTextureObject* color,
  vtkTextureObject* depth, unsigned int cleared, const std::function<void()>& draw)
{
  const auto width = static_cast<int>(color->GetWidth());
  const auto height = static_cast<int>(color->GetHeight());
  vtkOpenGLState* gl = framebuffer->GetContext()->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(gl);
  const vtkOpenGLState::ScopedglScissor scissor(gl);
  const vtkOpenGLState::ScopedglEnableDisable scissorTest(gl, GL_SCISSOR_TEST);
  gl->PushFramebufferBindings();
  framebuffer->Bind();
  framebuffer->AddColorAttachment(0, color);
  framebuffer->AddDepthAttachment(depth);
  framebuffer->ActivateDrawBuffer(0);
  const bool complete = framebuffer->StartNonOrtho(width, height);
  if (complete)
  {
    gl->vtkglViewport(0, 0, width, height);
    gl->vtkglScissor(0, 0, width, height);
    gl->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->vtkglDepthMask(GL_TRUE);
    gl->vtkglEnable(GL_DEPTH_TEST);
    gl->vtkglDepthFunc(GL_LEQUAL);
    gl->vtkglClearColor(0.f, 0.f, 0.f, 0.f);
    gl->vtkglClearDepth(1.0);
    gl->vtkglClear(cleared);
    draw();
  }
  framebuffer->RemoveColorAttachments(1);
  framebuffer->RemoveDepthAttachment();
  gl->PopFramebufferBindings();
  return complete;
}

DelegateImage::DelegateImage() = default;
DelegateImage::~DelegateImage() = default;

vtkSmartPointer<vtkTextureObject> DelegateImage::CreateColor(
  vtkOpenGLRenderWindow* window, int samples, int type) const
{
  vtkSmartPointer<vtkTextureObject> texture = NewTexture(window, samples);
  texture->Allocate2D(this->View.Width, this->View.Height, 4, type);
  return texture;
}

void DelegateImage::Prepare(vtkOpenGLRenderWindow* window, int samples, int colorType)
{
  const bool reusable = this->Color && this->Color->GetContext() == window &&
    static_cast<int>(this->Color->GetWidth()) == this->View.Width &&
    static_cast<int>(this->Color->GetHeight()) == this->View.Height && this->Samples == samples &&
    this->ColorType == colorType && !this->UsesTarget;
  if (!reusable)
  {
    this->UsesTarget = false;
    this->Samples = samples;
    this->ColorType = colorType;
    this->Color = this->CreateColor(window, samples, colorType);
    this->Depth = NewTexture(window, 1);
    this->Depth->AllocateDepth(this->View.Width, this->View.Height, vtkTextureObject::Float32);
    this->SampleDepth = this->Depth;
    if (samples > 1)
    {
      this->SampleDepth = NewTexture(window, samples);
      this->SampleDepth->AllocateDepth(
        this->View.Width, this->View.Height, vtkTextureObject::Float32);
    }
  }
  this->PrepareFramebuffers(window);
}

void DelegateImage::PrepareFramebuffers(vtkOpenGLRenderWindow* window)
{
  for (vtkSmartPointer<vtkOpenGLFramebufferObject>* framebuffer :
    { &this->Framebuffer, &this->Resolved })
  {
    if (!*framebuffer || (*framebuffer)->GetContext() != window)
    {
      *framebuffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
      (*framebuffer)->SetContext(window);
    }
  }
}

void DelegateImage::ResolveDepth(vtkOpenGLRenderWindow* window)
{
  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable scissorTest(gl, GL_SCISSOR_TEST);
  gl->vtkglDisable(GL_SCISSOR_TEST);
  gl->PushDrawFramebufferBinding();
  this->Resolved->Bind(vtkOpenGLFramebufferObject::GetDrawMode());
  this->Resolved->AddDepthAttachment(this->Depth);
  gl->vtkglBlitFramebuffer(0, 0, this->View.Width, this->View.Height, 0, 0, this->View.Width,
    this->View.Height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  this->Resolved->RemoveDepthAttachment();
  gl->PopDrawFramebufferBinding();
}

void DelegateImage::ResolveColor(vtkOpenGLRenderWindow* window, vtkTextureObject* target)
{
  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable scissorTest(gl, GL_SCISSOR_TEST);
  gl->vtkglDisable(GL_SCISSOR_TEST);
  gl->PushDrawFramebufferBinding();
  this->Resolved->Bind(vtkOpenGLFramebufferObject::GetDrawMode());
  this->Resolved->AddColorAttachment(0, target);
  this->Resolved->ActivateDrawBuffer(0);
  gl->vtkglBlitFramebuffer(0, 0, this->View.Width, this->View.Height, 0, 0, this->View.Width,
    this->View.Height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  this->Resolved->RemoveColorAttachments(1);
  gl->PopDrawFramebufferBinding();
}

int DelegateImage::GetTargetSamples(const vtkRenderState* state)
{
  auto* outer = vtkOpenGLFramebufferObject::SafeDownCast(state->GetFrameBuffer());
  return outer ? outer->GetMultiSamples()
               : state->GetRenderer()->GetRenderWindow()->GetMultiSamples();
}

int DelegateImage::GetTargetColorType(const vtkRenderState* state)
{
  auto* window = static_cast<vtkOpenGLRenderWindow*>(state->GetRenderer()->GetRenderWindow());
  auto* outer = vtkOpenGLFramebufferObject::SafeDownCast(state->GetFrameBuffer());
  vtkOpenGLFramebufferObject* target = outer ? outer : window->GetRenderFramebuffer();
  vtkTextureObject* color = target ? target->GetColorAttachmentAsTextureObject(0) : nullptr;
  return color && color->GetVTKDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_UNSIGNED_CHAR;
}

bool DelegateImage::SetUpView(
  const vtkRenderState* state, const int margin[2], const double* bounds)
{
  vtkRenderer* renderer = state->GetRenderer();
  this->Viewport[0] = this->Viewport[1] = 0;
  if (auto* outer = vtkOpenGLFramebufferObject::SafeDownCast(state->GetFrameBuffer()))
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
    return false;
  }
  this->Margin[0] = margin[0];
  this->Margin[1] = margin[1];
  this->View = ScreenTransform::FromRenderer(renderer, this->Viewport + 2, margin);
  this->HasTightClipping = bounds && this->View.TightenClippingRange(bounds);
  return true;
}

int DelegateImage::Draw(const vtkRenderState* state, vtkRenderPass* delegate, const int margin[2],
  bool oneSample, const double* bounds)
{
  if (!this->SetUpView(state, margin, bounds))
  {
    return -1;
  }
  vtkRenderer* renderer = state->GetRenderer();
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  this->Prepare(
    window, oneSample ? 1 : std::max(GetTargetSamples(state), 1), GetTargetColorType(state));

  int props = -1;
  FillTextures(this->Framebuffer, this->Color, this->SampleDepth,
    GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, [&]() {
      vtkRenderState inner(renderer);
      inner.SetPropArrayAndCount(state->GetPropArray(), state->GetPropArrayCount());
      inner.SetFrameBuffer(this->Framebuffer);
      std::optional<ScopedCamera> wider;
      std::vector<vtkProp*> visible;
      if (this->IsWider())
      {
        wider.emplace(renderer, this->View);
        visible = VisibleProps(renderer);
        inner.SetPropArrayAndCount(visible.data(), static_cast<int>(visible.size()));
      }
      delegate->Render(&inner);
      props = delegate->GetNumberOfRenderedProps();
      if (this->Samples > 1)
      {
        this->ResolveDepth(window);
      }
    });
  return props;
}

bool DelegateImage::DrawAgain(
  vtkRenderer* renderer, vtkTextureObject* target, const std::function<void()>& props)
{
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  vtkSmartPointer<vtkTextureObject> color = target;
  if (this->Samples > 1)
  {
    color = this->CreateColor(window, this->Samples);
  }
  return FillTextures(this->Framebuffer, color, this->SampleDepth, GL_COLOR_BUFFER_BIT, [&]() {
    std::optional<ScopedCamera> wider;
    if (this->IsWider())
    {
      wider.emplace(renderer, this->View);
    }
    // The same shaders produce the same depths, so GL_EQUAL selects the visible pixels of the
    // props.
    window->GetState()->vtkglDepthFunc(GL_EQUAL);
    props();
    window->GetState()->vtkglDepthFunc(GL_LEQUAL);
    if (this->Samples > 1)
    {
      this->ResolveColor(window, target);
    }
  });
}

vtkOpenGLFramebufferObject* DelegateImage::GetReadableTarget(const vtkRenderState* state)
{
  auto* window = static_cast<vtkOpenGLRenderWindow*>(state->GetRenderer()->GetRenderWindow());
  auto* outer = vtkOpenGLFramebufferObject::SafeDownCast(state->GetFrameBuffer());
  vtkOpenGLFramebufferObject* target = outer ? outer : window->GetRenderFramebuffer();
  const bool readable = target && target->GetMultiSamples() <= 1 &&
    (outer || window->GetMultiSamples() <= 1) && target->GetColorAttachmentAsTextureObject(0) &&
    target->GetDepthAttachmentAsTextureObject();
  return readable ? target : nullptr;
}

int DelegateImage::DrawToTarget(const vtkRenderState* state, vtkRenderPass* delegate)
{
  const int noMargin[2] = { 0, 0 };
  vtkOpenGLFramebufferObject* target = GetReadableTarget(state);
  if (!target || !this->SetUpView(state, noMargin))
  {
    return -1;
  }
  vtkTextureObject* depth = target->GetDepthAttachmentAsTextureObject();
  if (static_cast<int>(depth->GetWidth()) != this->View.Width ||
    static_cast<int>(depth->GetHeight()) != this->View.Height)
  {
    return -1;
  }
  this->PrepareFramebuffers(
    static_cast<vtkOpenGLRenderWindow*>(state->GetRenderer()->GetRenderWindow()));
  delegate->Render(state);
  this->UsesTarget = true;
  this->Samples = 1;
  this->Color = target->GetColorAttachmentAsTextureObject(0);
  this->Depth = depth;
  this->SampleDepth = depth;
  return delegate->GetNumberOfRenderedProps();
}

void DelegateImage::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->UsesTarget)
  {
    this->Color = this->Depth = this->SampleDepth = nullptr;
  }
  this->UsesTarget = false;
  Release(window, this->Color, this->Depth, this->SampleDepth, this->Framebuffer, this->Resolved);
}

}
