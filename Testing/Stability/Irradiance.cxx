// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Interpolated occlusion: contacts, thin walls, corners, and values that depend on earlier queries.
// The cache is compared with closed forms at visible points. Also: baked meshes.
#include "CacheScenes.h"
#include "Frames.h"
#include "Scenario.h"
#include "Surface.h"

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

/// Disables one mechanism of the cache.
using Ablation = void (*)(Cache*);

void UseHarmonicMean(Cache* cache)
{
  cache->SetRadiusRule(Cache::HARMONIC_MEAN);
}

/// [IC] limits the radius to at least 2 to 4 pixels.
void UseLargeMinimumRadius(Cache* cache)
{
  cache->SetMinimumRadius(32.0);
}

glm::dvec3 World(const Scene& scene, const RecordCandidate& site)
{
  return scene.ToWorld(site.Position);
}

/// A unit sphere with its center at `height` above a floor, which it touches at height 1. The image
/// has `size` x `size` pixels.
std::function<ScenarioResult(Variant)> Sphere(double height, int size, Ablation ablate)
{
  return [height, size, ablate](Variant variant) {
    Scene scene;
    ArrangeContact(scene, height, size);
    const RayScene rays(scene, 1);
    vtkNew<Cache> cache;
    cache->SetTolerance(.01);
    if (variant == Variant::Ablated)
    {
      ablate(cache);
    }
    cache->Begin(rays, Infinity, .02);
    ScenarioResult outcome{ 0.0, {} };
    outcome.Image = RenderFrame(
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

/// A concave corner of a floor and a wall, where [IC] computes radii of 0 or radii that are too
/// large.
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
    UseLargeMinimumRadius(cache);
  }
  cache->Begin(rays, 1.0, .02);
  ScenarioResult outcome{ 0.0, {} };
  outcome.Image = RenderFrame(
    rays, cache,
    [](glm::dvec3 position, glm::dvec3 normal) {
      const double a = normal.z > .5 ? -position.y : position.z;
      return a < 1.0 ? (std::acos(a) - a * std::sqrt(1.0 - a * a)) / std::acos(-1.0) : 0.0;
    },
    outcome.Value);
  return outcome;
}

/// An open room next to one with a low ceiling, separated by a sheet. Records of one room must not
/// be used in the other.
ScenarioResult ThinWall(Variant variant)
{
  Scene scene;
  ArrangeTwoRooms(scene);
  const RayScene rays(scene, 1);
  vtkNew<Cache> cache;
  if (variant == Variant::Ablated)
  {
    UseHarmonicMean(cache);
  }
  cache->Begin(rays, Infinity, .01);
  return { WorstBesideWall(rays, cache), RenderFrame(rays, cache) };
}

/// The inside of a closed box, where the whole hemisphere is occluded.
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
  const Frame image = RenderFrame(rays, cache);
  return { *std::max_element(image.Values.begin(), image.Values.end()), image };
}

/// Index of the i-th query of `count` in a different order than from first to last.
using QueryOrder = std::size_t (*)(std::size_t i, std::size_t count);

std::size_t ReversedOrder(std::size_t i, std::size_t count)
{
  return count - 1 - i;
}

/// All even queries before the odd ones.
std::size_t EvenThenOddOrder(std::size_t i, std::size_t count)
{
  const std::size_t even = (count + 1) / 2;
  return i < even ? 2 * i : 2 * (i - even) + 1;
}

/// The order of five threads that each process a fifth of the queries.
std::size_t FiveThreadOrder(std::size_t i, std::size_t count)
{
  const std::size_t block = count / 5;
  return i < 5 * block ? i % 5 * block + i / 5 : i;
}

