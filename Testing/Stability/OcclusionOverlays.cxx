// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Translucent props, volumes and overlays must not be darkened by the occlusion of surfaces behind
// them.
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

/// Returns the largest difference between images with and without occlusion at the given positions,
/// where an overlay covers the scene.
ScenarioResult MeasureChange(
  OcclusionScene& scene, Variant variant, const std::vector<Vector>& positions)
{
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  vtkNew<vtkRenderStepsPass> everything;
  vtkNew<Pass> wholeImage;
  if (variant == Variant::Ours)
  {
    scene.AddOcclusionPass(1.0);
  }
  else
  {
    // The delegate of this pass renders the whole image, including what covers the scene.
    wholeImage->SetDelegatePass(everything);
    wholeImage->SetRadiusUnit(Pass::WORLD);
    wholeImage->SetRadius(1.0);
    scene.Renderer->SetPass(wholeImage);
  }
  scene.Window->Render();
  const std::vector<int> occluded = scene.Image();
  double largest = 0.0;
  for (const Vector& position : positions)
  {
    const int at = 4 *
      (static_cast<int>(position[1] * scene.Height) * scene.Width +
        static_cast<int>(position[0] * scene.Width));
    for (int c = 0; c < 3; ++c)
    {
      largest = std::max(largest, std::abs(occluded[at + c] - plain[at + c]) / 255.0);
    }
  }
  Frame image{ scene.Width, scene.Height, {} };
  for (std::size_t i = 1; i < occluded.size(); i += 4)
  {
    image.Values.push_back(occluded[i] / 255.0);
  }
  if (scene.Renderer->GetPass() == wholeImage)
  {
    wholeImage->ReleaseGraphicsResources(scene.Window);
    scene.Renderer->SetPass(nullptr);
  }
  return { largest, image };
}

/// Grid of positions within bounds, as fractions of the image's size.
std::vector<Vector> GridPositions(double left, double right, double low, double high)
{
  std::vector<Vector> positions;
  for (int i = 0; i < 400; ++i)
  {
    positions.push_back({ left + (right - left) * (i % 20 + .5) / 20.0,
      low + (high - low) * (i / 20 + .5) / 20.0, 0 });
  }
  return positions;
}

/// A nearly opaque pane of glass in front of a corner.
ScenarioResult BehindGlass(Variant variant)
{
  OcclusionScene scene(96, 72);
  Furnish(scene);
  const auto glass = scene.AddWall({ -3, -2, -3 }, { 6, 0, 0 }, { 0, 0, 6 });
  glass->GetProperty()->SetOpacity(.95);
  return MeasureChange(scene, variant, GridPositions(0.0, 1.0, 0.0, 1.0));
}

/// A nearly opaque volume in front of a corner.
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
  return MeasureChange(scene, variant, GridPositions(.3, .7, .3, .7));
}

/// Text and a scalar bar over a scene: next to them, occlusion is the same as without them.
ScenarioResult TextAndScalarBar(Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  vtkNew<vtkLookupTable> table;
  table->SetHueRange(0.0, 0.0); // red, so that the green channel shows which pixels are covered
  table->Build();
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  bar->SetDrawTickLabels(0);
  vtkNew<vtkTextActor> text;
  text->SetInput("occlusion");
  text->GetTextProperty()->SetColor(1.0, 0.0, 0.0);
  text->SetPosition(20, 20);
  vtkNew<vtkRenderStepsPass> everything;
  vtkNew<Pass> wholeImage;
  const auto draw = [&](bool overlays) {
    bar->SetVisibility(overlays);
    text->SetVisibility(overlays);
    scene.Window->Render();
    Frame frame{ scene.Width, scene.Height, {} };
    const std::vector<int> bytes = scene.Image();
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
    wholeImage->SetDelegatePass(everything);
    wholeImage->SetRadiusUnit(Pass::WORLD);
    scene.Renderer->SetPass(wholeImage);
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
    wholeImage->ReleaseGraphicsResources(scene.Window);
    scene.Renderer->SetPass(nullptr);
  }
  return { largest, both };
}

}

std::vector<Scenario> OcclusionOverlayScenarios()
{
  const std::string wholeImage = "occlusion of opaque props only: the delegate renders all props";
  return {
    { "OcclusionBehindGlass", "nearly opaque glass in front of a corner", "still",
      Metric::MaximumDifference, .06, wholeImage, "[TSSAO] translucent props", "", BehindGlass },
    { "OcclusionBehindAVolume", "a nearly opaque volume in front of a corner", "still",
      Metric::MaximumDifference, .01, wholeImage, "[TSSAO] volumes", "", BehindAVolume },
    { "OcclusionBesideText", "text and a scalar bar over a corner", "still",
      Metric::MaximumDifference, .02, wholeImage, "", "", TextAndScalarBar },
  };
}

}
