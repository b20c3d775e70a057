// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion of unlimited distance baked onto the points of a mesh: with Penumbra's
// defaults, with rays at every point, and with peer programs. The reference traces many rays at
// some of the points. Times include building the acceleration structure.
#include "ChartPointQueries.h"

#include "Baking/BakeInput.h"
#include "Embree/RayScene.h"
#include "Surface.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace penumbra
{

namespace
{

using Filter = vtkPenumbraIrradianceFilter;

/// Rays per point of the reference, in full and in quick charts.
constexpr int TruthRays = 65536;
constexpr int QuickTruthRays = 4096;
/// Number of points with a reference value.
constexpr std::size_t TruePoints = 256;

/// A mesh with its reference values.
struct Subject
{
  vtkSmartPointer<vtkPolyData> Mesh;
  BakeInput Found;
  std::vector<std::size_t> Known; ///< sites with a reference value
  std::vector<double> Truth;
};

using Subjects = std::function<Subject&()>;

PointQuery QuestionAt(const BakeInput& found, std::size_t site)
{
  const Scene& scene = found.OccluderScene;
  return { glm::dvec3(found.Sites[site].Position) / scene.Scale + scene.Origin,
    glm::dvec3(found.Sites[site].Normal) };
}

Subjects Prepare(const ChartMesh& mesh, int truthRays)
{
  return Lazily<Subject>([mesh, truthRays] {
    auto subject = std::make_shared<Subject>();
    // One normal per point, the same for all programs.
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(mesh.Mesh);
    normals->SplittingOff();
    normals->ConsistencyOff();
    normals->Update();
    subject->Mesh = normals->GetOutput();
    subject->Found = PrepareBakeInput(subject->Mesh, BakeInputOptions());
    const RayScene rays(subject->Found.OccluderScene, 1);
    vtkNew<vtkPenumbraBruteForceIrradiance> source;
    source->SetMinimumRays(truthRays);
    source->SetMaximumRays(truthRays);
    source->Begin(rays, VTK_DOUBLE_MAX, 1.0);
    const std::size_t step = std::max<std::size_t>(subject->Found.Sites.size() / TruePoints, 1);
    for (std::size_t site = 0; site < subject->Found.Sites.size(); site += step)
    {
      const PointQuery at = QuestionAt(subject->Found, site);
      subject->Known.push_back(site);
      subject->Truth.push_back(source->Occlusion(&at.Position.x, &at.Normal.x).Value);
    }
    return subject;
  });
}

/// Returns the RMSE of `occlusion(site)` against the reference.
template <typename Occlusion>
double ErrorOf(const Subject& subject, const Occlusion& occlusion)
{
  double squares = 0.0;
  for (std::size_t i = 0; i < subject.Known.size(); ++i)
  {
    squares += std::pow(occlusion(subject.Known[i]) - subject.Truth[i], 2.0);
  }
  return std::sqrt(squares / static_cast<double>(subject.Known.size()));
}

Measurement Bake(const Subject& subject, int method, double tolerance)
{
  vtkNew<Filter> filter;
  filter->SetInputData(subject.Mesh);
  filter->SetTolerance(tolerance);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->SetMethod(method);
  filter->SetNumberOfThreads(1);
  const double start = CpuSeconds();
  filter->Update();
  Measurement result;
  result.Seconds = CpuSeconds() - start;
  vtkDataArray* values =
    vtkPolyData::SafeDownCast(filter->GetOutput())->GetPointData()->GetArray("AmbientOcclusion");
  result.Error = ErrorOf(
    subject, [&](std::size_t site) { return values->GetComponent(subject.Found.Ids[site], 0); });
  result.Count = filter->GetStatistics()->GetArray("Rays/Total")->GetComponent(0, 0) /
    static_cast<double>(subject.Found.Sites.size());
  return result;
}

PointQuerySteps PeersOnMesh(const std::string& scene, const Subjects& subject)
{
  PointQuerySteps steps;
  steps.Scene = scene;
  steps.Prepare = [=](const Peer&) {
    PointQueryScene asked;
    asked.Drawn = &subject().Found.OccluderScene;
    for (std::size_t site = 0; site < subject().Found.Sites.size(); ++site)
    {
      asked.Questions.push_back(QuestionAt(subject().Found, site));
    }
    return asked;
  };
  steps.Error = [=](const PointQueryScene&, const std::vector<glm::dvec3>& light) {
    return ErrorOf(subject(), [&](std::size_t site) { return 1.0 - light[site].x; });
  };
  return steps;
}

}

void AddBaking(ChartFamily& family, const ChartMesh& mesh, const ChartRequest& request)
{
  const Subjects subject = Prepare(mesh, request.Quick ? QuickTruthRays : TruthRays);
  for (const double tolerance :
    request.Quick ? std::vector<double>{ .03 } : std::vector<double>{ .1, .05, .03, .01, .005 })
  {
    std::ostringstream setting;
    setting << "tolerance " << tolerance;
    family.Steps.push_back({ mesh.Name, "Penumbra automatic (baked)", setting.str(), tolerance,
      [=] { return Bake(subject(), Filter::AUTOMATIC, tolerance); } });
    family.Steps.push_back({ mesh.Name, "rays at every point", setting.str(), tolerance,
      [=] { return Bake(subject(), Filter::BRUTE_FORCE, tolerance); } });
  }
  AddPeers(family, request.Peers, PeersOnMesh(mesh.Name, subject));
}

}