/// The same queries in two orders, with records computed on one thread and on five.
std::function<ScenarioResult(Variant)> QueriedTwice(QueryOrder other)
{
  return [other](Variant variant) {
    Scene scene;
    ArrangeContact(scene, 1.0, 128);
    const RayScene rays(scene, 1);
    const std::vector<RecordCandidate> sites = CandidatesInImage(rays, 6);
    std::vector<double> values[2];
    Frame image;
    for (const bool isSecond : { false, true })
    {
      vtkNew<Cache> cache;
      cache->SetOrder(variant == Variant::Ablated ? Cache::LAZY : Cache::LEVELS);
      vtkSMPTools::LocalScope(
        vtkSMPTools::Config(isSecond ? 5 : 1), [&]() { cache->Begin(rays, Infinity, .02); });
      values[isSecond].resize(sites.size());
      for (std::size_t i = 0; i < sites.size(); ++i)
      {
        const std::size_t query = isSecond ? other(i, sites.size()) : i;
        const RecordCandidate& site = sites[query];
        values[isSecond][query] = Ask(cache, World(scene, site), site.Normal);
      }
      image = RenderFrame(rays, cache);
    }
    return ScenarioResult{ LargestDifference(values[0], values[1]), image };
  };
}

/// A sphere whose stored normals point inward.
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
  Frame image{ 24, static_cast<int>(values->GetNumberOfTuples()) / 24, {} };
  double worst = 0.0;
  for (int i = 0; i < image.Width * image.Height; ++i)
  {
    image.Values.push_back(1.0 - values->GetComponent(i, 0));
    worst = std::max(worst, values->GetComponent(i, 0));
  }
  return { worst, image };
}

/// A mesh in two units of length. Ablated: a fixed radius in world units.
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
  Frame image{ 24, static_cast<int>(baked[1].size()) / 24, baked[1] };
  image.Values.resize(static_cast<std::size_t>(image.Width) * image.Height);
  return { Rmse(baked[0], baked[1]), image };
}

}

std::vector<Scenario> IrradianceScenarios()
{
  const std::string rule = "radii from the second derivative: harmonic mean of the distances";
  const std::string limit = "minimum radius of 3 pixels: 32 pixels";
  const std::string lazy = "records before queries: the lazy order of [IC]";
  const std::string dependent = "[IC] depends on the order of queries";
  const std::string closedForm = " against the closed form";
  return {
    { "CacheContact", "a sphere on a floor" + closedForm, "still", Metric::Bias, .01, rule,
      "[IC] distant records overrule a contact shadow", "", Sphere(1.0, 256, UseHarmonicMean) },
    { "CacheHovering", "a sphere above a floor" + closedForm, "still", Metric::Bias, .01, rule,
      "[IC] distant records overrule a contact shadow", "", Sphere(1.5, 256, UseHarmonicMean) },
    { "CacheSmallImage", "a sphere on a floor, in an image of 128x128 pixels" + closedForm, "still",
      Metric::Bias, .0085, limit, "[IC] radii without bounds", "",
      Sphere(1.0, 128, UseLargeMinimumRadius) },
    { "CacheConcaveCorner", "a floor and a wall" + closedForm, "still", Metric::Bias, .005, limit,
      "[IC] radius 0 on concave surfaces", "", ConcaveCorner },
    { "CacheThinWall", "a dark and a bright room, separated by a sheet", "still", Metric::Leak, .05,
      rule, "[IC] radii are not clamped by nearby records", "", ThinWall },
    { "CacheClosedBox", "the inside of a closed box", "still", Metric::Leak, 0.0,
      "a wall of the box: one is missing", "", "", ClosedBox },
    { "CacheOrderOfQuestions", "a sphere on a floor, queried from first to last and in reverse",
      "still", Metric::MaximumDifference, 0.0, lazy, dependent, "", QueriedTwice(ReversedOrder) },
    { "CacheTiles", "the same, queried at once and in two parts", "still",
      Metric::MaximumDifference, 0.0, lazy, dependent, "", QueriedTwice(EvenThenOddOrder) },
    { "CacheThreads", "the same, queried in the order of one thread and of five", "still",
      Metric::MaximumDifference, 0.0, lazy, dependent, "", QueriedTwice(FiveThreadOrder) },
    { "BakedInvertedNormals", "an open sphere whose normals point inward", "still",
      Metric::MaximumDifference, 0.0, "computed normals: the normals of the data", "", "",
      InvertedNormals },
    { "BakedUnit", "a dented sphere of size 1e-6", "still", Metric::UnitIndependence, .01,
      "radius from the bounds: 0.2 units", "[ISAO] distances in scene units", "", BakedUnits },
  };
}

}
