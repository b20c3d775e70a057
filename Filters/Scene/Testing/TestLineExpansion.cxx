// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Tessellation/LineExpansion.h"

#include <gtest/gtest.h>

using namespace penumbra;

namespace
{

Camera Perspective()
{
  Camera eye;
  eye.Width = eye.Height = 100;
  eye.Center = { 50.0, 50.0 };
  eye.PixelSize = .01;
  eye.Near = 1e-6;
  return eye;
}

Camera Parallel()
{
  Camera eye = Perspective();
  eye.Parallel = true;
  eye.Near = 0.0;
  return eye;
}

/// Twice the area of a quad in the picture, positive where it is counter-clockwise.
double Area(const Camera& eye, const Quad& quad)
{
  double area = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    const glm::dvec2 p = eye.Project(quad.Corners[i]);
    const glm::dvec2 q = eye.Project(quad.Corners[(i + 1) % 4]);
    area += .5 * (p.x * q.y - p.y * q.x);
  }
  return area;
}

}

TEST(Widening, MakesSegmentsExactlyAsWideAsAsked)
{
  for (const Camera& eye : { Perspective(), Parallel() })
  {
    const glm::dvec3 a(-.2, .1, -1.0);
    const glm::dvec3 b(.3, .25, -4.0);
    Quad quad;
    ASSERT_TRUE(ExpandLine(eye, a, b, 2.5, quad));
    const glm::dvec2 way = eye.Project(b) - eye.Project(a);
    EXPECT_NEAR(Area(eye, quad), 2.5 * glm::length(way), 1e-9);
    const glm::dvec2 across = eye.Project(quad.Corners[3]) - eye.Project(quad.Corners[0]);
    EXPECT_NEAR(glm::length(across), 2.5, 1e-9);
    EXPECT_NEAR(glm::dot(across, way), 0.0, 1e-9);
    EXPECT_EQ(quad.Start, 0.0);
    EXPECT_EQ(quad.End, 1.0);
  }
}

TEST(Widening, KeepsSegmentsInOnePlaneInFrontOfTheSegment)
{
  const Camera eye = Perspective();
  const glm::dvec3 a(-.2, .1, -1.0);
  const glm::dvec3 b(.3, .25, -4.0);
  Quad quad;
  ASSERT_TRUE(ExpandLine(eye, a, b, 3.0, quad));
  const glm::dvec3 u = quad.Corners[1] - quad.Corners[0];
  const glm::dvec3 v = quad.Corners[2] - quad.Corners[0];
  const glm::dvec3 w = quad.Corners[3] - quad.Corners[0];
  EXPECT_NEAR(glm::dot(glm::cross(u, v), w), 0.0, 1e-12);
  EXPECT_LT(eye.Depth(quad.Corners[0]), eye.Depth(a));
  EXPECT_GT(eye.Depth(quad.Corners[0]), .9 * eye.Depth(a));
  EXPECT_LT(eye.Depth(quad.Corners[1]), eye.Depth(b));
}

TEST(Widening, CutsSegmentsBehindTheEye)
{
  const Camera eye = Perspective();
  Quad quad;
  EXPECT_FALSE(ExpandLine(eye, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, .5 }, 1.0, quad));
  ASSERT_TRUE(ExpandLine(eye, { .1, 0.0, 1.0 }, { .1, .2, -1.0 }, 1.0, quad));
  EXPECT_NEAR(quad.Start, .5, 1e-5);
  EXPECT_EQ(quad.End, 1.0);
  ASSERT_TRUE(ExpandLine(eye, { .1, .2, -1.0 }, { .1, 0.0, 3.0 }, 1.0, quad));
  EXPECT_EQ(quad.Start, 0.0);
  EXPECT_NEAR(quad.End, .25, 1e-5);
}

TEST(Widening, LeavesSegmentsOutThatAreSeenFromTheirEnd)
{
  Quad quad;
  EXPECT_FALSE(ExpandLine(Parallel(), { .1, .2, -1.0 }, { .1, .2, -3.0 }, 1.0, quad));
}

TEST(Widening, MakesPointsSquaresOfTheirSize)
{
  for (const Camera& eye : { Perspective(), Parallel() })
  {
    Quad quad;
    ASSERT_TRUE(ExpandPoint(eye, { .1, .2, -3.0 }, 4.0, quad));
    EXPECT_NEAR(Area(eye, quad), 16.0, 1e-9);
    const glm::dvec2 middle = .5 * (eye.Project(quad.Corners[0]) + eye.Project(quad.Corners[2]));
    EXPECT_NEAR(glm::length(middle - eye.Project({ .1, .2, -3.0 })), 0.0, 1e-9);
    EXPECT_FALSE(ExpandPoint(eye, { .1, .2, 3.0 }, 4.0, quad));
  }
}
