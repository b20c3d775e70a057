// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The occlusion pass in static views that are difficult: image edges, viewports, projections, units
// of length, distances from the origin.
#include "OcclusionScenes.h"
#include "Scenario.h"
#include "vtkPenumbraOcclusionConstants.h"

#include "Frame/ScopedShaderEdit.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkPenumbraBilateralFilterPass.h"
#include "vtkProperty.h"
#include "vtkRenderStepsPass.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace penumbra
{

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// Replaces refinement to the tolerance by a single frame of 32 samples per pixel.
void OneFrame(Pass* pass)
{
  pass->SetConvergeInOneRender(Pass::NEVER);
}

Frame RenderOcclusion(OcclusionScene& scene)
{
  scene.Window->Render();
  return OcclusionOf(scene);
}

/// Flicker of a converged static view.
ScenarioResult StillView(Variant variant)
{
  OcclusionScene scene(96, 72);
  Furnish(scene);
  if (variant == Variant::Ablated)
  {
    scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  }
  else if (variant == Variant::Ours)
  {
    scene.AddOcclusionPass(1.0);
  }
  std::vector<std::vector<double>> times;
  Frame image;
  for (int frame = 0; frame < 4; ++frame)
  {
    image = variant == Variant::Peer ? OcclusionByVtk(scene, 1.0) : RenderOcclusion(scene);
    times.push_back(image.Values);
  }
  return { Flicker(times), Inverted(image) };
}

/// A floor in front of a wall against the closed form, in one column of pixels. Ablated: with a part
/// of the shaders replaced.
ScenarioResult Wall(
  OcclusionScene& scene, Variant variant, const char* part, const char* replacement)
{
  scene.AddOcclusionPass(1.0)->SetTolerance(.005);
  std::optional<ScopedShaderEdit> edit;
  if (variant == Variant::Ablated)
  {
    edit.emplace(part, replacement);
  }
  const std::vector<double> errors = ErrorsBeforeAWall(scene);
  return { RootMeanSquare(errors), OpennessOf(scene) };
}

ScenarioResult InPerspective(Variant variant)
{
  OcclusionScene scene(160, 96);
  return Wall(scene, variant,
    "abs(sampled.y - previous.y) < maximumSlope * (sampled.x - previous.x)", "false");
}

ScenarioResult InParallel(Variant variant)
{
  OcclusionScene scene(160, 96);
  scene.UseParallelProjection(true, 1.6);
  return Wall(scene, variant, "uniform float perspective;", "const float perspective = 1.0;");
}

ScenarioResult AtAWideAngle(Variant variant)
{
  OcclusionScene scene(160, 160);
  scene.Renderer->GetActiveCamera()->SetViewAngle(150.0);
  return Wall(scene, variant, "uniform float perspective;", "const float perspective = 0.0;");
}

/// Clipping planes at a ratio of 1 : 1e9, which exceeds the precision of a depth buffer. Ablated: the
/// pass does not fit them to the props.
ScenarioResult NearAndFar(Variant variant)
{
  const auto draw = [variant](double nearPlane, double farPlane) {
    OcclusionScene scene(96, 72);
    Furnish(scene);
    if (nearPlane > 0.0)
    {
      scene.Renderer->GetActiveCamera()->SetClippingRange(nearPlane, farPlane);
    }
    scene.AddOcclusionPass(1.0)->SetTolerance(.005);
    scene.Pass->SetOpaqueOnly(variant != Variant::Ablated);
    return RenderOcclusion(scene);
  };
  const Frame image = draw(1e-6, 1e3);
  return { Rmse(image.Values, draw(0.0, 0.0).Values), Inverted(image) };
}

/// The scene translated by 5e6 units by the actors' positions. Ablated: by the points, which are
/// floats.
ScenarioResult FarFromOrigin(Variant variant)
{
  const auto draw = [&](const Vector& at) {
    OcclusionScene scene(96, 72);
    const bool inPoints = variant == Variant::Ablated;
    const auto floor = inPoints
      ? scene.AddWall({ at[0] - 3, at[1] - 3, 0 }, { 6, 0, 0 }, { 0, 4, 0 })
      : scene.AddWall({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 4, 0 });
    floor->SetPosition(inPoints ? 0.0 : at[0], inPoints ? 0.0 : at[1], 0.0);
    const auto wall = scene.AddWall({ at[0] - 2, at[1] + .7, 0 }, { 4, .3, 0 }, { 0, 0, 1 });
    if (!inPoints)
    {
      scene.Renderer->RemoveActor(wall);
      scene.AddWall({ -2, .7, 0 }, { 4, .3, 0 }, { 0, 0, 1 })->SetPosition(at[0], at[1], 0.0);
    }
    scene.SetCamera({ at[0], at[1] - 5, 3 }, { at[0], at[1], .4 });
    scene.AddOcclusionPass(1.0)->SetTolerance(.005);
    return RenderOcclusion(scene);
  };
  const Frame image = draw({ 5e5, 5e6, 0 });
  return { Rmse(image.Values, draw({ 0, 0, 0 }).Values), Inverted(image) };
}

/// The bilateral filter over a black plate in front of a white wall. Ablated: without the weight by
/// distance.
ScenarioResult FilterAcrossAnEdge(Variant variant)
{
  OcclusionScene scene(96, 72);
  scene.AddWall({ -20, 1, -20 }, { 40, 0, 0 }, { 0, 0, 40 });
  scene.AddWall({ -40, 0, -20 }, { 40, 0, 0 }, { 0, 0, 40 })->GetProperty()->SetColor(0, 0, 0);
  scene.SetCamera({ 0, -5, 0 }, { 0, 0, 0 });
  const auto draw = [&] {
    scene.Window->Render();
    Frame frame{ scene.Width, scene.Height, {} };
    const std::vector<int> bytes = scene.Image();
    for (std::size_t i = 1; i < bytes.size(); i += 4)
    {
      frame.Values.push_back(bytes[i] / 255.0);
    }
    return frame;
  };
  const Frame plain = draw();
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkPenumbraBilateralFilterPass> filter;
  filter->SetDelegatePass(steps);
  filter->SetRadius(4);
  filter->SetDistanceSigma(variant == Variant::Ablated ? 1e3 : 0.0);
  scene.Renderer->SetPass(filter);
  const Frame filtered = draw();
  filter->ReleaseGraphicsResources(scene.Window);
  scene.Renderer->SetPass(nullptr);
  return { LargestDifference(plain.Values, filtered.Values), filtered };
}

std::function<ScenarioResult(Variant)> Units(double unit)
{
  return [unit](Variant variant) {
    const auto draw = [&](double scale) {
      OcclusionScene scene(96, 72);
      Furnish(scene, scale);
      if (variant == Variant::Peer)
      {
        return OcclusionByVtk(scene, .5); // its default radius, which is in world units
      }
      scene.AddOcclusionPass(.5)->SetTolerance(.005);
      if (variant == Variant::Ours)
      {
        scene.Pass->SetRadiusUnit(Pass::FRACTION_OF_BOUNDS);
        scene.Pass->SetRadius(.1);
      }
      return RenderOcclusion(scene);
    };
    const Frame image = draw(unit);
    return ScenarioResult{ Rmse(image.Values, draw(1.0).Values), Inverted(image) };
  };
}

/// The scene mirrored in the plane x = 0, or the camera turned by 90 degrees.
std::function<ScenarioResult(Variant)> Transformed(bool mirrors)
{
  return [mirrors](Variant variant) {
    const auto draw = [&](bool transformed) {
      OcclusionScene scene(96, 96);
      const double side = mirrors && transformed ? -1.0 : 1.0;
      Furnish(scene);
      scene.AddSphere({ side * -.9, -.5, .3 }, .3);
      scene.AddWall({ side * 1.2, -2.0, 0.0 }, { 0.0, 3.0, 0.0 }, { 0.0, 0.0, 1.0 });
      if (!mirrors && transformed)
      {
        scene.Renderer->GetActiveCamera()->Roll(90.0);
      }
      if (variant == Variant::Peer)
      {
        return OcclusionByVtk(scene, 1.0);
      }
      scene.AddOcclusionPass(1.0)->SetTolerance(.005);
      if (variant == Variant::Ablated)
      {
        OneFrame(scene.Pass);
      }
      return RenderOcclusion(scene);
    };
    const Frame plain = draw(false);
    const Frame other = draw(true);
    return ScenarioResult{
      Rmse(mirrors ? Mirrored(plain).Values : Turned(plain).Values, other.Values), Inverted(other)
    };
  };
}

ScenarioResult TwoResolutions(Variant variant)
{
  const auto draw = [&](int times) {
    OcclusionScene scene(80 * times, 60 * times);
    Furnish(scene);
    if (variant == Variant::Peer)
    {
      return OcclusionByVtk(scene, 1.0);
    }
    scene.AddOcclusionPass(1.0)->SetTolerance(.005);
    if (variant == Variant::Ablated)
    {
      scene.Pass->SetRadiusUnit(Pass::PIXELS);
      scene.Pass->SetRadius(15.0);
    }
    return RenderOcclusion(scene);
  };
  const Frame small = draw(1);
  return { Rmse(small.Values, Halved(draw(2)).Values), Inverted(small) };
}

/// The same view as a small image and as the center of a larger image.
ScenarioResult ImageEdge(Variant variant)
{
  constexpr double small = 20.0;
  const double tangent = std::tan(small / 2.0 * std::acos(-1.0) / 180.0);
  const double large = 2.0 * std::atan(2.0 * tangent) * 180.0 / std::acos(-1.0);
  const auto draw = [](int width, int height, double angle, double margin) {
    OcclusionScene scene(width, height);
    Furnish(scene);
    scene.Renderer->GetActiveCamera()->SetViewAngle(angle);
    scene.AddOcclusionPass(1.0)->GetConstants().Margin = margin;
    scene.Pass->SetTolerance(.005);
    return RenderOcclusion(scene);
  };
  const Frame whole = draw(192, 160, large, 0.0);
  const Frame center = draw(96, 80, small, variant == Variant::Ablated ? 0.0 : 50.0);
  std::vector<double> expected;
  for (int i = 0; i < 96 * 80; ++i)
  {
    expected.push_back(whole.Values[(40 + i / 96) * 192 + 48 + i % 96]);
  }
  return { Rmse(center.Values, expected), Inverted(center) };
}

/// A rod three radii in front of a wall. Next to the rod, the wall is not occluded.
ScenarioResult Halo(Variant variant)
{
  OcclusionScene scene(96, 72);
  scene.AddWall({ -6, 3, -4 }, { 12, 0, 0 }, { 0, 0, 8 });
  scene.AddWall({ -.1, 0, -4 }, { .2, 0, 0 }, { 0, 0, 8 });
  scene.SetCamera({ 0, -5, 0 }, { 0, 0, 0 });
  Frame image;
  if (variant == Variant::Peer)
  {
    image = OcclusionByVtk(scene, 1.0);
  }
  else
  {
    scene.AddOcclusionPass(1.0)->SetTolerance(.005);
    if (variant == Variant::Ablated)
    {
      scene.Pass->SetKernelName("volumetric");
    }
    image = RenderOcclusion(scene);
  }
  double dark = 0.0;
  for (int x = 0; x < 48; ++x)
  {
    dark += image.Values[36 * 96 + x] > .03;
  }
  return { dark, Inverted(image) };
}

/// The right half of a window, and the same image in a window of its size.
ScenarioResult Viewports(Variant variant)
{
  OcclusionScene single(64, 72);
  Furnish(single);
  single.AddOcclusionPass(1.0)->SetTolerance(.005);
  const Frame separate = RenderOcclusion(single);
  OcclusionScene pair(128, 72);
  Furnish(pair);
  pair.Renderer->SetViewport(.5, 0, 1, 1);
  vtkNew<vtkRenderer> left;
  left->SetViewport(0, 0, .5, 1);
  pair.Window->AddRenderer(left);
  pair.Renderer->ResetCameraClippingRange();
  pair.AddOcclusionPass(1.0)->SetTolerance(.005);
  Pass::AddTo(left);
  if (variant == Variant::Ablated)
  {
    pair.Pass->GetConstants().Margin = 0.0;
  }
  pair.Window->Render();
  const std::vector<float> values = pair.Array("AmbientOcclusion");
  const Frame half{ 64, 72, { values.begin(), values.end() } };
  return { LargestDifference(half.Values, separate.Values), Inverted(half) };
}

/// The window is enlarged while a view converges.
ScenarioResult Resize(Variant variant)
{
  OcclusionScene scene(96, 72);
  Furnish(scene);
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  scene.Window->SetSize(48, 36);
  for (int frame = 0; frame < 6; ++frame)
  {
    scene.Window->Render();
  }
  scene.Window->SetSize(96, 72);
  for (int frame = 0; frame < 6; ++frame)
  {
    if (variant == Variant::Ours || frame == 0)
    {
      scene.Window->Render();
    }
  }
  const Frame image = OcclusionOf(scene);
  return { Rmse(image.Values, Limit(scene).Values), Inverted(image) };
}

ScenarioResult TinyImages(Variant variant)
{
  double worst = 0.0;
  Frame image;
  for (const auto& [width, height] : { std::pair<int, int>(1, 1), { 2, 1 }, { 33, 7 }, { 7, 33 } })
  {
    OcclusionScene scene(width, height);
    Furnish(scene);
    scene.AddOcclusionPass(1.0)->SetTolerance(.005);
    if (variant == Variant::Ablated)
    {
      OneFrame(scene.Pass);
    }
    image = RenderOcclusion(scene);
    worst = std::max(worst, Rmse(image.Values, Limit(scene).Values));
  }
  return { worst, Inverted(image) };
}

}

