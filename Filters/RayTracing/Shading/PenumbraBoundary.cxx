// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PenumbraBoundary.h"

#include "OwenSobolSequence.h"
#include "RayTracingConstants.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

constexpr float Pi = glm::pi<float>();
/// Standard deviation of a uniform distribution over an interval of length 1.
constexpr float UniformDeviation = 0.2887f;

/// Half the length of a chord below which its cap is small. Without neighbors that have a boundary, a
/// wire is as likely: the ends of the cap are found to this bracket, in radians, and points at this
/// multiple of half the chord from its middle, at these angles in radians, must not belong to the cap.
constexpr float SmallChord = 0.3f;
constexpr float SmallCapBracket = 0.2f;
constexpr float ClosureRadius = 1.5f;
constexpr float ClosureAngle = 0.8f;

/// Chosen by simulated annealing: few strips with widths of 1/8 and 1/16 of the diameter and few disks with
/// a radius of 0.3 contain neither one of these points nor one of 8 points on the circumference.
constexpr glm::vec2 SpreadPoints[InteriorPoints] = { { 0.422f, -0.539f }, { -0.061f, 0.122f },
  { -0.291f, 0.673f }, { 0.246f, 0.384f }, { -0.071f, -0.471f }, { -0.592f, -0.326f },
  { -0.494f, 0.109f }, { 0.683f, 0.078f } };

}

float CapArea(float half)
{
  return (half - std::sin(half) * std::cos(half)) / Pi;
}

float ComputeCircleOffset(std::uint32_t seed)
{
  return 0.5f * Pi * NextFloat(seed);
}

glm::vec2 InteriorPointSet::At(std::uint32_t index) const
{
  const glm::vec2 point = SpreadPoints[(this->First + index) % InteriorPoints];
  return point.x * this->Axis + point.y * glm::vec2(-this->Axis.y, this->Axis.x);
}

void PenumbraBoundary::SetEnds(glm::vec2 begin, glm::vec2 end)
{
  this->Begin = begin;
  this->End = end;
}

// The phase of the brackets is random: errors of neighbors are independent of each other, although
// their predictions are not.
bool PenumbraBoundary::FindEnds(const PenumbraArc& arc)
{
  const float half = std::acos(glm::clamp(arc.Distance, -1.f, 1.f));
  const float room = std::min(half, Pi - half);
  if (room < MinimumPredictedAngle)
  {
    return false;
  }
  const float width = PredictedBracket * this->ComputeEndWidth(std::sin(half));
  const float bracket = std::min({ width, NarrowBracket, 0.5f * room });
  std::uint32_t random = this->Seed ^ 0x9e3779b9u;
  this->PredictedCurvature = arc.Curvature;
  return this->FindEnd(arc.Axis - half, bracket, NextFloat(random), 0.f, this->Begin) &&
    this->FindEnd(arc.Axis + half, bracket, NextFloat(random), 1.f, this->End) &&
    this->HalfAngle() > 0.f && this->HalfAngle() < Pi;
}

/// Brackets the end near `angle`. `before` is the visibility at smaller angles; `random` is the
/// position of `angle` in its bracket.
bool PenumbraBoundary::FindEnd(
  float angle, float width, float random, float before, glm::vec2& bracket) const
{
  bracket = { angle - random * width, angle + (1.f - random) * width };
  bool known[2] = { false, false };
  int side = random < 0.5f ? 0 : 1; // the nearer one first
  for (int step = 0; step < MaximumPredictedBrackets + 2; ++step)
  {
    const float value = this->Visibility(CircleRadius * OnCircle(bracket[side]));
    if (!IsBinary(value))
    {
      return false;
    }
    known[side] = true;
    if ((value == before) != (side == 0))
    {
      // The end is outside: this point is the other side of the next bracket, twice as wide.
      const float next =
        bracket[side] + (side == 0 ? -1.f : 1.f) * (step == 0 ? width : 2.f * width);
      bracket[1 - side] = bracket[side];
      bracket[side] = next;
      known[1 - side] = true;
      known[side] = false;
    }
    else if (known[1 - side])
    {
      return true;
    }
    else
    {
      side = 1 - side;
    }
  }
  return false;
}

