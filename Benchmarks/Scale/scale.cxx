// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Measures the ray caster on large and moving scenes: the time of extraction and of the BVH while
// the camera orbits, after one of many actors has changed, a million spheres, and ten million
// triangles. Run it with `./penumbra benchmark scale`, which also fetches the mesh.
#include "Benchmark.h"
#include "Meshes.h"
#include "Program.h"
#include "Scenes/AccuracyScenes.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>

namespace
{

using namespace penumbra;

constexpr int Frames = 36;
constexpr double OrbitTarget =
  0.02; // extraction and build of a frame, as a fraction of the first's
constexpr double ChangeTarget = 0.01; // the same after one of 1,000 actors has changed
constexpr double GyroidTriangles = 1e6;
constexpr int Width = 320;
constexpr int Height = 192;

/// Elapsed seconds of the phases of a frame.
using Phases = std::array<double, vtkPenumbraRayCaster::TRACING + 1>;

Phases Render(vtkPenumbraRayCaster* caster)
{
  caster->Update();
  Phases phases;
  for (int phase = 0; phase <= vtkPenumbraRayCaster::TRACING; ++phase)
  {
    phases[phase] = caster->GetPhaseSeconds(phase);
  }
  return phases;
}

double GetPreparation(const Phases& phases)
{
  return phases[vtkPenumbraRayCaster::EXTRACTION] + phases[vtkPenumbraRayCaster::BUILD];
}

std::string Describe(const Phases& phases, double divisor)
{
  char text[160];
  std::snprintf(text, sizeof text,
    "extraction %.3g ms, build %.3g ms, edges %.3g ms, tracing %.3g ms",
    1e3 * phases[vtkPenumbraRayCaster::EXTRACTION] / divisor,
    1e3 * phases[vtkPenumbraRayCaster::BUILD] / divisor,
    1e3 * phases[vtkPenumbraRayCaster::EDGES] / divisor,
    1e3 * phases[vtkPenumbraRayCaster::TRACING] / divisor);
  return text;
}

void MeasureOrbit(vtkPolyData* mesh, const std::string& name, int threads, ResultTable& results)
{
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, mesh, true);
  LookAlong(renderer, { -0.3, -0.4, -1.0 }, { 0.0, 1.0, 0.0 }, Width, Height);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Width, Height);
  caster->SetNumberOfThreads(threads);
  caster->KeepSceneOn();
  const Phases first = Render(caster);
  Phases others{};
  for (int frame = 1; frame < Frames; ++frame)
  {
    renderer->GetActiveCamera()->Azimuth(360.0 / Frames);
    renderer->ResetCameraClippingRange();
    const Phases phases = Render(caster);
    for (std::size_t i = 0; i < phases.size(); ++i)
    {
      others[i] += phases[i];
    }
  }
  const std::string scene =
    name + ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
  const double count = Frames - 1;
  results.Add(scene, "orbit: extraction + build, mean of frames 2 to 36 / frame 1",
    GetPreparation(others) / count / GetPreparation(first), TargetKind::AtMost, OrbitTarget,
    "frame 1: " + Describe(first, 1.0));
  results.Add(scene, "orbit: extraction + build, sum of frames 2 to 36 / frame 1",
    GetPreparation(others) / GetPreparation(first), TargetKind::None, 0.0,
    "mean of frames 2 to 36: " + Describe(others, count));
}

/// Spheres in a cubic grid.
constexpr int ActorsPerSide = 10;

