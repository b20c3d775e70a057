// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangles near a point, against the distances to dense samples of all triangles.
#include "Embree/RayScene.h"
#include "Scene.h"
#include "Surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>

using namespace penumbra;

namespace
{

/// Returns a number in [-1, 1], the same with every standard library.
float Draw(std::mt19937& random)
{
  return static_cast<float>(random() / 2147483647.5 - 1.0);
}

/// Returns the distance between a point and the nearest of a grid of points of the triangle.
double ComputeSampledDistance(const Surface& surface, std::uint32_t triangle, glm::vec3 point)
{
  constexpr int Steps = 200;
  const auto [a, b, c] = surface.GetPoints(triangle);
  double nearest = 1e30;
  for (int i = 0; i <= Steps; ++i)
  {
    for (int j = 0; j <= Steps - i; ++j)
    {
      const glm::vec3 at = a + float(i) / Steps * (b - a) + float(j) / Steps * (c - a);
      nearest = std::min(nearest, static_cast<double>(glm::distance(at, point)));
    }
  }
  return nearest;
}

using Found = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Found FindNear(const RayScene& rays, glm::vec3 point, float radius)
{
  Found found;
  VisitTrianglesNear(rays, point, radius, [&](std::uint32_t surface, std::uint32_t triangle) {
    found.emplace(surface, triangle);
    return false;
  });
  return found;
}

}

TEST(NearTriangles, MatchSampledDistances)
{
  std::mt19937 random(5);
  Scene scene;
  scene.Surfaces.resize(2);
  for (Surface& surface : scene.Surfaces)
  {
    for (unsigned int i = 0; i < 60; ++i)
    {
      surface.Positions.emplace_back(Draw(random), Draw(random), Draw(random));
    }
    for (unsigned int i = 0; i < 20; ++i)
    {
      surface.Triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
  }
  const RayScene rays(scene, 1);
  for (int k = 0; k < 20; ++k)
  {
    const glm::vec3 point(Draw(random), Draw(random), Draw(random));
    const float radius = .2f;
    const Found found = FindNear(rays, point, radius);
    for (std::uint32_t surface = 0; surface < 2; ++surface)
    {
      for (std::uint32_t triangle = 0; triangle < 20; ++triangle)
      {
        const double distance = ComputeSampledDistance(scene.Surfaces[surface], triangle, point);
        if (std::abs(distance - radius) > .01)
        {
          EXPECT_EQ(found.count({ surface, triangle }) == 1, distance < radius) << distance;
        }
      }
    }
  }
}

TEST(NearTriangles, NearestOfAcceptedPrimitivesMatchesSampledDistances)
{
  std::mt19937 random(7);
  Scene scene;
  scene.Surfaces.resize(2);
  Surface& triangles = scene.Surfaces[0];
  for (unsigned int i = 0; i < 20; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      triangles.Positions.emplace_back(Draw(random), Draw(random), Draw(random));
    }
    triangles.Triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  Surface& spheres = scene.Surfaces[1];
  spheres.Radii = { .1f };
  for (int i = 0; i < 4; ++i)
  {
    spheres.Positions.emplace_back(Draw(random), Draw(random), Draw(random));
  }
  const RayScene rays(scene, 1);
  for (int k = 0; k < 40; ++k)
  {
    const glm::vec3 point(Draw(random), Draw(random), Draw(random));
    for (const bool acceptsSpheres : { false, true })
    {
      double expected = 1e30;
      for (std::uint32_t triangle = 1; triangle < 20; triangle += 2)
      {
        expected = std::min(expected, ComputeSampledDistance(triangles, triangle, point));
      }
      for (std::size_t i = 0; i < 4 && acceptsSpheres; ++i)
      {
        const double center = glm::distance(spheres.Positions[i], point);
        expected = std::min(expected, std::max(center - .1, 0.0));
      }
      const float found =
        FindNearest(rays, point, .5f, [&](std::uint32_t surface, std::uint32_t primitive) {
          return surface == 1 ? acceptsSpheres : primitive % 2 == 1;
        });
      if (std::abs(expected - .5) > .01)
      {
        EXPECT_NEAR(std::min<double>(found, 1.0), expected < .5 ? expected : 1.0, .01);
      }
    }
  }
}

TEST(NearTriangles, AreFoundInFansOfSliversAndStopOnRequest)
{
  constexpr unsigned int Count = 20000;
  Scene scene;
  scene.Surfaces.resize(1);
  Surface& fan = scene.Surfaces[0];
  fan.Positions.emplace_back(0.f, 0.f, 0.f);
  for (unsigned int i = 0; i < Count; ++i)
  {
    const double angle = 2.0 * std::acos(-1.0) * i / Count;
    fan.Positions.emplace_back(std::cos(angle), std::sin(angle), .3 * std::sin(40.0 * angle));
    fan.Triangles.emplace_back(0, 1 + i, 1 + (i + 1) % Count);
  }
  const RayScene rays(scene, 1);
  for (unsigned int i = 0; i < Count; i += 997)
  {
    const glm::uvec3 corners = fan.Triangles[i];
    const glm::vec3 point = (fan.Positions[corners.y] + fan.Positions[corners.z]) / 2.f;
    const Found found = FindNear(rays, point, 1e-6f);
    EXPECT_EQ(found.count({ 0u, i }), 1u) << i;
    EXPECT_LE(found.size(), 4u) << i;
  }
  int visited = 0;
  VisitTrianglesNear(rays, glm::vec3(0.f), 1e-3f, [&](std::uint32_t, std::uint32_t) {
    ++visited;
    return visited == 3;
  });
  EXPECT_EQ(visited, 3);
}
