// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What lies over a scene must not be darkened by the occlusion of what lies behind it.
#include "OcclusionScenes.h"
#include "Scenario.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkGPUVolumeRayCastMapper.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkRenderStepsPass.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// The colour of the picture with and without occlusion, where something else lies over the scene.
ScenarioResult Untouched(OcclusionScene& scene, Variant variant, const std::vector<Vector>& places)
{
  scene.Window->Render();
  const std::vector<int> plain = scene.Picture();
  vtkNew<vtkRenderStepsPass> everything;
  vtkNew<Pass> byHand;
  if (variant == Variant::Ours)
  {
    scene.AddOcclusionPass(1.0);
  }
  else
  {
    // The pass by hand: its delegate draws the whole picture, what lies over the scene included.
    byHand->SetDelegatePass(everything);
    byHand->SetRadiusUnit(Pass::WORLD);
    byHand->SetRadius(1.0);
    scene.Renderer->SetPass(byHand);
  }
  scene.Window->Render();
  const std::vector<int> occluded = scene.Picture();
  double largest = 0.0;
  for (const Vector& place : places)
  {
    const int at = 4 *
      (static_cast<int>(place[1] * scene.Height) * scene.Width +
        static_cast<int>(place[0] * scene.Width));
    for (int c = 0; c < 3; ++c)
    {
      largest = std::max(largest, std::abs(occluded[at + c] - plain[at + c]) / 255.0);
    }
  }
  Frame picture{ scene.Width, scene.Height, {} };
  for (std::size_t i = 1; i < occluded.size(); i += 4)
  {
    picture.Values.push_back(occluded[i] / 255.0);
  }
  if (scene.Renderer->GetPass() == byHand)
  {
    byHand->ReleaseGraphicsResources(scene.Window);
    scene.Renderer->SetPass(nullptr);
  }
  return { largest, picture };
}

/// Places of a grid over the picture, within bounds.
std::vector<Vector> Places(double left, double right, double low, double high)
{
  std::vector<Vector> places;
  for (int i = 0; i < 400; ++i)
  {
    places.push_back({ left + (right - left) * (i % 20 + .5) / 20.0,
      low + (high - low) * (i / 20 + .5) / 20.0, 0 });
  }
  return places;
}

/// Glass that is nearly opaque before a corner.
ScenarioResult BehindGlass(Variant variant)
{
  OcclusionScene scene(96, 72);
  Furnish(scene);
  const auto glass = scene.AddWall({ -3, -2, -3 }, { 6, 0, 0 }, { 0, 0, 6 });
  glass->GetProperty()->SetOpacity(.95);
  return Untouched(scene, variant, Places(0.0, 1.0, 0.0, 1.0));
}

/// A cloud that is nearly opaque before a corner.
ScenarioResult BehindAVolume(Variant variant)
{
  OcclusionScene scene(96, 72);
  Furnish(scene);
  vtkNew<vtkImageData> cloud;
  cloud->SetDimensions(12, 4, 12);
  cloud->SetOrigin(-3.0, -2.4, -2.0);
  cloud->SetSpacing(6.0 / 11.0, .2, 6.0 / 11.0);
  cloud->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  cloud->GetPointData()->GetScalars()->Fill(200.0);
  vtkNew<vtkGPUVolumeRayCastMapper> mapper;
  mapper->SetInputData(cloud);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0.0, .99);
  opacity->AddPoint(255.0, .99);
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(0.0, 1.0, 1.0, 1.0);
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->GetProperty()->SetScalarOpacity(opacity);
  volume->GetProperty()->SetScalarOpacityUnitDistance(.1);
  volume->GetProperty()->SetColor(color);
  scene.Renderer->AddVolume(volume);
  return Untouched(scene, variant, Places(.3, .7, .3, .7));
}

/// Text and a scalar bar over a scene: beside them it looks as it does without them.
ScenarioResult TextAndScalarBar(Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  vtkNew<vtkLookupTable> table;
  table->SetHueRange(0.0, 0.0); // red: what lies under something is told from the green
  table->Build();
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  bar->SetDrawTickLabels(0);
  vtkNew<vtkTextActor> text;
  text->SetInput("occlusion");
  text->GetTextProperty()->SetColor(1.0, 0.0, 0.0);
  text->SetPosition(20, 20);
  vtkNew<vtkRenderStepsPass> everything;
  vtkNew<Pass> byHand;
  const auto draw = [&](bool overlays) {
    bar->SetVisibility(overlays);
    text->SetVisibility(overlays);
    scene.Window->Render();
    Frame frame{ scene.Width, scene.Height, {} };
    const std::vector<int> bytes = scene.Picture();
    for (std::size_t i = 1; i < bytes.size(); i += 4)
    {
      frame.Values.push_back(bytes[i] / 255.0);
    }
    return frame;
  };
  scene.Renderer->AddViewProp(bar);
  scene.Renderer->AddViewProp(text);
  const Frame plain = draw(false);
  const Frame covered = draw(true);
  if (variant == Variant::Ours)
  {
    scene.AddOcclusionPass(1.0);
  }
  else
  {
    byHand->SetDelegatePass(everything);
    byHand->SetRadiusUnit(Pass::WORLD);
    scene.Renderer->SetPass(byHand);
  }
  const Frame occluded = draw(false);
  const Frame both = draw(true);
  double largest = 0.0;
  for (std::size_t i = 0; i < plain.Values.size(); ++i)
  {
    const bool isFree = plain.Values[i] == covered.Values[i];
    largest = std::max(largest, isFree ? std::abs(both.Values[i] - occluded.Values[i]) : 0.0);
  }
  if (variant == Variant::Ablated)
  {
    byHand->ReleaseGraphicsResources(scene.Window);
    scene.Renderer->SetPass(nullptr);
  }
  return { largest, both };
}

}

std::vector<Scenario> OcclusionOverlayScenarios()
{
  const std::string byHand = "OpaqueOnly: the delegate draws everything";
  return {
    { "OcclusionBehindGlass", "nearly opaque glass before a corner", "still",
      Metric::MaximumDifference, .06, byHand, "[TSSAO] translucent props", "", BehindGlass },
    { "OcclusionBehindAVolume", "a nearly opaque cloud before a corner", "still",
      Metric::MaximumDifference, .01, byHand, "[TSSAO] volumes", "", BehindAVolume },
    { "OcclusionBesideText", "text and a scalar bar over a corner", "still",
      Metric::MaximumDifference, .02, byHand, "", "", TextAndScalarBar },
  };
}

}
