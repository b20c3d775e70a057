// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Embree/RayScene.h"
#include "Scene.h"
#include "Surface.h"
#include "Tessellation/DepthOffset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

using namespace penumbra;

namespace
{

/// Returns a square sheet of 2 n^2 triangles in a slanted plane in front of the camera.
Surface Slanted(unsigned int n)
{
  Surface surface;
  for (unsigned int j = 0; j <= n; ++j)
  {
    for (unsigned int i = 0; i <= n; ++i)
    {
      const double u = 2.0 * i / n - 1.0;
      const double v = 2.0 * j / n - 1.0;
      surface.Positions.emplace_back(u, v, -2.3 + .37 * u - .21 * v);
      if (i > 0 && j > 0)
      {
        const unsigned int k = j * (n + 1) + i;
        surface.Triangles.emplace_back(k - n - 2, k - n - 1, k);
        surface.Triangles.emplace_back(k - n - 2, k, k - 1);
      }
    }
  }
  return surface;
}

/// Returns one of 960 rays around the view axis.
Ray MakeRay(int i)
{
  const float angle = 2.39996f * static_cast<float>(i);
  const float radius = .01f * std::sqrt(static_cast<float>(i));
  return { glm::vec3(0.f), { radius * std::cos(angle), radius * std::sin(angle), -1.f } };
}

/// Returns the surfaces that each of 960 rays hits, which must be the same for all of them.
std::vector<std::uint32_t> FindLayers(const Scene& scene)
{
  const RayScene rays(scene, 1);
  std::vector<std::uint32_t> layers;
  for (int i = 0; i < 960; ++i)
  {
    std::vector<std::uint32_t> found;
    Ray ray = MakeRay(i);
    for (Hit hit = rays.Intersect(ray); hit.IsHit() && found.size() < 9; hit = rays.Intersect(ray))
    {
      found.push_back(hit.Surface);
      ray = ContinueBehind(ray, hit);
    }
    layers = i == 0 ? found : layers;
    EXPECT_EQ(found, layers) << i;
  }
  return layers;
}

Camera MakeCamera(bool parallel)
{
  Camera camera;
  camera.Parallel = parallel;
  camera.Width = camera.Height = 500;
  camera.Center = glm::dvec2(250.0);
  camera.PixelSize = parallel ? 0.005 : 0.002;
  camera.DepthUnit = 1e-5;
  return camera;
}

}

TEST(CoincidentSurfaces, AreInTheOrderInWhichVTKDrawsThem)
{
  const Surface first = Slanted(1);
  const Surface second = Slanted(20);
  Surface pane = first;
  pane.Front.Opacity = .5f;
  Surface line = first;
  line.IsLineOrPoint = true;
  Surface near = first;
  near.DepthRank = -1.f;
  using Layers = std::vector<std::uint32_t>;
  Scene scene;
  scene.Surfaces = { first, second };
  EXPECT_EQ(FindLayers(scene), (Layers{ 1, 0 })); // the later one first
  scene.Surfaces = { second, first };
  EXPECT_EQ(FindLayers(scene), (Layers{ 1, 0 }));
  scene.Surfaces = { pane, first, second };
  EXPECT_EQ(FindLayers(scene), (Layers{ 0, 2, 1 })); // translucent ones first
  scene.Surfaces = { near, pane, second, line };
  EXPECT_EQ(FindLayers(scene), (Layers{ 3, 0, 1, 2 }));
  Surface nearPane = pane;
  nearPane.DepthRank = -1.f;
  scene.Surfaces = { pane, first, pane, nearPane, second };
  EXPECT_EQ(FindLayers(scene), (Layers{ 3, 2, 4, 1 })); // translucent ones of one offset once
}

TEST(CoincidentSurfaces, DoNotHideSurfacesBehindThem)
{
  Surface behind = Slanted(3);
  for (glm::vec3& x : behind.Positions)
  {
    x.z -= .001f;
  }
  Scene scene;
  scene.Surfaces = { Slanted(1), behind, Slanted(20), Slanted(5) };
  EXPECT_EQ(FindLayers(scene), (std::vector<std::uint32_t>{ 3, 2, 0, 1 }));
}

