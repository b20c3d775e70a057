// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the cache with closed forms over all pixels of an image.
#include "vtkPenumbraIrradianceCache.h"

#include "ClosedForms/FalloffOcclusion.h"
#include "Embree/RayScene.h"
#include "Records/PixelCandidates.h"
#include "Records/RecordOctree.h"
#include "Scenes/Solids.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace penumbra;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr int Size = 256;

/// Returns the visible points of all levels of candidates.
std::vector<RecordCandidate> FindVisiblePoints(const RayScene& rays)
{
  std::vector<RecordCandidate> all;
  for (int level = 0; level < ImageLevels; ++level)
  {
    const std::vector<RecordCandidate> sites = CandidatesInImage(rays, level);
    all.insert(all.end(), sites.begin(), sites.end());
  }
  return all;
}

/// Visible points and their scene.
struct View
{
  const Scene& SceneData;
  std::vector<RecordCandidate> Sites;

  glm::dvec3 World(const RecordCandidate& site) const
  {
    return glm::dvec3(site.Position) / this->SceneData.Scale + this->SceneData.Origin;
  }
};

double QueryOcclusion(const vtkPenumbraIrradianceCache* cache, glm::dvec3 position,
  glm::dvec3 normal = { 0.0, 0.0, 1.0 })
{
  return cache->Occlusion(&position.x, &normal.x).Value;
}

using Reference = std::function<double(glm::dvec3 position, glm::dvec3 normal)>;

double ComputeRmse(
  const vtkPenumbraIrradianceCache* cache, const View& view, const Reference& reference)
{
  double square = 0.0;
  for (const RecordCandidate& site : view.Sites)
  {
    const glm::dvec3 world = view.World(site);
    square +=
      std::pow(QueryOcclusion(cache, world, site.Normal) - reference(world, site.Normal), 2.0);
  }
  return std::sqrt(square / static_cast<double>(view.Sites.size()));
}

double GetStatistic(const vtkPenumbraIrradianceCache* cache, const char* name)
{
  vtkNew<vtkFieldData> statistics;
  cache->Report(statistics);
  return statistics->GetArray(name)->GetComponent(0, 0);
}

/// Makes a unit sphere with its center at height h above a floor, seen as in the benchmark.
void MakeSphereScene(Scene& scene, double h)
{
  AddFloor(scene, 1000.f);
  AddSphere(scene, { 0.0, 0.0, h }, 1.0, 400);
  LookAt(scene, { 0.0, -7.0, 4.0 }, { 0.0, 0.0, .6 }, 45.0, Size, Size);
}

Reference SphereReference(double h)
{
  return [h](glm::dvec3 position, glm::dvec3 normal) {
    const double square = position.x * position.x + position.y * position.y;
    return normal.z > .999999 && position.z < 1e-3 ? h / std::pow(h * h + square, 1.5)
                                                   : .5 * (1.0 - normal.z);
  };
}

}

TEST(vtkPenumbraIrradianceCache, MeetsToleranceUnderSphere)
{
  for (const double h : { 1.0, 1.5 })
  {
    Scene scene;
    MakeSphereScene(scene, h);
    const RayScene rays(scene, 0);
    const View view{ scene, FindVisiblePoints(rays) };
    for (const double tolerance : { .02, .005 })
    {
      vtkNew<vtkPenumbraIrradianceCache> cache;
      cache->SetTolerance(tolerance);
      cache->Begin(rays, Infinity, .01);
      EXPECT_LE(ComputeRmse(cache, view, SphereReference(h)), tolerance) << h << " " << tolerance;
      EXPECT_LE(GetStatistic(cache, "Cache/Records"), 500) << h << " " << tolerance;
      EXPECT_LE(GetStatistic(cache, "Rays/Gather"), 600000) << h << " " << tolerance;
    }
  }
}

