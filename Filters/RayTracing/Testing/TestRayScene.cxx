// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Embree/RayScene.h"
#include "Embree/RayTriangle.h"
#include "Embree/RoundIntersection.h"
#include "Scene.h"
#include "Surface.h"
#include "SurfaceInstances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

using namespace penumbra;

namespace
{

/// Returns a square [-1, 1]^2 at height z that faces +z.
Surface Square(float z, bool reserve = true)
{
  Surface surface;
  surface.Positions = { { -1.f, -1.f, z }, { 1.f, -1.f, z }, { 1.f, 1.f, z }, { -1.f, 1.f, z } };
  surface.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  if (reserve)
  {
    surface.Positions.reserve(5);
    surface.Triangles.reserve(3);
  }
  else
  {
    surface.Positions.shrink_to_fit();
    surface.Triangles.shrink_to_fit();
  }
  return surface;
}

/// Returns a wavy sheet of 2 (n - 1)^2 triangles below the camera.
Surface Sheet(unsigned int n)
{
  Surface surface;
  for (unsigned int j = 0; j < n; ++j)
  {
    for (unsigned int i = 0; i < n; ++i)
    {
      const float u = 2.f * static_cast<float>(i) / static_cast<float>(n - 1) - 1.f;
      const float v = 2.f * static_cast<float>(j) / static_cast<float>(n - 1) - 1.f;
      surface.Positions.emplace_back(u, v, -2.f + .2f * std::sin(9.f * u) * std::cos(7.f * v));
      if (i > 0 && j > 0)
      {
        const unsigned int k = j * n + i;
        surface.Triangles.emplace_back(k - n - 1, k - n, k);
        surface.Triangles.emplace_back(k - n - 1, k, k - 1);
      }
    }
  }
  return surface;
}

Ray Down(float x, float y, float z = 0.f)
{
  return { { x, y, z }, { 0.f, 0.f, -1.f } };
}

}

TEST(RayScene, FindsNearestSurfaceAndDistance)
{
  Scene scene;
  scene.Surfaces = { Square(-5.f), Square(-3.f, false) };
  const RayScene rays(scene, 1);
  const Hit hit = rays.Intersect(Down(.5f, -.25f));
  ASSERT_TRUE(hit.IsHit());
  EXPECT_EQ(hit.Surface, 1u);
  EXPECT_EQ(hit.Primitive, 0u);
  EXPECT_FLOAT_EQ(hit.Distance, 3.f);
  // The point from the weights of the corners (-1, -1), (1, -1), (1, 1).
  EXPECT_NEAR(-1.f + 2.f * hit.U + 2.f * hit.V, .5f, 1e-6);
  EXPECT_NEAR(-1.f + 2.f * hit.V, -.25f, 1e-6);
}

TEST(RayScene, MissesOutsideTheSurface)
{
  Scene scene;
  scene.Surfaces = { Square(-5.f) };
  const RayScene rays(scene, 1);
  EXPECT_FALSE(rays.Intersect(Down(1.5f, 0.f)).IsHit());
  Ray shortRay = Down(0.f, 0.f);
  shortRay.Far = 4.9f;
  EXPECT_FALSE(rays.Intersect(shortRay).IsHit());
  EXPECT_FALSE(rays.Occluded(shortRay));
}

TEST(RayScene, MissesWithoutTriangles)
{
  Scene scene;
  scene.Surfaces.resize(3);
  const RayScene rays(scene, 0);
  EXPECT_FALSE(rays.Intersect(Down(0.f, 0.f)).IsHit());
  EXPECT_FALSE(rays.Occluded(Down(0.f, 0.f)));
}

