// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InScatteringDistribution.h"

#include "Shading/RayTracingConstants.h"
#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Returns the integral of exp(-slope t) over [0, length]; length may be infinite.
double IntegrateExponential(double slope, double length)
{
  const double x = slope * length;
  return std::abs(x) < 1e-9 ? length : -std::expm1(-x) / slope;
}

}

LightDirection DirectionToLight(const Light& light, glm::dvec3 point)
{
  LightDirection toLight;
  if (light.Kind == Light::Kinds::Directional)
  {
    toLight.Direction = -glm::dvec3(light.Direction);
    return toLight;
  }
  const glm::dvec3 offset = glm::dvec3(light.Position) - point;
  toLight.Distance = glm::length(offset);
  toLight.Direction = offset / std::max(toLight.Distance, 1e-300);
  toLight.InCone = light.Kind != Light::Kinds::Spot ||
    glm::dot(toLight.Direction, -glm::dvec3(light.Direction)) >= light.ConeCosine;
  return toLight;
}

InScatteringDistribution::InScatteringDistribution(const Medium& medium, const Light& light,
  glm::dvec3 origin, glm::dvec3 direction, double from, double to)
  : ScatteringMedium(medium),
    Source(light),
    Origin(origin),
    Direction(direction),
    From(from),
    To(medium.Extinction > 0.0 ? std::min(to, from + MaximumOpticalDepth / medium.Extinction) : to)
{
  if (!(this->ScatteringMedium.Scattering > 0.0) || !(this->To > this->From) ||
    !std::isfinite(this->To))
  {
    return;
  }
  if (light.Kind == Light::Kinds::Directional)
  {
    this->AddExactSegments();
  }
  else
  {
    this->AddTabulatedSegments();
  }
}

/// Returns the light scattered toward the camera per unit of length.
double InScatteringDistribution::Density(double t) const
{
  const glm::dvec3 point = this->Origin + t * this->Direction;
  const LightDirection toLight = DirectionToLight(this->Source, point);
  double inside =
    std::min(this->ScatteringMedium.DistanceToExit(point, toLight.Direction), toLight.Distance);
  // In an unbounded medium, a directional light is specified as it arrives at the point.
  inside = std::isfinite(inside) ? inside : 0.0;
  double strength = 1.0;
  if (this->Source.Kind != Light::Kinds::Directional)
  {
    const glm::dvec3 a(this->Source.Attenuation);
    strength = 1.0 / std::max(a.x + toLight.Distance * (a.y + toLight.Distance * a.z), 1e-30);
    if (this->Source.Kind == Light::Kinds::Spot)
    {
      const double cosine = glm::dot(toLight.Direction, -glm::dvec3(this->Source.Direction));
      strength *= std::pow(std::max(cosine, 0.0), static_cast<double>(this->Source.Exponent));
    }
  }
  const double cosine = glm::dot(toLight.Direction, this->Direction);
  return strength * this->ScatteringMedium.Scattering *
    this->ScatteringMedium.PhaseFunction(cosine) *
    std::exp(-this->ScatteringMedium.Extinction * (t - this->From + inside));
}

void InScatteringDistribution::AddSegment(double begin, double end, double slope, double weight)
{
  this->Segments.push_back({ begin, end - begin, slope, this->Sum, weight });
  this->Sum += weight;
}

// The distance to the light in the medium ends at the nearest of three faces of its box. The
// distance to each face is linear along the ray, so segments end where two faces are equally far.
void InScatteringDistribution::AddExactSegments()
{
  const glm::dvec3 toLight = -glm::dvec3(this->Source.Direction);
  glm::dvec3 distances(std::numeric_limits<double>::infinity());
  glm::dvec3 changes(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (toLight[axis] != 0.0)
    {
      const double face =
        toLight[axis] > 0.0 ? this->ScatteringMedium.High[axis] : this->ScatteringMedium.Low[axis];
      distances[axis] = (face - this->Origin[axis]) / toLight[axis];
      changes[axis] = -this->Direction[axis] / toLight[axis];
    }
  }
  std::vector<double> ends{ this->From, this->To };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int next = (axis + 1) % 3;
    const double t = (distances[next] - distances[axis]) / (changes[axis] - changes[next]);
    if (t > this->From && t < this->To)
    {
      ends.push_back(t);
    }
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
  {
    const double middle = 0.5 * (ends[i] + ends[i + 1]);
    int nearest = 0;
    for (int axis = 1; axis < 3; ++axis)
    {
      nearest =
        distances[axis] + middle * changes[axis] < distances[nearest] + middle * changes[nearest]
        ? axis
        : nearest;
    }
    const double change = std::isfinite(distances[nearest]) ? changes[nearest] : 0.0;
    const double slope = this->ScatteringMedium.Extinction * (1.0 + change);
    // The density is evaluated in the middle, where the nearest face is unambiguous, and
    // extrapolated back to the beginning.
    const double first = this->Density(middle) * std::exp(slope * (middle - ends[i]));
    this->AddSegment(
      ends[i], ends[i + 1], slope, first * IntegrateExponential(slope, ends[i + 1] - ends[i]));
  }
}

