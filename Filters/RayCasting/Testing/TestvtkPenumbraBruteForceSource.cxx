// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Occlusion of scenes whose answer is known in closed form.
#include "vtkPenumbraBruteForceSource.h"

#include "RayScene.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Pi = 3.14159265358979323846;

void AddRectangle(Scene& scene, glm::vec3 corner, glm::vec3 side, glm::vec3 other)
{
  Surface surface;
  surface.Positions = { corner, corner + side, corner + side + other, corner + other };
  surface.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  scene.Surfaces.push_back(surface);
}

/// A disc of radius r about (0, 0, z).
void AddDisc(Scene& scene, float r, float z)
{
  Surface surface;
  const unsigned int sides = 720;
  surface.Positions.emplace_back(0.f, 0.f, z);
  for (unsigned int i = 0; i < sides; ++i)
  {
    const double angle = 2.0 * Pi * i / sides;
    surface.Positions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    surface.Triangles.emplace_back(0, 1 + i, 1 + (i + 1) % sides);
  }
  scene.Surfaces.push_back(surface);
}

/// A sphere of radius r about c.
void AddSphere(Scene& scene, glm::dvec3 c, double r)
{
  Surface surface;
  const unsigned int rings = 200;
  for (unsigned int i = 0; i <= rings; ++i)
  {
    for (unsigned int j = 0; j < rings; ++j)
    {
      const double theta = Pi * i / rings;
      const double phi = 2.0 * Pi * j / rings;
      surface.Positions.emplace_back(c +
        r *
          glm::dvec3(
            std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
      if (i > 0)
      {
        const unsigned int next = (j + 1) % rings;
        surface.Triangles.emplace_back((i - 1) * rings + j, i * rings + j, i * rings + next);
        surface.Triangles.emplace_back(
          (i - 1) * rings + j, i * rings + next, (i - 1) * rings + next);
      }
    }
  }
  scene.Surfaces.push_back(surface);
}

void AddFloor(Scene& scene, float size)
{
  AddRectangle(scene, { -size, -size, 0.f }, { 2.f * size, 0.f, 0.f }, { 0.f, 2.f * size, 0.f });
}

vtkPenumbraIrradianceSource::Estimate Ask(const Scene& scene, glm::dvec3 point, double radius,
  double tolerance, glm::dvec3 normal = { 0.0, 0.0, 1.0 })
{
  const RayScene rays(scene, 1);
  vtkNew<vtkPenumbraBruteForceSource> source;
  source->SetMaximumRays(1 << 20);
  source->Begin(rays, radius, tolerance);
  return source->Occlusion(&point.x, &normal.x);
}

}

TEST(vtkPenumbraBruteForceSource, SeesNothingOnAnOpenPlane)
{
  Scene scene;
  AddFloor(scene, 10.f);
  for (int i = 0; i < 20; ++i)
  {
    EXPECT_EQ(Ask(scene, { .37 * i, -.11 * i, 0.0 }, Infinity, .004).Value, 0.0);
  }
}

TEST(vtkPenumbraBruteForceSource, SeesNoSkyInAClosedBox)
{
  Scene scene;
  const glm::vec3 x(2.f, 0.f, 0.f);
  const glm::vec3 y(0.f, 2.f, 0.f);
  const glm::vec3 z(0.f, 0.f, 2.f);
  const glm::vec3 low(-1.f);
  for (const glm::vec3& corner : { low, low + z })
  {
    AddRectangle(scene, corner, x, y);
  }
  for (const glm::vec3& corner : { low, low + y })
  {
    AddRectangle(scene, corner, x, z);
  }
  for (const glm::vec3& corner : { low, low + x })
  {
    AddRectangle(scene, corner, y, z);
  }
  EXPECT_EQ(Ask(scene, { .3, .2, -1.0 }, Infinity, .001).Value, 1.0);
  EXPECT_EQ(Ask(scene, { .3, .2, -1.0 }, .1, .001).Value, 0.0);
}

TEST(vtkPenumbraBruteForceSource, IsHalfAtTheFootOfAWall)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { 0.f, -1000.f, 0.f }, { 0.f, 2000.f, 0.f }, { 0.f, 0.f, 1000.f });
  EXPECT_NEAR(Ask(scene, { .01, 0.0, 0.0 }, Infinity, .001).Value, .5, .004);
}

