// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays to lights with a size, and the estimate of the visible fraction against closed forms.
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

TEST(VisibleFraction, OfHalfPlaneIsWithinToleranceAtSixteenRays)
{
  const Result result = Measure(4000, Tolerance, MakeHalfPlane);
  RecordProperty("rays", std::to_string(result.Rays));
  std::printf("rmse %.4f estimate %.4f rays %.1f most %lld\n", result.Rmse, result.EstimatedRms, result.Rays, result.MostRays);
  EXPECT_LE(result.Rmse, Tolerance);
  EXPECT_LE(result.Rmse, 1.2 * result.EstimatedRms);
  EXPECT_LE(result.Rays, 16.0);
}

TEST(VisibleFraction, OfDiskIsWithinTolerance)
{
  for (const float radius : { 0.2f, 0.7f, 1.f, 1.5f, 3.f, 8.f })
  {
    const Result result = Measure(2000, Tolerance,
      [radius](std::uint32_t& random, double& exact) { return MakeDisk(radius, random, exact); });
  std::printf("radius %.1f rmse %.4f estimate %.4f rays %.1f most %lld\n", radius, result.Rmse, result.EstimatedRms, result.Rays, result.MostRays);
    EXPECT_LE(result.Rmse, Tolerance) << radius;
    EXPECT_LE(result.Rmse, 1.5 * result.EstimatedRms) << radius;
    EXPECT_LE(result.MostRays, 1100) << radius;
  }
}
