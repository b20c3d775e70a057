// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangles that rasterization finds at samples are those that rays hit.
#include "Embree/CoincidentSurfaces.h"
#include "Rasterization/TileRasterizer.h"
#include "Scene.h"
#include "Scenes/Adversaries.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/OwenSobolSequence.h"
#include "Surface.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

using namespace penumbra;

namespace
{

constexpr int Side = 64;
constexpr int TileSide = 32;

float Next(std::uint32_t& state)
{
  state = MixBits(state + 1u);
  return static_cast<float>(state >> 8) * 0x1p-24f;
}

/// A camera at the origin that looks along -z.
Scene MakeView(bool parallel)
{
  Scene scene;
  scene.ViewCamera.Parallel = parallel;
  scene.ViewCamera.Width = Side;
  scene.ViewCamera.Height = Side;
  scene.ViewCamera.Center = glm::dvec2(0.5 * Side);
  scene.ViewCamera.PixelSize = (parallel ? 4.0 : 1.0) / Side;
  scene.ViewCamera.Near = 0.1;
  return scene;
}

/// Appends triangles of the given size at depths of 2 to 6.
void AddSoup(Surface& surface, int count, float size, std::uint32_t seed)
{
  for (int i = 0; i < count; ++i)
  {
    const float depth = 2.f + 4.f * Next(seed);
    const glm::vec3 center(3.f * Next(seed) - 1.5f, 3.f * Next(seed) - 1.5f, -depth);
    const auto first = static_cast<std::uint32_t>(surface.Positions.size());
    for (int k = 0; k < 3; ++k)
    {
      const float x = Next(seed) - 0.5f;
      const float y = Next(seed) - 0.5f;
      surface.Positions.push_back(center + size * glm::vec3(x, y, Next(seed) - 0.5f));
    }
    surface.Triangles.emplace_back(first, first + 1, first + 2);
  }
}

Ray MakeRay(const Camera& camera, glm::dvec2 p)
{
  Ray ray;
  ray.Origin = glm::vec3(camera.RayOrigin(p));
  ray.Direction = glm::vec3(camera.RayDirection(p));
  ray.Near = static_cast<float>(camera.Near);
  return ray;
}

struct Comparison
{
  int Samples = 0;
  int Different = 0; ///< samples at which rasterization finds another surface, triangle or none
  int RayPixels = 0; ///< pixels that require rays
};

/// Compares 64 samples of each pixel.
Comparison CompareWithRays(const Scene& scene, bool surfacesOnly = false)
{
  const RayScene rays(scene, 1);
  const TileGrid tiles{ glm::dvec2(0.0), TileSide, glm::ivec2(Side / TileSide) };
  const TriangleBins bins(scene, tiles, std::vector<char>(4, 1));
  Comparison result;
  SamplePoints points;
  std::vector<std::uint32_t> visible;
  for (int tile = 0; tile < 4; ++tile)
  {
    TileRasterizer rasterizer(rays, tiles, bins, tile);
    const glm::ivec2 origin = TileSide * glm::ivec2(tile % 2, tile / 2);
    for (int i = 0; i < TileSide * TileSide; ++i)
    {
      const glm::ivec2 pixel = origin + glm::ivec2(i % TileSide, i / TileSide);
      if (!rasterizer.SelectPixel(pixel))
      {
        ++result.RayPixels;
        continue;
      }
      points.Compute(static_cast<std::uint32_t>(i), 0, 64);
      rasterizer.Rasterize(points, visible);
      for (int k = i % 4; k < 64; k += 4) // rays are expensive
      {
        const Hit hit = rays.Intersect(
          MakeRay(scene.ViewCamera, glm::dvec2(pixel) + glm::dvec2(points.X[k], points.Y[k])));
        const PrimitiveId found = visible[k] == TileRasterizer::None
          ? PrimitiveId{ Hit::None, Hit::None }
          : rasterizer.GetTriangle(visible[k]);
        const bool isEqual =
          found.Surface == hit.Surface && (surfacesOnly || found.Primitive == hit.Primitive);
        ++result.Samples;
        result.Different += isEqual ? 0 : 1;
      }
    }
  }
  return result;
}

}

