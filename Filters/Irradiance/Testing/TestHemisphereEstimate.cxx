// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares gradients and second derivatives of occlusion with closed forms.
#include "ClosedForms/FalloffOcclusion.h"
#include "Records/RecordPlacement.h"
#include "Shading/HemisphereSampling.h"

#include <gtest/gtest.h>

#include <functional>

using namespace penumbra;

namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();

/// Gatherer of occlusion by an analytic shape, without the rounding errors of triangles.
class ShapeGatherer : public Gatherer
{
public:
  using Shape = std::function<HemisphereSample(glm::vec3 origin, glm::vec3 direction)>;

  explicit ShapeGatherer(Shape shape, const DistanceFalloff& falloff = {})
    : Intersect(std::move(shape)),
      Falloff(falloff)
  {
  }

  long long Gather(glm::vec3 point, const SurfaceNormals&, const std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& samples) const override
  {
    samples.clear();
    for (const glm::vec3& direction : directions)
    {
      HemisphereSample sample = this->Intersect(point, direction);
      if (!(sample.Distance < this->GetRadius()))
      {
        sample = HemisphereSample();
      }
      sample.Radiance =
        glm::vec3(std::isinf(sample.Distance) ? 0.f : this->Falloff.Evaluate(sample.Distance));
      samples.push_back(sample);
    }
    return static_cast<long long>(directions.size());
  }
  DistanceFalloff GetFalloff() const override { return this->Falloff; }

private:
  Shape Intersect;
  DistanceFalloff Falloff;
};

/// Unit sphere above the origin with its center at `height`.
ShapeGatherer::Shape MakeSphere(float height)
{
  return [height](glm::vec3 origin, glm::vec3 direction) {
    HemisphereSample sample;
    const glm::vec3 from = origin - glm::vec3(0.f, 0.f, height);
    const float b = glm::dot(from, direction);
    const float discriminant = b * b - (glm::dot(from, from) - 1.f);
    if (discriminant > 0.f && -b - std::sqrt(discriminant) > 0.f)
    {
      sample.Distance = -b - std::sqrt(discriminant);
      sample.Normal = from + sample.Distance * direction;
    }
    return sample;
  };
}

/// Infinite wall x = 0.
HemisphereSample Wall(glm::vec3 origin, glm::vec3 direction)
{
  HemisphereSample sample;
  if (origin.x * direction.x < 0.f)
  {
    sample.Distance = -origin.x / direction.x;
    sample.Normal = glm::vec3(1.f, 0.f, 0.f);
  }
  return sample;
}

/// Square with sides of 2 at height 1.
HemisphereSample Ceiling(glm::vec3 origin, glm::vec3 direction)
{
  HemisphereSample sample;
  const glm::vec3 at = origin + (1.f - origin.z) / direction.z * direction;
  if (direction.z > 0.f && std::abs(at.x) < 1.f && std::abs(at.y) < 1.f)
  {
    sample.Distance = (1.f - origin.z) / direction.z;
    sample.Normal = glm::vec3(0.f, 0.f, 1.f);
  }
  return sample;
}

/// Gatherer of light from the plane z = 1, of which a square with sides of 2 has a radiance of 1, the
/// rest one of 0.
class SquareGatherer : public Gatherer
{
public:
  long long Gather(glm::vec3 point, const SurfaceNormals&, const std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& samples) const override
  {
    samples.assign(directions.size(), HemisphereSample());
    for (std::size_t i = 0; i < directions.size(); ++i)
    {
      const bool isLit = Ceiling(point, directions[i]).Distance < Infinity;
      samples[i].Distance = (1.f - point.z) / directions[i].z;
      samples[i].Normal = glm::vec3(0.f, 0.f, 1.f);
      samples[i].Radiance = glm::vec3(isLit ? 1.f : 0.f);
    }
    return static_cast<long long>(directions.size());
  }
  DistanceFalloff GetFalloff() const override { return {}; }
};