TEST(RayScene, TracesPacketsLikeSingleRays)
{
  Scene scene;
  scene.Surfaces = { Surface(), Square(-5.f), Square(-3.f) };
  scene.Surfaces[2].Positions[2].z = -6.f;
  const RayScene rays(scene, 2);
  Ray packet[16];
  Hit hits[16];
  for (int i = 0; i < 16; ++i)
  {
    packet[i] = Down(-1.3f + .37f * (i % 4) * 2.f, -1.31f + .371f * (i / 4) * 2.f);
  }
  packet[5].Near = 1.f;
  packet[5].Far = 0.f;
  rays.Intersect16(packet, hits);
  int hitCount = 0;
  for (int i = 0; i < 16; ++i)
  {
    if (i == 5)
    {
      EXPECT_FALSE(hits[i].IsHit());
      continue;
    }
    const Hit single = rays.Intersect(packet[i]);
    EXPECT_EQ(hits[i].Surface, single.Surface) << i;
    EXPECT_EQ(hits[i].Primitive, single.Primitive) << i;
    if (single.IsHit())
    {
      EXPECT_NEAR(hits[i].Distance, single.Distance, 1e-5);
      ++hitCount;
    }
  }
  EXPECT_GT(hitCount, 3);
}

TEST(RayScene, SelectsLowestTriangleAtEdge)
{
  // The diagonal of the square belongs to both triangles. A second square behind it has the same
  // diagonal.
  for (const bool reversed : { false, true })
  {
    Scene scene;
    scene.Surfaces = { Square(-5.f), Square(-6.f) };
    if (reversed)
    {
      std::swap(scene.Surfaces[0].Triangles[0], scene.Surfaces[0].Triangles[1]);
    }
    const RayScene rays(scene, 1);
    Ray packet[16];
    Hit hits[16];
    for (int i = 0; i < 16; ++i)
    {
      const float along = -.97f + .121f * i;
      packet[i] = Down(along, along);
    }
    rays.Intersect16(packet, hits);
    for (int i = 0; i < 16; ++i)
    {
      const Hit single = rays.Intersect(packet[i]);
      for (const Hit& hit : { single, hits[i] })
      {
        EXPECT_EQ(hit.Surface, 0u) << i;
        EXPECT_EQ(hit.Primitive, 0u) << i;
        EXPECT_EQ(hit.Distance, 5.f) << i;
        EXPECT_GT(hit.NextNear, 5.f) << i;
      }
      EXPECT_EQ(single.U, hits[i].U) << i;
      EXPECT_EQ(single.V, hits[i].V) << i;
    }
  }
}

TEST(RayScene, SelectsNoHiddenTriangleAtEdge)
{
  // The same diagonal, a relative distance of 0.001 behind, of triangles with lower indices.
  Surface surface = Square(-5.005f);
  const Surface front = Square(-5.f);
  surface.Positions.insert(surface.Positions.end(), front.Positions.begin(), front.Positions.end());
  surface.Triangles.insert(surface.Triangles.end(), { { 4, 5, 6 }, { 4, 6, 7 } });
  Scene scene;
  scene.Surfaces = { surface };
  const RayScene rays(scene, 1);
  const Hit hit = rays.Intersect(Down(.25f, .25f));
  EXPECT_EQ(hit.Primitive, 2u);
  Ray behind = Down(.25f, .25f);
  behind.Near = hit.NextNear;
  EXPECT_EQ(rays.Intersect(behind).Primitive, 0u);
}

TEST(RayScene, ResolvesDistantSurfacesCloseToEachOther)
{
  // Relative distance 1e-6; the surfaces are four times as wide as they are distant.
  const auto wall = [](float z) {
    Surface surface = Square(z);
    for (glm::vec3& position : surface.Positions)
    {
      position.x *= 2e6f;
      position.y *= 2e6f;
    }
    return surface;
  };
  Scene scene;
  scene.Surfaces = { wall(-1e6f), wall(-999999.f), wall(-1000001.f) };
  const RayScene rays(scene, 1);
  for (int i = 0; i < 1000; ++i)
  {
    const float x = .37f * std::sin(12.9f * static_cast<float>(i));
    const float y = .37f * std::cos(7.1f * static_cast<float>(i));
    const Hit hit = rays.Intersect({ glm::vec3(0.f), { x, y, -1.f } });
    EXPECT_EQ(hit.Surface, 1u) << x << ", " << y;
    EXPECT_EQ(hit.Distance, 999999.f) << x << ", " << y;
  }
}