class Rasterization : public ::testing::TestWithParam<bool>
{
};

TEST_P(Rasterization, FindsTheHitsOfRays)
{
  for (const float size : { 0.02f, 0.2f, 2.f })
  {
    Scene scene = MakeView(GetParam());
    scene.Surfaces.resize(1);
    AddSoup(scene.Surfaces[0], 2000, size, 1u);
    const Comparison result = CompareWithRays(scene);
    EXPECT_EQ(result.RayPixels, 0);
    // Samples within rounding errors of an edge differ.
    EXPECT_LE(result.Different, 1e-4 * result.Samples) << size;
  }
}

TEST_P(Rasterization, CullsTheSidesThatRaysIgnore)
{
  Scene scene = MakeView(GetParam());
  scene.Surfaces.resize(2);
  AddSoup(scene.Surfaces[0], 500, 1.f, 2u);
  AddSoup(scene.Surfaces[1], 500, 1.f, 3u);
  scene.Surfaces[0].Backfaces = false;
  scene.Surfaces[1].Frontfaces = false;
  const Comparison result = CompareWithRays(scene);
  EXPECT_LE(result.Different, 1e-4 * result.Samples);
}

TEST_P(Rasterization, OrdersCoincidentSurfacesAsRaysDo)
{
  Scene scene = MakeView(GetParam());
  scene.Surfaces.resize(3);
  AddSoup(scene.Surfaces[0], 300, 1.5f, 4u);
  scene.Surfaces[1] = scene.Surfaces[0]; // later, thus in front
  scene.Surfaces[2] = scene.Surfaces[0]; // lines, thus in front of both
  scene.Surfaces[2].IsLineOrPoint = true;
  scene.Surfaces[2].Triangles.resize(150);
  const Comparison result = CompareWithRays(scene, true);
  EXPECT_LE(result.Different, 1e-4 * result.Samples);
}

