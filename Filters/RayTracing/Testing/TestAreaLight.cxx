// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays to lights with a size, and the estimate of the visible fraction against closed forms.
#include "Light.h"
#include "Shading/AreaLight.h"
#include "Shading/HemisphereSampling.h"

#include "ClosedForms/VisibleLight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace penumbra;

namespace
{

constexpr float Tolerance = 2.f / 256.f;
constexpr double Pi = 3.14159265358979323846;

/// Errors and numbers of rays of many estimates.
struct Result
{
  double Rmse = 0.0;
  double EstimatedRms = 0.0;
  double Rays = 0.0;
  double Wrong =
    0.0; ///< fraction of estimates that are off by more than two tolerances and four estimates
  long long MostRays = 0;
};

/// Estimates `count` penumbrae. `makeBlocker` draws an occluder and its closed form.
Result Measure(int count, float tolerance,
  const std::function<std::function<bool(glm::vec2)>(std::uint32_t&, double&)>& makeBlocker)
{
  Result result;
  for (int i = 0; i < count; ++i)
  {
    std::uint32_t random = MixBits(static_cast<std::uint32_t>(i) + 1u);
    double exact = 0.0;
    const std::function<bool(glm::vec2)> blocks = makeBlocker(random, exact);
    long long rays = 0;
    const VisibleFraction fraction = EstimateVisibleFraction(
      [&](glm::vec2 at) {
        ++rays;
        EXPECT_LE(glm::length(at), 1.0001f);
        return blocks(at) ? 0.f : 1.f;
      },
      random, tolerance);
    result.Rmse += std::pow(fraction.Value - exact, 2.0) / count;
    result.EstimatedRms += std::pow(fraction.Error, 2.0) / count;
    result.Rays += static_cast<double>(rays) / count;
    result.MostRays = std::max(result.MostRays, rays);
  }
  result.Rmse = std::sqrt(result.Rmse);
  result.EstimatedRms = std::sqrt(result.EstimatedRms);
  return result;
}

std::function<bool(glm::vec2)> MakeHalfPlane(std::uint32_t& random, double& exact)
{
  const float angle = static_cast<float>(2.0 * Pi) * NextFloat(random);
  const float offset = 2.f * NextFloat(random) - 1.f;
  exact = DiskBeyondLine(offset);
  const glm::vec2 normal(std::cos(angle), std::sin(angle));
  return [normal, offset](glm::vec2 at) { return glm::dot(at, normal) < offset; };
}

/// A disk whose boundary crosses the light.
std::function<bool(glm::vec2)> MakeDisk(float radius, std::uint32_t& random, double& exact)
{
  const float angle = static_cast<float>(2.0 * Pi) * NextFloat(random);
  const float nearest = std::abs(radius - 1.f);
  const float distance = nearest + (radius + 1.f - nearest) * NextFloat(random);
  exact = 1.0 - CommonAreaOfCircles(1.0, radius, distance) / Pi;
  const glm::vec2 center(distance * std::cos(angle), distance * std::sin(angle));
  return [center, radius](glm::vec2 at) { return glm::distance(at, center) < radius; };
}

}

TEST(VisibleFraction, OfHalfPlaneIsWithinToleranceAtFewRays)
{
  const Result result = Measure(4000, Tolerance, MakeHalfPlane);
  EXPECT_LE(result.Rmse, Tolerance);
  EXPECT_LE(result.Rmse, 1.2 * result.EstimatedRms);
  EXPECT_LE(result.Rays, 23.0);
}

TEST(VisibleFraction, OfDiskIsWithinTolerance)
{
  for (const float radius : { 0.7f, 1.f, 1.5f, 3.f, 8.f })
  {
    const Result result = Measure(2000, Tolerance,
      [radius](std::uint32_t& random, double& exact) { return MakeDisk(radius, random, exact); });
    EXPECT_LE(result.Rmse, 1.3 * Tolerance) << radius;
    EXPECT_LE(result.Rmse, 1.6 * result.EstimatedRms) << radius;
    EXPECT_LE(result.MostRays, 1100) << radius;
  }
}

TEST(VisibleFraction, OfDiskTakesNoMoreRaysWithALargerTolerance)
{
  for (const float radius : { 0.4f, 0.8f, 1.5f })
  {
    const auto measure = [=](float tolerance) {
      return Measure(2000, tolerance,
        [=](std::uint32_t& random, double& exact) { return MakeDisk(radius, random, exact); });
    };
    const double rays = measure(0.03f).Rays;
    EXPECT_LE(measure(0.1f).Rays, rays) << radius;
    EXPECT_LE(measure(1.f).Rays, rays) << radius;
  }
}

