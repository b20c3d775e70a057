// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Hits in a scene that has only the triangles near the rays, as on a rank of a parallel program.
#include "Embree/RayScene.h"
#include "Scene.h"
#include "Surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

using namespace penumbra;

namespace
{

constexpr int Width = 1000;
constexpr int Height = 400;
/// Side of a pixel at depth 1 along +y.
constexpr double PixelSize = 0.8 / Width;

/// Returns a wavy sheet of 2 (n - 1)^2 triangles, in coordinates with the eye at the origin, from which many
/// of them are seen edge-on.
Surface MakeSheet(unsigned int n)
{
  const glm::dvec3 eye(0.1, -3.0, 0.5);
  Surface surface;
  for (unsigned int j = 0; j < n; ++j)
  {
    for (unsigned int i = 0; i < n; ++i)
    {
      const double u = 2.0 * i / (n - 1) - 1.0;
      const double v = 2.0 * j / (n - 1) - 1.0;
      surface.Positions.emplace_back(
        glm::dvec3(u, v, 0.2 * std::sin(19.0 * u) * std::cos(17.0 * v)) - eye);
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

double ProjectX(glm::vec3 point)
{
  return static_cast<double>(point.x) / point.y / PixelSize + 0.5 * Width;
}

/// Returns a scene of the triangles that are seen between two columns of pixels, and their indices.
std::pair<Scene, std::vector<std::uint32_t>> MakePart(const Surface& whole, double low, double high)
{
  std::pair<Scene, std::vector<std::uint32_t>> part;
  Surface surface;
  surface.Positions = whole.Positions;
  for (std::uint32_t i = 0; i < whole.Triangles.size(); ++i)
  {
    const std::array<glm::vec3, 3> points = whole.GetPoints(i);
    const double a = ProjectX(points[0]);
    const double b = ProjectX(points[1]);
    const double c = ProjectX(points[2]);
    if (std::min({ a, b, c }) < high + 2.0 && std::max({ a, b, c }) > low - 2.0)
    {
      surface.Triangles.push_back(whole.Triangles[i]);
      part.second.push_back(i);
    }
  }
  part.first.Surfaces.push_back(std::move(surface));
  return part;
}

Ray MakeRay(double x, double y)
{
  return { glm::vec3(0.f),
    glm::vec3((x - 0.5 * Width) * PixelSize, 1.0, (y - 0.5 * Height) * PixelSize - 0.15) };
}

/// Returns triangles with an edge in the plane x = 0, one above the other, the even ones on its left side. The
/// center of the scene is on the right or left side.
Surface MakeTrianglesAtPlane(unsigned int count, bool isCenterRight)
{
  Surface surface;
  for (unsigned int i = 0; i < count; ++i)
  {
    const float depth = -4.f - 0.3f * static_cast<float>(i * 7 % 10);
    const auto y = static_cast<float>(i);
    const float side = i % 2 == 0 ? -1.f : 1.f;
    surface.Positions.emplace_back(0.f, y, depth);
    surface.Positions.emplace_back(0.f, y + 1.f, depth - 0.2f);
    surface.Positions.emplace_back(side, y + 0.5f, depth + 0.1f);
    surface.Triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const auto whole = std::make_shared<WholeSurface>();
  whole->Primitives = count;
  whole->HasTriangles = true;
  whole->PositionBounds.Add(glm::vec3(isCenterRight ? -1.f : -3.f, 0.f, -10.f));
  whole->PositionBounds.Add(glm::vec3(isCenterRight ? 3.f : 1.f, 99.f, 0.f));
  surface.Whole = whole;
  return surface;
}

bool AreEqual(const Hit& a, const Hit& b)
{
  return a.Surface == b.Surface && a.Primitive == b.Primitive && a.U == b.U && a.V == b.V &&
    a.Distance == b.Distance && a.NextNear == b.NextNear;
}

}

TEST(RayScene, HitsAreIndependentOfOtherTriangles)
{
  constexpr int Strip = 100;
  constexpr int Side = 4;
  Scene whole;
  whole.Surfaces.push_back(MakeSheet(800));
  const RayScene wholeRays(whole, 1);
  int hitCount = 0;
  int differentCount = 0;
  for (int strip = 0; strip < Width; strip += Strip)
  {
    const auto [part, triangles] = MakePart(whole.Surfaces[0], strip, strip + Strip);
    const RayScene partRays(part, 1);
    for (int block = 0; block < Strip * Height / (Side * Side); ++block)
    {
      const int x = strip + block * Side % Strip;
      const int y = block / (Strip / Side) * Side;
      Ray rays[16];
      Hit expected[16];
      Hit hits[16];
      for (int i = 0; i < 16; ++i)
      {
        rays[i] = MakeRay(x + i % Side + 0.17, y + i / Side + 0.31);
      }
      wholeRays.Intersect16(rays, expected);
      partRays.Intersect16(rays, hits);
      for (int i = 0; i < 16; ++i)
      {
        const Hit single = wholeRays.Intersect(rays[i]);
        hits[i].Primitive = hits[i].IsHit() ? triangles[hits[i].Primitive] : hits[i].Primitive;
        hitCount += expected[i].IsHit();
        differentCount += !AreEqual(hits[i], expected[i]) || !AreEqual(single, expected[i]);
      }
    }
  }
  EXPECT_GT(hitCount, 200000);
  EXPECT_EQ(differentCount, 0);
}

TEST(RayScene, HitsInACoordinatePlaneAreIndependentOfOtherTriangles)
{
  constexpr unsigned int Count = 99;
  for (const bool isCenterRight : { false, true })
  {
    Scene whole;
    whole.Surfaces.push_back(MakeTrianglesAtPlane(Count, isCenterRight));
    const RayScene wholeRays(whole, 1);
    for (unsigned int i = 0; i < Count; ++i)
    {
      SCOPED_TRACE(testing::Message() << isCenterRight << " " << i);
      Scene part;
      part.Surfaces.push_back(whole.Surfaces[0]);
      part.Surfaces[0].Triangles = { whole.Surfaces[0].Triangles[i] };
      part.Surfaces[0].Triangles.reserve(2);
      const RayScene partRays(part, 1);
      const bool isHit = (i % 2 == 1) == isCenterRight;
      for (const RayScene* rays : { &wholeRays, &partRays })
      {
        const Ray ray{ glm::vec3(0.f, static_cast<float>(i) + 0.3f, 0.f),
          glm::vec3(0.f, 0.f, -1.f) };
        EXPECT_EQ(rays->Intersect(ray).IsHit(), isHit);
        EXPECT_EQ(rays->Occluded(ray), isHit);
        Ray packet[16];
        std::fill_n(packet, 16, ray);
        Hit hits[16];
        Hit half[8];
        bool occluded[16];
        rays->Intersect16(packet, hits);
        rays->Intersect8(packet, half);
        rays->Occluded16(packet, occluded);
        for (int lane = 0; lane < 16; ++lane)
        {
          EXPECT_EQ(hits[lane].IsHit(), isHit) << lane;
          EXPECT_EQ(half[lane % 8].IsHit(), isHit) << lane;
          EXPECT_EQ(occluded[lane], isHit) << lane;
        }
      }
    }
  }
}
