// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Trees of oriented boxes: their hits against all triangles, and the number of triangles they test.
#include "Embree/SliverTree.h"
#include "Scene.h"
#include "Surface.h"

#include "Embree/BoxOverlap.h"
#include "Embree/RayScene.h"
#include "Embree/RayTriangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace penumbra;

namespace
{

/// Returns a flat disc of n triangles around the origin, of radius 1, at height -1. Facing +z.
Surface Disc(unsigned int n)
{
  Surface surface;
  surface.Positions.emplace_back(0.f, 0.f, -1.f);
  for (unsigned int i = 0; i < n; ++i)
  {
    const double angle = 2.0 * std::acos(-1.0) * i / n;
    surface.Positions.emplace_back(std::cos(angle), std::sin(angle), -1.f);
    surface.Triangles.emplace_back(0, 1 + i, 1 + (i + 1) % n);
  }
  return surface;
}

/// Returns rays into the directions of a spiral, downwards from the origin.
std::vector<Ray> SpiralRays(int count)
{
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i)
  {
    const double radius = 1.1 * std::sqrt((i + 0.5) / count); // some rays miss
    const double angle = 2.399963 * i;
    Ray ray;
    ray.Direction = { radius * std::cos(angle), radius * std::sin(angle), -1.0 };
    rays.push_back(ray);
  }
  return rays;
}

std::shared_ptr<const SliverTree> MakeIfUseful(const Surface& surface)
{
  return SliverTree::MakeIfUseful(surface, BoxOverlap(surface));
}

double MeanNumberOfTests(const SliverTree& tree, const std::vector<Ray>& rays)
{
  int tests = 0;
  for (const Ray& ray : rays)
  {
    const glm::dvec3 origin(ray.Origin);
    const glm::dvec3 direction(ray.Direction);
    double farthest = std::numeric_limits<double>::infinity();
    tree.VisitRay(origin, direction, 0.0, farthest, [&](std::uint32_t triangle) {
      ++tests;
      const double distance = ComputeDistance(tree.GetSurface(), triangle, origin, direction);
      farthest = distance < farthest ? distance : farthest;
    });
  }
  return static_cast<double>(tests) / static_cast<double>(rays.size());
}

}

TEST(SliverTree, TestsFewTrianglesOfLargeDiscs)
{
  const std::vector<Ray> rays = SpiralRays(2000);
  for (const unsigned int n : { 2000u, 16000u, 128000u })
  {
    const Surface disc = Disc(n);
    const SliverTree tree(disc);
    const double tests = MeanNumberOfTests(tree, rays);
    RecordProperty("Tests" + std::to_string(n), std::to_string(tests));
    EXPECT_LE(tests, 16.0) << n;
  }
}

// The rim of the cone is not perpendicular to its slivers.
TEST(SliverTree, TestsFewTrianglesAlongTheRimOfACone)
{
  for (const unsigned int n : { 2000u, 16000u, 128000u })
  {
    Surface cone = Disc(n);
    cone.Positions[0].z = -0.7f;
    for (std::size_t i = 2; i < cone.Positions.size(); i += 2)
    {
      cone.Positions[i].z += 0.05f;
    }
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; ++i)
    {
      const double height = (i + 0.5) / 2000; // of a point of the upper hemisphere
      const double radius = std::sqrt(1.0 - height * height);
      const double angle = 2.399963 * i;
      Ray ray;
      ray.Origin = cone.Positions[1 + static_cast<std::size_t>(i) * 61 % n];
      ray.Direction = { radius * std::cos(angle), radius * std::sin(angle), height };
      rays.push_back(ray);
    }
    const double tests = MeanNumberOfTests(SliverTree(cone), rays);
    RecordProperty("Tests" + std::to_string(n), std::to_string(tests));
    EXPECT_LE(tests, 8.0) << n;
  }
}

TEST(SliverTree, FindsTheHitsOfAllTriangles)
{
  Surface cone = Disc(1000);
  for (std::size_t i = 1; i < cone.Positions.size(); ++i)
  {
    cone.Positions[i].z += i % 2 == 0 ? 0.05f : 0.f;
  }
  const SliverTree tree(cone);
  int hits = 0;
  for (const Ray& ray : SpiralRays(500))
  {
    const glm::dvec3 origin(ray.Origin);
    const glm::dvec3 direction(ray.Direction);
    double expected = std::numeric_limits<double>::infinity();
    for (std::uint32_t triangle = 0; triangle < cone.Triangles.size(); ++triangle)
    {
      const double distance = ComputeDistance(tree.GetSurface(), triangle, origin, direction);
      expected = distance < expected ? distance : expected;
    }
    double actual = std::numeric_limits<double>::infinity();
    tree.VisitRay(origin, direction, 0.0, actual, [&](std::uint32_t triangle) {
      const double distance = ComputeDistance(tree.GetSurface(), triangle, origin, direction);
      actual = distance < actual ? distance : actual;
    });
    EXPECT_EQ(actual, expected);
    hits += std::isfinite(expected) ? 1 : 0;
  }
  EXPECT_GT(hits, 250);
}

