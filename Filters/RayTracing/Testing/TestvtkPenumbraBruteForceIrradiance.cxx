// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the occlusion of simple scenes with closed forms.
#include "vtkPenumbraBruteForceIrradiance.h"

#include "ClosedForms/FalloffOcclusion.h"
#include "Embree/RayScene.h"
#include "Scenes/Solids.h"
#include "Shading/Illumination.h"
#include "Surface.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

using namespace penumbra;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

vtkPenumbraIrradianceProvider::Estimate ComputeOcclusion(const Scene& scene, glm::dvec3 point,
  const vtkPenumbraIrradianceProvider::Occluders& occluders, double tolerance,
  glm::dvec3 normal = { 0.0, 0.0, 1.0 })
{
  const RayScene rays(scene, 1);
  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  provider->SetMaximumRays(1 << 20);
  provider->Begin(rays, occluders, tolerance);
  return provider->Occlusion(&point.x, &normal.x);
}

}

TEST(vtkPenumbraBruteForceIrradiance, ReturnsZeroOnOpenPlane)
{
  Scene scene;
  AddFloor(scene, 10.f);
  for (int i = 0; i < 20; ++i)
  {
    EXPECT_EQ(ComputeOcclusion(scene, { .37 * i, -.11 * i, 0.0 }, Infinity, .004).Value, 0.0);
  }
}

TEST(vtkPenumbraBruteForceIrradiance, ReturnsOneInClosedBox)
{
  Scene scene;
  AddBox(scene, glm::vec3(-1.f), glm::vec3(1.f));
  EXPECT_EQ(ComputeOcclusion(scene, { .3, .2, -1.0 }, Infinity, .001).Value, 1.0);
  EXPECT_EQ(ComputeOcclusion(scene, { .3, .2, -1.0 }, .1, .001).Value, 0.0);
}

TEST(vtkPenumbraBruteForceIrradiance, ReturnsHalfNextToWall)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { 0.f, -1000.f, 0.f }, { 0.f, 2000.f, 0.f }, { 0.f, 0.f, 1000.f });
  EXPECT_NEAR(ComputeOcclusion(scene, { .01, 0.0, 0.0 }, Infinity, .001).Value, .5, .004);
}

TEST(vtkPenumbraBruteForceIrradiance, MultipliesOcclusionByOpacity)
{
  for (const float opacity : { 0.f, .1f, .5f, .9f, 1.f })
  {
    for (const bool perPoint : { false, true })
    {
      Scene scene;
      AddFloor(scene, 1000.f);
      AddRectangle(scene, { 0.f, -1000.f, 0.f }, { 0.f, 2000.f, 0.f }, { 0.f, 0.f, 1000.f });
      Surface& wall = scene.Surfaces.back();
      if (perPoint)
      {
        const auto alpha = static_cast<unsigned char>(std::lround(255.f * opacity));
        wall.PointColors.assign(wall.Positions.size(), { 255, 255, 255, alpha });
      }
      else
      {
        wall.Front.Opacity = opacity;
      }
      EXPECT_NEAR(
        ComputeOcclusion(scene, { .01, 0.0, 0.0 }, Infinity, .001).Value, .5 * opacity, .005)
        << opacity;
      const FadingOcclusion fading{ 1.0, 1.0 };
      // The closed form without translucency, at a distance within a falloff.
      const vtkPenumbraIrradianceProvider::Occluders linear(
        1.0, vtkPenumbraIrradianceProvider::LINEAR);
      EXPECT_NEAR(ComputeOcclusion(scene, { .3, 0.0, 0.0 }, linear, .001).Value,
        opacity * fading.BeforeWall(.3), .005)
        << opacity;
    }
  }
}

TEST(vtkPenumbraBruteForceIrradiance, CombinesTranslucentLayers)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  for (const float z : { 1.f, 2.f })
  {
    AddRectangle(scene, { -1e4f, -1e4f, z }, { 2e4f, 0.f, 0.f }, { 0.f, 2e4f, 0.f });
    scene.Surfaces.back().Front.Opacity = .4f;
  }
  EXPECT_NEAR(ComputeOcclusion(scene, { 0.0, 0.0, 0.0 }, Infinity, .001).Value, .64, .005);
}

