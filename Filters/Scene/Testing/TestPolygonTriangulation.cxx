// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/PolygonTriangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

using namespace penumbra;

namespace
{

using Corners = std::vector<glm::dvec3>;
using Triangles = std::vector<glm::uvec3>;

Triangles Triangulate(const Corners& corners)
{
  Triangles triangles;
  TriangulatePolygon(corners, triangles);
  return triangles;
}

/// Returns the sum of the triangles' absolute areas and the sum of their signed areas along +z.
std::pair<double, double> ComputeAreas(const Corners& corners)
{
  double positive = 0.0;
  double signedSum = 0.0;
  for (const glm::uvec3& t : Triangulate(corners))
  {
    const glm::dvec3 cross = glm::cross(corners[t.y] - corners[t.x], corners[t.z] - corners[t.x]);
    positive += 0.5 * glm::length(cross);
    signedSum += 0.5 * cross.z;
  }
  return { positive, signedSum };
}

/// Reference implementation: ear clipping that tests each corner against all remaining corners.
Triangles TriangulateNaively(const Corners& corners)
{
  glm::dvec3 normal(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  const auto orientation = [&](unsigned int p, unsigned int q, unsigned int x) {
    return glm::dot(glm::cross(corners[q] - corners[p], corners[x] - corners[p]), normal);
  };
  std::vector<unsigned int> ring(corners.size());
  std::iota(ring.begin(), ring.end(), 0u);
  Triangles triangles;
  std::size_t i = 1;
  while (ring.size() > 3)
  {
    const std::size_t size = ring.size();
    std::size_t rejected = 0;
    for (; rejected < size; ++rejected, ++i)
    {
      const unsigned int a = ring[(i + size - 1) % size];
      const unsigned int b = ring[i % size];
      const unsigned int c = ring[(i + 1) % size];
      if (orientation(a, b, c) > 0.0 && std::none_of(ring.begin(), ring.end(), [&](unsigned int x) {
            return x != a && x != b && x != c && orientation(a, b, x) > 0.0 &&
              orientation(b, c, x) > 0.0 && orientation(c, a, x) > 0.0;
          }))
      {
        break;
      }
    }
    i %= size;
    triangles.emplace_back(ring[(i + size - 1) % size], ring[i], ring[(i + 1) % size]);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    i %= ring.size();
  }
  triangles.emplace_back(ring[(i + 2) % 3], ring[i], ring[(i + 1) % 3]);
  return triangles;
}

/// Returns a comb with slanted teeth: corners between two teeth become ears only after the corners
/// above them are removed.
Corners MakeLeaningComb(int size)
{
  Corners comb{ { -1, 0, 0 }, { size, 0, 0 } };
  for (int i = size; i-- > 0;)
  {
    comb.emplace_back(i + (i & 1 ? 40.0 : 0.0), i & 1 ? 100.0 : 1.0 + 0.25 * i / size, 0.0);
  }
  return comb;
}

}

TEST(PolygonTriangulation, MatchesNaiveEarClippingForManyCorners)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> radius(0.2, 1.0);
  for (const int size : { 64, 65, 100, 300 })
  {
    Corners star;
    Corners crossed; // self-intersecting
    for (int i = 0; i < size; ++i)
    {
      const double angle = 6.283185307179586 * i / size;
      const double r = radius(generator);
      star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.3 * r);
      crossed.emplace_back(radius(generator), radius(generator), radius(generator));
    }
    for (const Corners& corners : { star, crossed, MakeLeaningComb(size) })
    {
      EXPECT_EQ(Triangulate(corners), TriangulateNaively(corners)) << size;
    }
  }
}

TEST(PolygonTriangulation, TriangulatesTensOfThousandsOfCorners)
{
  const Corners comb = MakeLeaningComb(50000);
  EXPECT_EQ(Triangulate(comb).size(), comb.size() - 2);
}

TEST(PolygonTriangulation, MakesFansOfConvexPolygons)
{
  Corners hexagon;
  for (int i = 0; i < 6; ++i)
  {
    hexagon.emplace_back(std::cos(i), std::sin(i), 0.3 * std::cos(i));
  }
  const Triangles triangles = Triangulate(hexagon);
  ASSERT_EQ(triangles.size(), 4u);
  for (unsigned int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(triangles[i], glm::uvec3(0, i + 1, i + 2));
  }
}

TEST(PolygonTriangulation, CoversConcavePolygonsOnce)
{
  // An L shape, a quadrilateral with a reflex corner, and a star.
  const Corners l{ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 }, { 0, 2, 0 } };
  EXPECT_NEAR(ComputeAreas(l).first, 3.0, 1e-12);
  EXPECT_NEAR(ComputeAreas(l).second, 3.0, 1e-12);
  const Corners dart{ { 0, 0, 0 }, { 1, 0.2, 0 }, { 2, 0, 0 }, { 1, 2, 0 } };
  EXPECT_NEAR(ComputeAreas(dart).first, ComputeAreas(dart).second, 1e-12);
  EXPECT_NEAR(ComputeAreas(dart).first, 1.8, 1e-12);
  Corners star;
  double area = 0.0;
  for (int i = 0; i < 20; ++i)
  {
    const double angle = i * 3.14159265358979323846 / 10.0;
    const double r = i % 2 ? 0.3 : 1.0;
    star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    area += 0.5 * 0.3 * std::sin(3.14159265358979323846 / 10.0);
  }
  EXPECT_NEAR(ComputeAreas(star).first, area, 1e-12);
  EXPECT_NEAR(ComputeAreas(star).second, area, 1e-12);
}

TEST(PolygonTriangulation, SkipsCoincidentCorners)
{
  const Corners corners{ { 0, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 0, 0 } };
  EXPECT_EQ(Triangulate(corners).size(), 1u);
  EXPECT_TRUE(Triangulate({ { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } }).empty());
  EXPECT_TRUE(Triangulate({ { 1, 1, 1 }, { 2, 1, 1 } }).empty());
  EXPECT_TRUE(Triangulate({}).empty());
}

TEST(PolygonTriangulation, TerminatesForSelfIntersectingPolygons)
{
  const Corners bow{ { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0.5, 0 } };
  EXPECT_EQ(Triangulate(bow).size(), 3u);
  const Corners line{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 }, { 4, 0, 0 } };
  EXPECT_EQ(Triangulate(line).size(), 3u);
}

TEST(PolygonTriangulation, TerminatesForNaNCorners)
{
  Corners comb = MakeLeaningComb(200);
  comb[77].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Triangulate(comb).size(), comb.size() - 2);
}
