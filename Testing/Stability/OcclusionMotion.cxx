// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The occlusion pass in motion: the history of earlier frames must neither flicker nor leave
// ghosts. Occlusion in [0, 1] is compared with the converged occlusion of the same view.
#include "OcclusionScenes.h"
#include "Scenario.h"
#include "vtkPenumbraOcclusionConstants.h"

#include "Frame/ScopedShaderEdit.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace penumbra
{

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// Disables one mechanism of the pass: by a setting, or by an edit of the shader that reprojects the
/// history.
struct Ablation
{
  std::string Name;
  std::function<void(Pass*)> Set;
  std::string Part;
  std::string Replacement;
};

const Ablation NoHistory = { "history: none", nullptr, "min(reprojected.g, weightCap)", "0.0" };
const Ablation NearestHistory = { "bilinear interpolation of the history: the nearest pixel",
  nullptr, "mix(1.0 - fraction, fraction, tap)", "vec2(equal(tap, floor(fraction + 0.5)))" };
const Ablation DepthDifference = {
  "history is compared with the tangent plane: with the depth, eq. 8", nullptr,
  "abs(tapDepth * perDepth - planeDepth) < allowed",
  "abs(1.0 + tapDepth / position.z) < depthTolerance"
};
const Ablation NoDepthValidation = { "validation by depth (eq. 8): none",
  [](Pass* pass) { pass->GetConstants().DepthTolerance = 1.0; }, "", "" };
const Ablation NoNeighborValidation = { "validation by neighbors (eq. 9): none",
  [](Pass* pass) { pass->GetConstants().InvalidationWeight = 1000.0; }, "", "" };
const Ablation NoActorMotion = { "motion of actors: not followed",
  [](Pass* pass) { pass->GetConstants().UseActorMotion = false; }, "", "" };

/// Renders `frames` frames, each after `move`, with or without a mechanism.
template <typename Step, typename Observer>
void Render(OcclusionScene& scene, Variant variant, const Ablation& ablation, int frames, Step move,
  Observer observe)
{
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  std::optional<ScopedShaderEdit> edit;
  if (variant == Variant::Ablated && ablation.Set)
  {
    ablation.Set(scene.Pass);
  }
  if (variant == Variant::Ablated && !ablation.Part.empty())
  {
    edit.emplace(ablation.Part, ablation.Replacement);
  }
  for (int frame = 0; frame < 30; ++frame)
  {
    scene.Window->Render();
  }
  for (int frame = 0; frame < frames; ++frame)
  {
    move(scene, frame);
    scene.Window->Render();
    observe();
  }
}

/// Points of the floor of Furnish() in front of the sphere.
std::vector<Vector> FloorPoints()
{
  std::vector<Vector> points;
  for (int i = 0; i < 200; ++i)
  {
    points.push_back({ -1.2 + .12 * (i % 20), -1.6 + .1 * (i / 20), 0.0 });
  }
  return points;
}

using Step = void (*)(OcclusionScene&, int frame);

/// Measures the flicker of the floor while `move` changes the scene every frame.
ScenarioResult FlickerUnder(Step move, const Ablation& ablation, Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  std::vector<std::vector<double>> times;
  Render(
    scene, variant, ablation, 12, move, [&] { times.push_back(OnFloor(scene, FloorPoints())); });
  return { Flicker(times), OpennessOf(scene) };
}

/// Measures the error of the last of `frames` frames.
ScenarioResult ErrorAfter(Step move, int frames, const Ablation& ablation, Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  Render(scene, variant, ablation, frames, move, [] {});
  const Frame moving = OcclusionOf(scene);
  return { Rmse(moving.Values, Limit(scene).Values), Inverted(moving) };
}

/// Measures the number of frames until no trace is left of the state before `event`.
ScenarioResult GhostAfter(Step event, const Ablation& ablation, Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  std::vector<Frame> frames;
  const auto happen = [event](OcclusionScene& changed, int frame) {
    if (frame == 0)
    {
      event(changed, frame);
    }
  };
  Render(scene, variant, ablation, 24, happen, [&] { frames.push_back(OcclusionOf(scene)); });
  const Frame limit = Limit(scene);
  std::vector<double> errors;
  for (const Frame& frame : frames)
  {
    errors.push_back(Rmse(frame.Values, limit.Values));
  }
  return { GhostLength(errors), Inverted(frames[3]) };
}

vtkCamera* ActiveCamera(OcclusionScene& scene)
{
  return scene.Renderer->GetActiveCamera();
}

vtkActor* LastActor(OcclusionScene& scene)
{
  return scene.Renderer->GetActors()->GetLastActor();
}

vtkSphereSource* BallSource(OcclusionScene& scene)
{
  return vtkSphereSource::SafeDownCast(LastActor(scene)->GetMapper()->GetInputAlgorithm());
}

void PanSlowly(OcclusionScene& scene, int)
{
  ActiveCamera(scene)->Azimuth(.25);
}

void PanFast(OcclusionScene& scene, int)
{
  ActiveCamera(scene)->Azimuth(4.0);
  scene.Renderer->ResetCameraClippingRange();
}

void Zoom(OcclusionScene& scene, int)
{
  ActiveCamera(scene)->Dolly(1.03);
  scene.Renderer->ResetCameraClippingRange();
}

/// Tilts the camera 5 degrees above the floor, by a third of a pixel per frame.
void TiltAtGrazingAngle(OcclusionScene& scene, int frame)
{
  scene.SetCamera({ 0.0, -5.0, .45 }, { 0.0, 0.0, .3 + .01 * frame });
}

void Cut(OcclusionScene& scene, int)
{
  scene.SetCamera({ 2.5, -3.5, 1.4 }, { 0.0, 0.0, .5 });
}

void MoveBall(OcclusionScene& scene, int)
{
  LastActor(scene)->SetPosition(1.2, -.6, .5);
}

/// Moves all actors, each by the same distance.
void MoveScene(OcclusionScene& scene, int frame)
{
  vtkActorCollection* actors = scene.Renderer->GetActors();
  vtkCollectionSimpleIterator each;
  actors->InitTraversal(each);
  while (vtkActor* actor = actors->GetNextActor(each))
  {
    actor->SetPosition(.02 * frame, 0.0, actor->GetPosition()[2]);
  }
}

void RollBall(OcclusionScene& scene, int frame)
{
  LastActor(scene)->SetPosition(.03 * frame, 0.0, .5);
}

void GrowBall(OcclusionScene& scene, int frame)
{
  BallSource(scene)->SetRadius(.5 + .01 * frame);
}

void RemeshBall(OcclusionScene& scene, int frame)
{
  BallSource(scene)->SetThetaResolution(48 + frame % 3 * 8);
  BallSource(scene)->SetPhiResolution(48 + frame % 2 * 16);
}

/// Rotates the wall behind the ball about its left edge.
void OpenDoor(OcclusionScene& scene, int)
{
  auto* door = vtkActor::SafeDownCast(scene.Renderer->GetActors()->GetItemAsObject(1));
  door->SetOrigin(-3.0, 1.0, 0.0);
  door->SetOrientation(0.0, 0.0, 70.0);
}

void HideBall(OcclusionScene& scene, int)
{
  LastActor(scene)->VisibilityOff();
}

void Orbit(OcclusionScene& scene, int)
{
  ActiveCamera(scene)->Azimuth(15.0);
  scene.Renderer->ResetCameraClippingRange();
}

/// Moves the camera around the scene and back to its start.
ScenarioResult DriftOfOrbit(const Ablation& ablation, Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  Frame before;
  const auto orbit = [&before](OcclusionScene& moved, int frame) {
    before = frame == 0 ? OcclusionOf(moved) : before;
    Orbit(moved, frame);
  };
  Render(scene, variant, ablation, 24, orbit, [] {});
  const Frame after = OcclusionOf(scene);
  return { Rmse(before.Values, after.Values), Inverted(after) };
}

/// Vertical rods that move sideways in front of a wall.
ScenarioResult MovingRods(const Ablation& ablation, Variant variant)
{
  OcclusionScene scene(128, 96);
  scene.AddWall({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 4, 0 });
  scene.AddWall({ -3, 1, 0 }, { 6, 0, 0 }, { 0, 0, 2 });
  std::vector<vtkSmartPointer<vtkActor>> rods;
  for (int i = 0; i < 7; ++i)
  {
    rods.push_back(scene.AddWall({ .4 * i - 1.2, .4, 0 }, { .06, 0, 0 }, { 0, 0, 1.5 }));
  }
  scene.SetCamera({ 0, -5, 3 }, { 0, 0, .4 });
  const auto shift = [&rods](OcclusionScene&, int frame) {
    for (const auto& rod : rods)
    {
      rod->SetPosition(.02 * frame, 0.0, 0.0);
    }
  };
  Render(scene, variant, ablation, 12, shift, [] {});
  const Frame moving = OcclusionOf(scene);
  return { Rmse(moving.Values, Limit(scene).Values), Inverted(moving) };
}

/// A ball leaves the image to the left. The reference is rendered with a margin that contains the
/// ball.
ScenarioResult CrossImageEdge(Variant variant)
{
  double worst = 0.0;
  Frame image;
  const auto draw = [](double position, double margin) {
    OcclusionScene scene(96, 72);
    scene.AddFloor();
    scene.AddSphere({ position, 0, .5 }, .5);
    scene.SetCamera({ 0, -5, 3 }, { 0, 0, .4 });
    scene.AddOcclusionPass(1.0)->SetTolerance(.005);
    scene.Pass->GetConstants().Margin = margin;
    scene.Window->Render();
    return OcclusionOf(scene);
  };
  for (int frame = 0; frame < 3; ++frame)
  {
    const double position = -2.2 - .3 * frame;
    image = draw(position, variant == Variant::Ablated ? 0.0 : -1.0);
    const Frame whole = draw(position, 30.0);
    worst = std::max(worst, Rmse(image.Values, whole.Values));
  }
  return { worst, Inverted(image) };
}

template <typename Function, typename... Arguments>
std::function<ScenarioResult(Variant)> Bind(Function function, Arguments... arguments)
{
  return [=](Variant variant) { return function(arguments..., variant); };
}

}

