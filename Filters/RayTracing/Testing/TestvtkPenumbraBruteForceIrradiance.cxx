// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Occlusion of scenes whose answer is known in closed form.
#include "vtkPenumbraBruteForceIrradiance.h"

#include "ClosedForms/FalloffOcclusion.h"
#include "Embree/RayScene.h"
#include "Scenes/Solids.h"
#include "Shading/Illumination.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

using namespace penumbra;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

vtkPenumbraIrradianceProvider::Estimate Ask(const Scene& scene, glm::dvec3 point,
  const vtkPenumbraIrradianceProvider::Occluders& occluders, double tolerance,
  glm::dvec3 normal = { 0.0, 0.0, 1.0 })
{
  const RayScene rays(scene, 1);
  vtkNew<vtkPenumbraBruteForceIrradiance> source;
  source->SetMaximumRays(1 << 20);
  source->Begin(rays, occluders, tolerance);
  return source->Occlusion(&point.x, &normal.x);
}

}

TEST(vtkPenumbraBruteForceIrradiance, SeesNothingOnAnOpenPlane)
{
  Scene scene;
  AddFloor(scene, 10.f);
  for (int i = 0; i < 20; ++i)
  {
    EXPECT_EQ(Ask(scene, { .37 * i, -.11 * i, 0.0 }, Infinity, .004).Value, 0.0);
  }
}

TEST(vtkPenumbraBruteForceIrradiance, SeesNoSkyInAClosedBox)
{
  Scene scene;
  AddBox(scene, glm::vec3(-1.f), glm::vec3(1.f));
  EXPECT_EQ(Ask(scene, { .3, .2, -1.0 }, Infinity, .001).Value, 1.0);
  EXPECT_EQ(Ask(scene, { .3, .2, -1.0 }, .1, .001).Value, 0.0);
}

TEST(vtkPenumbraBruteForceIrradiance, IsHalfAtTheFootOfAWall)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { 0.f, -1000.f, 0.f }, { 0.f, 2000.f, 0.f }, { 0.f, 0.f, 1000.f });
  EXPECT_NEAR(Ask(scene, { .01, 0.0, 0.0 }, Infinity, .001).Value, .5, .004);
}

TEST(vtkPenumbraBruteForceIrradiance, IsThreeQuartersInTheCornerOfTwoWalls)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { 0.f, -1000.f, 0.f }, { 0.f, 2000.f, 0.f }, { 0.f, 0.f, 1000.f });
  AddRectangle(scene, { -1000.f, 0.f, 0.f }, { 2000.f, 0.f, 0.f }, { 0.f, 0.f, 1000.f });
  EXPECT_NEAR(Ask(scene, { .01, .01, 0.0 }, Infinity, .001).Value, .75, .004);
}

TEST(vtkPenumbraBruteForceIrradiance, KnowsADiscAboveThePoint)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  // r^2 / (r^2 + h^2)
  EXPECT_NEAR(Ask(scene, { 0.0, 0.0, 0.0 }, Infinity, .001).Value, .49 / 1.49, .004);
  EXPECT_EQ(Ask(scene, { 0.0, 0.0, 0.0 }, .99, .001).Value, 0.0);
}

TEST(vtkPenumbraBruteForceIrradiance, KnowsASphereAboveAPlane)
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

namespace
{

/// A sphere above a plane, asked from points all around: no border has a place of its own in the
/// hemisphere.
class SphereAbovePlane : public testing::Test
{
protected:
  void SetUp() override
  {
    AddFloor(this->Drawn, 10.f);
    AddSphere(this->Drawn, { 0.0, 0.0, Height }, 1.0);
    this->Rays = std::make_unique<RayScene>(this->Drawn, 1);
    this->Source->SetMaximumRays(1 << 20);
  }

  /// Calls use(answer, truth) for `count` points; with `rough` above 0 that is asked for instead.
  template <typename Use>
  void AskAround(int count, double tolerance, double rough, const Use& use)
  {
    this->Source->Begin(*this->Rays, Infinity, tolerance);
    for (int i = 0; i < count; ++i)
    {
      const double rho = .3 + 2.0 * i / count;
      const double point[3] = { rho * std::cos(7.0 * i), rho * std::sin(7.0 * i), 0.0 };
      const double up[3] = { 0.0, 0.0, 1.0 };
      use(rough > 0.0 ? this->Source->OcclusionWithin(point, up, rough)
                      : this->Source->Occlusion(point, up),
        Height / std::pow(Height * Height + rho * rho, 1.5));
    }
  }

  static constexpr double Height = 1.3;
  Scene Drawn;
  std::unique_ptr<RayScene> Rays;
  vtkNew<vtkPenumbraBruteForceIrradiance> Source;
};

}

TEST_F(SphereAbovePlane, IsAnsweredWithAnErrorThatIsTrue)
{
  for (const double tolerance : { .03, .01, .004 })
  {
    double square = 0.0;
    double reported = 0.0;
    const int count = 400;
    this->AskAround(count, tolerance, 0.0, [&](const auto& answer, double truth) {
      square += std::pow(answer.Value - truth, 2.0) / count;
      reported += answer.Error * answer.Error / count;
      EXPECT_LE(answer.Error, tolerance);
    });
    EXPECT_LE(std::sqrt(square), tolerance);
    EXPECT_NEAR(std::sqrt(square / reported), 1.0, .35) << tolerance;
  }
}