TEST(VisibleFraction, OfCombHasBoundedError)
{
  // A comb with three teeth of random phase.
  const auto makeComb = [](std::uint32_t& random, double& exact) {
    const float phase = NextFloat(random);
    const auto blocks = [phase](glm::vec2 at) {
      return std::fmod(1.5f * at.x + phase + 8.f, 1.f) < 0.4f;
    };
    exact = 0.0;
    for (int tooth = -6; tooth <= 6; ++tooth)
    {
      exact += DiskBeyondLine((tooth - phase) / 1.5) - DiskBeyondLine((tooth + 0.4 - phase) / 1.5);
    }
    exact = 1.0 - exact;
    return std::function<bool(glm::vec2)>(blocks);
  };
  const Result result = Measure(3000, Tolerance, makeComb);
  // The check points miss some of the teeth.
  EXPECT_LE(result.Rmse, 0.03);
  EXPECT_LE(result.MostRays, 1100);
}

namespace
{

/// Returns the fraction of points in the shadow of a wire with a wrong value and estimate. `width` is
/// relative to the diameter of the light.
double CountWrongWires(
  double width, const std::function<PenumbraNeighbors()>& makeNeighbors = nullptr)
{
  constexpr int Points = 2000;
  int wrong = 0;
  for (int i = 0; i < Points; ++i)
  {
    std::uint32_t random = MixBits(static_cast<std::uint32_t>(i) + 1u);
    const float angle = static_cast<float>(2.0 * Pi) * NextFloat(random);
    const glm::vec2 normal(std::cos(angle), std::sin(angle));
    const double begin = 2.0 * NextFloat(random) - 1.0 - width;
    const double end = begin + 2.0 * width;
    const double exact = 1.0 - DiskBeyondLine(begin) + DiskBeyondLine(end);
    PenumbraNeighbors neighbors = makeNeighbors ? makeNeighbors() : PenumbraNeighbors();
    const VisibleFraction found = EstimateVisibleFraction(
      [&](glm::vec2 at) {
        const float across = glm::dot(at, normal);
        return across > begin && across < end ? 0.f : 1.f;
      },
      random, 0.01f, makeNeighbors ? &neighbors : nullptr);
    wrong += std::abs(found.Value - exact) > std::max(0.02, 4.0 * found.Error) ? 1 : 0;
  }
  return static_cast<double>(wrong) / Points;
}

}

TEST(VisibleFraction, MissesSomeWiresNarrowerThanAQuarterOfTheLight)
{
  // Widths relative to the diameter of the light, and fractions of points with a wrong value and estimate.
  const double rows[][2] = { { 0.5, 0.02 }, { 0.25, 0.025 }, { 0.125, 0.06 }, { 0.0625, 0.35 } };
  for (const auto& [width, bound] : rows)
  {
    EXPECT_LE(CountWrongWires(width), bound) << width;
  }
}

namespace
{

/// Errors and rays of the 16 points of blocks over which a half-plane moves, like its shadow over the
/// pixels. `blocks` tells if the line at the distance `offset` from the center blocks a point.
Result MeasureBlocks(const std::function<bool(float across)>& blocks,
  const std::function<double(double offset)>& computeExact, double& correlation,
  float transmittance = 1.f)
{
  Result result;
  constexpr int Blocks = 300;
  double products = 0.0;
  for (int block = 0; block < Blocks; ++block)
  {
    std::uint32_t random = MixBits(static_cast<std::uint32_t>(block) + 1u);
    const float angle = static_cast<float>(2.0 * Pi) * NextFloat(random);
    const glm::vec2 normal(std::cos(angle), std::sin(angle));
    const float start = 1.6f * NextFloat(random) - 0.8f;
    const auto computeOffset = [start](glm::vec2 position) {
      return start + 0.02f * position.x - 0.03f * position.y;
    };
    PenumbraNeighbors neighbors;
    VisibleFraction fractions[16];
    do
    {
      neighbors.BeginNextPass();
      for (int i = 0; i < 16; ++i)
      {
        const glm::vec2 position(i % 4, i / 4);
        neighbors.MoveTo(position);
        const float offset = computeOffset(position);
        fractions[i] = EstimateVisibleFraction(
          [&](glm::vec2 at) {
            result.Rays += 1.0 / (16 * Blocks);
            return blocks(glm::dot(at, normal) - offset) ? 0.f : transmittance;
          },
          MixBits(random + static_cast<std::uint32_t>(i)), Tolerance, &neighbors);
      }
    }
    while (neighbors.NeedsNextPass());
    double before = 0.0;
    for (int i = 0; i < 16; ++i)
    {
      const double error =
        fractions[i].Value - transmittance * computeExact(computeOffset({ i % 4, i / 4 }));
      result.EstimatedRms += std::pow(fractions[i].Error, 2.0) / (16 * Blocks);
      result.Rmse += error * error / (16 * Blocks);
      const double accepted = std::max<double>(2.f * Tolerance, 4.f * fractions[i].Error);
      result.Wrong += std::abs(error) > accepted ? 1.0 / (16 * Blocks) : 0.0;
      products += i > 0 ? error * before / (15 * Blocks) : 0.0;
      before = error;
    }
  }
  correlation = products / result.Rmse;
  result.Rmse = std::sqrt(result.Rmse);
  result.EstimatedRms = std::sqrt(result.EstimatedRms);
  return result;
}

}