/// Returns the mean estimate of records with different jitter at almost the same point. Supersamples
/// cells if `tolerance` is not 0.
HemisphereEstimate AverageEstimates(
  const Gatherer& gatherer, glm::vec3 point, int side, int count = 60, double tolerance = 0.0)
{
  RecordOctree tree;
  RecordPlacementSettings settings;
  settings.Side = side;
  settings.Refine = tolerance > 0.0;
  settings.Tolerance = tolerance > 0.0 ? tolerance : settings.Tolerance;
  const RecordPlacement placement(gatherer, settings, tree);
  HemisphereEstimate mean;
  for (int i = 0; i < count; ++i)
  {
    RecordCandidate site;
    site.Position = point + glm::vec3(0.f, 1e-5f * static_cast<float>(i), 0.f);
    site.Pixel = 1.f;
    long long rays = 0;
    const HemisphereEstimate found = placement.Gather(site, rays).value().Gathered;
    const auto n = static_cast<float>(count);
    mean.Mean += found.Mean / n;
    mean.Error += found.Error / n;
    mean.HessianNorm += found.HessianNorm / n;
    for (int c = 0; c < 3; ++c)
    {
      mean.Translation[c] += found.Translation[c] / n;
      mean.Rotation[c] += found.Rotation[c] / n;
    }
  }
  return mean;
}

/// Returns the central difference of `f` at `x`.
double ComputeDerivative(const std::function<double(double)>& f, double x)
{
  return (f(x + 1e-4) - f(x - 1e-4)) / 2e-4;
}

/// Returns the occlusion under a rectangle [x0, x1] x [y0, y1] at height 1 (sum of four corners).
double ComputeRectangleOcclusion(double x0, double x1, double y0, double y1)
{
  const auto corner = [](double x, double y) {
    const double a = std::sqrt(1.0 + x * x);
    const double b = std::sqrt(1.0 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2.0 * 3.14159265358979);
  };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

}

TEST(HemisphereEstimate, AreZeroWithoutOccluders)
{
  const ShapeGatherer open([](glm::vec3, glm::vec3) { return HemisphereSample(); });
  const HemisphereEstimate found = AverageEstimates(open, { .3f, .2f, 0.f }, 32, 1);
  EXPECT_EQ(found.Mean.x, 0.f);
  EXPECT_EQ(found.Error, 0.f);
  EXPECT_EQ(found.HessianNorm, 0.f);
  EXPECT_EQ(found.Translation[0], glm::vec3(0.f));
}

TEST(HemisphereEstimate, MatchGradientNextToSphere)
{
  for (const double height : { 1.0, 1.5 })
  {
    const ShapeGatherer sphere(MakeSphere(static_cast<float>(height)));
    const auto occlusion = [height](double rho) {
      return height / std::pow(height * height + rho * rho, 1.5);
    };
    for (const double rho : { .5, 1.0, 2.0 })
    {
      const HemisphereEstimate found = AverageEstimates(sphere, { rho, 0.f, 0.f }, 32);
      EXPECT_NEAR(found.Mean.x, occlusion(rho), .002) << height << " " << rho;
      EXPECT_NEAR(found.Translation[0].x, ComputeDerivative(occlusion, rho),
        .08 * std::abs(ComputeDerivative(occlusion, rho)))
        << height << " " << rho;
      EXPECT_NEAR(found.Translation[0].y, 0.0, .02);
    }
  }
}

TEST(HemisphereEstimate, BoundHessianNextToSphere)
{
  const ShapeGatherer sphere(MakeSphere(1.f));
  const auto occlusion = [](double rho) { return std::pow(1.0 + rho * rho, -1.5); };
  const auto derivative = [&occlusion](double rho) { return ComputeDerivative(occlusion, rho); };
  for (const double rho : { .5, 1.0, 1.5, 2.0 })
  {
    // Maximum of the second derivatives along the radius and perpendicular to it.
    const double reference =
      std::max(std::abs(ComputeDerivative(derivative, rho)), std::abs(derivative(rho) / rho));
    const double found = AverageEstimates(sphere, { rho, 0.f, 0.f }, 32).HessianNorm;
    EXPECT_GT(found, .5 * reference) << rho;
    EXPECT_LT(found, 3.0 * reference) << rho;
  }
}

