// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureRenderers.h"

#include "FeatureProps.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

using penumbra::Feature;

namespace
{

using Renderer = vtkRenderer*;
using Window = vtkRenderWindow*;

/// Adds a sphere above a plane, and a spotlight or a directional light that casts shadows.
void AddShadows(vtkRenderer* renderer, bool spot)
{
  vtkActor* sphere = Add(renderer, MakeSphere(48));
  sphere->SetScale(0.4);
  sphere->SetPosition(0.05, 0.0, 0.35);
  Add(renderer, MakePlane())->GetProperty()->SetColor(0.8, 0.9, 1.0);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPositional(spot);
  light->SetConeAngle(spot ? 30.0 : 180.0);
  light->SetExponent(0.0);
  light->SetPosition(0.7, 0.4, 2.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(light);
  renderer->UseShadowsOn();
  renderer->GetActiveCamera()->SetPosition(0.3, -1.2, 2.0);
  renderer->GetActiveCamera()->SetViewUp(0.0, 1.0, 0.0);
  renderer->ResetCamera();
}

}

void AddRendererScenes(std::vector<FeatureScene>& scenes)
{
  const auto add = [&](Feature key, auto&& build, double different = 0.002) {
    scenes.push_back({ key, build, different });
  };
  for (const bool spot : { true, false })
  {
    add(Feature::RendererShadows, [spot](Renderer r, Window) { AddShadows(r, spot); });
  }
  add(Feature::HiddenLineRemoval, [](Renderer r, Window) {
    r->SetUseHiddenLineRemoval(true);
    Add(r, MakeCube())->GetProperty()->SetRepresentationToWireframe();
    Look(r);
  });
  add(Feature::ForceOpaque, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakeCube());
    actor->GetProperty()->SetOpacity(0.4);
    actor->ForceOpaqueOn();
    Look(r);
  });
}
