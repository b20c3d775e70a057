// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EmitterImage.h"

#include "Frame/OpenGLFunctions.h"
#include "Frame/ScopedCamera.h"
#include "Frame/Uniforms.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraShaftDepthCopyFS.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>

namespace penumbra
{

void EmitterImage::Allocate(vtkOpenGLRenderWindow* window, const ScreenTransform& view)
{
  if (this->Color && this->Color->GetContext() == window &&
    static_cast<int>(this->Color->GetWidth()) == view.Width &&
    static_cast<int>(this->Color->GetHeight()) == view.Height)
  {
    return;
  }
  for (vtkSmartPointer<vtkTextureObject>* texture : { &this->Color, &this->Depth })
  {
    *texture = vtkSmartPointer<vtkTextureObject>::New();
    (*texture)->SetContext(window);
    (*texture)->SetWrapS(vtkTextureObject::ClampToEdge);
    (*texture)->SetWrapT(vtkTextureObject::ClampToEdge);
  }
  this->Color->Allocate2D(view.Width, view.Height, 4, VTK_UNSIGNED_CHAR);
  this->Depth->AllocateDepth(view.Width, view.Height, vtkTextureObject::Float32);
  this->Framebuffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  this->Framebuffer->SetContext(window);
}

bool EmitterImage::CopyDepth(vtkOpenGLRenderWindow* window, const DelegateImage& image, int block)
{
  vtkShaderProgram* program = this->DepthCopy.Ready(window, vtkPenumbraShaftDepthCopyFS);
  if (!program)
  {
    return false;
  }
  SetPixelSize(program, "pixelSize", image.GetView().Width, image.GetView().Height);
  program->SetUniformf("blockSize", static_cast<float>(block));
  this->DepthCopy.BindTexture("depthBuffer", image.GetDepth());
  window->GetState()->vtkglDepthFunc(GL_ALWAYS);
  this->DepthCopy.Draw();
  window->GetState()->vtkglDepthFunc(GL_LEQUAL);
  return true;
}

bool EmitterImage::Draw(const vtkRenderState* state, const DelegateImage& image,
  const ScreenTransform& view, int block, const std::vector<vtkProp*>& emitters, bool prepass)
{
  vtkRenderer* renderer = state->GetRenderer();
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  this->Allocate(window, view);
  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(gl, GL_BLEND);
  bool hasDepth = false;
  const bool drawn = FillTextures(
    this->Framebuffer, this->Color, this->Depth, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, [&]() {
      const ScopedCamera camera(renderer, view);
      const auto isEmitter = [&](vtkProp* prop) {
        return std::find(emitters.begin(), emitters.end(), prop) != emitters.end();
      };
      gl->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      hasDepth = prepass || this->CopyDepth(window, image, block);
      const std::vector<vtkProp*> props = VisibleProps(renderer);
      for (vtkProp* prop : props)
      {
        if (prepass && !isEmitter(prop))
        {
          prop->RenderOpaqueGeometry(renderer);
        }
      }
      gl->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
      for (vtkProp* prop : props)
      {
        if (isEmitter(prop))
        {
          prop->RenderOpaqueGeometry(renderer);
        }
      }
    });
  return drawn && hasDepth;
}

void EmitterImage::ReleaseGraphicsResources(vtkWindow* window)
{
  this->DepthCopy.ReleaseGraphicsResources(window);
  Release(window, this->Color, this->Depth, this->Framebuffer);
}

}