TEST(HemisphereEstimate, MatchGradientUnderRectangle)
{
  const ShapeGatherer ceiling(Ceiling);
  const auto occlusion = [](double x) {
    return ComputeRectangleOcclusion(-1.0 - x, 1.0 - x, -1.0, 1.0);
  };
  for (const double x : { 0.0, .4, .8, 1.3 })
  {
    const HemisphereEstimate found = AverageEstimates(ceiling, { x, 0.f, 0.f }, 32);
    EXPECT_NEAR(found.Mean.x, occlusion(x), .002) << x;
    EXPECT_NEAR(found.Translation[0].x, ComputeDerivative(occlusion, x), .02) << x;
    const auto derivative = [&occlusion](double at) { return ComputeDerivative(occlusion, at); };
    EXPECT_GT(found.HessianNorm, .5 * std::abs(ComputeDerivative(derivative, x))) << x;
  }
}

TEST(HemisphereEstimate, MatchGradientWithSupersampledCells)
{
  const SquareGatherer square;
  const ShapeGatherer ceiling(Ceiling);
  const auto irradiance = [](double x) {
    return ComputeRectangleOcclusion(-1.0 - x, 1.0 - x, -1.0, 1.0);
  };
  for (const double x : { .8, 1.3, 2.0, 3.0 })
  {
    const double exact = ComputeDerivative(irradiance, x);
    for (const Gatherer* gatherer :
      { static_cast<const Gatherer*>(&square), static_cast<const Gatherer*>(&ceiling) })
    {
      const HemisphereEstimate found = AverageEstimates(*gatherer, { x, 0.f, 0.f }, 12, 200, .002);
      EXPECT_NEAR(found.Mean.x, irradiance(x), .001) << x;
      EXPECT_NEAR(found.Translation[0].x, exact, .1 * std::abs(exact)) << x;
    }
  }
}

TEST(HemisphereEstimate, AreZeroNextToInfiniteWall)
{
  const ShapeGatherer wall(Wall);
  const HemisphereEstimate found = AverageEstimates(wall, { .3f, 0.f, 0.f }, 32);
  EXPECT_NEAR(found.Mean.x, .5, .002);
  EXPECT_NEAR(found.Translation[0].x, 0.0, .03);
}

TEST(HemisphereEstimate, MatchGradientAtMaximumDistance)
{
  // A wall at distance x within R = 1 occludes a cone whose axis lies in the tangent plane.
  const ShapeGatherer wall(Wall, 1.f);
  const auto occlusion = [](double x) {
    return (std::acos(x) - x * std::sqrt(1.0 - x * x)) / 3.14159265358979;
  };
  for (const double x : { .2, .5, .8 })
  {
    const HemisphereEstimate found = AverageEstimates(wall, { x, 0.f, 0.f }, 32);
    EXPECT_NEAR(found.Mean.x, occlusion(x), .003) << x;
    EXPECT_NEAR(found.Translation[0].x, ComputeDerivative(occlusion, x), .02) << x;
    EXPECT_NEAR(found.Translation[0].y, 0.0, .03) << x;
  }
}

TEST(HemisphereEstimate, MatchRotationGradientNextToWall)
{
  // The wall at x = 0 occludes (1 + sin a) / 2 if the normal is rotated by a toward it.
  const ShapeGatherer wall(Wall);
  const HemisphereEstimate found = AverageEstimates(wall, { .3f, 0.f, 0.f }, 32);
  EXPECT_NEAR(found.Rotation[0].x, -.5, .005);
  EXPECT_NEAR(found.Rotation[0].y, 0.0, .01);
}

TEST(HemisphereEstimate, MatchStandardError)
{
  const ShapeGatherer sphere(MakeSphere(1.f));
  const double reference = std::pow(2.0, -1.5);
  double square = 0.0;
  double estimated = 0.0;
  for (int i = 0; i < 100; ++i)
  {
    const HemisphereEstimate found =
      AverageEstimates(sphere, { 1.f, 1e-3f * static_cast<float>(i % 7), 0.f }, 24, 1 + i);
    square += (i + 1) * std::pow(found.Mean.x - reference, 2.0) / 100.0;
    estimated += found.Error * found.Error / 100.0;
  }
  EXPECT_NEAR(std::sqrt(square / estimated), 1.0, .35);
}