std::vector<Scenario> OcclusionStillScenarios()
{
  const std::string frame = "convergence: one frame of 32 samples";
  const std::string scene = "a ball on a floor in front of a wall";
  const std::string volumetric = "ray-marched kernel: the volumetric kernel [TSSAO eq. 3]";
  return {
    { "OcclusionStillView", scene, "still", Metric::Flicker, 0.0,
      "convergence within one render: spread over frames",
      "[TSSAO] an exponential cap never stops flickering", VtksOcclusion, StillView },
    { "OcclusionBeforeAWall", "a floor in front of a wall, against the closed form", "still",
      Metric::Bias, .025, "surfaces between neighboring samples: none", "[ISAO] one layer of depth",
      "", InPerspective },
    { "OcclusionInParallel", "the same in parallel projection", "still", Metric::Bias, .03,
      "parallel projection: treated as perspective", "[TSSAO] parallel projection", "",
      InParallel },
    { "OcclusionAtAWideAngle", "the same at a view angle of 150 degrees", "still", Metric::Bias,
      .03, "perspective projection: treated as parallel", "", "", AtAWideAngle },
    { "OcclusionNearAndFar", "clipping planes at a ratio of 1 : 1e9", "still", Metric::Bias, .02,
      "fitted clipping planes: not fitted", "[ISAO] depth alone", "", NearAndFar },
    { "OcclusionFarFromTheOrigin", "a floor and a wall 5e6 units from the origin", "still",
      Metric::Bias, .01, "positions relative to the camera: offset in the points, which are floats",
      "[TSSAO] large scenes lose precision", "", FarFromOrigin },
    { "FilterAcrossAnEdge", "a plate in front of a wall, filtered", "still", Metric::Leak, .02,
      "filter weights by distance: none", "[ISAO] the filter blurs across edges", "",
      FilterAcrossAnEdge },
    { "OcclusionTinyUnit", "a ball of size 1e-6", "still", Metric::UnitIndependence, .01,
      "radius from the bounds: 0.5 units", "[ISAO] distances in scene units", VtksOcclusion,
      Units(1e-6) },
    { "OcclusionHugeUnit", "a ball of size 1e3", "still", Metric::UnitIndependence, .01,
      "radius from the bounds: 0.5 units", "[ISAO] distances in scene units", VtksOcclusion,
      Units(1e3) },
    { "OcclusionMirrored", "two balls, a floor and walls", "mirrored", Metric::Symmetry, .01, frame,
      "", VtksOcclusion, Transformed(true) },
    { "OcclusionTurned", "two balls, a floor and walls", "the camera is rotated by 90 degrees",
      Metric::Rotation, .009, frame, "", VtksOcclusion, Transformed(false) },
    { "OcclusionTwoResolutions", scene, "still", Metric::Resolution, .04,
      "radius in world units: in pixels", "", VtksOcclusion, TwoResolutions },
    { "OcclusionImageBorder", "a view, and the same view within a larger one", "still",
      Metric::Bias, .008, "margin around the image: none", "[TSSAO] the image edge", "",
      ImageEdge },
    { "OcclusionHalo", "a rod three radii in front of a wall", "still", Metric::HaloWidth, 1,
      volumetric, "[TSSAO] dark halos", VtksOcclusion, Halo },
    { "OcclusionViewports", "a viewport of half a window", "still", Metric::MaximumDifference, .01,
      "margin around the viewport: none", "[TSSAO] several viewports", "", Viewports },
    { "OcclusionResize", scene, "the window is resized while the view converges", Metric::Bias,
      .012, "frames after the new size: one", "[TSSAO] resized window", "", Resize },
    { "OcclusionTinyImages", "images of 1x1, 2x1, 33x7 and 7x33 pixels", "still", Metric::Bias, .01,
      frame, "", "", TinyImages },
  };
}

}