TEST(RayTriangle, FindsWhetherARayPassesAnEdge)
{
  const Surface square = Square(-5.f);
  // 0.1 below the diagonal, then 0.2 above the lower edge.
  const RayTriangle inside(square, 0, Down(.3f, .3f - .1f * std::sqrt(2.f)));
  EXPECT_TRUE(inside.IsValid);
  EXPECT_TRUE(inside.IsFront);
  EXPECT_FALSE(inside.IsOnEdge);
  EXPECT_NEAR(inside.Distance, 5.0, 1e-12);
  EXPECT_FALSE(RayTriangle(square, 0, Down(.3f, -.8f)).IsOnEdge);
  const RayTriangle outside(square, 1, Down(.3f, .3f - .1f * std::sqrt(2.f)));
  EXPECT_FALSE(outside.IsOnEdge);
  EXPECT_TRUE(RayTriangle(square, 1, Down(.3f, .3f)).IsOnEdge);
  EXPECT_FALSE(RayTriangle(square, 0, { { 0.f, 0.f, 0.f }, { 1.f, 0.f, 0.f } }).IsValid);
}

TEST(RayScene, SkipsCulledSides)
{
  Scene scene;
  scene.Surfaces = { Square(-3.f), Square(-5.f) };
  scene.Surfaces[0].Frontfaces = false;
  const RayScene rays(scene, 1);
  EXPECT_EQ(rays.Intersect(Down(.1f, .2f)).Surface, 1u);
  const Ray up{ { .1f, .2f, -10.f }, { 0.f, 0.f, 1.f } };
  EXPECT_EQ(rays.Intersect(up).Surface, 1u);
  scene.Surfaces[1].Backfaces = false;
  EXPECT_EQ(RayScene(scene, 1).Intersect(up).Surface, 0u);
}

TEST(RayScene, IgnoresLinesAndPointsInOcclusion)
{
  Scene scene;
  scene.Surfaces = { Square(-3.f), Square(-5.f) };
  scene.Surfaces[0].IsLineOrPoint = true;
  const RayScene rays(scene, 1);
  Ray ray = Down(.1f, .2f);
  EXPECT_EQ(rays.Intersect(ray).Surface, 0u);
  EXPECT_TRUE(rays.Occluded(ray));
  ray.Far = 4.f;
  EXPECT_FALSE(rays.Occluded(ray));
}

namespace
{

/// Returns rays exactly through vertices and edge midpoints.
std::vector<Ray> RaysThrough(const Surface& surface)
{
  std::vector<Ray> rays;
  for (std::size_t i = 0; i + 1 < surface.Positions.size(); i += 7)
  {
    rays.push_back({ glm::vec3(0.f), surface.Positions[i] });
    rays.push_back({ glm::vec3(0.f), .5f * (surface.Positions[i] + surface.Positions[i + 1]) });
  }
  rays.resize(rays.size() / 16 * 16);
  return rays;
}

}

TEST(RayScene, IsIndependentOfThreadCount)
{
  Scene scene;
  scene.Surfaces = { Sheet(300), Sheet(150) };
  const RayScene one(scene, 1);
  const RayScene many(scene, 7);
  int different = 0;
  for (const Ray& ray : RaysThrough(scene.Surfaces[0]))
  {
    const Hit a = one.Intersect(ray);
    const Hit b = many.Intersect(ray);
    different += a.Surface != b.Surface || a.Primitive != b.Primitive || a.Distance != b.Distance;
  }
  EXPECT_EQ(different, 0);
}

TEST(RayScene, MissesWithInvalidRays)
{
  Scene scene;
  scene.Surfaces = { Square(-1.f) };
  const RayScene rays(scene, 1);
  const float nan = std::nanf("");
  const float infinity = std::numeric_limits<float>::infinity();
  const glm::vec3 down(0.f, 0.f, -1.f);
  const std::vector<Ray> none = { { { nan, 0.f, 0.f }, down }, { { 0.f, infinity, 0.f }, down },
    { { 0.f, 0.f, 1e20f }, down }, { {}, { 0.f, nan, -1.f } }, { {}, { 0.f, 0.f, -infinity } },
    { {}, { 0.f, 0.f, 0.f } }, { {}, down, nan }, { {}, down, -1.f }, { {}, down, 0.f, nan } };
  for (const Ray& ray : none)
  {
    EXPECT_FALSE(rays.Intersect(ray).IsHit());
    EXPECT_FALSE(rays.Occluded(ray));
    Ray packet[16];
    std::fill_n(packet, 16, Ray{ { .1f, .2f, 0.f }, down });
    packet[5] = ray;
    Hit hits[16];
    bool occluded[16];
    rays.Intersect16(packet, hits);
    rays.Occluded16(packet, occluded);
    for (int i = 0; i < 16; ++i)
    {
      EXPECT_EQ(hits[i].IsHit(), i != 5);
      EXPECT_EQ(occluded[i], i != 5);
    }
  }
}