void InScatteringDistribution::AddTabulatedSegments()
{
  const glm::dvec3 toLight = glm::dvec3(this->Source.Position) - this->Origin;
  const double closest = glm::dot(toLight, this->Direction);
  const double lightDistance = std::max(glm::length(toLight - closest * this->Direction),
    MinimumLightDistance * (this->To - this->From));
  const double low = std::atan((this->From - closest) / lightDistance);
  const double high = std::atan((this->To - closest) / lightDistance);
  const double opacity = -std::expm1(-this->ScatteringMedium.Extinction * (this->To - this->From));

  std::vector<double> ends{ this->From, this->To };
  for (int i = 1; i < AngularSegments; ++i)
  {
    ends.push_back(closest + lightDistance * std::tan(low + (high - low) * i / AngularSegments));
  }
  for (int i = 1; i < ExtinctionSegments; ++i)
  {
    const double fraction = static_cast<double>(i) / ExtinctionSegments;
    ends.push_back(opacity > 1e-6
        ? this->From - std::log1p(-fraction * opacity) / this->ScatteringMedium.Extinction
        : this->From + fraction * (this->To - this->From));
  }
  std::sort(ends.begin(), ends.end());
  for (double& end : ends)
  {
    end = std::clamp(end, this->From, this->To);
  }
  double density = this->Density(this->From);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
  {
    const double length = ends[i + 1] - ends[i];
    if (!(length > 0.0))
    {
      continue;
    }
    const double next = this->Density(ends[i + 1]);
    // Three-point Gauss-Legendre quadrature.
    const double middle = ends[i] + 0.5 * length;
    const double offset = 0.5 * length * std::sqrt(0.6);
    const double weight = length / 18.0 *
      (5.0 * this->Density(middle - offset) + 8.0 * this->Density(middle) +
        5.0 * this->Density(middle + offset));
    const bool isPositive = density > 0.0 && next > 0.0;
    this->AddSegment(
      ends[i], ends[i + 1], isPositive ? std::log(density / next) / length : 0.0, weight);
    density = next;
  }
}

double InScatteringDistribution::CDF(double t) const
{
  if (!(this->Sum > 0.0))
  {
    return 0.0;
  }
  const auto after = std::upper_bound(this->Segments.begin(), this->Segments.end(), t,
    [](double parameter, const Segment& segment) { return parameter < segment.Begin; });
  if (after == this->Segments.begin())
  {
    return 0.0;
  }
  const Segment& segment = *(after - 1);
  const double offset = std::clamp(t - segment.Begin, 0.0, segment.Length);
  const double part = segment.Weight * IntegrateExponential(segment.Slope, offset) /
    IntegrateExponential(segment.Slope, segment.Length);
  return (segment.Before + part) / this->Sum;
}

double InScatteringDistribution::InvertCDF(double fraction) const
{
  const double target = fraction * this->Sum;
  const auto after = std::upper_bound(this->Segments.begin(), this->Segments.end(), target,
    [](double light, const Segment& segment) { return light < segment.Before; });
  if (after == this->Segments.begin())
  {
    return this->From;
  }
  const Segment& segment = *(after - 1);
  if (!(segment.Weight > 0.0))
  {
    return segment.Begin;
  }
  const double part = std::clamp((target - segment.Before) / segment.Weight, 0.0, 1.0);
  const double x = segment.Slope * segment.Length;
  const double offset =
    std::abs(x) < 1e-9 ? part * segment.Length : -std::log1p(part * std::expm1(-x)) / segment.Slope;
  return segment.Begin + std::clamp(offset, 0.0, segment.Length);
}

}