TEST(CoincidentSurfaces, HaveOneHitForRaysThatSkipAllOfThem)
{
  Scene scene;
  scene.Surfaces = { Slanted(1), Slanted(20) };
  const RayScene rays(scene, 1);
  Ray packet[16];
  Hit hits[16];
  for (int i = 0; i < 16; ++i)
  {
    packet[i] = MakeRay(i);
  }
  rays.Intersect16(packet, hits);
  for (int i = 0; i < 16; ++i)
  {
    EXPECT_EQ(hits[i].Surface, 1u);
    Ray behind = packet[i];
    behind.Near = hits[i].NextNear;
    EXPECT_FALSE(rays.Intersect(behind).IsHit());
  }
}

TEST(OffsetSurface, KeepsTheProjection)
{
  for (const bool parallel : { false, true })
  {
    const Camera camera = MakeCamera(parallel);
    for (const double factor : { -1.0, 2.0 })
    {
      const Surface before = Slanted(20);
      Surface after = before;
      OffsetSurface(camera, { factor, 0.0 }, after);
      for (std::size_t i = 0; i < before.Positions.size(); ++i)
      {
        const glm::dvec3 a(before.Positions[i]);
        const glm::dvec3 b(after.Positions[i]);
        EXPECT_LT(glm::distance(camera.Project(a), camera.Project(b)), 1e-3);
        EXPECT_EQ(camera.Depth(b) > camera.Depth(a), factor > 0.0);
      }
      // The normals do not change.
      ASSERT_EQ(after.TriangleNormals.size(), before.Triangles.size());
      EXPECT_EQ(after.TriangleNormals[7], before.ComputeNormal(7));
    }
  }
}

TEST(OffsetSurface, ShiftsPlanesByTheirSlope)
{
  // The depth changes by .37 and .21 per unit of x and y.
  const Camera camera = MakeCamera(true);
  const double slope = std::hypot(.37, .21) * camera.PixelSize;
  Surface surface = Slanted(4);
  const glm::vec3 before = surface.Positions[7];
  OffsetSurface(camera, { -3.0, -2.0 }, surface);
  EXPECT_NEAR(surface.Positions[7].z - before.z, 3.0 * slope + 2.0 * camera.DepthUnit, 1e-6);
}

TEST(OffsetSurface, SeparatesCopiesAtGrazingIncidence)
{
  for (const bool parallel : { false, true })
  {
    const Camera camera = MakeCamera(parallel);
    for (const double slope : { 0.0, 1.0, 30.0, 300.0 })
    {
      for (const double units : { -1e-6, 1e-6 })
      {
        Surface floor;
        floor.Positions = { { -1.f, -.01f, -1.f }, { 1.f, -.01f, -1.f },
          { 1.f, .01f, -1.f - .02 * slope }, { -1.f, .01f, -1.f - .02 * slope } };
        floor.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
        floor.Positions.reserve(5);
        floor.Triangles.reserve(3);
        Surface moved = floor;
        OffsetSurface(camera, { 0.0, units }, moved);
        Scene scene;
        scene.Surfaces = { moved, floor };
        const RayScene rays(scene, 1);
        for (int i = 0; i < 200; ++i)
        {
          const double y = .00009 * ((37 * i) % 200 - 100);
          const double v = y / (1.0 + slope);
          const Ray ray = parallel ? Ray{ { .001 * i - .1, y, 0.0 }, { 0.f, 0.f, -1.f } }
                                   : Ray{ glm::vec3(0.f), { .001 * i - .1, v, -1.0 } };
          const Hit hit = rays.Intersect(ray);
          ASSERT_TRUE(hit.IsHit()) << slope;
          EXPECT_EQ(hit.Surface, units < 0.0 ? 0u : 1u) << slope << " " << i;
        }
      }
    }
  }
}
