// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene.h"
#include "Surface.h"
#include "Tessellation/SceneExtractionClipping.h"

#include <gtest/gtest.h>

using namespace penumbra;

namespace
{

/// Returns the square [0, 4] x [0, 4] at z = 0 with point colors and normals that are linear in x.
Surface MakeSquare()
{
  Surface surface;
  surface.Positions = { { 0.f, 0.f, 0.f }, { 4.f, 0.f, 0.f }, { 4.f, 4.f, 0.f },
    { 0.f, 4.f, 0.f } };
  surface.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  for (const glm::vec3& x : surface.Positions)
  {
    surface.PointColors.emplace_back(50.f * x.x, 0, 0, 255);
    surface.Normals.emplace_back(x.x, 0.f, 1.f);
  }
  surface.CellColors = { glm::u8vec4(1), glm::u8vec4(2) };
  return surface;
}

double ComputeArea(const Surface& surface)
{
  double area = 0.0;
  for (const glm::uvec3& t : surface.Triangles)
  {
    const glm::dvec3 a = surface.Positions[t.x];
    area += 0.5 *
      glm::cross(glm::dvec3(surface.Positions[t.y]) - a, glm::dvec3(surface.Positions[t.z]) - a).z;
  }
  return area;
}

}

TEST(Clipping, KeepsThePositiveSideOfPlanes)
{
  Surface surface = MakeSquare();
  ClipSurface({ { 1.0, 0.0, 0.0, -1.0 } }, Scene(), surface);
  EXPECT_NEAR(ComputeArea(surface), 12.0, 1e-6);
  ClipSurface({ { 0.0, -1.0, 0.0, 1.0 }, { 1.0, 1.0, 0.0, -2.0 } }, Scene(), surface);
  EXPECT_NEAR(ComputeArea(surface), 2.5, 1e-6);
  EXPECT_GT(surface.Triangles.capacity(), surface.Triangles.size());
  EXPECT_GT(surface.Positions.capacity(), surface.Positions.size());
}

TEST(Clipping, InterpolatesPointDataAndCopiesCellData)
{
  Surface surface = MakeSquare();
  ClipSurface({ { 1.0, 0.0, 0.0, -1.0 } }, Scene(), surface);
  ASSERT_EQ(surface.PointColors.size(), surface.Positions.size());
  ASSERT_EQ(surface.Normals.size(), surface.Positions.size());
  ASSERT_EQ(surface.CellColors.size(), surface.Triangles.size());
  ASSERT_EQ(surface.CellIds.size(), surface.Triangles.size());
  for (std::size_t i = 0; i < surface.Positions.size(); ++i)
  {
    EXPECT_NEAR(surface.PointColors[i].r, 50.f * surface.Positions[i].x, 1.0);
    EXPECT_NEAR(surface.Normals[i].x, surface.Positions[i].x, 1e-6);
  }
  for (std::size_t i = 0; i < surface.Triangles.size(); ++i)
  {
    EXPECT_EQ(surface.CellColors[i].r, surface.CellIds[i] + 1);
  }
}

TEST(Clipping, ReusesNewPointsOfNeighboringTriangles)
{
  Surface surface = MakeSquare();
  ClipSurface({ { 1.0, 0.0, 0.0, -1.0 } }, Scene(), surface);
  EXPECT_EQ(surface.Positions.size(), 4u + 3u);
}

TEST(Clipping, AcceptsPlanesInWorldCoordinates)
{
  Scene scene;
  scene.Origin = { 100.0, 0.0, 0.0 };
  scene.Scale = 0.5;
  Surface surface = MakeSquare();
  // x = 1 in scene coordinates is x = 102 in world coordinates.
  ClipSurface({ { 1.0, 0.0, 0.0, -102.0 } }, scene, surface);
  EXPECT_NEAR(ComputeArea(surface), 12.0, 1e-6);
}

TEST(Clipping, RemovesAllOrNothingIfNoTriangleIsCut)
{
  Surface surface = MakeSquare();
  ClipSurface({ { 1.0, 0.0, 0.0, -9.0 } }, Scene(), surface);
  EXPECT_TRUE(surface.Triangles.empty());
  surface = MakeSquare();
  ClipSurface({ { 1.0, 0.0, 0.0, 9.0 } }, Scene(), surface);
  EXPECT_EQ(surface.Triangles.size(), 2u);
  EXPECT_TRUE(surface.CellIds.empty());
}
