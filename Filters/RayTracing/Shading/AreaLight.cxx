// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "AreaLight.h"

#include "HemisphereSampling.h"
#include "Light.h"
#include "OwenSobolSequence.h"
#include "PenumbraBoundary.h"
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
    // Samples of a divided light that agree by chance may have missed an opaque occluder or, if they
    // are hidden, a gap.
    const float agreeing = *ends.second > 0.f ? *ends.second : 1.f;
    const double range = *ends.first == *ends.second ? agreeing : *ends.second - *ends.first;
    const double squares =
      OwenSobolSequence::SumPairDifferences(values) + LightVarianceFloorPairs * range * range;
    const double error = StratificationGain * std::sqrt(squares) / count;
    if (error <= tolerance || count >= MaximumLightSamples)
    {
      return { static_cast<float>(sum / count), static_cast<float>(error) };
    }
  }
}

/// Samples a light that more than one boundary divides.
VisibleFraction SampleComplex(const DiskVisibility& visibility, std::uint32_t seed, float tolerance,
  PenumbraNeighbors* neighbors)
{
  if (neighbors)
  {
    neighbors->SetComplex();
  }
  return SampleSequence(visibility, seed, tolerance);
}

/// Number of points inside the disk that must have the visibility `value` of the circumference.
std::uint32_t GetInteriorPoints(const PenumbraNeighbors* neighbors, float value)
{
  if (!neighbors || neighbors->IsComplex())
  {
    return InteriorPoints;
  }
  return neighbors->HasUniform(value) ? SupportedInteriorPoints : BlockInteriorPoints;
}

/// Number of points inside the disk that check a boundary.
int GetCheckPoints(const PenumbraNeighbors* neighbors)
{
  if (neighbors && neighbors->IsComplex())
  {
    return ComplexCheckPoints;
  }
  return neighbors && neighbors->HasBoundary() ? BlockCheckPoints : CheckPoints;
}

/// Narrows `boundary` and adds it to the neighbors. Returns false if it is not one smooth curve.
bool Refine(PenumbraBoundary& boundary, PenumbraNeighbors* neighbors)
{
  const bool isSupported = neighbors && neighbors->HasBoundary() && !neighbors->IsComplex();
  if (!boundary.Refine(GetCheckPoints(neighbors), isSupported))
  {
    return false;
  }
  if (neighbors)
  {
    neighbors->Add(boundary.GetArc());
  }
  return true;
}

/// Returns true if `count` points inside the disk have the visibility `value`.
bool AgreesInside(
  const DiskVisibility& visibility, std::uint32_t seed, float value, std::uint32_t count)
{
  const InteriorPointSet points(seed);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    if (visibility(points.At(i)) != value)
    {
      return false;
    }
  }
  return true;
}

/// Returns true if the light is as visible as `arc` predicts, which is outside the disk.
bool IsUniform(const DiskVisibility& visibility, const PenumbraArc& arc, std::uint32_t seed)
{
  const float value = arc.Distance < 0.f ? 1.f : 0.f;
  const float nearest = arc.Distance < 0.f ? arc.Axis + Pi : arc.Axis;
  for (const float offset : { 0.f, -OutsideProbeAngle, OutsideProbeAngle })
  {
    if (visibility(CircleRadius * OnCircle(nearest + offset)) != value)
    {
      return false;
    }
  }
  return AgreesInside(visibility, seed, value, SupportedInteriorPoints);
}

/// Visibility of points on the circumference of the disk.
struct Circle
{
  Circle(const DiskVisibility& visibility, std::uint32_t seed)
    : Visibility(visibility),
      Offset(ComputeCircleOffset(seed))
  {
  }