/// Measures the next images after one of many actors has changed.
void MeasureChanges(Options& options)
{
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  std::vector<vtkSmartPointer<vtkActor>> actors;
  for (int i = 0; i < ActorsPerSide * ActorsPerSide * ActorsPerSide; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(i % ActorsPerSide, i / ActorsPerSide % ActorsPerSide,
      static_cast<double>(i / (ActorsPerSide * ActorsPerSide)));
    sphere->SetRadius(0.4);
    sphere->SetThetaResolution(32);
    sphere->SetPhiResolution(18);
    sphere->Update();
    actors.push_back(AddMesh(renderer, sphere->GetOutput(), true));
  }
  LookAlong(renderer, { -0.3, -0.4, -1.0 }, { 0.0, 1.0, 0.0 }, Width, Height);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Width, Height);
  caster->SetNumberOfThreads(1);
  caster->KeepSceneOn();
  const Phases first = Render(caster);
  struct
  {
    const char* Name;
    std::function<void(vtkActor*, int)> Apply;
  } const changes[] = {
    { "moves", [](vtkActor* actor, int frame) { actor->SetPosition(0.1, 0.01 * frame, 0.0); } },
    { "changes its color",
      [](vtkActor* actor, int frame) { actor->GetProperty()->SetColor(1.0, 0.02 * frame, 0.0); } },
    { "is hidden or shown",
      [](vtkActor* actor, int frame) { actor->SetVisibility(frame % 2 == 0); } },
  };
  // In the middle of the grid.
  vtkActor* const actor = actors[ActorsPerSide / 2 * (1 + ActorsPerSide * (1 + ActorsPerSide))];
  for (const auto& change : changes)
  {
    std::vector<double> seconds;
    Phases last{};
    for (int frame = 1; frame < Frames; ++frame)
    {
      change.Apply(actor, frame);
      last = Render(caster);
      seconds.push_back(GetPreparation(last));
    }
    std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
    options.Results.Add("1,000 actors of 1,024 triangles, 1 thread",
      std::string("one ") + change.Name + ": extraction + build, median / those of the first image",
      seconds[seconds.size() / 2] / GetPreparation(first), TargetKind::AtMost, ChangeTarget,
      "last image: " + Describe(last, 1.0) + "; first: " + Describe(first, 1.0));
  }
}

void MeasureOrbits(Options& options)
{
  const vtkSmartPointer<vtkPolyData> dragon =
    Smooth(ReadOff(options.Meshes + "/ChineseDragon-10kv.off"));
  const vtkSmartPointer<vtkPolyData> gyroid = MakeGyroid(GyroidTriangles, true);
  for (const int threads : { 1, 2 })
  {
    MeasureOrbit(dragon, "dragon", threads, options.Results);
    MeasureOrbit(gyroid, "gyroid of a million triangles", threads, options.Results);
  }
}

}

int main(int argc, char** argv)
{
  Options options;
  Program program;
  program.Name = "scale";
  program.Title = "Large and moving scenes: measurements and targets";
  program.Usage = "--meshes FOLDER --output FOLDER [--python PROGRAM] [--only "
                  "ranks|ranks-baking|orbit|previews|changes|spheres|triangles]";
  program.Values = { { "--meshes", &options.Meshes, true }, { "--output", &options.Output, true },
    { "--python", &options.Python, false } };
  program.Parts = { { "ranks", [&] { MeasureRanks(options); } },
    { "ranks-baking", [&] { MeasureBakingOnRanks(options); } },
    { "orbit", [&] { MeasureOrbits(options); } }, { "previews", [&] { MeasurePreviews(options); } },
    { "changes", [&] { MeasureChanges(options); } },
    { "spheres", [&] { MeasureSpheres(options); } },
    { "triangles", [&] { MeasureTriangles(options); } } };
  vtkSMPTools::Initialize(2);
  return program.Run(argc, argv, options.Results, options.Output, [] {
    return std::vector<std::string>{ "elapsed time",
      "orbit: 36 frames of 320 x 192 pixels with KeepScene, 10 degrees apart",
      "window: 1000 x 600 pixels of vtkPenumbraRayCastPass, 15 views, 10 degrees apart",
      "1,000 actors: 36 images of 320 x 192 pixels with KeepScene, the camera does not move",
      "a million spheres: 1000 x 600 pixels, radius 0.5 in a cube of side 100, ambient occlusion "
      "of radius "
      "3, tolerance 0.05; PyVista: points of 3 pixels as spheres, no antialiasing, SSAO",
      "ranks: 8 blocks of an isosurface on 1 to 8 processes with one thread each, which sockets "
      "connect; 1000 x 600 pixels; effects: blocks of 5 % of the triangles, 320 x 192 pixels; "
      "baking: 1 %",
      "ten million triangles: 1000 x 600 pixels, normals and scalars per point, no effects" };
  });
}
