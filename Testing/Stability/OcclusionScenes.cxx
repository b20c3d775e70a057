// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionScenes.h"

#include "VTKSSAOPass.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkProperty.h"
#include "vtkSSAOPass.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

void Furnish(OcclusionScene& scene, double unit)
{
  scene.AddWall({ -3 * unit, -3 * unit, 0 }, { 6 * unit, 0, 0 }, { 0, 4 * unit, 0 });
  scene.AddWall({ -3 * unit, unit, 0 }, { 6 * unit, 0, 0 }, { 0, 0, 2 * unit });
  scene.AddSphere({ 0, 0, .5 * unit }, .5 * unit);
  scene.SetCamera({ 0, -5 * unit, 3 * unit }, { 0, 0, .4 * unit });
}

Frame OcclusionOf(OcclusionScene& scene)
{
  const std::vector<float> values = scene.Array("AmbientOcclusion");
  return { scene.Width, scene.Height, { values.begin(), values.end() } };
}

Frame Inverted(const Frame& frame)
{
  Frame result = frame;
  for (double& value : result.Values)
  {
    value = 1.0 - value;
  }
  return result;
}

Frame OpennessOf(OcclusionScene& scene)
{
  return Inverted(OcclusionOf(scene));
}

Frame OcclusionByVtk(OcclusionScene& scene, double radius)
{
  vtkActorCollection* actors = scene.Renderer->GetActors();
  vtkCollectionSimpleIterator each;
  actors->InitTraversal(each);
  while (vtkActor* actor = actors->GetNextActor(each))
  {
    // Ambient white is independent of the lights. vtkSSAOPass needs actors with lighting on.
    actor->GetProperty()->LightingOn();
    actor->GetProperty()->SetAmbient(1.0);
    actor->GetProperty()->SetDiffuse(0.0);
  }
  scene.Renderer->SetBackground(1.0, 1.0, 1.0);
  const vtkSmartPointer<vtkSSAOPass> pass = NewVTKSSAOPass(radius, 128);
  scene.Renderer->SetPass(pass);
  scene.Window->Render();
  const std::vector<int> bytes = scene.Image();
  pass->ReleaseGraphicsResources(scene.Window);
  scene.Renderer->SetPass(nullptr);
  Frame frame{ scene.Width, scene.Height, {} };
  for (std::size_t i = 1; i < bytes.size(); i += 4)
  {
    frame.Values.push_back(1.0 - bytes[i] / 255.0);
  }
  return frame;
}

Frame Limit(OcclusionScene& scene)
{
  const double tolerance = scene.Pass->GetTolerance();
  const int mode = scene.Pass->GetConvergeInOneRender();
  scene.Pass->SetTolerance(.004);
  scene.Pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
  scene.Window->Render();
  scene.Pass->SetTolerance(tolerance);
  scene.Pass->SetConvergeInOneRender(mode);
  return OcclusionOf(scene);
}

std::vector<double> OnFloor(OcclusionScene& scene, const std::vector<Vector>& points)
{
  const std::vector<float> values = scene.Array("AmbientOcclusion");
  std::vector<double> result;
  for (const Vector& point : points)
  {
    scene.Renderer->SetWorldPoint(point[0], point[1], point[2], 1.0);
    scene.Renderer->WorldToDisplay();
    const double* at = scene.Renderer->GetDisplayPoint();
    const double x = std::clamp(at[0] - .5, 0.0, scene.Width - 1.001);
    const double y = std::clamp(at[1] - .5, 0.0, scene.Height - 1.001);
    const int corner = static_cast<int>(y) * scene.Width + static_cast<int>(x);
    const double u = x - std::floor(x);
    const double v = y - std::floor(y);
    result.push_back((1.0 - v) * ((1.0 - u) * values[corner] + u * values[corner + 1]) +
      v * ((1.0 - u) * values[corner + scene.Width] + u * values[corner + scene.Width + 1]));
  }
  return result;
}

}