TEST(RayScene, ComputesNormalsOfTinyTriangles)
{
  for (const float size : { 1.f, 1e-7f, 1e-12f, 1e-25f, 1e-38f })
  {
    Surface surface;
    surface.Positions = { { 0.f, 0.f, 0.f }, { size, 0.f, 0.f }, { 0.f, size, 0.f } };
    surface.Triangles = { { 0, 1, 2 } };
    EXPECT_EQ(glm::normalize(surface.ComputeNormal(0)), glm::vec3(0.f, 0.f, 1.f)) << size;
  }
}

TEST(RayScene, FindsEveryRoundShapeThatARayTouches)
{
  // Rays that pass the outline of a sphere or tube at a millionth of its radius inside, near and far
  // from the origin, in packets and alone.
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1.f, 1.f);
  const auto draw = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
  for (const float shift : { 0.f, 1000.f })
  {
    for (int repetition = 0; repetition < 100; ++repetition)
    {
      Surface surface;
      const glm::vec3 center = draw() + shift;
      surface.Positions = { center, center + 0.5f * draw() };
      surface.Positions.reserve(3);
      surface.Radii = { 0.1f * (1.2f + uniform(random)), 0.1f * (1.2f + uniform(random)) };
      if (repetition % 2 == 0)
      {
        surface.Segments = { { 0, 1 } };
      }
      Scene scene;
      scene.Surfaces = { surface };
      const RayScene rays(scene, 1);
      Ray packet[16];
      for (Ray& ray : packet)
      {
        const float u = surface.Segments.empty() ? 0.f : 0.5f + 0.5f * uniform(random);
        const glm::vec3 at = glm::mix(surface.Positions[0], surface.Positions[1], u);
        const float radius = glm::mix(surface.Radii[0], surface.Radii[1], u);
        ray.Direction = glm::normalize(draw());
        const glm::vec3 across = glm::normalize(glm::cross(ray.Direction, draw()));
        ray.Origin = at + (1.f - 1e-6f) * radius * across - 3.f * ray.Direction;
      }
      Hit hits[16];
      bool occluded[16];
      rays.Intersect16(packet, hits);
      rays.Occluded16(packet, occluded);
      for (int i = 0; i < 16; ++i)
      {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::uint32_t k = 0; k < surface.GetNumberOfPrimitives(); ++k)
        {
          const RoundIntersection range(
            surface.GetRoundShape(k), packet[i].Origin, packet[i].Direction);
          nearest = range.IsHit ? std::min(nearest, range.Enter) : nearest;
        }
        const bool expected = std::isfinite(nearest);
        ASSERT_EQ(hits[i].IsHit(), expected) << repetition;
        ASSERT_EQ(rays.Intersect(packet[i]).IsHit(), expected) << repetition;
        ASSERT_EQ(occluded[i], expected) << repetition;
        if (expected)
        {
          ASSERT_EQ(hits[i].Distance, static_cast<float>(nearest)) << repetition;
        }
      }
    }
  }
}

