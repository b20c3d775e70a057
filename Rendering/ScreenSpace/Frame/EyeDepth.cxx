// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EyeDepth.h"

#include "OpenGLFunctions.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraDepthChangeFS.h"
#include "vtkPenumbraEyeDepthFS.h"
#include "vtkPenumbraViewLib.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <atomic>

namespace penumbra
{

namespace
{

/// Returns a version that is unique in this process, starting at 1.
long long NextVersion()
{
  static std::atomic<long long> last(0);
  return ++last;
}

}

EyeDepth::Change EyeDepth::Update(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const ScreenTransform& view, bool moved)
{
  // The current texture keeps its size, because it becomes the previous one of an image of another
  // size.
  Allocate(this->Textures[1 - this->Current], window, view.Width, view.Height, 1);
  const ScreenTransform& last = this->GetView();
  vtkTextureObject* current = this->GetCurrent();
  const bool comparable =
    this->Filled && current && current->GetContext() == window && last.Parallel == view.Parallel;
  if (comparable && !moved && last.HasSameView(view))
  {
    this->Views[this->Current] = view; // the clipping planes may have changed
    if (this->IsUnchanged(window, image))
    {
      return Change::None;
    }
  }
  this->Current = 1 - this->Current;
  this->Version = NextVersion();
  this->Views[this->Current] = view;
  this->Filled = this->Fill(window, image);
  if (!this->Filled)
  {
    return Change::Failed;
  }
  return comparable ? Change::Moved : Change::Reset;
}

bool EyeDepth::IsUnchanged(vtkOpenGLRenderWindow* window, const DelegateImage& image)
{
  static const std::string source =
    Assemble(vtkPenumbraDepthChangeFS, { { "ViewLib", vtkPenumbraViewLib } });
  vtkShaderProgram* program = this->Compare.Ready(window, source);
  if (!program)
  {
    return false;
  }
  // Nothing is written; the target only needs the right size.
  const ScopedRenderTarget target(window, image.GetFramebuffer(), { this->GetPrevious() });
  this->GetView().SetUniforms(program);
  this->Compare.BindTexture("depthBuffer", image.GetDepth());
  this->Compare.BindTexture("eyeDepths", this->GetCurrent());
  window->GetState()->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  const unsigned int changed = this->Compare.DrawAndCount();
  window->GetState()->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  return changed == 0;
}

bool EyeDepth::Fill(vtkOpenGLRenderWindow* window, const DelegateImage& image)
{
  static const std::string source =
    Assemble(vtkPenumbraEyeDepthFS, { { "ViewLib", vtkPenumbraViewLib } });
  vtkShaderProgram* program = this->Linearize.Ready(window, source);
  const ScopedRenderTarget target(window, image.GetFramebuffer(), { this->GetCurrent() });
  if (!program || !target.IsComplete())
  {
    return false;
  }
  this->GetView().SetUniforms(program);
  this->Linearize.BindTexture("depthBuffer", image.GetDepth());
  this->Linearize.Draw();
  return true;
}

void EyeDepth::ReleaseGraphicsResources(vtkWindow* window)
{
  for (vtkSmartPointer<vtkTextureObject>& texture : this->Textures)
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
      texture = nullptr;
    }
  }
  this->Linearize.ReleaseGraphicsResources(window);
  this->Compare.ReleaseGraphicsResources(window);
  this->Filled = false;
}

}
