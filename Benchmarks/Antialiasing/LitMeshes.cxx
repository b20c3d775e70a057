// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// White diffuse meshes under one headlight: the default appearance. Times are CPU seconds of the
// whole cast on one thread, including the construction of the scene; POV-Ray's are of tracing only.
#include "Benchmark.h"
#include "Meshes.h"
#include "PovRay.h"

#include "vtkPenumbraRayCasterConstants.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cstdio>

namespace penumbra
{
namespace
{

constexpr int Size = 1024;

struct LitScene
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> Mesh;
  double Edge; ///< targets; 0: reported only
  double Full;
  double RaysPerPixel;
  bool Timed;
};

TargetKind If(double limit)
{
  return limit > 0.0 ? TargetKind::AtMost : TargetKind::None;
}

/// Returns the fastest of three casts.
Answer CastThrice(vtkRenderer* renderer, double tolerance)
{
  Answer best;
  for (int i = 0; i < 3; ++i)
  {
    Answer answer = Cast(
      renderer, Size, Size, [&](vtkPenumbraRayCaster* caster) { caster->SetTolerance(tolerance); });
    if (i == 0 || answer.Seconds < best.Seconds)
    {
      best = std::move(answer);
    }
  }
  return best;
}

void CompareWithUniform(Benchmark& benchmark, const LitScene& scene, vtkRenderer* renderer,
  const std::vector<glm::dvec3>& truth, const std::vector<bool>& isEdge, double edge,
  double seconds)
{
  std::vector<glm::dvec2> ladder;
  for (int n : { 1, 2, 3, 4, 6, 8, 12, 16 })
  {
    const Answer answer = Cast(renderer, Size, Size, [&](vtkPenumbraRayCaster* caster) {
      caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
      caster->GetConstants().UniformSamples = n;
    });
    const Errors errors = Compare(answer.Colors, truth, isEdge);
    ladder.emplace_back(errors.Edge, answer.Seconds);
    std::printf("  uniform %dx%d: edge %.5f full %.6f, %.3f s\n", n, n, errors.Edge, errors.Full,
      answer.Seconds);
    if (n == 8)
    {
      benchmark.Results.Add(scene.Name, "edge RMSE of uniform 8x8", errors.Edge, TargetKind::None);
      benchmark.Results.Add(scene.Name, "full RMSE of uniform 8x8", errors.Full, TargetKind::None);
    }
  }
  // Beyond the most accurate step, its time is a lower bound.
  const bool isBound = IsExtrapolated(ladder, edge);
  const glm::dvec2 last = ladder.back();
  benchmark.Results.Add(scene.Name, "times faster than uniform",
    (isBound ? last.y : CostAtError(ladder, edge)) / seconds,
    scene.Timed ? TargetKind::AtLeast : TargetKind::None, 8.0,
    isBound ? "lower bound: 16x16 rays have an edge error of " + std::to_string(last.x)
            : "at equal edge error, interpolated over n = 1..16");
}

void CompareWithPovRay(Benchmark& benchmark, const LitScene& scene, vtkRenderer* renderer,
  const BruteForceScene& description, const std::vector<glm::dvec3>& truth,
  const std::vector<bool>& isEdge, double edge, double seconds)
{
  const std::string file = benchmark.Output + "/" + scene.Name + ".pov";
  WritePovRayScene(file, renderer, description, Size, Size);
  std::vector<glm::dvec2> trace;
  std::vector<glm::dvec2> process;
  for (const PovRayStep& step : PovRayLadder())
  {
    const PovRayAnswer answer = RunPovRay(benchmark.PovRay, file, Size, Size, step);
    const Errors errors = Compare(answer.Colors, truth, isEdge);
    trace.emplace_back(errors.Edge, answer.TraceSeconds);
    process.emplace_back(errors.Edge, answer.ProcessSeconds);
    std::printf("  POV-Ray +A%g +R%d: edge %.5f full %.6f, %.2f rays/pixel, %.3f s\n",
      step.Threshold, step.Depth, errors.Edge, errors.Full, answer.RaysPerPixel,
      answer.TraceSeconds);
  }
  const double reached =
    std::min_element(trace.begin(), trace.end(), [](auto a, auto b) { return a.x < b.x; })->x;
  const std::string remark = reached <= edge
    ? "at equal edge error"
    : "extrapolated: its best edge error is " + std::to_string(reached);
  benchmark.Results.Add(scene.Name, "times faster than POV-Ray, trace",
    CostAtError(trace, edge) / seconds, scene.Timed ? TargetKind::AtLeast : TargetKind::None, 20.0,
    remark);
  benchmark.Results.Add(scene.Name, "times faster than POV-Ray, process",
    CostAtError(process, edge) / seconds, TargetKind::None, 0.0, remark);
}

void Measure(Benchmark& benchmark, const LitScene& scene)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, scene.Mesh, true);
  LookAlong(renderer, { -0.6, -0.3, -1.0 }, { 0.0, 1.0, 0.0 }, Size, Size);
  const BruteForceScene description = BruteForceOf(renderer, Size, Size);
  const BruteForceImage truth = DrawByBruteForce(description, Size, Size, benchmark.TruthSamples);
  const std::vector<bool> isEdge = SilhouettePixels(truth);

  // Selects the coarsest tolerance that meets the targets; the default is always measured and
  // reported.
  Answer answer;
  Errors errors;
  double inverse = 256.0;
  for (; inverse <= 1024.0; inverse *= 2.0)
  {
    answer = CastThrice(renderer, 1.0 / inverse);
    errors = inverse == 256.0 ? Judge(benchmark, scene.Name, answer, truth.Colors, isEdge, Size)
                              : Compare(answer.Colors, truth.Colors, isEdge);
    std::printf("  tolerance 1/%g: edge %.5f full %.6f worst %.4f, %.3f rays/pixel, %.3f s\n",
      inverse, errors.Edge, errors.Full, errors.Worst, answer.RaysPerPixel, answer.Seconds);
    if (errors.Edge <= scene.Edge && errors.Full <= scene.Full)
    {
      break;
    }
  }
  const std::string at = "tolerance 1/" + std::to_string(int(std::min(inverse, 1024.0)));
  ResultTable& table = benchmark.Results;
  table.Add(scene.Name, "edge RMSE", errors.Edge, If(scene.Edge), scene.Edge,
    at + ", " + std::to_string(errors.EdgePixels) + " edge pixels");
  table.Add(scene.Name, "full RMSE", errors.Full, If(scene.Full), scene.Full, at);
  table.Add(scene.Name, "rays per pixel", answer.RaysPerPixel, If(scene.RaysPerPixel),
    scene.RaysPerPixel, at);
  table.Add(scene.Name, "CPU seconds", answer.Seconds, TargetKind::None);
  if (!benchmark.Peers)
  {
    return;
  }
  CompareWithUniform(benchmark, scene, renderer, truth.Colors, isEdge, errors.Edge, answer.Seconds);
  if (scene.Timed && !benchmark.PovRay.empty())
  {
    CompareWithPovRay(
      benchmark, scene, renderer, description, truth.Colors, isEdge, errors.Edge, answer.Seconds);
  }
}

}

void MeasureLitMeshes(Benchmark& benchmark)
{
  vtkSmartPointer<vtkPolyData> dragon = ReadOff(benchmark.MeshFile("ChineseDragon-10kv"));
  vtkSmartPointer<vtkPolyData> elephant = ReadOff(benchmark.MeshFile("elephant"));
  Measure(benchmark, { "dragon", dragon, 0.0016, 0.0003, 2.0, true });
  Measure(benchmark, { "elephant", elephant, 0.0016, 0.00015, 1.35, true });
  Measure(benchmark, { "dragon-smooth", Smooth(dragon), 0.0, 0.0, 0.0, false });
  Measure(benchmark, { "elephant-smooth", Smooth(elephant), 0.0, 0.0, 0.0, false });
}

}
