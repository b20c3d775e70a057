// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"

#include "Baking/BakeInput.h"
#include "BruteForce/ImageErrors.h"
#include "Embree/RayScene.h"
#include "Meshes.h"
#include "PeerTimings.h"
#include "ResultImages.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkLoopSubdivisionFilter.h"
#include "vtkNew.h"
#include "vtkPLYWriter.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cmath>
#include <fstream>

namespace penumbra
{
namespace
{

/// Distance between the points with a reference of 16,384 rays.
constexpr std::size_t TruthStep = 400;

struct Truth
{
  std::vector<vtkIdType> Ids;
  std::vector<double> Values;
};

Truth FindTruth(vtkPolyData* mesh)
{
  const BakeInput found = PrepareBakeInput(mesh, BakeInputOptions());
  const Scene& scene = found.OccluderScene;
  const RayScene rays(scene, 1);
  vtkNew<vtkPenumbraBruteForceIrradiance> source;
  source->SetMinimumRays(16384);
  source->Begin(rays, VTK_DOUBLE_MAX, 1.0);
  Truth truth;
  for (std::size_t i = 0; i < found.Sites.size(); i += TruthStep)
  {
    const glm::dvec3 world = scene.ToWorld(found.Sites[i].Position);
    const glm::dvec3 normal(found.Sites[i].Normal);
    truth.Ids.push_back(found.Ids[i]);
    truth.Values.push_back(source->Occlusion(&world.x, &normal.x).Value);
  }
  return truth;
}

struct Baked
{
  vtkSmartPointer<vtkPolyData> Mesh;
  double Error = 0.0;
  double Seconds = 0.0;
  double Records = 0.0;
  double Rays = 0.0;
};

Baked BakeIt(vtkPolyData* mesh, double tolerance, int method, const Truth& truth)
{
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  filter->SetTolerance(tolerance);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->SetMethod(method);
  filter->SetNumberOfThreads(1);
  const double start = FrameSeconds();
  filter->Update();
  Baked baked;
  baked.Seconds = FrameSeconds() - start;
  baked.Mesh = vtkPolyData::SafeDownCast(filter->GetOutput());
  vtkDataArray* values = baked.Mesh->GetPointData()->GetArray("AmbientOcclusion");
  for (std::size_t i = 0; i < truth.Ids.size(); ++i)
  {
    baked.Error += std::pow(values->GetComponent(truth.Ids[i], 0) - truth.Values[i], 2.0);
  }
  baked.Error = std::sqrt(baked.Error / static_cast<double>(truth.Ids.size()));
  const auto count = [&](const char* name) {
    return filter->GetStatistics()->GetArray(name)->GetComponent(0, 0);
  };
  baked.Records = count("Cache/Records");
  baked.Rays = count("Rays/Total");
  return baked;
}

/// Writes mesh and reference for MeshLab; returns the script's arguments.
std::string WriteFor(const IrradianceBenchmark& benchmark, vtkPolyData* mesh, const Truth& truth)
{
  const std::string meshFile = benchmark.Output + "/armadillo.ply";
  vtkNew<vtkPLYWriter> writer;
  writer->SetInputData(mesh);
  writer->SetFileName(meshFile.c_str());
  writer->Write();
  const std::string truthFile = benchmark.Output + "/armadillo-truth.txt";
  std::ofstream file(truthFile);
  for (std::size_t i = 0; i < truth.Ids.size(); ++i)
  {
    file << truth.Ids[i] << ' ' << truth.Values[i] << '\n';
  }
  return "meshlab.py '" + meshFile + "' '" + truthFile + "'";
}

}

void MeasureBaking(IrradianceBenchmark& benchmark)
{
  ResultTable& table = benchmark.Results;
  vtkNew<vtkLoopSubdivisionFilter> subdivision;
  subdivision->SetInputData(ReadOff(benchmark.Meshes + "/armadillo.off"));
  subdivision->SetNumberOfSubdivisions(1);
  subdivision->Update();
  const vtkSmartPointer<vtkPolyData> mesh = Smooth(subdivision->GetOutput());
  const Truth truth = FindTruth(mesh);

  std::vector<glm::dvec2> ladder;
  std::vector<Baked> cached;
  double slowest = 0.0;
  vtkSmartPointer<vtkPolyData> best; // brute force with the smallest tolerance
  const std::string name = "armadillo, 104 thousand points";
  for (const double tolerance : { .03, .01, .006 })
  {
    const Baked brute = BakeIt(mesh, tolerance, vtkPenumbraIrradianceFilter::BRUTE_FORCE, truth);
    ladder.emplace_back(brute.Error, brute.Seconds);
    best = brute.Mesh;
    cached.push_back(BakeIt(mesh, tolerance, vtkPenumbraIrradianceFilter::AUTOMATIC, truth));
    const Baked& baked = cached.back();
    slowest = std::max(slowest, baked.Seconds / brute.Seconds);
    table.Add(name, "RMSE at tolerance " + std::to_string(tolerance).substr(0, 5), baked.Error,
      TargetKind::AtMost, tolerance,
      std::to_string(static_cast<int>(baked.Records)) + " records, " +
        std::to_string(baked.Rays * 1e-6).substr(0, 4) + " M rays; brute force " +
        std::to_string(brute.Error).substr(0, 6) + ", " +
        std::to_string(brute.Rays * 1e-6).substr(0, 4) + " M rays");
  }
  WriteBakings(benchmark.Output + "/baked-scan.png", cached[1].Mesh, best);
  table.Add(name, "RMSE at the default tolerance", cached[1].Error, TargetKind::AtMost, .009,
    "Embree without cache: 0.0089 at 256 rays");
  table.Add(name, "time at equal RMSE, baking over brute force",
    cached[1].Seconds / CostAtError(ladder, cached[1].Error), TargetKind::AtMost, .5,
    std::string(IsExtrapolated(ladder, cached[1].Error) ? "extrapolated, " : "") +
      "at an RMSE of " + std::to_string(cached[1].Error).substr(0, 6) +
      ": half of the rays, but reading, the acceleration structure and fits also take time");
  CompareTimes(table, name, { "MeshLab", benchmark.MeshLab, WriteFor(benchmark, mesh, truth) },
    cached[1].Error, cached[1].Seconds, .2);
  table.Add(name, "greatest time at equal tolerance, baking over brute force", slowest,
    TargetKind::AtMost, 1.0);
}

}