TEST(VisibleFraction, IsPredictedFromNeighborsWithIndependentErrors)
{
  double correlation = 1.0;
  const Result result = MeasureBlocks([](float across) { return across < 0.f; },
    [](double at) { return DiskBeyondLine(at); }, correlation);
  EXPECT_LE(result.Rmse, Tolerance);
  EXPECT_LE(result.Rmse, 1.2 * result.EstimatedRms);
  EXPECT_LE(result.Rays, 12.0);
  EXPECT_LE(std::abs(correlation), 0.1);
}

TEST(VisibleFraction, OfCombIsDetectedByNeighbors)
{
  double correlation = 1.0;
  const auto computeExact = [](double at) {
    double hidden = 0.0;
    for (int tooth = -6; tooth <= 6; ++tooth)
    {
      hidden += DiskBeyondLine(at + tooth / 1.5) - DiskBeyondLine(at + (tooth + 0.4) / 1.5);
    }
    return 1.0 - hidden;
  };
  const Result result =
    MeasureBlocks([](float across) { return std::fmod(1.5f * across + 16.f, 1.f) < 0.4f; },
      computeExact, correlation);
  EXPECT_LE(result.Rmse, 0.04);
}

TEST(VisibleFraction, OfWiresIsFoundByNeighbors)
{
  // Widths relative to the diameter of the light, and fractions of points with a wrong value and estimate.
  const double rows[][2] = { { 0.25, 0.06 }, { 0.125, 0.06 }, { 0.0625, 0.012 }, { 0.03125, 0.1 } };
  for (const auto& [width, bound] : rows)
  {
    const double wide = 2.0 * width;
    double correlation = 1.0;
    const Result result = MeasureBlocks([wide](float at) { return at > 0.f && at < wide; },
      [wide](double at) { return 1.0 - DiskBeyondLine(at) + DiskBeyondLine(at + wide); },
      correlation);
    EXPECT_LE(result.Wrong, bound) << width;
  }
}

TEST(VisibleFraction, OfWiresIsFoundBehindAPane)
{
  double correlation = 1.0;
  const Result result = MeasureBlocks([](float at) { return at > 0.f && at < 0.125f; },
    [](double at) { return 1.0 - DiskBeyondLine(at) + DiskBeyondLine(at + 0.125); }, correlation,
    0.5f);
  EXPECT_LE(result.Wrong, 0.06);
}

TEST(VisibleFraction, OfWiresIsFoundNextToAnEdge)
{
  // An edge that leaves the light before it reaches this point, where an arc without a chord is predicted.
  const PenumbraArc edge{ 0.f, -1.2f, 0.f };
  PenumbraNeighbors lit;
  lit.Add(edge);
  EXPECT_EQ(EstimateVisibleFraction([](glm::vec2) { return 1.f; }, 1u, Tolerance, &lit).Value, 1.f);
  EXPECT_FALSE(lit.NeedsNextPass());
  lit.SetComplex();
  EXPECT_TRUE(lit.NeedsNextPass());

  const auto makeNeighbors = [edge]() {
    PenumbraNeighbors neighbors;
    neighbors.Add(edge);
    neighbors.SetComplex();
    return neighbors;
  };
  EXPECT_LE(CountWrongWires(0.0625, makeNeighbors), 0.03);
}

