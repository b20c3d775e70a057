// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraScreenSpacePass.h"

#include "Chain/PassSlots.h"
#include "Frame/WindowReleaseNotifier.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"

vtkPenumbraScreenSpacePass::vtkPenumbraScreenSpacePass()
  : ReleaseNotifier(vtkSmartPointer<penumbra::WindowReleaseNotifier>::New())
{
}

vtkPenumbraScreenSpacePass::~vtkPenumbraScreenSpacePass()
{
  this->ReleaseNotifier->Stop(this->Window);
}

void vtkPenumbraScreenSpacePass::Render(const vtkRenderState* state)
{
  this->NumberOfRenderedProps = 0;
  if (!this->DelegatePass)
  {
    vtkWarningMacro("The pass has no delegate, so nothing is rendered. Call SetDelegatePass().");
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
    // The projections of the two eyes are sheared; positions are not computed from depth for them.
    this->WarnOnce(std::string("Stereo rendering does not support ") + this->GetEffectName() +
      "; the scene is rendered without the effect. Turn stereo off.");
    return nullptr;
  }
  if (window && window != this->Window)
  {
    penumbra::MoveToWindow(this, this->Window, window);
    this->ReleaseNotifier->Watch(
      window, [this](vtkWindow* released) { this->ReleaseGraphicsResources(released); });
  }
  return window;
}

void vtkPenumbraScreenSpacePass::WarnOnce(const std::string& warning)
{
  if (this->LastWarning != warning)
  {
    this->LastWarning = warning;
    vtkWarningMacro(<< warning);
  }
}

void vtkPenumbraScreenSpacePass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->ReleaseNotifier->Stop(this->Window);
  this->Window = nullptr;
}

void vtkPenumbraScreenSpacePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OpaqueOnly: " << this->OpaqueOnly << "\n";
}