TEST(vtkPenumbraBruteForceIrradiance, ReturnsThreeQuartersInCorner)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { 0.f, -1000.f, 0.f }, { 0.f, 2000.f, 0.f }, { 0.f, 0.f, 1000.f });
  AddRectangle(scene, { -1000.f, 0.f, 0.f }, { 2000.f, 0.f, 0.f }, { 0.f, 0.f, 1000.f });
  EXPECT_NEAR(ComputeOcclusion(scene, { .01, .01, 0.0 }, Infinity, .001).Value, .75, .004);
}

TEST(vtkPenumbraBruteForceIrradiance, MatchesClosedFormBelowDisk)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  // r^2 / (r^2 + h^2)
  EXPECT_NEAR(ComputeOcclusion(scene, { 0.0, 0.0, 0.0 }, Infinity, .001).Value, .49 / 1.49, .004);
  EXPECT_EQ(ComputeOcclusion(scene, { 0.0, 0.0, 0.0 }, .99, .001).Value, 0.0);
}

TEST(vtkPenumbraBruteForceIrradiance, MatchesClosedFormBelowSphere)
{
  Scene scene;
  AddFloor(scene, 10.f);
  const double h = 1.3;
  AddSphere(scene, { 0.0, 0.0, h }, 1.0);
  for (const double rho : { 0.0, .8, 2.0, 4.0 })
  {
    const double reference = h / std::pow(h * h + rho * rho, 1.5);
    EXPECT_NEAR(ComputeOcclusion(scene, { rho, 0.0, 0.0 }, Infinity, .001).Value, reference, .004)
      << rho;
  }
}

namespace
{

/// Occlusion of a plane by a sphere at points in many directions, so that the silhouette of the
/// sphere has no preferred position in the hemisphere.
class SphereAbovePlane : public testing::Test
{
protected:
  void SetUp() override
  {
    AddFloor(this->TracedScene, 10.f);
    AddSphere(this->TracedScene, { 0.0, 0.0, Height }, 1.0);
    this->Rays = std::make_unique<RayScene>(this->TracedScene, 1);
    this->Provider->SetMaximumRays(1 << 20);
  }

  /// Calls use(estimate, reference) for `count` points. If `coarse` > 0, the points are estimated
  /// by OcclusionWithin() with this tolerance.
  template <typename Use>
  void EstimateAround(int count, double tolerance, double coarse, const Use& use)
  {
    this->Provider->Begin(*this->Rays, Infinity, tolerance);
    for (int i = 0; i < count; ++i)
    {
      const double rho = .3 + 2.0 * i / count;
      const double point[3] = { rho * std::cos(7.0 * i), rho * std::sin(7.0 * i), 0.0 };
      const double up[3] = { 0.0, 0.0, 1.0 };
      use(coarse > 0.0 ? this->Provider->OcclusionWithin(point, up, coarse)
                       : this->Provider->Occlusion(point, up),
        Height / std::pow(Height * Height + rho * rho, 1.5));
    }
  }

  static constexpr double Height = 1.3;
  Scene TracedScene;
  std::unique_ptr<RayScene> Rays;
  vtkNew<vtkPenumbraBruteForceIrradiance> Provider;
};

}

TEST_F(SphereAbovePlane, ReportsCalibratedError)
{
  for (const double tolerance : { .03, .01, .004 })
  {
    double square = 0.0;
    double reported = 0.0;
    const int count = 400;
    this->EstimateAround(count, tolerance, 0.0, [&](const auto& estimate, double reference) {
      square += std::pow(estimate.Value - reference, 2.0) / count;
      reported += estimate.Error * estimate.Error / count;
      EXPECT_LE(estimate.Error, tolerance);
    });
    EXPECT_LE(std::sqrt(square), tolerance);
    EXPECT_NEAR(std::sqrt(square / reported), 1.0, .35) << tolerance;
  }
}

TEST_F(SphereAbovePlane, MeetsToleranceForSmallOccluder)
{
  // The sphere is small as seen from distant points; the error must be within the tolerance even if
  // all rays miss it.
  this->Provider->Begin(*this->Rays, Infinity, 1.0 / 128.0);
  double square = 0.0;
  const int count = 1000;
  for (int i = 0; i < count; ++i)
  {
    const double rho = 3.5 + 1.0 * i / count;
    const double point[3] = { rho * std::cos(7.0 * i), rho * std::sin(7.0 * i), 0.0 };
    const double up[3] = { 0.0, 0.0, 1.0 };
    const double reference = Height / std::pow(Height * Height + rho * rho, 1.5);
    square += std::pow(this->Provider->Occlusion(point, up).Value - reference, 2.0) / count;
  }
  EXPECT_LE(std::sqrt(square), 1.0 / 128.0);
}