TEST_P(Rasterization, LeavesNoGapsBetweenTriangles)
{
  Scene scene = MakeView(GetParam());
  scene.Surfaces.resize(1);
  Surface& surface = scene.Surfaces[0];
  constexpr std::uint32_t n = 300;
  std::uint32_t seed = 5u;
  for (std::uint32_t i = 0; i <= n; ++i)
  {
    for (std::uint32_t j = 0; j <= n; ++j)
    {
      const glm::vec2 at(6.f * i / n - 3.f, 6.f * j / n - 3.f);
      const float x = 0.003f * Next(seed);
      surface.Positions.emplace_back(at + glm::vec2(x, 0.003f * Next(seed)), -2.f - Next(seed));
      if (i < n && j < n)
      {
        const std::uint32_t a = i * (n + 1) + j;
        surface.Triangles.emplace_back(a, a + 1, a + n + 1);
        surface.Triangles.emplace_back(a + 1, a + n + 2, a + n + 1);
      }
    }
  }
  const RayScene rays(scene, 1);
  const TileGrid tiles{ glm::dvec2(0.0), TileSide, glm::ivec2(Side / TileSide) };
  const TriangleBins bins(scene, tiles, { 1, 0, 0, 0 });
  EXPECT_EQ(bins.GetCount(1), 0u);
  TileRasterizer rasterizer(rays, tiles, bins, 0);
  SamplePoints points;
  std::vector<std::uint32_t> visible;
  for (int i = 0; i < TileSide * TileSide; ++i)
  {
    ASSERT_TRUE(rasterizer.SelectPixel({ i % TileSide, i / TileSide }));
    points.Compute(static_cast<std::uint32_t>(i), 0, 256);
    rasterizer.Rasterize(points, visible);
    EXPECT_EQ(std::count(visible.begin(), visible.end(), TileRasterizer::None), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Camera, Rasterization, ::testing::Bool(),
  [](const ::testing::TestParamInfo<bool>& row) { return row.param ? "Parallel" : "Perspective"; });

TEST(TileRasterizer, LeavesWhatOnlyRaysCanDecide)
{
  // A translucent triangle in the left half, which an opaque one hides in the lower half, and a
  // triangle that the near plane cuts at the right.
  Scene scene = MakeView(false);
  scene.Surfaces.resize(2);
  const auto add = [&](int surface, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto first = static_cast<std::uint32_t>(scene.Surfaces[surface].Positions.size());
    scene.Surfaces[surface].Positions.insert(scene.Surfaces[surface].Positions.end(), { a, b, c });
    scene.Surfaces[surface].Triangles.emplace_back(first, first + 1, first + 2);
  };
  scene.Surfaces[1].Front.Opacity = 0.5f;
  add(1, { -20.f, -20.f, -4.f }, { -0.5f, -20.f, -4.f }, { -0.5f, 20.f, -4.f });
  add(0, { -20.f, -20.f, -3.f }, { 20.f, -20.f, -3.f }, { -0.5f, -0.5f, -3.f });
  add(0, { 0.4f, 0.2f, -1.f }, { 0.4f, -0.2f, -1.f }, { 0.4f, 0.f, 1.f });
  const RayScene rays(scene, 1);
  const TileGrid tiles{ glm::dvec2(0.0), TileSide, glm::ivec2(Side / TileSide) };
  const TriangleBins bins(scene, tiles, std::vector<char>(4, 1));
  TileRasterizer lower(rays, tiles, bins, 0);
  EXPECT_TRUE(lower.SelectPixel({ 16, 2 }));
  TileRasterizer upper(rays, tiles, bins, 2);
  EXPECT_FALSE(upper.SelectPixel({ 16, 40 }));
  EXPECT_TRUE(upper.SelectPixel({ 31, 40 }));
  TileRasterizer right(rays, tiles, bins, 3);
  EXPECT_FALSE(right.SelectPixel({ 60, 32 }));
}

TEST(SamplePoints, AreStratified)
{
  for (const auto& [first, count] : { std::pair(0, 64), std::pair(64, 64), std::pair(256, 256) })
  {
    SamplePoints points;
    points.Compute(7u, first, count);
    ASSERT_EQ(points.GetCount(), count);
    // One point in each cell of 8 by count / 8, 4 points in each cell of 4 by 4 of 64 points.
    std::set<std::pair<int, int>> cells;
    std::set<std::uint32_t> indices;
    for (int i = 0; i < count; ++i)
    {
      // The points keep a distance of 1e-4 from the sides of the pixel.
      const double x = (points.X[i] - 1e-4) / (1.0 - 2e-4);
      const double y = (points.Y[i] - 1e-4) / (1.0 - 2e-4);
      cells.emplace(static_cast<int>(x * 8.0 + 1e-6), static_cast<int>(y * count / 8.0 + 1e-6));
      indices.insert(points.Indices[i]);
      const int cell = i / points.GetCountPerCell();
      EXPECT_EQ(static_cast<int>(x * 4.0 + 1e-6), cell % 4);
      EXPECT_EQ(static_cast<int>(y * 4.0 + 1e-6), cell / 4);
    }
    EXPECT_EQ(cells.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(*indices.rbegin(), static_cast<std::uint32_t>(count - 1));
    EXPECT_EQ(indices.size(), static_cast<std::size_t>(count));
  }
}

TEST(TileRasterizer, AcceptsTrianglesFarOutsideOfTheImage)
{
  Scene scene = MakeView(false);
  scene.Surfaces.resize(1);
  Surface& surface = scene.Surfaces[0];
  std::uint32_t seed = 9u;
  for (int i = 0; i < 60; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const float size = std::pow(10.f, 36.f * Next(seed));
      const float x = Next(seed) - 0.5f;
      surface.Positions.push_back(size * glm::vec3(x, Next(seed) - 0.5f, -Next(seed)));
    }
    surface.Triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const Comparison result = CompareWithRays(scene, true);
  EXPECT_EQ(result.RayPixels, 0);
  EXPECT_LE(result.Different, 1e-4 * result.Samples);
}