TEST(vtkPenumbraIrradianceCache, MeetsToleranceInScreenSpace)
{
  for (const double h : { 1.0, 1.5 })
  {
    Scene scene;
    MakeSphereScene(scene, h);
    const RayScene rays(scene, 0);
    const View view{ scene, FindVisiblePoints(rays) };
    for (const double tolerance : { .02, .005 })
    {
      vtkNew<vtkPenumbraIrradianceCache> cache;
      cache->SetSpace(vtkPenumbraIrradianceCache::SCREEN);
      cache->SetTolerance(tolerance);
      cache->Begin(rays, Infinity, .01);
      EXPECT_LE(ComputeRmse(cache, view, SphereReference(h)), tolerance) << h << " " << tolerance;
      EXPECT_LE(GetStatistic(cache, "Cache/Records"), 1000) << h << " " << tolerance;
    }
  }
}

TEST(vtkPenumbraIrradianceCache, TracesRaysForInvisiblePointsInScreenSpace)
{
  Scene scene;
  MakeSphereScene(scene, 1.5);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->SetSpace(vtkPenumbraIrradianceCache::SCREEN);
  cache->SetTolerance(.005);
  cache->Begin(rays, Infinity, .01);
  const Reference reference = SphereReference(1.5);
  const glm::dvec3 points[] = { { 0.0, 1.0, 1.5 }, { 0.0, 4.0, 0.0 }, { 0.0, -9.0, 0.0 },
    { 30.0, 0.0, 0.0 } }; // behind and below the sphere; behind the camera; outside of the image
  for (const glm::dvec3& point : points)
  {
    const bool onSphere = point.z > 0.0;
    const glm::dvec3 normal(0.0, onSphere ? 1.0 : 0.0, onSphere ? 0.0 : 1.0);
    EXPECT_NEAR(QueryOcclusion(cache, point, normal), reference(point, normal), .02)
      << point.x << " " << point.y;
  }
}

TEST(vtkPenumbraIrradianceCache, BoundsErrorWithSplitSphereRadii)
{
  Scene scene;
  MakeSphereScene(scene, 1.5);
  const RayScene rays(scene, 0);
  const View view{ scene, FindVisiblePoints(rays) };
  for (const int rule :
    { vtkPenumbraIrradianceCache::NEAREST_HIT, vtkPenumbraIrradianceCache::HARMONIC_MEAN })
  {
    vtkNew<vtkPenumbraIrradianceCache> cache;
    cache->SetRadiusRule(rule);
    cache->SetTolerance(.01);
    cache->Begin(rays, Infinity, .01);
    EXPECT_LE(ComputeRmse(cache, view, SphereReference(1.5)), .03) << rule;
  }
}

TEST(vtkPenumbraIrradianceCache, MeetsToleranceNextToWallAndInCorner)
{
  constexpr float Far = 1000.f;
  Scene wall; // 1 high
  AddFloor(wall, Far);
  AddRectangle(wall, { -Far, 0, 0 }, { 2 * Far, 0, 0 }, { 0, 0, 1 });
  LookAt(wall, { 0, -4, 3 }, { 0, -.5, 0 }, 45.0, Size, Size);
  Scene corner; // with very large walls: occlusion is constant on the floor
  AddFloor(corner, Far);
  AddRectangle(corner, { -Far, 0, 0 }, { 2 * Far, 0, 0 }, { 0, 0, Far });
  AddRectangle(corner, { 0, -Far, 0 }, { 0, 2 * Far, 0 }, { 0, 0, Far });
  LookAt(corner, { -.3, -.4, .5 }, { -.1, -.1, 0 }, 45.0, Size, Size);
  for (const Scene* scene : { &wall, &corner })
  {
    const RayScene rays(*scene, 0);
    View view{ *scene, {} };
    for (const RecordCandidate& site : CandidatesInImage(rays, ImageLevels - 3))
    {
      if (site.Normal.z > .9f)
      {
        view.Sites.push_back(site);
      }
    }
    const Reference reference = [&](glm::dvec3 at, glm::dvec3) {
      return scene == &wall ? .5 * (1.0 - std::abs(at.y) / std::hypot(at.y, 1.0)) : .75;
    };
    for (const int space :
      { vtkPenumbraIrradianceCache::WORLD, vtkPenumbraIrradianceCache::SCREEN })
    {
      vtkNew<vtkPenumbraIrradianceCache> cache;
      cache->SetSpace(space);
      cache->SetTolerance(.005);
      cache->Begin(rays, Infinity, .01);
      EXPECT_LE(ComputeRmse(cache, view, reference), .005) << (scene == &wall) << " " << space;
    }
  }
}

