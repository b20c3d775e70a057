// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Gradients and bends of occlusion against closed forms.
#include "ClosedForms/FalloffOcclusion.h"
#include "Records/RecordPlacement.h"
#include "Shading/HemisphereSampling.h"

#include <gtest/gtest.h>

#include <functional>

using namespace penumbra;

namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();

/// Occlusion by a shape that is one formula: no triangles, no rounding of theirs.
class ShapeGatherer : public Gatherer
{
public:
  using Shape = std::function<HemisphereSample(glm::vec3 origin, glm::vec3 direction)>;

  explicit ShapeGatherer(Shape shape, const DistanceFalloff& falloff = {})
    : Seen(std::move(shape)),
      Counting(falloff)
  {
  }

  long long Gather(glm::vec3 point, glm::vec3, const std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& sights) const override
  {
    sights.clear();
    for (const glm::vec3& direction : directions)
    {
      HemisphereSample sight = this->Seen(point, direction);
      if (!(sight.Distance < this->GetReach()))
      {
        sight = HemisphereSample();
      }
      sight.Radiance =
        glm::vec3(std::isinf(sight.Distance) ? 0.f : this->Counting.Evaluate(sight.Distance));
      sights.push_back(sight);
    }
    return static_cast<long long>(directions.size());
  }
  DistanceFalloff GetFalloff() const override { return this->Counting; }

private:
  Shape Seen;
  DistanceFalloff Counting;
};

/// A sphere of radius 1 above the origin, its centre at `height`.
ShapeGatherer::Shape SphereAt(float height)
{
  return [height](glm::vec3 origin, glm::vec3 direction) {
    HemisphereSample sight;
    const glm::vec3 from = origin - glm::vec3(0.f, 0.f, height);
    const float b = glm::dot(from, direction);
    const float discriminant = b * b - (glm::dot(from, from) - 1.f);
    if (discriminant > 0.f && -b - std::sqrt(discriminant) > 0.f)
    {
      sight.Distance = -b - std::sqrt(discriminant);
      sight.Normal = from + sight.Distance * direction;
    }
    return sight;
  };
}

/// The wall x = 0, without end.
HemisphereSample Wall(glm::vec3 origin, glm::vec3 direction)
{
  HemisphereSample sight;
  if (origin.x * direction.x < 0.f)
  {
    sight.Distance = -origin.x / direction.x;
    sight.Normal = glm::vec3(1.f, 0.f, 0.f);
  }
  return sight;
}

/// A square with sides of 2 at height 1.
HemisphereSample Ceiling(glm::vec3 origin, glm::vec3 direction)
{
  HemisphereSample sight;
  const glm::vec3 at = origin + (1.f - origin.z) / direction.z * direction;
  if (direction.z > 0.f && std::abs(at.x) < 1.f && std::abs(at.y) < 1.f)
  {
    sight.Distance = (1.f - origin.z) / direction.z;
    sight.Normal = glm::vec3(0.f, 0.f, 1.f);
  }
  return sight;
}

