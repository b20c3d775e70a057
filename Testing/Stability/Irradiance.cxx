// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where interpolated occlusion fails: contacts, thin walls, corners, and answers that depend on who
// asked before. The cache against closed forms at the places that a picture sees; baked meshes.
#include "CacheScenes.h"
#include "Frames.h"
#include "Scenario.h"

#include "Embree/RayScene.h"
#include "Records/PixelCandidates.h"
#include "Scenes/Solids.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

using Cache = vtkPenumbraIrradianceCache;

/// Records with the harmonic mean of the distances as radius, between 16 and 1000 pixels. [IC] limits the
/// radius to between 2 to 4 and 20 to 64 pixels, so this is not the setting of the paper.
void UseWideHarmonicMean(Cache* cache)
{
  cache->SetRadiusRule(Cache::HARMONIC_MEAN);
  cache->SetMinimumRadius(16.0);
  cache->SetMaximumRadius(1000.0);
}

glm::dvec3 World(const Scene& scene, const RecordCandidate& site)
{
  return scene.ToWorld(site.Position);
}

/// A unit sphere, its centre at `height` above a floor: contact at 1. Seen in a picture of `size`.
std::function<ScenarioResult(Variant)> Sphere(double height, int size)
{
  return [height, size](Variant variant) {
    Scene scene;
    ArrangeContact(scene, height, size);
    const RayScene rays(scene, 1);
    vtkNew<Cache> cache;
    cache->SetTolerance(.01);
    if (variant == Variant::Ablated)
    {
      UseWideHarmonicMean(cache);
    }
    cache->Begin(rays, Infinity, .02);
    ScenarioResult outcome{ 0.0, {} };
    outcome.Picture = Picture(
      rays, cache,
      [height](glm::dvec3 position, glm::dvec3 normal) {
        const double square = position.x * position.x + position.y * position.y;
        return normal.z > .99999 && position.z < 1e-3
          ? height / std::pow(height * height + square, 1.5)
          : .5 * (1.0 - normal.z);
      },
      outcome.Value);
    return outcome;
  };
}

/// A corner of a floor and a wall: [IC] gives records there no radius, or too large ones.
ScenarioResult ConcaveCorner(Variant variant)
{
  Scene scene;
  AddRectangle(scene, { -500.f, -500.f, 0.f }, { 1000.f, 0.f, 0.f }, { 0.f, 500.f, 0.f });
  AddRectangle(scene, { -500.f, 0.f, 0.f }, { 1000.f, 0.f, 0.f }, { 0.f, 0.f, 500.f });
  LookAt(scene, { 0.0, -4.0, 3.0 }, { 0.0, -.2, .2 }, 30.0, 128, 128);
  const RayScene rays(scene, 1);
  vtkNew<Cache> cache;
  cache->SetTolerance(.01);
  if (variant == Variant::Ablated)
  {
    UseWideHarmonicMean(cache);
  }
  cache->Begin(rays, 1.0, .02);
  ScenarioResult outcome{ 0.0, {} };
  outcome.Picture = Picture(
    rays, cache,
    [](glm::dvec3 position, glm::dvec3 normal) {
      const double a = normal.z > .5 ? -position.y : position.z;
      return a < 1.0 ? (std::acos(a) - a * std::sqrt(1.0 - a * a)) / std::acos(-1.0) : 0.0;
    },
    outcome.Value);
  return outcome;
}

/// A room that is open above beside one with a low lid, a sheet between them; a record of one must not
/// serve the other.
ScenarioResult ThinWall(Variant variant)
{
  Scene scene;
  ArrangeTwoRooms(scene);
  const RayScene rays(scene, 1);
  vtkNew<Cache> cache;
  if (variant == Variant::Ablated)
  {
    UseWideHarmonicMean(cache);
  }
  cache->Begin(rays, Infinity, .01);
  return { WorstBesideWall(rays, cache), Picture(rays, cache) };
}

/// All of the sky is blocked.
ScenarioResult ClosedBox(Variant variant)
{
  Scene scene;
  AddBox(scene, { -3.f, -8.f, -1.f }, { 3.f, 4.f, 5.f });
  if (variant == Variant::Ablated)
  {
    scene.Surfaces.pop_back();
  }
  LookAt(scene, { 0.0, -7.0, 4.0 }, { 0.0, 0.0, .6 }, 45.0, 128, 128);
  const RayScene rays(scene, 1);
  vtkNew<Cache> cache;
  cache->Begin(rays, Infinity, .01);
  const Frame picture = Picture(rays, cache);
  return { *std::max_element(picture.Values.begin(), picture.Values.end()), picture };
}

/// The i-th question of `count`, in another order than from first to last.
using OrderOfQuestions = std::size_t (*)(std::size_t i, std::size_t count);

std::size_t Backwards(std::size_t i, std::size_t count)
{
  return count - 1 - i;
}

/// Every second part of a picture before the others.
std::size_t InTwoPieces(std::size_t i, std::size_t count)
{
  const std::size_t even = (count + 1) / 2;
  return i < even ? 2 * i : 2 * (i - even) + 1;
}

/// As five threads would ask that share the picture.
std::size_t InFiveThreads(std::size_t i, std::size_t count)
{
  const std::size_t share = count / 5;
  return i < 5 * share ? i % 5 * share + i / 5 : i;
}