TEST(vtkPenumbraIrradianceCache, PrefersNearRecordsToFarRecordsWithoutHits)
{
  // The plate is edge-on for far points: the rays of their records pass above and below it.
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { -1, -.5, 1 }, { 2, 0, 0 }, { 0, 1, 0 });
  LookAt(scene, { 0, -4, .9 }, { 0, 0, 0 }, 45.0, Size, Size);
  const RayScene rays(scene, 0);
  const auto corner = [](double a, double b) { // of a plate at height 1
    const double u = std::hypot(1.0, a);
    const double v = std::hypot(1.0, b);
    return (a / u * std::atan(b / u) + b / v * std::atan(a / v)) / (2.0 * std::acos(-1.0));
  };
  const Reference reference = [&](glm::dvec3 at, glm::dvec3 normal) {
    return normal.z < 0.0 ? 1.0
                          : corner(at.x + 1.0, at.y + .5) - corner(at.x - 1.0, at.y + .5) -
        corner(at.x + 1.0, at.y - .5) + corner(at.x - 1.0, at.y - .5);
  };
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->SetTolerance(.01);
  cache->Begin(rays, Infinity, .02);
  EXPECT_LE(ComputeRmse(cache, { scene, FindVisiblePoints(rays) }, reference), .01);
}

TEST(vtkPenumbraIrradianceCache, IsExactWithoutOccludersAndInClosedBox)
{
  Scene open;
  AddFloor(open, 100.f);
  LookAt(open, { 0.0, -7.0, 4.0 }, { 0.0, 0.0, .6 }, 45.0, Size, Size);
  Scene box;
  AddBox(box, { -3.f, -8.f, -1.f }, { 3.f, 4.f, 5.f });
  LookAt(box, { 0.0, -7.0, 4.0 }, { 0.0, 0.0, .6 }, 45.0, Size, Size);
  for (const Scene* scene : { &open, &box })
  {
    const RayScene rays(*scene, 0);
    const View view{ *scene, FindVisiblePoints(rays) };
    for (const int space :
      { vtkPenumbraIrradianceCache::WORLD, vtkPenumbraIrradianceCache::SCREEN })
    {
      vtkNew<vtkPenumbraIrradianceCache> cache;
      cache->SetSpace(space);
      cache->Begin(rays, Infinity, .01);
      for (const RecordCandidate& site : view.Sites)
      {
        ASSERT_EQ(QueryOcclusion(cache, view.World(site), site.Normal), scene == &open ? 0.0 : 1.0);
      }
    }
  }
}

TEST(vtkPenumbraIrradianceCache, IsIndependentOfThreadCountAndQueryOrder)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  const RayScene rays(scene, 0);
  const View view{ scene, FindVisiblePoints(rays) };
  for (const int space : { vtkPenumbraIrradianceCache::WORLD, vtkPenumbraIrradianceCache::SCREEN })
  {
    std::vector<double> values[2];
    for (const int threads : { 1, 5 })
    {
      vtkNew<vtkPenumbraIrradianceCache> cache;
      cache->SetSpace(space);
      vtkSMPTools::LocalScope(
        vtkSMPTools::Config(threads), [&]() { cache->Begin(rays, 2.0, .02); });
      for (std::size_t i = 0; i < view.Sites.size(); ++i)
      {
        const RecordCandidate& site = view.Sites[threads == 1 ? i : view.Sites.size() - 1 - i];
        values[threads == 1 ? 0 : 1].push_back(
          QueryOcclusion(cache, view.World(site), site.Normal));
      }
    }
    std::reverse(values[1].begin(), values[1].end());
    EXPECT_EQ(values[0], values[1]);
  }
}

