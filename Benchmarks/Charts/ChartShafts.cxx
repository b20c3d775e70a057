// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light shafts: the mean of a radial mask of the paper, in one pass or in two chained passes; depth
// along the path to the light for blocks of three sizes; marched shadow rays. The error is relative
// to the RMS of the added light; the reference uses 512 shadow rays per pixel. Shaders are compiled
// before the clock starts.
#include "ChartFamilies.h"

#include "ShaftScene.h"
#include "vtkPenumbraShaftConstants.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

using Pass = vtkPenumbraLightShaftPass;

struct Subject
{
  std::unique_ptr<ShaftScene> Scene;
  vtkSmartPointer<vtkLight> Sun;
  std::vector<double> Truth;
};

using Subjects = std::function<Subject&()>;

/// The scene built by `arrange`, in a homogeneous medium.
Subjects InHaze(
  const Vector& sun, bool quick, const std::function<void(ShaftScene& scene)>& arrange)
{
  return Lazily<Subject>([=] {
    auto subject = std::make_shared<Subject>();
    subject->Scene = std::make_unique<ShaftScene>(quick ? 96 : 384, quick ? 72 : 288);
    ShaftScene& scene = *subject->Scene;
    arrange(scene);
    subject->Sun = scene.AddSun(sun);
    scene.SetMedium(.12, .12);
    subject->Truth = scene.RenderWithRayCaster(quick ? 64 : 512);
    return subject;
  });
}

