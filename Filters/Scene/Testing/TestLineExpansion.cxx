// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Tessellation/LineExpansion.h"

#include <gtest/gtest.h>

using namespace penumbra;

namespace
{

Camera MakePerspectiveCamera()
{
  Camera camera;
  camera.Width = camera.Height = 100;
  camera.Center = { 50.0, 50.0 };
  camera.PixelSize = 0.01;
  camera.Near = 1e-6;
  return camera;
}

Camera MakeParallelCamera()
{
  Camera camera = MakePerspectiveCamera();
  camera.Parallel = true;
  camera.Near = 0.0;
  return camera;
}

/// Returns the area of a quad in the image in square pixels, positive if it is counterclockwise.
double ComputeArea(const Camera& camera, const Quad& quad)
{
  double area = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    const glm::dvec2 p = camera.Project(quad.Corners[i]);
    const glm::dvec2 q = camera.Project(quad.Corners[(i + 1) % 4]);
    area += 0.5 * (p.x * q.y - p.y * q.x);
  }
  return area;
}

}

TEST(LineExpansion, MakesLinesOfExactWidth)
{
  for (const Camera& camera : { MakePerspectiveCamera(), MakeParallelCamera() })
  {
    const glm::dvec3 a(-0.2, 0.1, -1.0);
    const glm::dvec3 b(0.3, 0.25, -4.0);
    Quad quad;
    ASSERT_TRUE(ExpandLine(camera, a, b, 2.5, { 2.5, {} }, quad));
    const glm::dvec2 delta = camera.Project(b) - camera.Project(a);
    EXPECT_NEAR(ComputeArea(camera, quad), 2.5 * glm::length(delta), 1e-9);
    const glm::dvec2 across = camera.Project(quad.Corners[3]) - camera.Project(quad.Corners[0]);
    EXPECT_NEAR(glm::length(across), 2.5, 1e-9);
    EXPECT_NEAR(glm::dot(across, delta), 0.0, 1e-9);
    EXPECT_EQ(quad.Start, 0.0);
    EXPECT_EQ(quad.End, 1.0);
  }
}

TEST(LineExpansion, MakesPlanarQuadsInFrontOfTheLine)
{
  const Camera camera = MakePerspectiveCamera();
  const glm::dvec3 a(-0.2, 0.1, -1.0);
  const glm::dvec3 b(0.3, 0.25, -4.0);
  Quad quad;
  ASSERT_TRUE(ExpandLine(camera, a, b, 3.0, { 3.0, {} }, quad));
  const glm::dvec3 u = quad.Corners[1] - quad.Corners[0];
  const glm::dvec3 v = quad.Corners[2] - quad.Corners[0];
  const glm::dvec3 w = quad.Corners[3] - quad.Corners[0];
  EXPECT_NEAR(glm::dot(glm::cross(u, v), w), 0.0, 1e-12);
  EXPECT_LT(camera.Depth(quad.Corners[0]), camera.Depth(a));
  EXPECT_GT(camera.Depth(quad.Corners[0]), 0.9 * camera.Depth(a));
  EXPECT_LT(camera.Depth(quad.Corners[1]), camera.Depth(b));
}

TEST(LineExpansion, ClipsLinesBehindTheCamera)
{
  const Camera camera = MakePerspectiveCamera();
  Quad quad;
  EXPECT_FALSE(ExpandLine(camera, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.5 }, 1.0, { 1.0, {} }, quad));
  ASSERT_TRUE(ExpandLine(camera, { 0.1, 0.0, 1.0 }, { 0.1, 0.2, -1.0 }, 1.0, { 1.0, {} }, quad));
  EXPECT_NEAR(quad.Start, 0.5, 1e-5);
  EXPECT_EQ(quad.End, 1.0);
  ASSERT_TRUE(ExpandLine(camera, { 0.1, 0.2, -1.0 }, { 0.1, 0.0, 3.0 }, 1.0, { 1.0, {} }, quad));
  EXPECT_EQ(quad.Start, 0.0);
  EXPECT_NEAR(quad.End, 0.25, 1e-5);
}

TEST(LineExpansion, RejectsLinesParallelToTheViewDirection)
{
  Quad quad;
  EXPECT_FALSE(ExpandLine(
    MakeParallelCamera(), { 0.1, 0.2, -1.0 }, { 0.1, 0.2, -3.0 }, 1.0, { 1.0, {} }, quad));
}

TEST(LineExpansion, MakesSquaresOfThePointSize)
{
  for (const Camera& camera : { MakePerspectiveCamera(), MakeParallelCamera() })
  {
    Quad quad;
    ASSERT_TRUE(ExpandPoint(camera, { 0.1, 0.2, -3.0 }, 4.0, { 4.0, {} }, quad));
    EXPECT_NEAR(ComputeArea(camera, quad), 16.0, 1e-9);
    const glm::dvec2 center =
      0.5 * (camera.Project(quad.Corners[0]) + camera.Project(quad.Corners[2]));
    EXPECT_NEAR(glm::length(center - camera.Project({ 0.1, 0.2, -3.0 })), 0.0, 1e-9);
    EXPECT_FALSE(ExpandPoint(camera, { 0.1, 0.2, 3.0 }, 4.0, { 4.0, {} }, quad));
  }
}
