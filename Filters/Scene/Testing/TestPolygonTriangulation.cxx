// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Tessellation/PolygonTriangulation.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra;

namespace
{

using Corners = std::vector<glm::dvec3>;
using Triangles = std::vector<glm::uvec3>;

Triangles Cut(const Corners& corners)
{
  Triangles triangles;
  TriangulatePolygon(corners, triangles);
  return triangles;
}

/// The sum of the triangles' areas, each taken positive, and of their signed areas along +z.
std::pair<double, double> Areas(const Corners& corners)
{
  double positive = 0.0;
  double signedSum = 0.0;
  for (const glm::uvec3& t : Cut(corners))
  {
    const glm::dvec3 cross = glm::cross(corners[t.y] - corners[t.x], corners[t.z] - corners[t.x]);
    positive += .5 * glm::length(cross);
    signedSum += .5 * cross.z;
  }
  return { positive, signedSum };
}

}

TEST(PolygonTriangulation, IsAFanForConvexPolygons)
{
  Corners hexagon;
  for (int i = 0; i < 6; ++i)
  {
    hexagon.emplace_back(std::cos(i), std::sin(i), .3 * std::cos(i));
  }
  const Triangles triangles = Cut(hexagon);
  ASSERT_EQ(triangles.size(), 4u);
  for (unsigned int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(triangles[i], glm::uvec3(0, i + 1, i + 2));
  }
}

TEST(PolygonTriangulation, CoversConcavePolygonsOnce)
{
  // An L, a quadrilateral with a reflex corner, and a star.
  const Corners l{ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 }, { 0, 2, 0 } };
  EXPECT_NEAR(Areas(l).first, 3.0, 1e-12);
  EXPECT_NEAR(Areas(l).second, 3.0, 1e-12);
  const Corners dart{ { 0, 0, 0 }, { 1, .2, 0 }, { 2, 0, 0 }, { 1, 2, 0 } };
  EXPECT_NEAR(Areas(dart).first, Areas(dart).second, 1e-12);
  EXPECT_NEAR(Areas(dart).first, 1.8, 1e-12);
  Corners star;
  double area = 0.0;
  for (int i = 0; i < 20; ++i)
  {
    const double angle = i * 3.14159265358979323846 / 10.0;
    const double r = i % 2 ? .3 : 1.0;
    star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    area += .5 * .3 * std::sin(3.14159265358979323846 / 10.0);
  }
  EXPECT_NEAR(Areas(star).first, area, 1e-12);
  EXPECT_NEAR(Areas(star).second, area, 1e-12);
}

TEST(PolygonTriangulation, SkipsCornersThatCoincide)
{
  const Corners corners{ { 0, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 0, 0 } };
  EXPECT_EQ(Cut(corners).size(), 1u);
  EXPECT_TRUE(Cut({ { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } }).empty());
  EXPECT_TRUE(Cut({ { 1, 1, 1 }, { 2, 1, 1 } }).empty());
  EXPECT_TRUE(Cut({}).empty());
}

TEST(PolygonTriangulation, EndsOnPolygonsThatCrossThemselves)
{
  const Corners bow{ { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, .5, 0 } };
  EXPECT_EQ(Cut(bow).size(), 3u);
  const Corners line{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 }, { 4, 0, 0 } };
  EXPECT_EQ(Cut(line).size(), 3u);
}