TEST(VisibleFraction, OfSpotsIsMissedOnlyIfTheyAreSmall)
{
  constexpr int Points = 2000;
  // Radii relative to that of the light, and fractions of points with a wrong value and estimate.
  const double rows[][2] = { { 0.5, 0.0 }, { 0.3, 0.13 }, { 0.2, 0.6 } };
  for (const auto& [radius, bound] : rows)
  {
    int wrong = 0;
    for (int i = 0; i < Points; ++i)
    {
      std::uint32_t random = MixBits(static_cast<std::uint32_t>(i) + 1u);
      const float distance = static_cast<float>((1.0 - radius) * std::sqrt(NextFloat(random)));
      const float angle = static_cast<float>(2.0 * Pi) * NextFloat(random);
      const glm::vec2 center = distance * glm::vec2(std::cos(angle), std::sin(angle));
      const VisibleFraction found = EstimateVisibleFraction(
        [&](glm::vec2 at) { return glm::distance(at, center) < radius ? 0.f : 1.f; }, random,
        0.01f);
      wrong += std::abs(found.Value - (1.0 - radius * radius)) > std::max(0.02, 4.0 * found.Error);
    }
    EXPECT_LE(wrong, bound * Points) << radius;
  }
}

TEST(VisibleFraction, OfTranslucentOccluderIsItsTransmittance)
{
  const VisibleFraction fraction =
    EstimateVisibleFraction([](glm::vec2) { return 0.4f; }, 7u, Tolerance);
  EXPECT_NEAR(fraction.Value, 0.4f, 1e-5f);
}

TEST(VisibleFraction, OfPaneIsNoReasonToEstimateABlockAgain)
{
  constexpr float Transmittance = 0.5f;
  PenumbraNeighbors neighbors;
  int rays = 0;
  for (const float edge : { -2.f, 0.3f, 2.f })
  {
    const VisibleFraction fraction = EstimateVisibleFraction(
      [&](glm::vec2 at) {
        ++rays;
        return at.x < edge ? Transmittance : 1.f;
      },
      7u, Tolerance, &neighbors);
    rays = edge == 0.3f ? 0 : rays;
    EXPECT_NEAR(
      fraction.Value, 1.0 - (1.0 - Transmittance) * (1.0 - DiskBeyondLine(edge)), 2.0 * Tolerance);
    EXPECT_FALSE(neighbors.IsComplex());
    EXPECT_LE(rays, 16);
  }
}

TEST(AreaLight, RaysEndAtTheSphere)
{
  Light light;
  light.Kind = Light::Kinds::Positional;
  light.Position = { 1.f, 2.f, 3.f };
  light.Radius = 0.5f;
  const glm::vec3 point(-1.f, 0.5f, 0.25f);
  const AreaLight area(light, point);
  for (const glm::vec2 at : { glm::vec2(0.f), glm::vec2(0.6f, 0.3f), glm::vec2(-0.999f, 0.f) })
  {
    const Ray ray = area.MakeRay(at);
    EXPECT_NEAR(glm::length(ray.Direction), 1.f, 1e-5f);
    EXPECT_NEAR(glm::distance(point + ray.Far * ray.Direction, light.Position), 0.5f, 1e-3f);
  }
  EXPECT_TRUE(AreaLight(light, { 1.1f, 2.f, 3.f }).ContainsPoint());
}

TEST(AreaLight, RaysCoverTheAngularDiameterOfTheSun)
{
  Light sun;
  sun.AngularRadius = 0.25f;
  const AreaLight area(sun, glm::vec3(0.f));
  EXPECT_NEAR(
    std::acos(glm::dot(area.MakeRay({ 1.f, 0.f }).Direction, -sun.Direction)), 0.25f, 1e-4f);
  EXPECT_TRUE(std::isinf(area.MakeRay({ 0.f, 0.f }).Far));
}

TEST(AreaLight, RaysToSpotlightEndOnItsDisk)
{
  Light spot;
  spot.Kind = Light::Kinds::Spot;
  spot.Position = { 0.f, 0.f, 4.f };
  spot.Radius = 0.5f;
  const glm::vec3 point(0.3f, 0.1f, 0.f);
  const Ray ray = AreaLight(spot, point).MakeRay({ 0.f, 1.f });
  const glm::vec3 end = point + ray.Far * ray.Direction;
  EXPECT_NEAR(end.z, 4.f, 1e-5f);
  EXPECT_NEAR(std::hypot(end.x, end.y), 0.5f, 1e-5f);
}
