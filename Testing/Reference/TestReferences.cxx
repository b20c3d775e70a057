// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reference solutions against closed forms and against each other.
#include "BruteForce/ImageErrors.h"
#include "ClosedForms/ExactCoverage.h"
#include "ClosedForms/FalloffOcclusion.h"
#include "ClosedForms/HalfPlaneScattering.h"
#include "Scenes/TestScene.h"

#include "vtkCamera.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace penumbra;

namespace
{

double Sum(const std::vector<double>& fractions)
{
  return std::accumulate(fractions.begin(), fractions.end(), 0.0);
}

}

TEST(ExactCoverage, OfARectangleEqualsItsOverlapWithEachPixel)
{
  ExactCoverage coverage(4, 3);
  coverage.AddPolygon({ { 0.25, 0.5 }, { 2.5, 0.5 }, { 2.5, 2.25 }, { 0.25, 2.25 } });
  const std::vector<double> fractions = coverage.GetShares();
  const double columns[4] = { 0.75, 1.0, 0.5, 0.0 };
  const double rows[3] = { 0.5, 1.0, 0.25 };
  for (int j = 0; j < 3; ++j)
  {
    for (int i = 0; i < 4; ++i)
    {
      EXPECT_NEAR(fractions[4 * j + i], columns[i] * rows[j], 1e-14);
    }
  }
}

TEST(ExactCoverage, SumsToTheAreaInsideTheImage)
{
  const double radius = 9.3;
  const int edges = 50;
  const double pi = std::acos(-1.0);
  const double area = 0.5 * edges * radius * radius * std::sin(2.0 * pi / edges);
  EXPECT_NEAR(Sum(SharesOf({ Disc({ 15.2, 14.9 }, radius, edges) }, 32, 32)), area, 1e-10);
  // Half of the disk is outside of each image edge in turn, by symmetry about a line through the
  // center.
  EXPECT_NEAR(Sum(SharesOf({ Disc({ 0.0, 14.9 }, radius, edges) }, 32, 32)), 0.5 * area, 1e-10);
  EXPECT_NEAR(Sum(SharesOf({ Disc({ 32.0, 14.9 }, radius, edges) }, 32, 32)), 0.5 * area, 1e-10);
  EXPECT_NEAR(Sum(SharesOf({ Disc({ 15.2, 0.0 }, radius, edges) }, 32, 32)), 0.5 * area, 1e-10);
  EXPECT_NEAR(Sum(SharesOf({ Disc({ 15.2, 32.0 }, radius, edges) }, 32, 32)), 0.5 * area, 1e-10);
}

TEST(ExactCoverage, HandlesHolesAndSubpixelShapes)
{
  ExactCoverage coverage(3, 3);
  coverage.AddPolygon({ { 1.1, 1.1 }, { 1.9, 1.1 }, { 1.9, 1.9 }, { 1.1, 1.9 } });
  coverage.AddPolygon({ { 1.4, 1.4 }, { 1.4, 1.6 }, { 1.6, 1.6 }, { 1.6, 1.4 } });
  const std::vector<double> fractions = coverage.GetShares();
  EXPECT_NEAR(fractions[4], 0.64 - 0.04, 1e-14);
  EXPECT_NEAR(Sum(fractions), 0.60, 1e-14);
}

TEST(HalfPlaneInHaze, MatchesNumericalIntegration)
{
  HalfPlaneInHaze haze;
  haze.Intensity = 3.0;
  for (const double low : { -HalfPlaneInHaze::Endless, -1.0 })
  {
    haze.Low[0] = low;
    haze.High[0] = 4.0;
    haze.High[1] = 3.0;
    haze.Low[1] = haze.Low[2] = -3.0;
    for (const glm::dvec2 point :
      { glm::dvec2(0.1, -0.4), glm::dvec2(-0.9, 0.7), glm::dvec2(0.3, 1.3), glm::dvec2(0.8, 0.0) })
    {
      // Ray march from the camera. Air is lit for x > 0, and elsewhere only above the half-plane.
      const glm::dvec3 direction(1.0, -point.x, point.y);
      const double step = 1e-4 * glm::length(direction);
      double through = 0.0;
      double sum = 0.0;
      for (double t = 5e-5; t < 6.0; t += 1e-4)
      {
        const glm::dvec3 at = glm::dvec3(-1.3, 0.0, -0.5) + t * direction;
        if (at.x < 0.0 && at.z > 1.0)
        {
          break;
        }
        const bool inside =
          at.x > low && at.x < 4.0 && std::abs(at.y) < 3.0 && at.z > -3.0 && at.z < 2.0;
        const double lost = 0.5 * (through + 0.5 * step + 2.0 - at.z);
        sum +=
          inside && at.x > 0.0 ? 3.0 * 0.3 / (4.0 * std::acos(-1.0)) * std::exp(-lost) * step : 0.0;
        through += inside ? step : 0.0;
      }
      EXPECT_NEAR(haze.Exact(point.x, point.y), sum, 1e-5);
    }
  }
}

class ReferencesAgree : public testing::TestWithParam<int>
{
};