TEST(RayScene, FindsTheNearestOfManySpheres)
{
  // So many that their BVH groups them; some are equal, of which the last is hit, as in VTK.
  std::mt19937 random(6);
  std::uniform_real_distribution<float> uniform(-1.f, 1.f);
  const auto draw = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
  Surface surface;
  for (int i = 0; i < 500001; ++i)
  {
    surface.Positions.push_back(i % 10 == 9 ? surface.Positions.back() : draw());
    surface.Radii.push_back(i % 10 == 9 ? surface.Radii.back() : 0.004f + 0.002f * uniform(random));
  }
  Scene scene;
  scene.Surfaces = { surface };
  const RayScene rays(scene, 1);
  int hits = 0;
  for (int repetition = 0; repetition < 2; ++repetition)
  {
    Ray packet[16];
    for (Ray& ray : packet)
    {
      ray.Origin = draw();
      ray.Direction = glm::normalize(draw());
    }
    Hit found[16];
    bool occluded[16];
    rays.Intersect16(packet, found);
    rays.Occluded16(packet, occluded);
    for (int i = 0; i < 16; ++i)
    {
      float nearest = std::numeric_limits<float>::infinity();
      std::uint32_t last = 0;
      for (std::uint32_t k = 0; k < surface.Positions.size(); ++k)
      {
        const RoundIntersection range(
          surface.GetRoundShape(k), packet[i].Origin, packet[i].Direction);
        const auto distance = static_cast<float>(range.Enter >= 0.0 ? range.Enter : range.Leave);
        if (range.IsHit && distance >= packet[i].Near && distance <= nearest)
        {
          nearest = distance;
          last = k;
        }
      }
      ASSERT_EQ(found[i].IsHit(), std::isfinite(nearest));
      ASSERT_EQ(occluded[i], std::isfinite(nearest));
      if (found[i].IsHit())
      {
        ++hits;
        ASSERT_EQ(found[i].Distance, nearest);
        ASSERT_EQ(found[i].Primitive, last);
        const Hit single = rays.Intersect(packet[i]);
        ASSERT_EQ(single.Primitive, last);
      }
    }
  }
  EXPECT_GT(hits, 20);
}

TEST(RayScene, FindsTheLastOfEquallyDistantSpheresOfTwoSurfaces)
{
  std::mt19937 random(8);
  std::uniform_real_distribution<float> uniform(-1.f, 1.f);
  const auto draw = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
  Surface surface;
  for (int i = 0; i < 100; ++i)
  {
    surface.Positions.push_back(draw());
    surface.Radii.push_back(0.2f);
  }
  Scene scene;
  scene.Surfaces = { surface, surface };
  // The order of the spheres differs, so that either surface may be met first.
  std::reverse(scene.Surfaces[1].Positions.begin(), scene.Surfaces[1].Positions.end());
  for (int order = 0; order < 2; ++order)
  {
    const RayScene rays(scene, 1);
    int hits = 0;
    for (int i = 0; i < 1000; ++i)
    {
      const Hit hit = rays.Intersect({ draw(), glm::normalize(draw()) });
      hits += hit.IsHit() ? 1 : 0;
      EXPECT_EQ(hit.IsHit() ? hit.Surface : 1u, 1u);
    }
    EXPECT_GT(hits, 500);
    std::swap(scene.Surfaces[0], scene.Surfaces[1]);
  }
}

TEST(RayScene, FindsTheLastOfASphereAndAnInstanceAtTheSameDistance)
{
  Surface sphere;
  sphere.Positions = { { 0.f, 0.f, -5.f } };
  sphere.Radii = { 5.f };
  Surface square = Square(0.f);
  auto instances = std::make_shared<SurfaceInstances>();
  instances->Transforms = { glm::dmat4x3(1.0) };
  instances->Transforms[0][3] = { 0.0, 0.25, 0.0 };
  instances->Colors = { glm::u8vec4(255) };
  instances->Ids = { 0 };
  instances->Radius = 2.0;
  // If its box is higher, the square is met first.
  for (const double height : { 0.0, 1.0 })
  {
    instances->HalfSize = { 1.0, 1.0, height };
    square.Instances = std::make_shared<const SurfaceInstances>(*instances);
    for (const std::vector<Surface>& surfaces :
      { std::vector<Surface>{ sphere, square }, std::vector<Surface>{ square, sphere } })
    {
      Scene scene;
      scene.Surfaces = surfaces;
      const RayScene rays(scene, 1);
      const Hit hit = rays.Intersect(Down(0.f, 0.f, 20.f));
      ASSERT_TRUE(hit.IsHit());
      EXPECT_EQ(hit.Distance, 20.f);
      EXPECT_EQ(hit.Surface, 1u) << height << " " << surfaces[0].IsRound();
    }
  }
}
