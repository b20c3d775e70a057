// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraScreenSpacePass.h"

#include "Chain/PassSlots.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLResourceFreeCallback.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"

vtkPenumbraScreenSpacePass::vtkPenumbraScreenSpacePass() = default;

vtkPenumbraScreenSpacePass::~vtkPenumbraScreenSpacePass()
{
  if (this->Window)
  {
    this->Window->UnregisterGraphicsResources(this->EndOfWindow.get());
  }
}

void vtkPenumbraScreenSpacePass::Render(const vtkRenderState* state)
{
  this->NumberOfRenderedProps = 0;
  if (!this->DelegatePass)
  {
    vtkWarningMacro("There is no delegate to draw the scene.");
    return;
  }
  if (state->GetRenderer()->GetSelector() || !this->RenderEffect(state))
  {
    this->DelegatePass->Render(state);
    this->NumberOfRenderedProps = this->DelegatePass->GetNumberOfRenderedProps();
  }
}

vtkOpenGLRenderWindow* vtkPenumbraScreenSpacePass::EnterWindow(vtkRenderer* renderer)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (window && window->GetStereoRender())
  {
    // The projections of the two eyes are sheared: positions do not follow from depth as they do here.
    this->WarnOnce(
      std::string("In stereo the scene is drawn without ") + this->GetEffectName() + ".");
    return nullptr;
  }
  if (window && window != this->Window)
  {
    penumbra::MoveToWindow(this, this->Window, window);
    this->EndOfWindow = std::make_unique<vtkOpenGLResourceFreeCallback<vtkPenumbraScreenSpacePass>>(
      this, &vtkPenumbraScreenSpacePass::ReleaseGraphicsResources);
    this->EndOfWindow->RegisterGraphicsResources(window);
  }
  return window;
}

void vtkPenumbraScreenSpacePass::WarnOnce(const std::string& warning)
{
  if (this->Warned != warning)
  {
    this->Warned = warning;
    vtkWarningMacro(<< warning);
  }
}

void vtkPenumbraScreenSpacePass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  if (this->Window && !this->EndOfWindow->IsReleasing())
  {
    this->Window->UnregisterGraphicsResources(this->EndOfWindow.get());
    this->EndOfWindow.reset();
  }
  this->Window = nullptr;
}

void vtkPenumbraScreenSpacePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OpaqueOnly: " << this->OpaqueOnly << "\n";
}