TEST(vtkPenumbraIrradianceCache, DoesNotInterpolateThroughThinWall)
{
  // Two rooms separated by a thin wall; the left one has a low ceiling.
  Scene scene;
  AddFloor(scene, 4.f);
  AddRectangle(scene, { 0.f, -4.f, 0.f }, { 0.f, 8.f, 0.f }, { 0.f, 0.f, 4.f });
  AddRectangle(scene, { -4.f, -4.f, .5f }, { 4.f, 0.f, 0.f }, { 0.f, 8.f, 0.f });
  LookAt(scene, { 1.0, -9.0, 5.0 }, { 0.0, 0.0, 0.0 }, 40.0, Size, Size);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->Begin(rays, Infinity, .01);
  for (int i = 1; i < 100; ++i)
  {
    EXPECT_GT(QueryOcclusion(cache, { -.01 * i, -3.0, 0.0 }), .75)
      << i; // under the ceiling, mostly occluded
  }
  for (int i = 1; i < 30; ++i)
  {
    EXPECT_LT(QueryOcclusion(cache, { .01 * i, 0.0, 0.0 }), .52) << i; // next to the wall
  }
}

TEST(vtkPenumbraIrradianceCache, RecordsRoundTripThroughPolyData)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  scene.Scale = 4.0;
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> first;
  first->Begin(rays, 1.0, .02);
  vtkNew<vtkPolyData> records;
  first->GetRecords(records);
  ASSERT_GT(records->GetNumberOfPoints(), 100);
  EXPECT_TRUE(records->GetPointData()->GetArray("AmbientOcclusion"));
  EXPECT_EQ(records->GetNumberOfVerts(), records->GetNumberOfPoints());

  vtkNew<vtkPenumbraIrradianceCache> second;
  second->SetInitialRecords(records);
  second->Begin(rays, 1.0, .02);
  EXPECT_EQ(GetStatistic(second, "Cache/Records"), GetStatistic(first, "Cache/Records"));
  EXPECT_EQ(GetStatistic(second, "Rays/Gather"), 0);
  vtkNew<vtkPolyData> again;
  second->GetRecords(again);
  for (vtkIdType i = 0; i < records->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(again->GetPointData()->GetArray("Serves")->GetComponent(i, 0),
      records->GetPointData()->GetArray("Serves")->GetComponent(i, 0));
  }
  const View view{ scene, CandidatesInImage(rays, 6) };
  for (const RecordCandidate& site : view.Sites)
  {
    EXPECT_NEAR(QueryOcclusion(second, view.World(site), site.Normal),
      QueryOcclusion(first, view.World(site), site.Normal), 1e-3);
  }
}

TEST(vtkPenumbraIrradianceCache, ReloadsModifiedInitialRecords)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> first;
  first->Begin(rays, 1.0, .02);
  vtkNew<vtkPolyData> records;
  first->GetRecords(records);
  vtkNew<vtkPenumbraIrradianceCache> second;
  second->SetInitialRecords(records);
  second->Begin(rays, 1.0, .02);
  records->GetPointData()->GetArray("AmbientOcclusion")->Fill(.25);
  records->GetPointData()->GetArray("AmbientOcclusion")->Modified();
  second->Begin(rays, 1.0, .02);
  vtkNew<vtkPolyData> again;
  second->GetRecords(again);
  EXPECT_NEAR(again->GetPointData()->GetArray("AmbientOcclusion")->GetComponent(7, 0), .25, 1e-6);
}

