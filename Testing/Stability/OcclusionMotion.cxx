// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The occlusion pass in motion: the history of earlier frames must neither flicker nor leave
// ghosts. Occlusion in [0, 1] is compared with the converged occlusion of the same view.
#include "OcclusionScenes.h"
#include "Scenario.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// Disables a mechanism of the pass.
using Ablation = void (*)(Pass*);

/// The maximum weight is that of one frame of 8 samples, so no sample of an earlier frame is kept.
void DisableHistory(Pass* pass)
{
  pass->SetMaximumWeight(8.0);
  pass->SetFirstSamples(8);
}

void DisableValidation(Pass* pass)
{
  pass->SetDepthTolerance(1.0);
  pass->SetInvalidationWeight(1000.0);
  pass->UseActorMotionOff();
}

void DisableNeighborValidation(Pass* pass)
{
  pass->SetInvalidationWeight(1000.0);
}

/// Adds the pass and renders some frames of the static scene.
void Start(OcclusionScene& scene, Variant variant, Ablation ablate, int frames = 30)
{
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  if (variant == Variant::Ablated)
  {
    ablate(scene.Pass);
  }
  for (int frame = 0; frame < frames; ++frame)
  {
    scene.Window->Render();
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
ScenarioResult FlickerUnder(Step move, Ablation ablate, Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  Start(scene, variant, ablate);
  std::vector<std::vector<double>> times;
  for (int frame = 0; frame < 12; ++frame)
  {
    move(scene, frame);
    scene.Window->Render();
    times.push_back(OnFloor(scene, FloorPoints()));
  }
  return { Flicker(times), OpennessOf(scene) };
}

/// Measures the error of the last of `frames` frames.
ScenarioResult ErrorAfter(Step move, int frames, Ablation ablate, Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  Start(scene, variant, ablate);
  for (int frame = 0; frame < frames; ++frame)
  {
    move(scene, frame);
    scene.Window->Render();
  }
  const Frame moving = OcclusionOf(scene);
  return { Rmse(moving.Values, Limit(scene).Values), Inverted(moving) };
}

/// Measures the number of frames until no trace is left of the state before `event`.
ScenarioResult GhostAfter(Step event, Ablation ablate, Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  Start(scene, variant, ablate);
  event(scene, 0);
  std::vector<Frame> frames;
  for (int frame = 0; frame < 24; ++frame)
  {
    scene.Window->Render();
    frames.push_back(OcclusionOf(scene));
  }
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

void Graze(OcclusionScene& scene, int frame)
{
  scene.SetCamera({ .02 * frame, -5.0, .45 }, { 0.0, 0.0, .3 });
}

void Cut(OcclusionScene& scene, int)
{
  scene.SetCamera({ 2.5, -3.5, 1.4 }, { 0.0, 0.0, .5 });
}

void MoveBall(OcclusionScene& scene, int)
{
  LastActor(scene)->SetPosition(1.2, -.6, .5);
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

/// Moves the camera around the scene and back to its start.
ScenarioResult Orbit(Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  Start(scene, variant, DisableValidation);
  const Frame before = OcclusionOf(scene);
  for (int frame = 0; frame < 24; ++frame)
  {
    ActiveCamera(scene)->Azimuth(15.0);
    scene.Renderer->ResetCameraClippingRange();
    scene.Window->Render();
  }
  const Frame after = OcclusionOf(scene);
  return { Rmse(before.Values, after.Values), Inverted(after) };
}

/// Vertical rods that move sideways in front of a wall.
ScenarioResult MovingRods(Variant variant)
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
  Start(scene, variant, DisableValidation);
  for (int frame = 0; frame < 12; ++frame)
  {
    for (const auto& rod : rods)
    {
      rod->SetPosition(.02 * frame, 0.0, 0.0);
    }
    scene.Window->Render();
  }
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
    scene.Pass->SetMargin(margin);
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
  const std::string history = "history: none";
  const std::string validation = "validation of history: none (eq. 8 and 9, actor motion)";
  const std::string neighbors = "validation of neighbors: none (eq. 9)";
  const std::string scene = "a ball on a floor in front of a wall";
  return {
    { "OcclusionSlowPan", scene, "slow pan, 0.25 degrees per frame", Metric::Flicker, .01, history,
      "[TSSAO eq. 7] nearest history drifts", "", Bind(FlickerUnder, PanSlowly, DisableHistory) },
    { "OcclusionFastPan", scene, "fast pan, 4 degrees per frame", Metric::Bias, .06, history,
      "[TSSAO eq. 8] history of disoccluded surfaces", "",
      Bind(ErrorAfter, PanFast, 6, DisableHistory) },
    { "OcclusionZoom", scene, "zoom, 3 % per frame", Metric::Bias, .03, history,
      "[TSSAO eq. 7] nearest history drifts", "", Bind(ErrorAfter, Zoom, 10, DisableHistory) },
    { "OcclusionGrazingPan", "the same at 5 degrees above the floor", "slow pan", Metric::Flicker,
      .012, history, "[TSSAO eq. 8] rejects planes at grazing angles", "",
      Bind(FlickerUnder, Graze, DisableHistory) },
    { "OcclusionCut", scene, "cut", Metric::GhostLength, 8, validation, "[TSSAO] camera cut", "",
      Bind(GhostAfter, Cut, DisableValidation) },
    { "OcclusionOrbit", scene, "orbit by 360 degrees, closed loop", Metric::Drift, .085, validation,
      "[TSSAO eq. 8] history of disoccluded surfaces", "", Orbit },
    { "OcclusionMovedActor", scene, "the ball jumps to the side", Metric::GhostLength, 20,
      validation, "[TSSAO] moving actors", "", Bind(GhostAfter, MoveBall, DisableValidation) },
    { "OcclusionRollingActor", scene, "the ball moves along the wall", Metric::Bias, .068,
      validation, "[TSSAO] moving actors", "", Bind(ErrorAfter, RollBall, 12, DisableValidation) },
    { "OcclusionOpeningDoor", scene, "the wall opens like a door", Metric::GhostLength, 12,
      validation, "[TSSAO eq. 9] a neighbor moves", "",
      Bind(GhostAfter, OpenDoor, DisableValidation) },
    { "OcclusionGoneActor", scene, "the ball disappears", Metric::GhostLength, 12, neighbors,
      "[TSSAO eq. 9] a neighbor moves", "", Bind(GhostAfter, HideBall, DisableNeighborValidation) },
    { "OcclusionDeformingSurface", scene, "the ball grows", Metric::Bias, .05, validation,
      "[TSSAO] changed geometry", "", Bind(ErrorAfter, GrowBall, 12, DisableValidation) },
    { "OcclusionChangingTopology", scene, "the mesh of the ball changes every frame",
      Metric::Flicker, .01, history, "[TSSAO] changed geometry", "",
      Bind(FlickerUnder, RemeshBall, DisableHistory) },
    { "OcclusionRodsInMotion", "thin rods in front of a wall", "the rods move", Metric::Bias, .055,
      validation, "[TSSAO eq. 8] history of disoccluded surfaces", "", MovingRods },
    { "OcclusionBorderCrossing", "a ball on a floor", "it leaves the image", Metric::Bias, .01,
      "margin around the image: none", "[TSSAO] the image edge", "", CrossImageEdge },
  };
}

}