/// The mean of what records with other jitter find at almost the same place.
HemisphereEstimate MeanOf(const Gatherer& gatherer, glm::vec3 point, int side, int count = 60)
{
  RecordOctree tree;
  RecordPlacementSettings settings;
  settings.Side = side;
  const RecordPlacement places(gatherer, settings, tree);
  HemisphereEstimate mean;
  for (int i = 0; i < count; ++i)
  {
    RecordCandidate site;
    site.Position = point + glm::vec3(0.f, 1e-5f * static_cast<float>(i), 0.f);
    site.Pixel = 1.f;
    long long rays = 0;
    const HemisphereEstimate found = places.Gather(site, rays).value().Gathered;
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

/// What numerical differences make of a formula.
double Slope(const std::function<double(double)>& f, double x)
{
  return (f(x + 1e-4) - f(x - 1e-4)) / 2e-4;
}

/// Blocked share under a rectangle [x0, x1] x [y0, y1] at height 1 (sum of four corners).
double RectangleShare(double x0, double x1, double y0, double y1)
{
  const auto corner = [](double x, double y) {
    const double a = std::sqrt(1.0 + x * x);
    const double b = std::sqrt(1.0 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2.0 * 3.14159265358979);
  };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

}

TEST(Derivatives, AreNoneInTheOpen)
{
  const ShapeGatherer open([](glm::vec3, glm::vec3) { return HemisphereSample(); });
  const HemisphereEstimate found = MeanOf(open, { .3f, .2f, 0.f }, 32, 1);
  EXPECT_EQ(found.Mean.x, 0.f);
  EXPECT_EQ(found.Error, 0.f);
  EXPECT_EQ(found.HessianNorm, 0.f);
  EXPECT_EQ(found.Translation[0], glm::vec3(0.f));
}

TEST(Derivatives, KnowTheSlopeBesideASphere)
{
  for (const double height : { 1.0, 1.5 })
  {
    const ShapeGatherer sphere(SphereAt(static_cast<float>(height)));
    const auto share = [height](double rho) {
      return height / std::pow(height * height + rho * rho, 1.5);
    };
    for (const double rho : { .5, 1.0, 2.0 })
    {
      const HemisphereEstimate found = MeanOf(sphere, { rho, 0.f, 0.f }, 32);
      EXPECT_NEAR(found.Mean.x, share(rho), .002) << height << " " << rho;
      EXPECT_NEAR(found.Translation[0].x, Slope(share, rho), .08 * std::abs(Slope(share, rho)))
        << height << " " << rho;
      EXPECT_NEAR(found.Translation[0].y, 0.0, .02);
    }
  }
}

TEST(Derivatives, BoundTheBendBesideASphere)
{
  const ShapeGatherer sphere(SphereAt(1.f));
  const auto share = [](double rho) { return std::pow(1.0 + rho * rho, -1.5); };
  const auto slope = [&share](double rho) { return Slope(share, rho); };
  for (const double rho : { .5, 1.0, 1.5, 2.0 })
  {
    // The largest of the bends along the radius and across it.
    const double truth = std::max(std::abs(Slope(slope, rho)), std::abs(slope(rho) / rho));
    const double found = MeanOf(sphere, { rho, 0.f, 0.f }, 32).HessianNorm;
    EXPECT_GT(found, .5 * truth) << rho;
    EXPECT_LT(found, 3.0 * truth) << rho;
  }
}

TEST(Derivatives, KnowTheSlopeUnderARectangle)
{
  const ShapeGatherer ceiling(Ceiling);
  const auto share = [](double x) { return RectangleShare(-1.0 - x, 1.0 - x, -1.0, 1.0); };
  for (const double x : { 0.0, .4, .8, 1.3 })
  {
    const HemisphereEstimate found = MeanOf(ceiling, { x, 0.f, 0.f }, 32);
    EXPECT_NEAR(found.Mean.x, share(x), .002) << x;
    EXPECT_NEAR(found.Translation[0].x, Slope(share, x), .02) << x;
    const auto slope = [&share](double at) { return Slope(share, at); };
    EXPECT_GT(found.HessianNorm, .5 * std::abs(Slope(slope, x))) << x;
  }
}

TEST(Derivatives, AreNoneBesideAWallWithoutEnd)
{
  const ShapeGatherer wall(Wall);
  const HemisphereEstimate found = MeanOf(wall, { .3f, 0.f, 0.f }, 32);
  EXPECT_NEAR(found.Mean.x, .5, .002);
  EXPECT_NEAR(found.Translation[0].x, 0.0, .03);
}

TEST(Derivatives, KnowTheSlopeWhereReachEnds)
{
  // Of a wall at distance x within reach R = 1 a cone is seen, its axis in the tangent plane.
  const ShapeGatherer wall(Wall, 1.f);
  const auto share = [](double x) {
    return (std::acos(x) - x * std::sqrt(1.0 - x * x)) / 3.14159265358979;
  };
  for (const double x : { .2, .5, .8 })
  {
    const HemisphereEstimate found = MeanOf(wall, { x, 0.f, 0.f }, 32);
    EXPECT_NEAR(found.Mean.x, share(x), .003) << x;
    EXPECT_NEAR(found.Translation[0].x, Slope(share, x), .02) << x;
    EXPECT_NEAR(found.Translation[0].y, 0.0, .03) << x;
  }
}

TEST(Derivatives, KnowHowTurningChangesTheShare)
{
  // The wall at x = 0 blocks (1 + sin a) / 2 where the normal is turned by a towards it.
  const ShapeGatherer wall(Wall);
  const HemisphereEstimate found = MeanOf(wall, { .3f, 0.f, 0.f }, 32);
  EXPECT_NEAR(found.Rotation[0].x, -.5, .005);
  EXPECT_NEAR(found.Rotation[0].y, 0.0, .01);
}

TEST(Derivatives, TellTheStandardError)
{
  const ShapeGatherer sphere(SphereAt(1.f));
  const double truth = std::pow(2.0, -1.5);
  double square = 0.0;
  double told = 0.0;
  for (int i = 0; i < 100; ++i)
  {
    const HemisphereEstimate found =
      MeanOf(sphere, { 1.f, 1e-3f * static_cast<float>(i % 7), 0.f }, 24, 1 + i);
    square += (i + 1) * std::pow(found.Mean.x - truth, 2.0) / 100.0;
    told += found.Error * found.Error / 100.0;
  }
  EXPECT_NEAR(std::sqrt(square / told), 1.0, .35);
}

TEST(Derivatives, FindWallsByDirection)
{
  const ShapeGatherer wall(Wall);
  RecordOctree tree;
  const RecordPlacement places(wall, RecordPlacementSettings(), tree);
  RecordCandidate site;
  site.Position = { .3f, 0.f, 0.f };
  site.Pixel = 1.f;
  long long rays = 0;
  const Record record = places.Gather(site, rays).value();
  const float factor = 1.f / std::sqrt(1.f - std::cos(.2f));
  EXPECT_EQ(record.Weight({ { -.1f, 0.f, 0.f }, site.Normal }, factor), 0.f);
  EXPECT_GT(record.Weight({ { .6f, 0.f, 0.f }, site.Normal }, factor), 0.f);
  EXPECT_GT(record.Weight({ { .3f, .5f, 0.f }, site.Normal }, factor), 0.f);
}

TEST(Derivatives, KnowSlopeAndBendBeforeAWallThatFallsOff)
{
  for (const int shape : { 1, 2, 3 })
  {
    const ShapeGatherer wall(Wall, { 2.f, static_cast<DistanceFalloff::Shapes>(shape) });
    const FadingOcclusion truth{ 2.0, PowersOfFalloffs[shape] };
    const auto share = [&truth](double x) { return truth.BeforeWall(x); };
    const auto slope = [&share](double x) { return (share(x + .01) - share(x - .01)) / .02; };
    for (const double x : { .2, .6, 1.2 })
    {
      const HemisphereEstimate found = MeanOf(wall, { x, 0.f, 0.f }, 32);
      EXPECT_NEAR(found.Mean.x, share(x), .002) << shape << " " << x;
      EXPECT_NEAR(found.Translation[0].x, slope(x), .08 * std::abs(slope(x))) << shape << " " << x;
      EXPECT_NEAR(found.Translation[0].y, 0.0, .01);
      const double bend = std::abs(slope(x + .01) - slope(x - .01)) / .02;
      EXPECT_GT(found.HessianNorm, .5 * bend) << shape << " " << x;
      EXPECT_LT(found.HessianNorm, 3.0 * bend + .1) << shape << " " << x;
    }
  }
}