TEST(vtkPenumbraIrradianceCache, MeetsToleranceInLazyOrder)
{
  Scene scene;
  MakeSphereScene(scene, 1.5);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->SetOrder(vtkPenumbraIrradianceCache::LAZY);
  cache->SetTolerance(.01);
  cache->Begin(rays, Infinity, .01);
  EXPECT_EQ(GetStatistic(cache, "Cache/Records"), 0);
  EXPECT_LE(ComputeRmse(cache, { scene, FindVisiblePoints(rays) }, SphereReference(1.5)), .02);
  EXPECT_GT(GetStatistic(cache, "Cache/Records"), 50);
}

TEST(vtkPenumbraIrradianceCache, ReusesRecordsForSameScene)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  int calls = 0;
  const auto count = [&calls](double) {
    ++calls;
    return false;
  };
  ASSERT_TRUE(cache->Begin(rays, 1.0, .02, count));
  const int firstCalls = calls;
  EXPECT_GT(firstCalls, 0);
  ASSERT_TRUE(cache->Begin(rays, 1.0, .02, count));
  EXPECT_EQ(calls, firstCalls);
  const RayScene another(scene, 0);
  ASSERT_TRUE(cache->Begin(another, 1.0, .02, count));
  EXPECT_EQ(calls, 2 * firstCalls);
}

TEST(vtkPenumbraIrradianceCache, RestartsAfterStop)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  EXPECT_FALSE(cache->Begin(rays, 1.0, .02, [](double fraction) { return fraction > .3; }));
  vtkNew<vtkPenumbraIrradianceCache> fresh;
  ASSERT_TRUE(cache->Begin(rays, 1.0, .02));
  ASSERT_TRUE(fresh->Begin(rays, 1.0, .02));
  EXPECT_EQ(GetStatistic(cache, "Cache/Records"), GetStatistic(fresh, "Cache/Records"));
}

TEST(vtkPenumbraIrradianceCache, MeetsToleranceNextToWallWithFalloff)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { -1000.f, 0, 0 }, { 2000.f, 0, 0 }, { 0, 0, 1000.f });
  LookAt(scene, { 0, -4, 3 }, { 0, -.5, 0 }, 45.0, Size, Size);
  const RayScene rays(scene, 0);
  View view{ scene, {} };
  for (const RecordCandidate& site : CandidatesInImage(rays, ImageLevels - 3))
  {
    if (site.Normal.z > .9f)
    {
      view.Sites.push_back(site);
    }
  }
  for (int falloff = 0; falloff < 4; ++falloff)
  {
    for (const double radius : { .5, 2.0 })
    {
      const FadingOcclusion fading{ radius, PowersOfFalloffs[falloff] };
      const Reference reference = [&](glm::dvec3 at, glm::dvec3) {
        return fading.BeforeWall(std::abs(at.y));
      };
      vtkNew<vtkPenumbraIrradianceCache> cache;
      cache->SetTolerance(.01);
      cache->Begin(rays, { radius, falloff }, .02);
      EXPECT_LE(ComputeRmse(cache, view, reference), .01) << falloff << " " << radius;
      EXPECT_LE(GetStatistic(cache, "Cache/Records"), 1500) << falloff << " " << radius;
    }
  }
}

TEST(vtkPenumbraIrradianceCache, RebuildsRecordsForNewFalloff)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  const glm::dvec3 point(1.2, 0.0, 0.0);
  cache->Begin(rays, 2.0, .02);
  const double whole = QueryOcclusion(cache, point);
  cache->Begin(rays, { 2.0, vtkPenumbraIrradianceProvider::LINEAR }, .02);
  EXPECT_LT(QueryOcclusion(cache, point), .8 * whole);
  cache->Begin(rays, 2.0, .02);
  EXPECT_EQ(QueryOcclusion(cache, point), whole);
}