/// The same questions in two orders, records made on one thread and on five.
std::function<ScenarioResult(Variant)> AskedAgain(OrderOfQuestions other)
{
  return [other](Variant variant) {
    Scene scene;
    ArrangeContact(scene, 1.0, 128);
    const RayScene rays(scene, 1);
    const std::vector<RecordCandidate> sites = CandidatesInImage(rays, 6);
    std::vector<double> answers[2];
    Frame picture;
    for (const bool again : { false, true })
    {
      vtkNew<Cache> cache;
      cache->SetOrder(variant == Variant::Ablated ? Cache::LAZY : Cache::LEVELS);
      vtkSMPTools::LocalScope(
        vtkSMPTools::Config(again ? 5 : 1), [&]() { cache->Begin(rays, Infinity, .02); });
      answers[again].resize(sites.size());
      for (std::size_t i = 0; i < sites.size(); ++i)
      {
        const std::size_t question = again ? other(i, sites.size()) : i;
        const RecordCandidate& site = sites[question];
        answers[again][question] = Ask(cache, World(scene, site), site.Normal);
      }
      picture = Picture(rays, cache);
    }
    return ScenarioResult{ LargestDifference(answers[0], answers[1]), picture };
  };
}

/// The inside of a sphere whose file has its normals turned outwards.
ScenarioResult InvertedNormals(Variant variant)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(24);
  source->SetPhiResolution(24);
  const auto sphere = DataOf(source);
  vtkDataArray* normals = sphere->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    const double* n = normals->GetTuple3(i);
    normals->SetTuple3(i, -n[0], -n[1], -n[2]);
  }
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(sphere);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->SetComputeNormals(variant == Variant::Ours);
  filter->SetNumberOfThreads(1);
  filter->Update();
  vtkDataArray* values =
    vtkPolyData::SafeDownCast(filter->GetOutput())->GetPointData()->GetArray("AmbientOcclusion");
  Frame picture{ 24, static_cast<int>(values->GetNumberOfTuples()) / 24, {} };
  double worst = 0.0;
  for (int i = 0; i < picture.Width * picture.Height; ++i)
  {
    picture.Values.push_back(1.0 - values->GetComponent(i, 0));
    worst = std::max(worst, values->GetComponent(i, 0));
  }
  return { worst, picture };
}

/// A mesh in two units; broken: a radius in world units.
ScenarioResult BakedUnits(Variant variant)
{
  std::vector<double> baked[2];
  for (const bool tiny : { false, true })
  {
    vtkNew<vtkSphereSource> source;
    source->SetThetaResolution(24);
    source->SetPhiResolution(24);
    const auto dented = Deformed(DataOf(source), [&](glm::dvec3 p) {
      return (tiny ? 1e-6 : 1.0) * p * (1.0 - .6 * std::exp(-20.0 * (1.0 - 2.0 * p.z)));
    });
    dented->GetPointData()->Initialize();
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(dented);
    filter->SetRadius(variant == Variant::Ablated ? .2 : 0.0);
    filter->SetNumberOfThreads(1);
    filter->Update();
    vtkDataArray* values =
      vtkPolyData::SafeDownCast(filter->GetOutput())->GetPointData()->GetArray("AmbientOcclusion");
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      baked[tiny].push_back(values->GetComponent(i, 0));
    }
  }
  Frame picture{ 24, static_cast<int>(baked[1].size()) / 24, baked[1] };
  picture.Values.resize(static_cast<std::size_t>(picture.Width) * picture.Height);
  return { Rmse(baked[0], baked[1]), picture };
}

}

std::vector<Scenario> IrradianceScenarios()
{
  const std::string printed =
    "radii from the second derivative, and their limits: the harmonic mean, 16 to 1000 pixels";
  const std::string lazy = "records before questions: [IC]'s lazy order";
  const std::string dependent = "[IC] depends on the order of questions";
  const std::string plane = " against the closed form";
  return {
    { "CacheContact", "a sphere on a floor" + plane, "still", Metric::Bias, .01, printed,
      "[IC] distant records overrule a contact shadow", "", Sphere(1.0, 256) },
    { "CacheHovering", "a sphere over a floor" + plane, "still", Metric::Bias, .01, printed,
      "[IC] radii without bounds", "", Sphere(1.5, 256) },
    { "CacheSmallPicture", "a sphere on a floor, in a picture of 128x128" + plane, "still",
      Metric::Bias, .01, printed, "", "", Sphere(1.0, 128) },
    { "CacheConcaveCorner", "a floor and a wall" + plane, "still", Metric::Bias, .006, printed,
      "[IC] radius 0 on concave surfaces", "", ConcaveCorner },
    { "CacheThinWall", "a dark room and a bright one, a sheet between", "still", Metric::Leak, .05,
      printed, "[IC] radii that nothing nearby clamps", "", ThinWall },
    { "CacheClosedBox", "the inside of a closed box", "still", Metric::Leak, 0.0,
      "a wall: one is left out", "", "", ClosedBox },
    { "CacheOrderOfQuestions", "a sphere on a floor, asked from first to last and back", "still",
      Metric::MaximumDifference, 0.0, lazy, dependent, "", AskedAgain(Backwards) },
    { "CacheTiles", "the same, asked at once and in two pieces", "still", Metric::MaximumDifference,
      0.0, lazy, dependent, "", AskedAgain(InTwoPieces) },
    { "CacheThreads", "the same, asked by one thread and as by five", "still",
      Metric::MaximumDifference, 0.0, lazy, dependent, "", AskedAgain(InFiveThreads) },
    { "BakedInvertedNormals", "an open sphere whose normals point inwards", "still",
      Metric::MaximumDifference, 0.0, "computed normals: those of the file", "", "",
      InvertedNormals },
    { "BakedUnit", "a dented sphere of size 1e-6", "still", Metric::UnitIndependence, .01,
      "a radius from the bounds: .2", "[ISAO] distances in scene units", "", BakedUnits },
  };
}

}