std::vector<Scenario> OcclusionMotionScenarios()
{
  const std::string scene = "a ball on a floor in front of a wall";
  return {
    { "OcclusionSlowPan", scene, "slow pan, 0.25 degrees per frame", Metric::Bias, .022,
      NearestHistory.Name, "[TSSAO eq. 7] nearest history drifts", "",
      Bind(ErrorAfter, PanSlowly, 40, NearestHistory) },
    { "OcclusionFastPan", scene, "fast pan, 4 degrees per frame", Metric::Bias, .043,
      NoDepthValidation.Name, "[TSSAO eq. 8] history of disoccluded surfaces", "",
      Bind(ErrorAfter, PanFast, 6, NoDepthValidation) },
    { "OcclusionZoom", scene, "zoom, 3 % per frame", Metric::Bias, .03, NearestHistory.Name,
      "[TSSAO eq. 7] nearest history drifts", "", Bind(ErrorAfter, Zoom, 10, NearestHistory) },
    { "OcclusionGrazingTilt", "the same at 5 degrees above the floor",
      "slow tilt, a third of a pixel per frame", Metric::Flicker, .012, DepthDifference.Name,
      "[TSSAO eq. 8] rejects planes at grazing angles", "",
      Bind(FlickerUnder, TiltAtGrazingAngle, DepthDifference) },
    { "OcclusionCut", scene, "the first frame after a cut", Metric::Bias, .05,
      NoDepthValidation.Name, "[TSSAO] camera cut", "",
      Bind(ErrorAfter, Cut, 1, NoDepthValidation) },
    { "OcclusionOrbit", scene, "orbit by 360 degrees, closed loop", Metric::Drift, .06,
      NoDepthValidation.Name, "[TSSAO eq. 8] history of disoccluded surfaces", "",
      Bind(DriftOfOrbit, NoDepthValidation) },
    { "OcclusionMovedActor", scene, "the ball jumps to the side", Metric::GhostLength, 12,
      NoNeighborValidation.Name, "[TSSAO eq. 9] a neighbor moves", "",
      Bind(GhostAfter, MoveBall, NoNeighborValidation) },
    { "OcclusionMovedScene", scene, "all actors move by the same distance", Metric::Bias, .013,
      NoActorMotion.Name, "[TSSAO] moving actors", "",
      Bind(ErrorAfter, MoveScene, 12, NoActorMotion) },
    { "OcclusionRollingActor", scene, "the ball moves along the wall", Metric::Bias, .021,
      NoDepthValidation.Name, "[TSSAO eq. 8] history of disoccluded surfaces", "",
      Bind(ErrorAfter, RollBall, 12, NoDepthValidation) },
    { "OcclusionOpeningDoor", scene, "the wall opens like a door", Metric::GhostLength, 12,
      NoNeighborValidation.Name, "[TSSAO eq. 9] a neighbor moves", "",
      Bind(GhostAfter, OpenDoor, NoNeighborValidation) },
    { "OcclusionGoneActor", scene, "the ball disappears", Metric::GhostLength, 12,
      NoNeighborValidation.Name, "[TSSAO eq. 9] a neighbor moves", "",
      Bind(GhostAfter, HideBall, NoNeighborValidation) },
    { "OcclusionDeformingSurface", scene, "the ball grows", Metric::Bias, .033,
      NoDepthValidation.Name, "[TSSAO] changed geometry", "",
      Bind(ErrorAfter, GrowBall, 12, NoDepthValidation) },
    { "OcclusionChangingTopology", scene, "the mesh of the ball changes every frame",
      Metric::Flicker, .002, NoHistory.Name, "[TSSAO] changed geometry", "",
      Bind(FlickerUnder, RemeshBall, NoHistory) },
    { "OcclusionRodsInMotion", "thin rods in front of a wall", "the rods move", Metric::Bias, .028,
      NoDepthValidation.Name, "[TSSAO eq. 8] history of disoccluded surfaces", "",
      Bind(MovingRods, NoDepthValidation) },
    { "OcclusionBorderCrossing", "a ball on a floor", "it leaves the image", Metric::Bias, .01,
      "margin around the image: none", "[TSSAO] the image edge", "", CrossImageEdge },
  };
}

}
