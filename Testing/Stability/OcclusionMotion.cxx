// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The occlusion pass while something moves: what it keeps from earlier frames must neither flicker nor
// linger. Occlusion in [0, 1], against what the pass converges to at the same place.
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

/// How a mechanism is taken away.
using Breaking = void (*)(Pass*);

void KeepNothing(Pass* pass)
{
  pass->SetMaximumWeight(8.0);
  pass->SetFirstSamples(8);
  pass->FilterOff();
}

void KeepUnchecked(Pass* pass)
{
  pass->SetDepthTolerance(1.0);
  pass->SetInvalidationWeight(1000.0);
  pass->UseActorMotionOff();
}

void KeepBesideMoved(Pass* pass)
{
  pass->SetInvalidationWeight(1000.0);
}

/// A scene that has been still for a while, on the way to convergence.
void Start(OcclusionScene& scene, Variant variant, Breaking broken, int frames = 30)
{
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  if (variant == Variant::Ablated)
  {
    broken(scene.Pass);
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

/// Flicker of the floor while `move` moves something every frame.
ScenarioResult FlickerUnder(Step move, Breaking broken, Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  Start(scene, variant, broken);
  std::vector<std::vector<double>> times;
  for (int frame = 0; frame < 12; ++frame)
  {
    move(scene, frame);
    scene.Window->Render();
    times.push_back(OnFloor(scene, FloorPoints()));
  }
  return { Flicker(times), OpennessOf(scene) };
}

/// Error of the last of some frames.
ScenarioResult ErrorAfter(Step move, int frames, Breaking broken, Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  Start(scene, variant, broken);
  for (int frame = 0; frame < frames; ++frame)
  {
    move(scene, frame);
    scene.Window->Render();
  }
  const Frame moving = OcclusionOf(scene);
  return { Rmse(moving.Values, Limit(scene).Values), Inverted(moving) };
}

/// Frames until nothing is left of what was there before `event`.
ScenarioResult GhostAfter(Step event, Breaking broken, Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  Start(scene, variant, broken);
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

vtkCamera* Eye(OcclusionScene& scene)
{
  return scene.Renderer->GetActiveCamera();
}

vtkActor* Ball(OcclusionScene& scene)
{
  return scene.Renderer->GetActors()->GetLastActor();
}

vtkSphereSource* BallSource(OcclusionScene& scene)
{
  return vtkSphereSource::SafeDownCast(Ball(scene)->GetMapper()->GetInputAlgorithm());
}

void PanSlowly(OcclusionScene& scene, int)
{
  Eye(scene)->Azimuth(.25);
}

void PanFast(OcclusionScene& scene, int)
{
  Eye(scene)->Azimuth(4.0);
  scene.Renderer->ResetCameraClippingRange();
}

void Zoom(OcclusionScene& scene, int)
{
  Eye(scene)->Dolly(1.03);
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
  Ball(scene)->SetPosition(1.2, -.6, .5);
}

void RollBall(OcclusionScene& scene, int frame)
{
  Ball(scene)->SetPosition(.03 * frame, 0.0, .5);
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

/// The wall behind the ball swings open about its left edge.
void OpenDoor(OcclusionScene& scene, int)
{
  auto* door = vtkActor::SafeDownCast(scene.Renderer->GetActors()->GetItemAsObject(1));
  door->SetOrigin(-3.0, 1.0, 0.0);
  door->SetOrientation(0.0, 0.0, 70.0);
}

void TakeBallAway(OcclusionScene& scene, int)
{
  Ball(scene)->VisibilityOff();
}

/// Round the scene and back.
ScenarioResult Orbit(Variant variant)
{
  OcclusionScene scene(128, 96);
  Furnish(scene);
  Start(scene, variant, KeepUnchecked);
  const Frame before = OcclusionOf(scene);
  for (int frame = 0; frame < 24; ++frame)
  {
    Eye(scene)->Azimuth(15.0);
    scene.Renderer->ResetCameraClippingRange();
    scene.Window->Render();
  }
  const Frame after = OcclusionOf(scene);
  return { Rmse(before.Values, after.Values), Inverted(after) };
}

/// Upright rods that turn before a wall.
ScenarioResult TurningRods(Variant variant)
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
  Start(scene, variant, KeepUnchecked);
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

/// A ball leaves the picture to the left: what it hides from a column near the border, against a picture
/// with all of its surroundings.
ScenarioResult CrossBorder(Variant variant)
{
  double worst = 0.0;
  Frame picture;
  const auto draw = [](double place, double margin) {
    OcclusionScene scene(96, 72);
    scene.AddFloor();
    scene.AddSphere({ place, 0, .5 }, .5);
    scene.SetCamera({ 0, -5, 3 }, { 0, 0, .4 });
    scene.AddOcclusionPass(1.0)->SetTolerance(.005);
    scene.Pass->SetMargin(margin);
    scene.Window->Render();
    return OcclusionOf(scene);
  };
  for (int frame = 0; frame < 3; ++frame)
  {
    const double place = -2.2 - .3 * frame;
    picture = draw(place, variant == Variant::Ablated ? 0.0 : -1.0);
    const Frame whole = draw(place, 30.0);
    worst = std::max(worst, Rmse(picture.Values, whole.Values));
  }
  return { worst, Inverted(picture) };
}

template <typename Function, typename... Arguments>
std::function<ScenarioResult(Variant)> Bind(Function function, Arguments... arguments)
{
  return [=](Variant variant) { return function(arguments..., variant); };
}

}

std::vector<Scenario> OcclusionMotionScenarios()
{
  const std::string nothing = "history and filter: none";
  const std::string unchecked = "validation of history: none (eq. 8 and 9)";
  const std::string beside = "validation of neighbours: none (eq. 9)";
  const std::string scene = "a ball on a floor before a wall";
  return {
    { "OcclusionSlowPan", scene, "slow pan, .25 degree a frame", Metric::Flicker, .01, nothing,
      "[TSSAO eq. 7] nearest history drifts", "", Bind(FlickerUnder, PanSlowly, KeepNothing) },
    { "OcclusionFastPan", scene, "fast pan, 4 degrees a frame", Metric::Bias, .06, nothing,
      "[TSSAO eq. 8] history of what was hidden", "", Bind(ErrorAfter, PanFast, 6, KeepNothing) },
    { "OcclusionZoom", scene, "zoom, 3 % a frame", Metric::Bias, .03, nothing,
      "[TSSAO eq. 7] nearest history drifts", "", Bind(ErrorAfter, Zoom, 10, KeepNothing) },
    { "OcclusionGrazingPan", "the same at 5 degrees above the floor", "slow pan", Metric::Flicker,
      .012, nothing, "[TSSAO eq. 8] rejects planes at grazing angles", "",
      Bind(FlickerUnder, Graze, KeepNothing) },
    { "OcclusionCut", scene, "cut", Metric::GhostLength, 8, unchecked, "[TSSAO] camera cut", "",
      Bind(GhostAfter, Cut, KeepUnchecked) },
    { "OcclusionOrbit", scene, "orbit by 360 degrees, closed loop", Metric::Drift, .085, unchecked,
      "[TSSAO eq. 8] history of what was hidden", "", Orbit },
    { "OcclusionMovedActor", scene, "the ball jumps aside", Metric::GhostLength, 20, unchecked,
      "[TSSAO] moving actors", "", Bind(GhostAfter, MoveBall, KeepUnchecked) },
    { "OcclusionRollingActor", scene, "the ball rolls before the wall", Metric::Bias, .068,
      unchecked, "[TSSAO] moving actors", "", Bind(ErrorAfter, RollBall, 12, KeepUnchecked) },
    { "OcclusionOpeningDoor", scene, "the wall opens like a door", Metric::GhostLength, 12,
      unchecked, "[TSSAO eq. 9] a neighbour moves", "", Bind(GhostAfter, OpenDoor, KeepUnchecked) },
    { "OcclusionGoneActor", scene, "the ball disappears", Metric::GhostLength, 12, beside,
      "[TSSAO eq. 9] a neighbour moves", "", Bind(GhostAfter, TakeBallAway, KeepBesideMoved) },
    { "OcclusionDeformingSurface", scene, "the ball grows", Metric::Bias, .05, unchecked,
      "[TSSAO] changed geometry", "", Bind(ErrorAfter, GrowBall, 12, KeepUnchecked) },
    { "OcclusionChangingTopology", scene, "the ball's mesh is another one every frame",
      Metric::Flicker, .01, nothing, "[TSSAO] changed geometry", "",
      Bind(FlickerUnder, RemeshBall, KeepNothing) },
    { "OcclusionRodsInMotion", "thin rods before a wall", "the rods move", Metric::Bias, .055,
      unchecked, "[TSSAO eq. 8] history of what was hidden", "", TurningRods },
    { "OcclusionBorderCrossing", "a ball on a floor", "it leaves the picture", Metric::Bias, .01,
      "a margin around the picture: none", "[TSSAO] the image border", "", CrossBorder },
  };
}

}