void ArrangeSolids(ShaftScene& scene)
{
  scene.AddFloor(12.0);
  scene.AddSolids(14, 1);
  scene.Look({ .5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
}

/// Places a mesh with a diagonal of 4 above the floor.
void ArrangeMesh(ShaftScene& scene, vtkPolyData* mesh)
{
  scene.AddFloor(12.0);
  const double* bounds = mesh->GetBounds();
  const double scale = 4.0 / mesh->GetLength();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetScale(scale);
  actor->SetPosition(-.5 * scale * (bounds[0] + bounds[1]), -.5 * scale * (bounds[2] + bounds[3]),
    .5 - scale * bounds[4]);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0.0, 0.0, 0.0);
  scene.Renderer->AddActor(actor);
  scene.Look({ .5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
}

/// Places leaves on a spiral around the top of a tree.
void ArrangeLeaves(ShaftScene& scene)
{
  for (int i = 0; i < 60; ++i)
  {
    const double up = (i + .5) / 60.0;
    const double away = 1.1 * std::sqrt(up * (1.0 - up)) + .1;
    scene.AddSphere({ away * std::cos(2.4 * i), away * std::sin(2.4 * i), .8 + 1.6 * up }, .13);
  }
  scene.Look({ 0.0, -7.0, .2 }, { 0.0, 0.0, .9 }, 30.0);
}

double ErrorOf(const Subject& subject, const std::vector<double>& light)
{
  double squares = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    squares += std::pow(light[i] - subject.Truth[i], 2.0);
    size += subject.Truth[i] * subject.Truth[i];
  }
  return std::sqrt(squares / size);
}

/// Number of repetitions, of which the fastest counts.
constexpr int Frames = 12;

/// Returns a statistic of the last frame.
double Statistic(const Subject& subject, const char* name)
{
  return subject.Scene->Pass->GetStatistics()->GetArray(name)->GetComponent(0, 0);
}

Measurement MeasurePass(Subject& subject, int estimator, double tolerance, int steps)
{
  Pass* pass = subject.Scene->Pass;
  pass->SetEstimator(estimator);
  pass->SetTolerance(tolerance);
  pass->GetConstants().Steps = steps;
  Measurement result;
  result.Seconds = std::numeric_limits<double>::infinity();
  const double* place = subject.Sun->GetPosition();
  const Vector sun = { place[0], place[1], place[2] };
  for (int frame = -1; frame < Frames; ++frame)
  {
    // A static scene is computed only once. The light is therefore moved slightly in every frame
    // and is at its position in the last one.
    const bool isLast = frame + 1 == Frames;
    subject.Sun->SetPosition(sun[0] + (isLast ? 0.0 : 1e-6 * (frame + 2)), sun[1], sun[2]);
    const double start = CpuSeconds();
    subject.Scene->Window->Render();
    subject.Scene->Window->WaitForCompletion();
    result.Seconds = frame < 0 ? result.Seconds : std::min(result.Seconds, CpuSeconds() - start);
  }
  result.Count = Statistic(subject, "LitFractions/Computed") *
    Statistic(subject, "Samples/PerLitFraction") / static_cast<double>(subject.Truth.size());
  result.Error = ErrorOf(subject, subject.Scene->RenderWithPass());
  return result;
}

Measurement MeasureRays(Subject& subject, int steps)
{
  long long rays = 0;
  const double start = CpuSeconds();
  const std::vector<double> light = subject.Scene->RenderWithRayCaster(steps, &rays);
  const double seconds = CpuSeconds() - start;
  return { ErrorOf(subject, light), seconds,
    static_cast<double>(rays) / static_cast<double>(light.size()) };
}

void AddSteps(ChartFamily& family, const std::string& scene, const Subjects& subject, bool quick)
{
  const std::vector<int> ladder =
    quick ? std::vector<int>{ 8, 32 } : std::vector<int>{ 4, 8, 16, 32, 64, 128, 256 };
  const struct
  {
    const char* Method;
    int Estimator;
    double Tolerance;
  } methods[] = { { "mean of a mask [Shafts]", Pass::RADIAL, 1.0 / 256.0 },
    { "depth in every pixel", Pass::DEPTH, 1.0 / 1024.0 },
    { "depth in blocks of 3x3", Pass::DEPTH, 1.0 / 256.0 },
    { "depth in blocks of 4x4", Pass::DEPTH, 1.0 / 64.0 } };
  for (const auto& method : methods)
  {
    for (const int steps : ladder)
    {
      family.Steps.push_back({ scene, method.Method, std::to_string(steps) + " steps", 0.0,
        [=] { return MeasurePass(subject(), method.Estimator, method.Tolerance, steps); } });
    }
  }
  for (const int steps : quick ? std::vector<int>() : std::vector<int>{ 2, 4, 8, 16 })
  {
    // Two passes of n steps are equivalent to one loop of n * n steps.
    family.Steps.push_back({ scene, "chained geometric mask [Shafts]",
      std::to_string(steps) + " + " + std::to_string(steps) + " steps", 0.0, [=] {
        Pass* pass = subject().Scene->Pass;
        pass->GetConstants().Passes = 2;
        Measurement measured = MeasurePass(subject(), Pass::RADIAL, 1.0 / 256.0, steps);
        measured.Count *= 2.0;
        pass->GetConstants().Passes = 1;
        return measured;
      } });
  }
  for (const int steps : quick ? std::vector<int>{ 8 } : std::vector<int>{ 2, 4, 8, 16, 32, 64 })
  {
    family.Steps.push_back({ scene, "shadow rays", std::to_string(steps) + " steps", 0.0,
      [=] { return MeasureRays(subject(), steps); } });
  }
  for (const int inverse :
    quick ? std::vector<int>{ 64, 256 } : std::vector<int>{ 16, 64, 128, 256, 1024 })
  {
    // The tolerance is a color difference; the error here is relative to the added light.
    family.Steps.push_back(
      { scene, "Penumbra automatic", "--tolerance 1/" + std::to_string(inverse), 0.0,
        [=] { return MeasurePass(subject(), Pass::DEPTH, 1.0 / inverse, 0); } });
  }
}

}

ChartFamily ShaftFamily(const ChartRequest& request)
{
  ChartFamily family{ "shafts",
    std::string("Light shafts, ") + (request.Quick ? "96x72" : "384x288"),
    "RMSE over RMS of the added light", "depths or shadow rays per pixel",
    std::string(request.Quick ? "64" : "512") + " shadow rays per pixel", {} };
  const Vector inView = { .2, 1.0, .32 };
  for (const ChartMesh& mesh : request.Meshes)
  {
    const auto arrange = [mesh](ShaftScene& scene) { ArrangeMesh(scene, mesh.Mesh); };
    AddSteps(family, mesh.Name, InHaze(inView, request.Quick, arrange), request.Quick);
  }
  if (request.Meshes.empty())
  {
    AddSteps(family, "sun in view", InHaze(inView, request.Quick, ArrangeSolids), request.Quick);
  }
  if (request.Meshes.empty() && !request.Quick)
  {
    AddSteps(
      family, "sun outside of the image", InHaze({ .72, 1.0, .32 }, false, ArrangeSolids), false);
    AddSteps(family, "sun behind leaves", InHaze({ .05, 1.0, .35 }, false, ArrangeLeaves), false);
  }
  return family;
}

}