TEST(vtkPenumbraIrradianceCache, DoesNotInterpolateFromPlateIntoShallowPocket)
{
  constexpr float Far = 1000.f;
  constexpr float Half = .3f;
  constexpr float Depth = .08f;
  Scene scene;
  AddRectangle(scene, { -Half, -Half, -Depth }, { 2 * Half, 0, 0 }, { 0, 2 * Half, 0 });
  for (const float side : { -1.f, 1.f })
  {
    AddRectangle(scene, { side * Half, -Half, -Depth }, { 0, 2 * Half, 0 }, { 0, 0, Depth });
    AddRectangle(scene, { -Half, side * Half, -Depth }, { 2 * Half, 0, 0 }, { 0, 0, Depth });
    AddRectangle(scene, { side * Half, -Far, 0 }, { side * Far, 0, 0 }, { 0, 2 * Far, 0 });
    AddRectangle(scene, { -Half, side * Half, 0 }, { 2 * Half, 0, 0 }, { 0, side * Far, 0 });
  }
  LookAt(scene, { 0, -2.4, 4 }, { 0, 0, 0 }, 45.0, Size, Size);
  const RayScene rays(scene, 0);
  View view{ scene, {} };
  for (const RecordCandidate& site : FindVisiblePoints(rays))
  {
    const glm::dvec3 world = glm::dvec3(site.Position) + scene.Origin;
    if (site.Normal.z > .9f && world.z < -.5 * Depth)
    {
      view.Sites.push_back(site);
    }
  }
  ASSERT_GT(view.Sites.size(), 200u);
  // The unoccluded part is a square above.
  const auto corner = [](double x, double y) {
    const double u = std::hypot(1.0, x);
    const double v = std::hypot(1.0, y);
    return (x / u * std::atan(y / u) + y / v * std::atan(x / v)) / (2.0 * 3.14159265358979);
  };
  const Reference reference = [&](glm::dvec3 at, glm::dvec3) {
    const double x0 = (-Half - at.x) / Depth;
    const double x1 = (Half - at.x) / Depth;
    const double y0 = (-Half - at.y) / Depth;
    const double y1 = (Half - at.y) / Depth;
    return 1.0 - (corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0));
  };
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->SetTolerance(.01);
  cache->Begin(rays, Infinity, .02);
  // Occlusion changes by half within five pixels of the walls. Interpolation from the plate gave
  // 0.25.
  EXPECT_LE(ComputeRmse(cache, view, reference), .025);
}

TEST(vtkPenumbraIrradianceCache, PlacesNoRecordOnLineOfCorner)
{
  // The center row of pixels hits the line of the corner between floor and wall.
  Scene scene;
  AddRectangle(scene, { -500, -500, 0 }, { 1000, 0, 0 }, { 0, 501, 0 });
  AddRectangle(scene, { -500, 0, 0 }, { 1000, 0, 0 }, { 0, 0, 500 });
  AddRectangle(scene, { -500, .01f, 0 }, { 1000, 0, 0 }, { 0, 0, 500 });
  LookAt(scene, { 0, -4, 3 }, { 0, 0, 0 }, 30.0, 65, 65);
  const RayScene rays(scene, 0);
  const View view{ scene, FindVisiblePoints(rays) };
  for (const int space : { vtkPenumbraIrradianceCache::WORLD, vtkPenumbraIrradianceCache::SCREEN })
  {
    vtkNew<vtkPenumbraIrradianceCache> cache;
    cache->SetSpace(space);
    cache->SetTolerance(.01);
    cache->Begin(rays, 1.0, .02);
    double maximum = 0.0;
    for (const RecordCandidate& site : view.Sites)
    {
      const glm::dvec3 world = view.World(site);
      const double a = site.Normal.z > .5f ? -world.y : world.z;
      if (a > .01 && a < .4)
      {
        const double reference = (std::acos(a) - a * std::sqrt(1.0 - a * a)) / std::acos(-1.0);
        maximum =
          std::max(maximum, std::abs(QueryOcclusion(cache, world, site.Normal) - reference));
      }
    }
    EXPECT_LT(maximum, .04) << space;
  }
}