TEST_F(SphereAbovePlane, IsUnbiasedAtCoarseTolerance)
{
  for (const double tolerance : { .1, .03, .015 })
  {
    double square = 0.0;
    double mean = 0.0;
    long long rays = 0;
    const int count = 4000;
    this->EstimateAround(count, .004, tolerance, [&](const auto& estimate, double reference) {
      square += std::pow(estimate.Value - reference, 2.0) / count;
      mean += (estimate.Value - reference) / count;
      rays += estimate.Rays;
    });
    EXPECT_LE(std::sqrt(square), 1.1 * tolerance);
    EXPECT_LE(std::abs(mean), 3.0 * tolerance / std::sqrt(count) + 2e-4) << tolerance;
    EXPECT_LE(rays / count, 128);
  }
}

TEST(vtkPenumbraBruteForceIrradiance, TracesMoreRaysForSmallerTolerance)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  const auto open = ComputeOcclusion(scene, { 9.0, 9.0, 0.0 }, .5, .01);
  const auto coarse = ComputeOcclusion(scene, { 0.0, 0.0, 0.0 }, Infinity, .05);
  const auto fine = ComputeOcclusion(scene, { 0.0, 0.0, 0.0 }, Infinity, .002);
  EXPECT_LE(open.Rays, 64);
  EXPECT_LT(coarse.Rays, fine.Rays);
  EXPECT_LT(fine.Rays, 10000);
}

TEST(vtkPenumbraBruteForceIrradiance, RespectsMaximumRays)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  const RayScene rays(scene, 1);
  const glm::dvec3 point(0.0);
  const glm::dvec3 normal(0.0, 0.0, 1.0);
  for (const int minimum : { 8, 32, 4096 })
  {
    vtkNew<vtkPenumbraBruteForceIrradiance> provider;
    provider->SetMinimumRays(minimum);
    provider->SetMaximumRays(100);
    provider->Begin(rays, Infinity, 0.0);
    EXPECT_EQ(provider->Occlusion(&point.x, &normal.x).Rays, 64);
    provider->BeginIrradiance(Illumination(rays, IlluminationSettings()), 0.0);
    EXPECT_GE(
      64 * IlluminationSettings().Bounces, provider->Irradiance(&point.x, &normal.x, 0.0).Rays);
  }
}

TEST(vtkPenumbraBruteForceIrradiance, IsIndependentOfSceneUnits)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  const auto original = ComputeOcclusion(scene, { .2, .1, 0.0 }, 1.5, .01);
  scene.Origin = { 64.0, 32.0, 16.0 };
  scene.Scale = .25;
  const auto scaled = ComputeOcclusion(scene, { 64.8, 32.4, 16.0 }, 6.0, .01);
  EXPECT_NEAR(original.Value, scaled.Value, .03);
}

TEST(vtkPenumbraBruteForceIrradiance, MatchesClosedFormWithFalloff)
{
  Scene wall;
  AddFloor(wall, 1000.f);
  AddRectangle(wall, { 0.f, -1000.f, 0.f }, { 0.f, 2000.f, 0.f }, { 0.f, 0.f, 1000.f });
  Scene ceiling;
  AddRectangle(ceiling, { -1000.f, -1000.f, 0.f }, { 2000.f, 0.f, 0.f }, { 0.f, 2000.f, 0.f });
  for (int falloff = 0; falloff < 4; ++falloff)
  {
    const FadingOcclusion reference{ 2.0, PowersOfFalloffs[falloff] };
    for (const double distance : { .02, .5, 1.2, 2.5 })
    {
      EXPECT_NEAR(ComputeOcclusion(wall, { distance, 0.0, 0.0 }, { 2.0, falloff }, .001).Value,
        reference.BeforeWall(distance), .003)
        << falloff << " " << distance;
      EXPECT_NEAR(ComputeOcclusion(ceiling, { 0.0, 0.0, -distance }, { 2.0, falloff }, .001).Value,
        reference.UnderCeiling(distance), .003)
        << falloff << " " << distance;
    }
  }
}

TEST(vtkPenumbraBruteForceIrradiance, IgnoresFalloffWithInfiniteRadius)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddDisc(scene, .7f, 1.f);
  const glm::dvec3 point(.2, .1, 0.0);
  for (int falloff = 1; falloff < 4; ++falloff)
  {
    EXPECT_EQ(ComputeOcclusion(scene, point, { Infinity, falloff }, .01).Value,
      ComputeOcclusion(scene, point, Infinity, .01).Value);
  }
}