TEST_F(SphereAbovePlane, IsFoundWhereItBlocksLittle)
{
  // Far away the sphere is small: answers that miss it altogether must not err by more than believed.
  this->Source->Begin(*this->Rays, Infinity, 1.0 / 128.0);
  double square = 0.0;
  const int count = 1000;
  for (int i = 0; i < count; ++i)
  {
    const double rho = 3.5 + 1.0 * i / count;
    const double point[3] = { rho * std::cos(7.0 * i), rho * std::sin(7.0 * i), 0.0 };
    const double up[3] = { 0.0, 0.0, 1.0 };
    const double truth = Height / std::pow(Height * Height + rho * rho, 1.5);
    square += std::pow(this->Source->Occlusion(point, up).Value - truth, 2.0) / count;
  }
  EXPECT_LE(std::sqrt(square), 1.0 / 128.0);
}

TEST_F(SphereAbovePlane, IsAnsweredRoughlyWithoutBias)
{
  for (const double tolerance : { .1, .03, .015 })
  {
    double square = 0.0;
    double mean = 0.0;
    long long rays = 0;
    const int count = 4000;
    this->AskAround(count, .004, tolerance, [&](const auto& answer, double truth) {
      square += std::pow(answer.Value - truth, 2.0) / count;
      mean += (answer.Value - truth) / count;
      rays += answer.Rays;
    });
    EXPECT_LE(std::sqrt(square), 1.1 * tolerance);
    EXPECT_LE(std::abs(mean), 3.0 * tolerance / std::sqrt(count) + 2e-4) << tolerance;
    EXPECT_LE(rays / count, 128);
  }
}

TEST(vtkPenumbraBruteForceIrradiance, SpendsMoreRaysOnlyWhereTheyAreNeeded)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  const auto open = Ask(scene, { 9.0, 9.0, 0.0 }, .5, .01);
  const auto coarse = Ask(scene, { 0.0, 0.0, 0.0 }, Infinity, .05);
  const auto fine = Ask(scene, { 0.0, 0.0, 0.0 }, Infinity, .002);
  EXPECT_LE(open.Rays, 64);
  EXPECT_LT(coarse.Rays, fine.Rays);
  EXPECT_LT(fine.Rays, 10000);
}

TEST(vtkPenumbraBruteForceIrradiance, SpendsNoMoreRaysThanItMay)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  const RayScene rays(scene, 1);
  const glm::dvec3 point(0.0);
  const glm::dvec3 normal(0.0, 0.0, 1.0);
  for (const int minimum : { 8, 32, 4096 })
  {
    vtkNew<vtkPenumbraBruteForceIrradiance> source;
    source->SetMinimumRays(minimum);
    source->SetMaximumRays(100);
    source->Begin(rays, Infinity, 0.0);
    EXPECT_EQ(source->Occlusion(&point.x, &normal.x).Rays, 64);
    source->BeginIrradiance(Illumination(rays, IlluminationSettings()), 0.0);
    EXPECT_GE(
      64 * IlluminationSettings().Bounces, source->Irradiance(&point.x, &normal.x, 0.0).Rays);
  }
}

TEST(vtkPenumbraBruteForceIrradiance, AnswersTheSameInOtherUnits)
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

TEST(vtkPenumbraBruteForceIrradiance, FallsOffWithTheDistanceOfAWallOrACeiling)
{
  Scene wall;
  AddFloor(wall, 1000.f);
  AddRectangle(wall, { 0.f, -1000.f, 0.f }, { 0.f, 2000.f, 0.f }, { 0.f, 0.f, 1000.f });
  Scene ceiling;
  AddRectangle(ceiling, { -1000.f, -1000.f, 0.f }, { 2000.f, 0.f, 0.f }, { 0.f, 2000.f, 0.f });
  for (int falloff = 0; falloff < 4; ++falloff)
  {
    const FadingOcclusion truth{ 2.0, PowersOfFalloffs[falloff] };
    for (const double distance : { .02, .5, 1.2, 2.5 })
    {
      EXPECT_NEAR(Ask(wall, { distance, 0.0, 0.0 }, { 2.0, falloff }, .001).Value,
        truth.BeforeWall(distance), .003)
        << falloff << " " << distance;
      EXPECT_NEAR(Ask(ceiling, { 0.0, 0.0, -distance }, { 2.0, falloff }, .001).Value,
        truth.UnderCeiling(distance), .003)
        << falloff << " " << distance;
    }
  }
}

TEST(vtkPenumbraBruteForceIrradiance, FallsOffFromNothingWithoutALimit)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  const glm::dvec3 point(.2, .1, 0.0);
  for (int falloff = 1; falloff < 4; ++falloff)
  {
    EXPECT_EQ(
      Ask(scene, point, { Infinity, falloff }, .01).Value, Ask(scene, point, Infinity, .01).Value);
  }
}