TEST(vtkPenumbraIrradianceCache, RejectsNaNSettings)
{
  Scene scene;
  AddFloor(scene, 1.f);
  LookAt(scene, { 0, -2, 2 }, { 0, 0, 0 }, 45.0, Size, Size);
  const RayScene rays(scene, 0);
  for (auto set :
    { &vtkPenumbraIrradianceCache::SetTolerance, &vtkPenumbraIrradianceCache::SetMinimumRadius,
      &vtkPenumbraIrradianceCache::SetMaximumRadius, &vtkPenumbraIrradianceCache::SetNormalAngle })
  {
    vtkNew<vtkPenumbraIrradianceCache> cache;
    (cache.Get()->*set)(std::numeric_limits<double>::quiet_NaN());
    EXPECT_THROW(cache->Begin(rays, Infinity, .02), std::runtime_error);
  }
}

TEST(RecordOctree, ClampsRadiiOfRecordsThatContainNewRecord)
{
  constexpr float MinimumPixels = 2.f;
  Record wide;
  wide.Radius = 10.f;
  wide.MaximumPlaneDistance = .05f;
  wide.Gathered.Clearance.fill(100.f);
  Record narrow = wide;
  narrow.Position.x = 2.f;
  narrow.Radius = 1.f;
  Record invalid = narrow;
  invalid.Position.x = -1.f;
  invalid.IsValid = false;
  for (const bool wideFirst : { true, false })
  {
    RecordOctree tree;
    tree.Initialize(glm::vec3(0.f), 20.f);
    tree.InsertClamped(wideFirst ? wide : narrow, MinimumPixels);
    tree.InsertClamped(wideFirst ? narrow : wide, MinimumPixels);
    tree.InsertClamped(invalid, MinimumPixels);
    // The narrow record clamps the wide one only if the wide one contains it on insertion.
    EXPECT_EQ(tree.FindAt(wide)->Radius, wideFirst ? 3.f : 10.f);
    EXPECT_EQ(tree.FindAt(narrow)->Radius, 1.f);
  }
}

TEST(RecordOctree, KeepsMinimumRadiusWhenClamping)
{
  Record coarse;
  coarse.Radius = 10.f;
  coarse.MaximumPlaneDistance = 2.f;
  coarse.Gathered.Clearance.fill(100.f);
  Record fine = coarse;
  fine.Position.x = 1.f;
  fine.Radius = .5f;
  fine.MaximumPlaneDistance = .01f;
  RecordOctree tree;
  tree.Initialize(glm::vec3(0.f), 20.f);
  tree.InsertClamped(coarse, 3.f);
  tree.InsertClamped(fine, 3.f);
  EXPECT_EQ(tree.FindAt(coarse)->Radius, 6.f);
  EXPECT_EQ(tree.FindAt(fine)->Radius, .5f);
}

TEST(vtkPenumbraIrradianceCache, MultipliesOcclusionByOpacity)
{
  for (const float opacity : { 0.f, .1f, .5f, .9f, 1.f })
  {
    Scene scene;
    AddFloor(scene, 1000.f);
    AddRectangle(scene, { 0.f, -1000.f, 0.f }, { 0.f, 2000.f, 0.f }, { 0.f, 0.f, 1000.f });
    scene.Surfaces.back().Front.Opacity = opacity;
    LookAt(scene, { 4.0, -4.0, 4.0 }, { 1.0, 0.0, 0.0 }, 40.0, Size, Size);
    const RayScene rays(scene, 1);
    vtkNew<vtkPenumbraIrradianceCache> cache;
    cache->Begin(rays, Infinity, .005);
    double square = 0.0;
    int count = 0;
    for (double x = .1; x < 1.5; x += .1)
    {
      square += std::pow(QueryOcclusion(cache, { x, 0.0, 0.0 }) - .5 * opacity, 2.0);
      ++count;
    }
    EXPECT_LE(std::sqrt(square / count), .005) << opacity;
  }
}
