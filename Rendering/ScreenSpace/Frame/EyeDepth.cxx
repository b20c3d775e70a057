// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EyeDepth.h"

#include "OpenGLFunctions.h"
#include "ScreenSpaceConstants.h"
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

EyeDepth::Comparison EyeDepth::ChooseComparison(bool moving)
{
  if (!moving)
  {
    this->UncomparedFrames = 0;
    return Comparison::Wait;
  }
  ++this->UncomparedFrames;
  if (this->UncomparedFrames < FramesPerDepthComparison)
  {
    return Comparison::Skip;
  }
  if (this->UncomparedFrames == FramesPerDepthComparison)
  {
    this->HasDifferences = false;
    return Comparison::Later;
  }
  if (this->UncomparedFrames < FramesPerDepthComparison + FramesUntilComparison)
  {
    return Comparison::Skip;
  }
  this->UncomparedFrames = 0;
  const bool changed = !this->HasDifferences || this->Differences.Take() > 0;
  return changed ? Comparison::Skip : Comparison::Wait;
}

EyeDepth::Change EyeDepth::Update(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const ScreenTransform& view, Comparison comparison)
{
  // The current texture keeps its size, because it becomes the previous one of an image of another
  // size.
  Allocate(this->Textures[1 - this->Current], window, view.Width, view.Height, 1);
  const ScreenTransform& last = this->GetView();
  vtkTextureObject* current = this->GetCurrent();
  const bool comparable =
    this->Filled && current && current->GetContext() == window && last.Parallel == view.Parallel;
  if (comparable && comparison != Comparison::Skip && last.HasSameView(view))
  {
    this->HasDifferences = this->CountDifferences(window, image, view);
    if (comparison == Comparison::Wait && this->HasDifferences && this->Differences.Take() == 0)
    {
      this->Views[this->Current] = view; // the clipping planes may have changed
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

bool EyeDepth::CountDifferences(
  vtkOpenGLRenderWindow* window, const DelegateImage& image, const ScreenTransform& view)
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
  view.SetUniforms(program);
  this->Compare.BindTexture("depthBuffer", image.GetDepth());
  this->Compare.BindTexture("eyeDepths", this->GetCurrent());
  window->GetState()->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  this->Compare.DrawAndCount(this->Differences);
  window->GetState()->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  return true;
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
  Release(window, this->Textures[0], this->Textures[1]);
  this->Differences.ReleaseGraphicsResources();
  this->HasDifferences = false;
  this->Linearize.ReleaseGraphicsResources(window);
  this->Compare.ReleaseGraphicsResources(window);
  this->Filled = false;
}

}