TEST(HemisphereEstimate, HaveNoWeightBehindWalls)
{
  const ShapeGatherer wall(Wall);
  RecordOctree tree;
  const RecordPlacement placement(wall, RecordPlacementSettings(), tree);
  RecordCandidate site;
  site.Position = { .3f, 0.f, 0.f };
  site.Pixel = 1.f;
  long long rays = 0;
  const Record record = placement.Gather(site, rays).value();
  const float factor = 1.f / std::sqrt(1.f - std::cos(.2f));
  EXPECT_EQ(record.Weight({ { -.1f, 0.f, 0.f }, site.Normal }, factor), 0.f);
  EXPECT_GT(record.Weight({ { .6f, 0.f, 0.f }, site.Normal }, factor), 0.f);
  EXPECT_GT(record.Weight({ { .3f, .5f, 0.f }, site.Normal }, factor), 0.f);
}

TEST(HemisphereEstimate, MatchGradientAndHessianOfWallWithFalloff)
{
  for (const int shape : { 1, 2, 3 })
  {
    const ShapeGatherer wall(Wall, { 2.f, static_cast<DistanceFalloff::Shapes>(shape) });
    const FadingOcclusion reference{ 2.0, PowersOfFalloffs[shape] };
    const auto occlusion = [&reference](double x) { return reference.BeforeWall(x); };
    const auto derivative = [&occlusion](
                              double x) { return (occlusion(x + .01) - occlusion(x - .01)) / .02; };
    for (const double x : { .2, .6, 1.2 })
    {
      const HemisphereEstimate found = AverageEstimates(wall, { x, 0.f, 0.f }, 32);
      EXPECT_NEAR(found.Mean.x, occlusion(x), .002) << shape << " " << x;
      EXPECT_NEAR(found.Translation[0].x, derivative(x), .08 * std::abs(derivative(x)))
        << shape << " " << x;
      EXPECT_NEAR(found.Translation[0].y, 0.0, .01);
      const double curvature = std::abs(derivative(x + .01) - derivative(x - .01)) / .02;
      EXPECT_GT(found.HessianNorm, .5 * curvature) << shape << " " << x;
      EXPECT_LT(found.HessianNorm, 3.0 * curvature + .1) << shape << " " << x;
    }
  }
}

TEST(HemisphereEstimate, IncludeNarrowStrips)
{
  // A strip over the hemisphere is a strip of the unit disk, of half the width of a cell.
  constexpr int Side = 12;
  constexpr float Width = .5f * 2.f / Side;
  RecordOctree tree;
  RecordPlacementSettings settings;
  settings.Side = Side;
  settings.Refine = true;
  settings.Tolerance = .004;
  std::uint32_t random = 1;
  double sum = 0.0;
  double squares = 0.0;
  double exact = 0.0;
  constexpr int Count = 400;
  for (int i = 0; i < Count; ++i)
  {
    const float angle = 6.2831853f * NextFloat(random);
    const glm::vec3 across(std::cos(angle), std::sin(angle), 0.f);
    const float low = -.9f + 1.7f * NextFloat(random);
    const ShapeGatherer strip([&](glm::vec3, glm::vec3 direction) {
      HemisphereSample sample;
      const float at = glm::dot(direction, across);
      sample.Distance = at > low && at < low + Width ? 10.f : sample.Distance;
      return sample;
    });
    RecordCandidate site;
    site.Position = { .01f * static_cast<float>(i), 0.f, 0.f };
    site.Pixel = 1.f;
    long long rays = 0;
    const double found =
      RecordPlacement(strip, settings, tree).Gather(site, rays).value().Gathered.Mean.x;
    const auto area = [](double x) { return x * std::sqrt(1.0 - x * x) + std::asin(x); };
    const double occlusion = (area(low + Width) - area(low)) / 3.14159265358979;
    sum += found - occlusion;
    squares += std::pow(found - occlusion, 2.0);
    exact += occlusion;
  }
  EXPECT_LT(std::abs(sum), .02 * exact);
  EXPECT_LT(std::sqrt(squares / Count), .1 * exact / Count);
}