bool PenumbraBoundary::Refine(int checkPoints, bool isSupported)
{
  this->IsSupported = isSupported;
  return this->NarrowEnds() && this->IsClosed() && this->FindSagitta() && this->Check(checkPoints);
}

bool PenumbraBoundary::NarrowEnds()
{
  while (this->EstimateEndError() > EndErrorFraction * this->Tolerance || this->IsWide())
  {
    const bool first = this->Begin.y - this->Begin.x >= this->End.y - this->End.x;
    glm::vec2& bracket = first ? this->Begin : this->End;
    const float middle = 0.5f * (bracket.x + bracket.y);
    if (middle <= bracket.x || middle >= bracket.y)
    {
      break;
    }
    const float value = this->Visibility(CircleRadius * OnCircle(middle));
    if (!IsBinary(value))
    {
      return false;
    }
    ((value == 1.f) == first ? bracket.y : bracket.x) = middle;
  }
  return true;
}

// A wire also hides a small part of the circumference.
bool PenumbraBoundary::IsClosed() const
{
  if (this->IsSupported || this->HalfLength() > SmallChord)
  {
    return true;
  }
  const float around = std::cos(this->HalfAngle()) < 0.f ? 1.f : 0.f;
  const float radius = ClosureRadius * this->HalfLength();
  for (const float angle : { -ClosureAngle, 0.f, ClosureAngle })
  {
    const float across = radius * std::cos(angle);
    const glm::vec2 point = this->At(radius * std::sin(angle), around > 0.f ? across : -across);
    if (this->Visibility(point) != around)
    {
      return false;
    }
  }
  return true;
}

float PenumbraBoundary::GetArea() const
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

float PenumbraBoundary::GetError() const
{
  return std::hypot(this->EstimateEndError(), this->EstimateSagittaError());
}

PenumbraArc PenumbraBoundary::GetArc() const
{
  const float chord = this->HalfLength();
  const float sagitta = this->Sagitta();
  return { this->AxisAngle(), std::cos(this->HalfAngle()),
    2.f * sagitta / std::max(chord * chord + sagitta * sagitta, 1e-6f) };
}

float PenumbraBoundary::HalfAngle() const
{
  return 0.25f * (this->End.x + this->End.y - this->Begin.x - this->Begin.y);
}

bool PenumbraBoundary::IsWide() const
{
  const bool isSmall = this->HalfLength() <= SmallChord;
  return (!isSmall || !this->IsSupported) &&
    std::max(this->Begin.y - this->Begin.x, this->End.y - this->End.x) >
    (isSmall ? SmallCapBracket : NarrowBracket);
}

float PenumbraBoundary::EstimateEndError() const
{
  const float slope = this->HalfLength() * this->HalfLength() / Pi;
  const float width = std::hypot(this->Begin.y - this->Begin.x, this->End.y - this->End.x);
  return UniformDeviation * slope * width;
}

float PenumbraBoundary::ComputeEndWidth(float halfLength) const
{
  const float slope = std::max(halfLength * halfLength, 1e-6f) / Pi;
  return EndErrorFraction * this->Tolerance / (UniformDeviation * slope * std::sqrt(2.f));
}

float PenumbraBoundary::EstimateSagittaError() const
{
  const bool isStraight = this->Middle.x < 0.f && this->Middle.y > 0.f;
  return (isStraight ? StraightError : CurvedError) * this->SagittaWidth() * this->HalfLength() /
    Pi;
}

/// Point at `along` times the direction of the chord and `across` times the direction from its
/// middle to the visible side.
glm::vec2 PenumbraBoundary::At(float along, float across) const
{
  const glm::vec2 axis = OnCircle(this->AxisAngle());
  return (std::cos(this->HalfAngle()) + across) * axis + along * glm::vec2(-axis.y, axis.x);
}