  /// Traces points until two of them differ, or the cap between two points is too small to matter.
  void Trace(float tolerance)
  {
    int next = FirstCirclePoints;
    do
    {
      const int step = MaximumCirclePoints / next;
      for (int i = 0; i < next; ++i)
      {
        if (this->Count == 0 || i % 2 == 1)
        {
          this->Values[i * step] = this->Visibility(
            CircleRadius * OnCircle(this->Offset + 2.f * Pi * static_cast<float>(i) / next));
        }
      }
      this->Count = next;
      this->Changes = 0;
      for (int i = 0; i < this->Count; ++i)
      {
        this->Changes += this->Get(i) != this->Get(i + 1) ? 1 : 0;
        this->HasTranslucent = this->HasTranslucent || !IsBinary(this->Get(i));
      }
      next *= 2;
    }
    while (this->Changes == 0 && this->Count < MaximumCirclePoints &&
      (this->Count < MinimumCirclePoints || this->EstimateMissedCap() > tolerance));
  }

  float Get(int i) const
  {
    return this->Values[i % this->Count * (MaximumCirclePoints / this->Count)];
  }

  float EstimateMissedCap() const
  {
    return MissedCapError * CapArea(Pi / static_cast<float>(this->Count));
  }

  /// Sets the ends of a boundary between two pairs of points.
  void SetEnds(PenumbraBoundary& boundary) const
  {
    glm::vec2 begin(0.f);
    glm::vec2 end(0.f);
    for (int i = 0; i < this->Count; ++i)
    {
      const glm::vec2 bracket =
        this->Offset + 2.f * Pi / static_cast<float>(this->Count) * glm::vec2(i, i + 1);
      begin = this->Get(i) < this->Get(i + 1) ? bracket : begin;
      end = this->Get(i) > this->Get(i + 1) ? bracket : end;
    }
    if (end.x < begin.x)
    {
      end += 2.f * Pi;
    }
    boundary.SetEnds(begin, end);
  }

  const DiskVisibility& Visibility;
  float Offset;
  int Count = 0;
  int Changes = 0;             ///< between neighbors
  bool HasTranslucent = false; ///< a value is neither 0 nor 1
  std::array<float, MaximumCirclePoints> Values;
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

VisibleFraction EstimateVisibleFraction(const std::function<float(glm::vec2)>& visibility,
  std::uint32_t seed, float tolerance, PenumbraNeighbors* neighbors)
{
  PenumbraArc arc;
  if (neighbors && neighbors->Predict(arc))
  {
    PenumbraBoundary boundary(visibility, seed, tolerance);
    if (boundary.FindEnds(arc) && Refine(boundary, neighbors))
    {
      return { boundary.GetArea(), boundary.GetError() };
    }
    if (std::abs(arc.Distance) >= MinimumOutsideDistance && !neighbors->IsComplex() &&
      IsUniform(visibility, arc, seed))
    {
      const float value = arc.Distance < 0.f ? 1.f : 0.f;
      neighbors->AddUniform(value);
      return { value, MissedCapError * CapArea(0.5f * OutsideProbeAngle) };
    }
  }
  Circle circle(visibility, seed);
  circle.Trace(tolerance);
  if (circle.Changes == 0)
  {
    const float value = circle.Values[0];
    // At a neighbor more than one boundary divides the light: a few points may miss them here.
    const bool isDoubtful = neighbors && neighbors->IsComplex();
    if (isDoubtful || !AgreesInside(visibility, seed, value, GetInteriorPoints(neighbors, value)))
    {
      return SampleComplex(visibility, seed, tolerance, neighbors);
    }
    if (neighbors)
    {
      neighbors->AddUniform(value);
    }
    return { value, circle.EstimateMissedCap() };
  }
  if (circle.Changes == 2 && circle.HasTranslucent)
  {
    return SampleSequence(visibility, seed, tolerance); // the edge of a pane
  }
  if (circle.Changes == 2)
  {
    PenumbraBoundary boundary(visibility, seed, tolerance);
    circle.SetEnds(boundary);
    if (Refine(boundary, neighbors))
    {
      return { boundary.GetArea(), boundary.GetError() };
    }
  }
  return SampleComplex(visibility, seed, tolerance, neighbors);
}

}