TEST_P(ReferencesAgree, OnShapes)
{
  const int size = 64;
  const std::vector<std::vector<Shape>> scenes = { HalfPlane(size, size),
    { Disc({ 31.7, 32.2 }, 25.3, 100) }, { Star({ 32.4, 31.9 }, 30.0, 6.0, 72) },
    SmallDiscs(size, size, 8), Rods(size, size, 3), Comb(size, size) };
  const std::vector<Shape>& shapes = scenes[GetParam()];
  const std::vector<double> fractions = SharesOf(shapes, size, size);
  vtkSmartPointer<vtkRenderer> renderer = RendererOf(shapes, size, size);
  const BruteForceImage image =
    DrawByBruteForce(BruteForceOf(renderer, size, size), size, size, 128);
  const Errors errors =
    Compare(image.Colors, WhiteOnBlack(fractions), PartlyCoveredPixels(fractions));
  EXPECT_GT(errors.EdgePixels, 20u);
  // 128 x 128 point samples have a coverage error of a few 1e-4 at an edge.
  EXPECT_LT(errors.Edge, 0.0006);
  EXPECT_LT(errors.Worst, 0.009);
}

INSTANTIATE_TEST_SUITE_P(BruteForceAndExactCoverage, ReferencesAgree, testing::Range(0, 6));

TEST(BruteForce, MatchesClosedFormShadingOfASphere)
{
  // In parallel projection the headlight gives cos = sqrt(1 - r^2) at distance r from the center.
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(512);
  sphere->SetPhiResolution(256);
  sphere->Update();
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, sphere->GetOutput(), true);
  renderer->GetActiveCamera()->ParallelProjectionOn();
  LookAlong(renderer, { 0.3, 0.4, -1.0 }, { 0.0, 1.0, 0.0 }, 32, 32);
  renderer->GetActiveCamera()->SetParallelScale(1.25);
  const BruteForceImage image = DrawByBruteForce(BruteForceOf(renderer, 32, 32), 32, 32, 16);
  for (int i = 0; i < 32; ++i)
  {
    const double r2 = (std::pow((i + 0.5) / 16.0 - 1.0, 2) + std::pow(0.5 / 16.0, 2)) * 1.5625;
    if (r2 < 0.8)
    {
      EXPECT_NEAR(image.Colors[16 * 32 + i].x, std::sqrt(1.0 - r2), 0.004) << "column " << i;
    }
  }
}

TEST(BruteForce, DistinguishesSilhouettesFromCreases)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(12);
  sphere->SetPhiResolution(8);
  sphere->Update();
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, sphere->GetOutput(), true);
  LookAlong(renderer, { 0.0, 0.0, -1.0 }, { 0.0, 1.0, 0.0 }, 64, 64);
  const BruteForceImage image = DrawByBruteForce(BruteForceOf(renderer, 64, 64), 64, 64, 16);
  EXPECT_EQ(image.Kinds[0], PixelKind::Inside);
  EXPECT_EQ(image.Kinds[64 * 32 + 32], PixelKind::Crease); // the pole faces the camera
  for (std::size_t i = 0; i < image.Kinds.size(); ++i)
  {
    const double x = static_cast<double>(i % 64) - 31.5;
    const double y = static_cast<double>(i / 64) - 31.5;
    if (image.Kinds[i] == PixelKind::Silhouette)
    {
      EXPECT_GT(x * x + y * y, 16.0 * 16.0); // the sphere's outline has a radius of about 18
    }
  }
}

TEST(Measure, InterpolatesCostLogarithmically)
{
  EXPECT_NEAR(CostAtError({ { 0.1, 1.0 }, { 0.001, 100.0 } }, 0.01), 10.0, 1e-9);
  EXPECT_NEAR(CostAtError({ { 0.1, 1.0 }, { 0.001, 100.0 } }, 0.0001), 1000.0, 1e-6);
  EXPECT_NEAR(CostAtError({ { 0.1, 1.0 }, { 0.2, 5.0 }, { 0.001, 100.0 } }, 0.01), 10.0, 1e-9);
}

TEST(FadingOcclusion, AgreesWithClosedFormsUnderACeiling)
{
  const double k = .3;
  const double cut = 1.0 - k * k;
  const double closed[] = { cut, (1.0 - k) * (1.0 - k), cut + 2.0 * k * k * std::log(k),
    cut - 4.0 / 3.0 * std::sqrt(k) * (1.0 - std::pow(k, 1.5)) };
  for (int i = 0; i < 4; ++i)
  {
    const FadingOcclusion reference{ 2.0, PowersOfFalloffs[i] };
    EXPECT_NEAR(reference.UnderCeiling(2.0 * k), closed[i], 1e-9) << i;
    EXPECT_EQ(reference.UnderCeiling(2.5), 0.0);
  }
}

TEST(FadingOcclusion, ApproachesHalfAtTheFootOfAWall)
{
  for (const double power : PowersOfFalloffs)
  {
    EXPECT_NEAR((FadingOcclusion{ 1e9, power }.BeforeWall(1e-3)), .5, 2e-4) << power;
  }
}
