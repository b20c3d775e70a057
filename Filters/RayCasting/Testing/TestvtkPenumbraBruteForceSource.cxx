// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Occlusion of scenes whose answer is known in closed form.
#include "vtkPenumbraBruteForceSource.h"

#include "RayScene.h"
#include "Solids.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

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
  AddBox(scene, glm::vec3(-1.f), glm::vec3(1.f));
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