TEST(SliverTree, FindsTrianglesNearAPoint)
{
  const Surface disc = Disc(5000);
  const SliverTree tree(disc);
  std::vector<std::uint32_t> near;
  const glm::dvec3 rim(disc.Positions[1 + 1234]);
  tree.VisitNear(rim, 1e-5, [&](std::uint32_t triangle) { near.push_back(triangle); });
  EXPECT_EQ(std::count(near.begin(), near.end(), 1233u), 1);
  EXPECT_EQ(std::count(near.begin(), near.end(), 1234u), 1);
  EXPECT_LE(near.size(), 16u);
}

TEST(SliverTree, IsUsedOnlyForSlivers)
{
  const Surface disc = Disc(20000);
  EXPECT_NE(MakeIfUseful(disc), nullptr);
  EXPECT_EQ(MakeIfUseful(Disc(100)), nullptr);
  EXPECT_EQ(MakeIfUseful(Surface()), nullptr);
  // Copies of one triangle overlap, but are not thin.
  Surface copies = Disc(3);
  copies.Triangles.assign(20000, copies.Triangles[0]);
  EXPECT_EQ(MakeIfUseful(copies), nullptr);
}

TEST(RayScene, HitsTheTrianglesOfALargeDisc)
{
  constexpr unsigned int Triangles = 20000;
  Scene scene;
  scene.Surfaces = { Disc(Triangles) };
  const RayScene rays(scene, 1);
  ASSERT_NE(rays.GetSlivers(0), nullptr);
  const std::vector<Ray> spiral = SpiralRays(1600);
  for (std::size_t first = 0; first < spiral.size(); first += 16)
  {
    Hit hits[16];
    bool occluded[16];
    rays.Intersect16(&spiral[first], hits);
    rays.Occluded16(&spiral[first], occluded);
    for (int i = 0; i < 16; ++i)
    {
      const Ray& ray = spiral[first + i];
      const double radius = std::hypot(ray.Direction.x, ray.Direction.y);
      const bool inside = radius < 1.0;
      ASSERT_EQ(hits[i].IsHit(), inside) << radius;
      EXPECT_EQ(occluded[i], inside);
      EXPECT_EQ(rays.Occluded(ray), inside);
      EXPECT_EQ(rays.Intersect(ray).Primitive, hits[i].Primitive);
      if (!inside || radius < 0.1)
      {
        continue;
      }
      EXPECT_FLOAT_EQ(hits[i].Distance, 1.f);
      const double angle = std::atan2(ray.Direction.y, ray.Direction.x) / (2.0 * std::acos(-1.0));
      const double expected = std::floor((angle < 0.0 ? angle + 1.0 : angle) * Triangles);
      EXPECT_NEAR(hits[i].Primitive, expected, 1.0);
    }
  }
}

TEST(RayScene, CullsTheTrianglesOfALargeDisc)
{
  Scene scene;
  scene.Surfaces = { Disc(20000) };
  scene.Surfaces[0].Frontfaces = false;
  const RayScene rays(scene, 1);
  ASSERT_NE(rays.GetSlivers(0), nullptr);
  Ray down;
  down.Direction = { 0.3f, 0.2f, -1.f };
  EXPECT_FALSE(rays.Intersect(down).IsHit());
  Ray up;
  up.Origin = { 0.f, 0.f, -2.f };
  up.Direction = { 0.3f, 0.2f, 1.f };
  EXPECT_TRUE(rays.Intersect(up).IsHit());
  up.Far = 0.5f;
  EXPECT_FALSE(rays.Intersect(up).IsHit());
}

TEST(BoxOverlap, GrowsWithCopiesAndNotWithTriangles)
{
  EXPECT_FALSE(BoxOverlap(Surface()).IsLarge());
  EXPECT_FALSE(BoxOverlap(Disc(100)).IsLarge());
  EXPECT_GT(BoxOverlap(Disc(4000)).Number, 30.0 * BoxOverlap(Disc(100)).Number);
}

TEST(RemoveCopies, KeepsTheFirstOfEachOrientation)
{
  Surface surface = Disc(4);
  EXPECT_TRUE(RemoveCopies(surface).empty());
  surface.Positions.push_back(surface.Positions[1]); // vertex 5, at the position of vertex 1
  surface.Triangles = { { 0, 1, 2 }, { 2, 0, 1 }, { 0, 2, 1 }, { 0, 5, 2 }, { 0, 2, 3 },
    { 2, 1, 0 } };
  constexpr std::uint32_t None = 0xffffffffu;
  const std::vector<glm::uvec3> expected = { { 0, 1, 2 }, glm::uvec3(None), { 0, 2, 1 },
    glm::uvec3(None), { 0, 2, 3 }, glm::uvec3(None) };
  EXPECT_EQ(RemoveCopies(surface), expected);
}

TEST(RayScene, HitsTheFirstOfManyCopies)
{
  Scene scene;
  scene.Surfaces = { Disc(3) };
  scene.Surfaces[0].Triangles.assign(5000, scene.Surfaces[0].Triangles[0]);
  scene.Surfaces[0].Triangles[0] = { 0, 2, 3 };
  const RayScene rays(scene, 1);
  Ray ray;
  ray.Direction = { 0.3f, 0.3f, -1.f };
  const Hit hit = rays.Intersect(ray);
  ASSERT_TRUE(hit.IsHit());
  EXPECT_EQ(hit.Primitive, 1u);
  EXPECT_TRUE(rays.Occluded(ray));
  ray.Near = hit.NextNear;
  EXPECT_FALSE(rays.Intersect(ray).IsHit());
}
