// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of surfaces of overlapping triangles in one plane: their hits against all triangles, and the
// number of triangles they list.
#include "Embree/PlanarCells.h"
#include "Scene.h"
#include "Surface.h"

#include "Embree/BoxOverlap.h"
#include "Embree/RayScene.h"
#include "Embree/RayTriangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

using namespace penumbra;

namespace
{

/// Returns n random triangles in the square of the corners `origin` +- `x` +- `y`.
Surface RandomTriangles(unsigned int n, glm::vec3 origin, glm::vec3 x, glm::vec3 y)
{
  std::mt19937 generator(7);
  const auto random = [&] { return static_cast<float>(generator() * 0x1p-31 - 1.0); };
  Surface surface;
  for (unsigned int i = 0; i < n; ++i)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const float u = random();
      surface.Positions.push_back(origin + u * x + random() * y);
    }
    surface.Triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return surface;
}

Surface RandomTrianglesOnFloor(unsigned int n)
{
  return RandomTriangles(n, { 0.f, 0.f, -1.f }, { 1.f, 0.f, 0.f }, { 0.f, 1.f, 0.f });
}

std::shared_ptr<const PlanarCells> MakeIfUseful(const Surface& surface)
{
  return PlanarCells::MakeIfUseful(surface, BoxOverlap(surface));
}

/// Returns rays from around (0, 0, 3) to a grid of points of the square of RandomTriangles, and
/// beyond.
std::vector<Ray> GridRays(glm::vec3 origin, glm::vec3 x, glm::vec3 y)
{
  constexpr int Side = 32;
  std::vector<Ray> rays;
  for (int i = 0; i < Side * Side; ++i)
  {
    const float u = 1.05f * (2.f * (i % Side + 0.37f) / Side - 1.f);
    const float v = 1.05f * (2.f * (i / Side + 0.59f) / Side - 1.f);
    Ray ray;
    ray.Origin = { 0.2f * v, 0.1f * u, 3.f };
    ray.Direction = origin + u * x + v * y - ray.Origin;
    rays.push_back(ray);
  }
  return rays;
}

}

TEST(PlanarCells, ListFewOfManyTriangles)
{
  for (const unsigned int n : { 1000u, 8000u, 64000u })
  {
    const auto cells = MakeIfUseful(RandomTrianglesOnFloor(n));
    ASSERT_NE(cells, nullptr) << n;
    double listed = 0.0;
    double area = 0.0;
    for (std::size_t cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      const glm::vec3 size = cells->GetBox(cell).High - cells->GetBox(cell).Low;
      area += size.x * size.y;
      cells->VisitTriangles(cell, [&](std::uint32_t) {
        listed += size.x * size.y;
        return false;
      });
    }
    RecordProperty("Listed" + std::to_string(n), std::to_string(listed / area));
    RecordProperty("Cells" + std::to_string(n), std::to_string(cells->GetNumberOfCells()));
    EXPECT_LE(listed / area, 8.0) << n;
    EXPECT_LE(cells->GetNumberOfCells(), 2 * n) << n;
    EXPECT_LE(area, 4.01) << n;
  }
}

class PlanarCellsOfPlane : public ::testing::TestWithParam<glm::vec3>
{
};

// The plane contains the vector that is the parameter.
TEST_P(PlanarCellsOfPlane, FindTheTriangleOfLowestIndex)
{
  const glm::vec3 origin(0.1f, -0.2f, -1.f);
  const glm::vec3 x = this->GetParam();
  const glm::vec3 y = glm::normalize(glm::cross({ 0.1f, 0.2f, 1.f }, x));
  Scene scene;
  scene.Surfaces = { RandomTriangles(1000, origin, x, y) };
  const RayScene rays(scene, 1);
  ASSERT_NE(rays.GetCells(0), nullptr);
  const std::vector<Ray> grid = GridRays(origin, x, y);
  int hitCount = 0;
  for (std::size_t first = 0; first < grid.size(); first += 16)
  {
    Hit hits[16];
    bool occluded[16];
    rays.Intersect16(&grid[first], hits);
    rays.Occluded16(&grid[first], occluded);
    for (int i = 0; i < 16; ++i)
    {
      const Ray& ray = grid[first + i];
      std::uint32_t expected = Hit::None;
      for (std::uint32_t t = 0; t < 1000 && expected == Hit::None; ++t)
      {
        const double distance =
          ComputeDistance(scene.Surfaces[0], t, glm::dvec3(ray.Origin), glm::dvec3(ray.Direction));
        expected = std::isfinite(distance) ? t : expected;
      }
      const bool isHit = expected != Hit::None;
      ASSERT_EQ(hits[i].IsHit(), isHit);
      EXPECT_EQ(hits[i].Primitive, expected);
      EXPECT_EQ(rays.Intersect(ray).Primitive, expected);
      EXPECT_EQ(occluded[i], isHit);
      EXPECT_EQ(rays.Occluded(ray), isHit);
      if (isHit)
      {
        EXPECT_NEAR(hits[i].Distance, 1.f, 1e-5);
        ++hitCount;
        Ray next = ray;
        next.Near = hits[i].NextNear + 1e-5f;
        EXPECT_FALSE(rays.Intersect(next).IsHit());
      }
    }
  }
  EXPECT_GT(hitCount, 800);
  EXPECT_LT(hitCount, 1000);
}

INSTANTIATE_TEST_SUITE_P(Planes, PlanarCellsOfPlane,
  ::testing::Values(
    glm::vec3(1.f, 0.f, 0.f), glm::vec3(0.6f, 0.5f, 0.7f), glm::vec3(-0.3f, 0.8f, 0.5f)));

TEST(PlanarCells, AreUsedOnlyForOverlapInOnePlane)
{
  const Surface floor = RandomTrianglesOnFloor(1000);
  ASSERT_NE(MakeIfUseful(floor), nullptr);
  EXPECT_EQ(MakeIfUseful(Surface()), nullptr);
  EXPECT_EQ(MakeIfUseful(RandomTrianglesOnFloor(50)), nullptr);
  Surface bent = floor;
  bent.Positions[100].z += 1e-4f;
  EXPECT_EQ(MakeIfUseful(bent), nullptr);
  Surface invalid = floor;
  invalid.Positions[100].x = std::nanf("");
  EXPECT_EQ(MakeIfUseful(invalid), nullptr);
  Surface culled = floor;
  culled.Backfaces = false;
  EXPECT_EQ(MakeIfUseful(culled), nullptr);
  Surface lines = floor;
  lines.IsLineOrPoint = true;
  EXPECT_EQ(MakeIfUseful(lines), nullptr);
  // Copies are removed instead.
  Surface copies = RandomTrianglesOnFloor(1);
  copies.Triangles.assign(1000, copies.Triangles[0]);
  EXPECT_EQ(MakeIfUseful(copies), nullptr);
}

TEST(PlanarCells, AreNotUsedIfTheyAreTooMany)
{
  // Only very small cells are covered by a triangle of width 0.01.
  Surface slivers = RandomTrianglesOnFloor(16000);
  for (std::size_t i = 0; i < slivers.Positions.size(); i += 3)
  {
    const glm::vec3 along = slivers.Positions[i + 1] - slivers.Positions[i];
    slivers.Positions[i + 2] =
      slivers.Positions[i] + 0.01f * glm::normalize(glm::vec3(-along.y, along.x, 0.f));
  }
  const BoxOverlap overlap(slivers);
  ASSERT_GT(overlap.Number, 16.0 * overlap.Thinness); // the mean number of triangles over a point
  EXPECT_EQ(PlanarCells::MakeIfUseful(slivers, overlap), nullptr);
}