/// Moves the bracket of the sagitta, within [low, high], until it contains the boundary.
bool PenumbraBoundary::BracketSagitta(float low, float high)
{
  bool isKnown = false;
  for (const int side : { -1, 1 })
  {
    float& bound = side < 0 ? this->Middle.x : this->Middle.y;
    float& other = side < 0 ? this->Middle.y : this->Middle.x;
    const float limit = side < 0 ? low : high;
    float step =
      std::max(this->SagittaWidth(), ProbeDistance); // the limits may have cut the bracket
    for (bool isInside = isKnown || bound == limit; !isInside; isInside = bound == limit)
    {
      const float value = this->Visibility(this->At(0.f, -bound));
      if (!IsBinary(value))
      {
        return false;
      }
      if (value == (side < 0 ? 1.f : 0.f))
      {
        break;
      }
      isKnown = true;
      other = bound;
      bound = side < 0 ? std::max(bound - step, limit) : std::min(bound + step, limit);
      step *= 3.f;
    }
  }
  return true;
}

/// Brackets the distance of the boundary from the chord at its middle, positive to the hidden side.
bool PenumbraBoundary::FindSagitta()
{
  const float chord = std::cos(this->HalfAngle());
  const float low = chord - 1.f;
  const float high = chord + 1.f;
  const float half = this->HalfLength();
  const float bend = std::abs(this->PredictedCurvature * half);
  float predicted =
    this->PredictedCurvature * half * half / (1.f + std::sqrt(std::max(1.f - bend * bend, 0.f)));
  float probe = ProbeDistance;
  if (std::abs(predicted) < StraightSagitta)
  {
    predicted = 0.f;
  }
  else
  {
    std::uint32_t random = this->Seed ^ 0x85ebca6bu;
    probe = std::min(probe,
      0.5f * PredictedBracket * SagittaErrorFraction * this->Tolerance * Pi /
        (CurvedError * std::max(half, 0.1f)));
    predicted += probe * (2.f * NextFloat(random) - 1.f);
  }
  this->Middle = { std::clamp(predicted - probe, low, high),
    std::clamp(predicted + probe, low, high) };
  if (half * ProbeDistance / Pi * 4.f < this->Tolerance * 0.5f)
  {
    return true; // a cap too small to matter
  }
  if (!this->BracketSagitta(low, high))
  {
    return false;
  }
  while (this->SagittaWidth() > 2.f * ProbeDistance + 1e-3f ||
    this->EstimateSagittaError() > 1.001f * SagittaErrorFraction * this->Tolerance)
  {
    const float middle = this->Sagitta();
    const float value = this->Visibility(this->At(0.f, -middle));
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

/// Returns the distance of a point from the boundary along the axis, positive on the visible side.
float PenumbraBoundary::SignedDistance(glm::vec2 point) const
{
  const glm::vec2 axis = OnCircle(this->AxisAngle());
  const float along = glm::dot(point, glm::vec2(-axis.y, axis.x));
  const float chord = this->HalfLength();
  const float h = std::abs(this->Sagitta());
  float rise = 0.f;
  if (h > 1e-4f && chord > 1e-4f)
  {
    const float radius = (chord * chord + h * h) / (2.f * h);
    rise = std::sqrt(std::max(radius * radius - along * along, 0.f)) - (radius - h);
  }
  return glm::dot(point, axis) - std::cos(this->HalfAngle()) + std::copysign(rise, this->Sagitta());
}

/// Tests both sides of the boundary at one quarter of its length, and points of the sequence.
bool PenumbraBoundary::Check(int points) const
{
  const float along = (this->Seed & 0x10000u ? 0.5f : -0.5f) * this->HalfLength();
  const float offset = this->SignedDistance(this->At(along, 0.f));
  const OwenSobolSequence sequence(this->Seed);
  for (int i = 0; i < 2 + points; ++i)
  {
    const glm::vec2 at = sequence.At(static_cast<std::uint32_t>(i));
    const glm::vec2 point = i < 2
      ? this->At(along, (i == 0 ? CheckDistance : -CheckDistance) - offset)
      : SampleUniformDiskConcentric(at.x, at.y);
    const float distance = this->SignedDistance(point);
    if (glm::dot(point, point) < 1.f && std::abs(distance) > 0.8f * CheckDistance &&
      this->Visibility(point) != (distance > 0.f ? 1.f : 0.f))
    {
      return false;
    }
  }
  return true;
}

}
