// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PassSlots.h"

#include "RendererStepsPass.h"

#include "vtkImageProcessingPass.h"
#include "vtkNew.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSSAAPass.h"

#include <algorithm>
#include <optional>

namespace penumbra
{

namespace
{

/// Returns the render steps made by EnsurePassSlots(), if `pass` contains them.
RendererStepsPass* FindRenderSteps(vtkRenderPass* pass)
{
  auto* camera = RendererCameraPass::SafeDownCast(pass);
  return camera ? camera->GetSteps() : nullptr;
}

/// Returns the slot inside the pass of a slot.
std::optional<PassSlot> FindInnerSlot(const PassSlot& slot)
{
  if (auto* image = vtkImageProcessingPass::SafeDownCast(slot.Pass))
  {
    return PassSlot{ image->GetDelegatePass(),
      [image](vtkRenderPass* pass) { image->SetDelegatePass(pass); }, slot.OpaqueOnly };
  }
  if (auto* supersampling = vtkSSAAPass::SafeDownCast(slot.Pass))
  {
    return PassSlot{ supersampling->GetDelegatePass(),
      [supersampling](vtkRenderPass* pass) { supersampling->SetDelegatePass(pass); },
      slot.OpaqueOnly };
  }
  if (RendererStepsPass* rendererSteps = FindRenderSteps(slot.Pass))
  {
    return PassSlot{ rendererSteps->GetOpaquePass(),
      [rendererSteps](vtkRenderPass* pass) { rendererSteps->SetOpaquePass(pass); }, true };
  }
  if (auto* steps = vtkRenderStepsPass::SafeDownCast(slot.Pass))
  {
    return PassSlot{ steps->GetOpaquePass(),
      [steps](vtkRenderPass* pass) { steps->SetOpaquePass(pass); }, true };
  }
  return std::nullopt;
}

}

std::vector<PassSlot> FindPassSlots(vtkRenderer* renderer)
{
  if (!renderer)
  {
    return {};
  }
  return FindInnerSlots(
    { renderer->GetPass(), [renderer](vtkRenderPass* pass) { renderer->SetPass(pass); }, false });
}

std::vector<PassSlot> FindInnerSlots(const PassSlot& slot)
{
  std::vector<PassSlot> slots;
  std::optional<PassSlot> next = slot;
  while (next)
  {
    slots.push_back(*next);
    next = FindInnerSlot(slots.back());
  }
  return slots;
}

const PassSlot* FindPass(
  const std::vector<PassSlot>& slots, const std::function<bool(vtkRenderPass*)>& predicate)
{
  const auto found = std::find_if(slots.begin(), slots.end(),
    [&](const PassSlot& slot) { return slot.Pass && predicate(slot.Pass); });
  return found == slots.end() ? nullptr : &*found;
}

std::vector<PassSlot> EnsurePassSlots(vtkRenderer* renderer)
{
  std::vector<PassSlot> slots = FindPassSlots(renderer);
  if (!slots.back().Pass && !slots.back().OpaqueOnly)
  {
    slots.back().Set(vtkNew<RendererCameraPass>());
    slots = FindPassSlots(renderer);
  }
  return slots;
}

void RemovePass(vtkRenderer* renderer, vtkImageProcessingPass* pass)
{
  const vtkSmartPointer<vtkImageProcessingPass> kept = pass;
  const std::vector<PassSlot> slots = FindPassSlots(renderer);
  if (renderer->GetRenderWindow())
  {
    renderer->GetPass()->ReleaseGraphicsResources(renderer->GetRenderWindow());
  }
  FindPass(slots, [&](vtkRenderPass* found) {
    return found == pass;
  })->Set(pass->GetDelegatePass());
  const PassSlot* made =
    FindPass(slots, [](vtkRenderPass* found) { return FindRenderSteps(found); });
  if (made && vtkOpaquePass::SafeDownCast(FindRenderSteps(made->Pass)->GetOpaquePass()))
  {
    made->Set(nullptr);
  }
}

void MoveToWindow(vtkRenderPass* pass, vtkOpenGLRenderWindow*& last, vtkOpenGLRenderWindow* window)
{
  if (last && last != window)
  {
    last->MakeCurrent();
    pass->ReleaseGraphicsResources(last);
    window->MakeCurrent();
    window->GetState()->Reset();
  }
  last = window;
}

}
