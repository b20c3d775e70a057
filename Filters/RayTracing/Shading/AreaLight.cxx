// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "AreaLight.h"

#include "HemisphereSampling.h"
#include "OwenSobolSequence.h"
#include "RayTracingConstants.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace penumbra
{
namespace
{

constexpr float Pi = glm::pi<float>();

/// Area of a cap of the unit disk with half the central angle `half`, as a fraction of the disk.
float CapArea(float half)
{
  return (half - std::sin(half) * std::cos(half)) / Pi;
}

glm::vec2 OnCircle(float angle)
{
  return { std::cos(angle), std::sin(angle) };
}

bool IsBinary(float value)
{
  return value == 0.f || value == 1.f;
}

VisibleFraction SampleSequence(
  const std::function<float(glm::vec2)>& visibility, std::uint32_t seed, float tolerance)
{
  const OwenSobolSequence sequence(seed);
  std::vector<float> values;
  values.reserve(FirstLightSamples);
  double sum = 0.0;
  for (std::uint32_t count = FirstLightSamples;; count *= 2)
  {
    while (values.size() < count)
    {
      const glm::vec2 at = sequence.At(static_cast<std::uint32_t>(values.size()));
      values.push_back(visibility(SampleUniformDiskConcentric(at.x, at.y)));
      sum += values.back();
    }
    const auto ends = std::minmax_element(values.begin(), values.end());
    const double range = *ends.second - *ends.first;
    const double squares =
      OwenSobolSequence::SumPairDifferences(values) + LightVarianceFloorPairs * range * range;
    const double error = StratificationGain * std::sqrt(squares) / count;
    if (error <= tolerance || count >= MaximumLightSamples)
    {
      return { static_cast<float>(sum / count), static_cast<float>(error) };
    }
  }
}

/// Smooth boundary between the visible and the hidden part of the disk: a circular arc between two
/// points on the circumference. All positions are brackets that visibility tests make narrower.
class Boundary
{
public:
  /// `begin` and `end` are angles; the circumference is visible from `begin` counterclockwise to
  /// `end`. Each bracket contains a hidden and a visible end.
  Boundary(glm::vec2 begin, glm::vec2 end)
    : Begin(begin),
      End(end)
  {
  }

  /// Narrows the brackets until the estimated error is at most `tolerance`. Returns false if the
  /// boundary is not a smooth curve, or if `visibility` is neither 0 nor 1.
  bool Refine(
    const std::function<float(glm::vec2)>& visibility, std::uint32_t seed, float tolerance)
  {
    while (this->EstimateEndError() > EndErrorFraction * tolerance || this->IsWide())
    {
      const bool first = this->Begin.y - this->Begin.x >= this->End.y - this->End.x;
      glm::vec2& bracket = first ? this->Begin : this->End;
      const float middle = 0.5f * (bracket.x + bracket.y);
      if (middle <= bracket.x || middle >= bracket.y)
      {
        break;
      }
      const float value = visibility(CircleRadius * OnCircle(middle));
      if (!IsBinary(value))
      {
        return false;
      }
      ((value == 1.f) == first ? bracket.y : bracket.x) = middle;
    }
    return this->FindSagitta(visibility, tolerance) && this->Check(visibility, seed);
  }

  float Area() const
  {
    const float chord = this->HalfLength();
    float area = CapArea(this->HalfAngle());
    const float sagitta = this->Sagitta();
    if (std::abs(sagitta) > 1e-4f && chord > 1e-4f)
    {
      const float h = std::abs(sagitta);
      const float radius = (chord * chord + h * h) / (2.f * h);
      const float half = 2.f * std::atan2(h, chord);
      area += std::copysign(radius * radius * CapArea(half), sagitta);
    }
    return std::clamp(area, 0.f, 1.f);
  }

  float Error() const { return std::hypot(this->EstimateEndError(), this->EstimateSagittaError()); }

private:
  float HalfAngle() const
  {
    return 0.25f * (this->End.x + this->End.y - this->Begin.x - this->Begin.y);
  }
  float HalfLength() const { return std::abs(std::sin(this->HalfAngle())); }
  bool IsWide() const
  {
    return this->HalfLength() > 0.3f &&
      std::max(this->Begin.y - this->Begin.x, this->End.y - this->End.x) > NarrowBracket;
  }
  float SagittaWidth() const { return this->Middle.y - this->Middle.x; }
  float Sagitta() const { return 0.5f * (this->Middle.x + this->Middle.y); }

  float EstimateEndError() const
  {
    const float slope = this->HalfLength() * this->HalfLength() / Pi;
    const float width = std::hypot(this->Begin.y - this->Begin.x, this->End.y - this->End.x);
    return 0.2887f * slope * width;
  }

  float EstimateSagittaError() const
  {
    const bool isStraight = this->Middle.x < 0.f && this->Middle.y > 0.f;
    return (isStraight ? StraightError : CurvedError) * this->SagittaWidth() * this->HalfLength() /
      Pi;
  }

  /// Point at `along` times the direction of the chord and `across` times the direction from its
  /// middle to the visible side.
  glm::vec2 At(float along, float across) const
  {
    const float middle = 0.25f * (this->Begin.x + this->Begin.y + this->End.x + this->End.y);
    const glm::vec2 axis = OnCircle(middle);
    return (std::cos(this->HalfAngle()) + across) * axis + along * glm::vec2(-axis.y, axis.x);
  }

  /// Brackets the distance of the boundary from the chord at its middle, positive to the hidden
  /// side.
  bool FindSagitta(const std::function<float(glm::vec2)>& visibility, float tolerance)
  {
    const float chord = std::cos(this->HalfAngle());
    const float low = chord - 1.f;
    const float high = chord + 1.f;
    this->Middle = { std::max(-ProbeDistance, low), std::min(ProbeDistance, high) };
    if (this->HalfLength() * ProbeDistance / Pi * 4.f < tolerance * 0.5f)
    {
      return true; // a cap too small to matter
    }
    for (const int side : { -1, 1 })
    {
      float& bound = side < 0 ? this->Middle.x : this->Middle.y;
      float& other = side < 0 ? this->Middle.y : this->Middle.x;
      const float limit = side < 0 ? low : high;
      bool isKnown = bound == limit || (side > 0 && bound < ProbeDistance);
      while (!isKnown)
      {
        const float value = visibility(this->At(0.f, -bound));
        if (!IsBinary(value))
        {
          return false;
        }
        if (value == (side < 0 ? 1.f : 0.f))
        {
          break;
        }
        other = bound;
        bound = side * std::min(std::abs(limit), 3.f * std::abs(bound));
        isKnown = bound == limit;
      }
    }
    while (this->Middle.y - this->Middle.x > 2.f * ProbeDistance + 1e-3f ||
      this->EstimateSagittaError() > SagittaErrorFraction * tolerance)
    {
      const float middle = this->Sagitta();
      const float value = visibility(this->At(0.f, -middle));
      if (!IsBinary(value))
      {
        return false;
      }
      (value == 1.f ? this->Middle.x : this->Middle.y) = middle;
      if (this->SagittaWidth() < 1e-3f)
      {
        break;
      }
    }
    return true;
  }

  /// Returns the distance of a point from the boundary along the axis, positive on the visible
  /// side.
  float SignedDistance(glm::vec2 point) const
  {
    const float middle = 0.25f * (this->Begin.x + this->Begin.y + this->End.x + this->End.y);
    const glm::vec2 axis = OnCircle(middle);
    const float along = glm::dot(point, glm::vec2(-axis.y, axis.x));
    const float chord = this->HalfLength();
    const float h = std::abs(this->Sagitta());
    float rise = 0.f;
    if (h > 1e-4f && chord > 1e-4f)
    {
      const float radius = (chord * chord + h * h) / (2.f * h);
      rise = std::sqrt(std::max(radius * radius - along * along, 0.f)) - (radius - h);
    }
    return glm::dot(point, axis) - std::cos(this->HalfAngle()) +
      std::copysign(rise, this->Sagitta());
  }

  /// Tests both sides of the boundary at one quarter of its length, and points of the sequence.
  bool Check(const std::function<float(glm::vec2)>& visibility, std::uint32_t seed) const
  {
    const float along = (seed & 0x10000u ? 0.5f : -0.5f) * this->HalfLength();
    const float offset = this->SignedDistance(this->At(along, 0.f));
    const OwenSobolSequence sequence(seed);
    for (int i = 0; i < 2 + CheckPoints; ++i)
    {
      const glm::vec2 at = sequence.At(static_cast<std::uint32_t>(i));
      const glm::vec2 point = i < 2
        ? this->At(along, (i == 0 ? CheckDistance : -CheckDistance) - offset)
        : SampleUniformDiskConcentric(at.x, at.y);
      const float distance = this->SignedDistance(point);
      if (glm::dot(point, point) < 1.f && std::abs(distance) > 0.8f * CheckDistance &&
        visibility(point) != (distance > 0.f ? 1.f : 0.f))
      {
        return false;
      }
    }
    return true;
  }

  glm::vec2 Begin;
  glm::vec2 End;
  glm::vec2 Middle{ 0.f }; ///< bracket of the sagitta: hidden side of x, visible side of y
};

}

AreaLight::AreaLight(const Light& light, glm::vec3 point)
  : Source(light),
    Point(point),
    Axis(-light.Direction)
{
  if (light.Kind == Light::Kinds::Directional)
  {
    const float sine = std::sin(0.5f * light.AngularRadius);
    this->Cap = 2.f * sine * sine;
    this->Distance = std::numeric_limits<float>::infinity();
  }
  else
  {
    const glm::vec3 toward = light.Position - point;
    this->Distance = glm::length(toward);
    this->Inside = light.Kind == Light::Kinds::Positional && this->Distance <= light.Radius;
    if (light.Kind == Light::Kinds::Positional && !this->Inside)
    {
      this->Axis = toward / this->Distance;
      const float sine = light.Radius / this->Distance;
      this->Cap = sine * sine / (1.f + std::sqrt(1.f - sine * sine));
    }
  }
  const glm::mat3 frame = FrameFromNormal(this->Axis);
  this->Tangents[0] = frame[0];
  this->Tangents[1] = frame[1];
}

Ray AreaLight::MakeRay(glm::vec2 disk) const
{
  Ray ray;
  ray.Origin = this->Point;
  const glm::vec3 across = disk.x * this->Tangents[0] + disk.y * this->Tangents[1];
  if (this->Source.Kind == Light::Kinds::Spot)
  {
    const glm::vec3 toward = this->Source.Position + this->Source.Radius * across - this->Point;
    ray.Far = glm::length(toward);
    ray.Direction = toward / ray.Far;
    return ray;
  }
  const float square = glm::dot(disk, disk);
  const float height = square * this->Cap; // 1 - cosine
  const float factor = std::sqrt(this->Cap * (2.f - height));
  ray.Direction = (1.f - height) * this->Axis + factor * across;
  if (this->Source.Kind == Light::Kinds::Positional)
  {
    const float sine = this->Distance * factor * std::sqrt(square);
    const float depth =
      std::sqrt(std::max(this->Source.Radius * this->Source.Radius - sine * sine, 0.f));
    ray.Far = std::max(this->Distance * (1.f - height) - depth, 0.f);
  }
  return ray;
}

VisibleFraction EstimateVisibleFraction(
  const std::function<float(glm::vec2)>& visibility, std::uint32_t seed, float tolerance)
{
  // The points on the circumference are rotated by the seed, so that errors of neighbors are
  // independent.
  std::uint32_t random = seed;
  const float offset = 0.5f * Pi * NextFloat(random);
  std::array<float, MaximumCirclePoints> circle;
  int count = 0;
  int changes = 0;
  int next = FirstCirclePoints;
  do
  {
    const int step = MaximumCirclePoints / next;
    for (int i = 0; i < next; ++i)
    {
      if (count == 0 || i % 2 == 1)
      {
        circle[i * step] =
          visibility(CircleRadius * OnCircle(offset + 2.f * Pi * static_cast<float>(i) / next));
      }
    }
    count = next;
    changes = 0;
    for (int i = 0; i < count; ++i)
    {
      changes += circle[i * step] != circle[(i + 1) % count * step] ? 1 : 0;
      changes += IsBinary(circle[i * step]) ? 0 : MaximumCirclePoints;
    }
    next *= 2;
  }
  while (changes == 0 && count < MaximumCirclePoints &&
    (count < MinimumCirclePoints || MissedCapError * CapArea(Pi / count) > tolerance));

  const float missed = MissedCapError * CapArea(Pi / static_cast<float>(count));
  if (changes == 0)
  {
    const OwenSobolSequence sequence(seed);
    for (std::uint32_t i = 0; i < InteriorPoints; ++i)
    {
      const glm::vec2 at = sequence.At(i);
      if (visibility(SampleUniformDiskConcentric(at.x, at.y)) != circle[0])
      {
        return SampleSequence(visibility, seed, tolerance);
      }
    }
    return { circle[0], missed };
  }
  if (changes == 2)
  {
    const int step = MaximumCirclePoints / count;
    glm::vec2 begin(0.f);
    glm::vec2 end(0.f);
    for (int i = 0; i < count; ++i)
    {
      const float before = circle[i * step];
      const float after = circle[(i + 1) % count * step];
      const glm::vec2 bracket = offset + 2.f * Pi / static_cast<float>(count) * glm::vec2(i, i + 1);
      begin = before < after ? bracket : begin;
      end = before > after ? bracket : end;
    }
    if (end.x < begin.x)
    {
      end += 2.f * Pi;
    }
    Boundary boundary(begin, end);
    if (boundary.Refine(visibility, seed, tolerance))
    {
      return { boundary.Area(), boundary.Error() };
    }
  }
  return SampleSequence(visibility, seed, tolerance);
}

}
