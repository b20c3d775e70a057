// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Measures the ray caster on large and moving scenes: the time of extraction and of the BVH while
// the camera orbits, a million spheres, and ten million triangles. Run it with `./penumbra benchmark scale`, which also fetches the mesh.
#include "Benchmark.h"
#include "Meshes.h"
#include "Program.h"
#include "Scenes/AccuracyScenes.h"
#include "Scenes/TestScene.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"

#include <array>
#include <cstdio>

namespace
{

using namespace penumbra;

constexpr int Frames = 36;
constexpr double OrbitTarget =
  0.02; // extraction and build of a frame, as a fraction of the first's
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
  program.Usage =
    "--meshes FOLDER --output FOLDER [--python PROGRAM] [--only orbit|spheres|triangles]";
  program.Values = { { "--meshes", &options.Meshes, true }, { "--output", &options.Output, true },
    { "--python", &options.Python, false } };
  program.Parts = { { "orbit", [&] { MeasureOrbits(options); } },
    { "spheres", [&] { MeasureSpheres(options); } },
    { "triangles", [&] { MeasureTriangles(options); } } };
  vtkSMPTools::Initialize(2);
  return program.Run(argc, argv, options.Results, options.Output, [] {
    return std::vector<std::string>{ "elapsed time; " + DateLine(), VersionLine(),
      "orbit: 36 frames of 320 x 192 pixels with KeepScene, 10 degrees apart",
      "a million spheres: 1000 x 600 pixels, radius 0.5 in a cube of side 100, ambient occlusion "
      "of radius "
      "3, tolerance 0.05; PyVista: points of 3 pixels as spheres, no antialiasing, SSAO",
      "ten million triangles: 1000 x 600 pixels, normals and scalars per point, no effects" };
  });
}
