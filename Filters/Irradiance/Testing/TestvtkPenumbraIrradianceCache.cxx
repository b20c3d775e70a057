// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the cache with closed forms over all pixels of an image.
#include "CacheView.h"
#include "Surface.h"

#include "ClosedForms/FalloffOcclusion.h"
#include "Embree/RayScene.h"
#include "Scenes/Solids.h"

#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra_testing;

TEST(vtkPenumbraIrradianceCache, MeetsToleranceUnderSphere)
{
  for (const double h : { 1.0, 1.5 })
  {
    Scene scene;
    MakeSphereScene(scene, h);
    const RayScene rays(scene, 0);
    const CacheView view{ scene, FindVisiblePoints(rays) };
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
    const CacheView view{ scene, FindVisiblePoints(rays) };
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
  const CacheView view{ scene, FindVisiblePoints(rays) };
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
    CacheView view{ *scene, {} };
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
    const CacheView view{ *scene, FindVisiblePoints(rays) };
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
  const CacheView view{ scene, FindVisiblePoints(rays) };
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

TEST(vtkPenumbraIrradianceCache, MeetsToleranceNextToWallWithFalloff)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { -1000.f, 0, 0 }, { 2000.f, 0, 0 }, { 0, 0, 1000.f });
  LookAt(scene, { 0, -4, 3 }, { 0, -.5, 0 }, 45.0, Size, Size);
  const RayScene rays(scene, 0);
  CacheView view{ scene, {} };
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
  CacheView view{ scene, {} };
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

TEST(vtkPenumbraIrradianceCache, JoinsPixelsOnlyIfItNeedsManyRecords)
{
  Scene smooth;
  MakeSphereScene(smooth, 1.5);
  Scene rough;
  for (int i = 0; i < 400; ++i)
  {
    AddSphere(rough, { .25 * (i % 20) - 2.5, .25 * (i / 20) - 2.5, .1 * (i % 3) }, .15, 20);
  }
  LookAt(rough, { 0.0, 0.0, 12.0 }, { 0.0, .01, 0.0 }, 30.0, Size, Size);
  const RayScene smoothRays(smooth, 0);
  const RayScene roughRays(rough, 0);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->JoinPixelsOn();
  cache->Begin(smoothRays, Infinity, .01);
  EXPECT_FALSE(cache->JoinsPixels(true, false));
  EXPECT_GT(GetStatistic(cache, "Cache/Records"), 0.0);
  cache->Begin(roughRays, Infinity, .01);
  EXPECT_TRUE(cache->JoinsPixels(true, false));
  EXPECT_EQ(GetStatistic(cache, "Cache/Records"), 0.0);
  // Points that are asked for alone are estimated without records.
  vtkNew<vtkPenumbraBruteForceIrradiance> rays;
  rays->Begin(roughRays, Infinity, .01);
  const CacheView view{ rough, CandidatesInImage(roughRays, 2) };
  ASSERT_FALSE(view.Sites.empty());
  for (const RecordCandidate& site : view.Sites)
  {
    const glm::dvec3 at = view.World(site);
    const glm::dvec3 normal(site.Normal);
    EXPECT_EQ(cache->Occlusion(&at.x, &normal.x).Value, rays->Occlusion(&at.x, &normal.x).Value);
  }
  cache->JoinPixelsOff();
  EXPECT_FALSE(cache->JoinsPixels(true, true));
}
