// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PassSlots.h"

#include "RendererStepsPass.h"

#include "vtkCameraPass.h"
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

/// The stages that were made for a renderer without a pass, if `pass` is the camera's around them.
RendererStepsPass* OwnStages(vtkRenderPass* pass)
{
  auto* camera = vtkCameraPass::SafeDownCast(pass);
  return camera ? dynamic_cast<RendererStepsPass*>(camera->GetDelegatePass()) : nullptr;
}

/// What hangs within the pass of a place.
std::optional<PassSlot> NextPlace(const PassSlot& place)
{
  if (auto* image = vtkImageProcessingPass::SafeDownCast(place.Pass))
  {
    return PassSlot{ image->GetDelegatePass(),
      [image](vtkRenderPass* pass) { image->SetDelegatePass(pass); }, place.OpaqueOnly };
  }
  if (auto* fine = vtkSSAAPass::SafeDownCast(place.Pass))
  {
    return PassSlot{ fine->GetDelegatePass(),
      [fine](vtkRenderPass* pass) { fine->SetDelegatePass(pass); }, place.OpaqueOnly };
  }
  if (RendererStepsPass* stages = OwnStages(place.Pass))
  {
    return PassSlot{ stages->GetOpaquePass(),
      [stages](vtkRenderPass* pass) { stages->SetOpaquePass(pass); }, true };
  }
  if (auto* steps = vtkRenderStepsPass::SafeDownCast(place.Pass))
  {
    return PassSlot{ steps->GetOpaquePass(),
      [steps](vtkRenderPass* pass) { steps->SetOpaquePass(pass); }, true };
  }
  return std::nullopt;
}

}

std::vector<PassSlot> FindPassSlots(vtkRenderer* renderer)
{
  std::vector<PassSlot> places;
  if (!renderer)
  {
    return places;
  }
  std::optional<PassSlot> next = PassSlot{ renderer->GetPass(),
    [renderer](vtkRenderPass* pass) { renderer->SetPass(pass); }, false };
  while (next)
  {
    places.push_back(*next);
    next = NextPlace(places.back());
  }
  return places;
}

const PassSlot* FindPass(
  const std::vector<PassSlot>& places, const std::function<bool(vtkRenderPass*)>& isWanted)
{
  const auto found = std::find_if(places.begin(), places.end(),
    [&](const PassSlot& place) { return place.Pass && isWanted(place.Pass); });
  return found == places.end() ? nullptr : &*found;
}

std::vector<PassSlot> EnsurePassSlots(vtkRenderer* renderer)
{
  std::vector<PassSlot> places = FindPassSlots(renderer);
  if (!places.back().Pass && !places.back().OpaqueOnly)
  {
    vtkNew<vtkOpaquePass> opaque;
    vtkNew<RendererStepsPass> stages;
    stages->SetOpaquePass(opaque);
    vtkNew<vtkCameraPass> camera;
    camera->SetDelegatePass(stages);
    places.back().Set(camera);
    places = FindPassSlots(renderer);
  }
  return places;
}

void RemovePass(vtkRenderer* renderer, vtkImageProcessingPass* pass)
{
  const vtkSmartPointer<vtkImageProcessingPass> kept = pass;
  const std::vector<PassSlot> places = FindPassSlots(renderer);
  if (renderer->GetRenderWindow())
  {
    renderer->GetPass()->ReleaseGraphicsResources(renderer->GetRenderWindow());
  }
  FindPass(places, [&](vtkRenderPass* found) {
    return found == pass;
  })->Set(pass->GetDelegatePass());
  const PassSlot* own = FindPass(places, [](vtkRenderPass* found) { return OwnStages(found); });
  if (own && vtkOpaquePass::SafeDownCast(OwnStages(own->Pass)->GetOpaquePass()))
  {
    own->Set(nullptr);
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