TEST(vtkPenumbraBruteForceSource, IsThreeQuartersInTheCornerOfTwoWalls)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { 0.f, -1000.f, 0.f }, { 0.f, 2000.f, 0.f }, { 0.f, 0.f, 1000.f });
  AddRectangle(scene, { -1000.f, 0.f, 0.f }, { 2000.f, 0.f, 0.f }, { 0.f, 0.f, 1000.f });
  EXPECT_NEAR(Ask(scene, { .01, .01, 0.0 }, Infinity, .001).Value, .75, .004);
}

TEST(vtkPenumbraBruteForceSource, KnowsADiscAboveThePoint)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  // r^2 / (r^2 + h^2)
  EXPECT_NEAR(Ask(scene, { 0.0, 0.0, 0.0 }, Infinity, .001).Value, .49 / 1.49, .004);
  EXPECT_EQ(Ask(scene, { 0.0, 0.0, 0.0 }, .99, .001).Value, 0.0);
}

TEST(vtkPenumbraBruteForceSource, KnowsASphereAboveAPlane)
{
  Scene scene;
  AddFloor(scene, 10.f);
  const double h = 1.3;
  AddSphere(scene, { 0.0, 0.0, h }, 1.0);
  for (const double rho : { 0.0, .8, 2.0, 4.0 })
  {
    const double truth = h / std::pow(h * h + rho * rho, 1.5);
    EXPECT_NEAR(Ask(scene, { rho, 0.0, 0.0 }, Infinity, .001).Value, truth, .004) << rho;
  }
}

TEST(vtkPenumbraBruteForceSource, ReportsAnErrorThatIsTrue)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  for (const double tolerance : { .03, .01, .004 })
  {
    double square = 0.0;
    double reported = 0.0;
    const int count = 200;
    for (int i = 0; i < count; ++i)
    {
      // The same answer up to 1e-6 everywhere here, but another jitter.
      const auto answer = Ask(scene, { 1e-6 * i, 0.0, 0.0 }, Infinity, tolerance);
      square += std::pow(answer.Value - .49 / 1.49, 2.0) / count;
      reported += answer.Error * answer.Error / count;
      EXPECT_LE(answer.Error, tolerance);
    }
    EXPECT_LE(std::sqrt(square), 1.2 * tolerance);
    EXPECT_NEAR(std::sqrt(square / reported), 1.0, .35) << tolerance;
  }
}

TEST(vtkPenumbraBruteForceSource, SpendsMoreRaysOnlyWhereTheyAreNeeded)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  const auto open = Ask(scene, { 9.0, 9.0, 0.0 }, .5, .01);
  const auto coarse = Ask(scene, { 0.0, 0.0, 0.0 }, Infinity, .05);
  const auto fine = Ask(scene, { 0.0, 0.0, 0.0 }, Infinity, .002);
  EXPECT_LE(open.Rays, 32);
  EXPECT_LT(coarse.Rays, fine.Rays);
  EXPECT_LT(fine.Rays, 10000);
}

TEST(vtkPenumbraBruteForceSource, AnswersTheSameInOtherUnits)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  const auto here = Ask(scene, { .2, .1, 0.0 }, 1.5, .01);
  scene.Origin = { 64.0, 32.0, 16.0 };
  scene.Scale = .25;
  const auto there = Ask(scene, { 64.8, 32.4, 16.0 }, 6.0, .01);
  EXPECT_NEAR(here.Value, there.Value, .03);
}
