// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InScatteringDistribution.h"

#include "Light.h"
#include "Medium/PhaseFunctions.h"
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

bool IsUnbounded(const Medium& medium)
{
  const double infinity = std::numeric_limits<double>::infinity();
  return medium.Low == glm::dvec3(-infinity) && medium.High == glm::dvec3(infinity);
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
    Columns(medium.Density, origin + from * direction, direction, to - from),
    To(this->FindEnd(to))
{
  if (!this->ScatteringMedium.Scatters() || !(this->To > this->From) || !std::isfinite(this->To))
  {
    return;
  }
  const MediumDensity& density = this->ScatteringMedium.Density;
  const bool directional = light.Kind == Light::Kinds::Directional;
  if (density.IsUniform())
  {
    directional ? this->AddExactSegments() : this->AddTabulatedSegments();
  }
  else if (directional && !density.Image && IsUnbounded(medium))
  {
    this->AddFalloffSegments();
  }
  else
  {
    this->AddAdaptiveSegments();
  }
}

/// Returns the end of the ray. Light from behind it is lost.
double InScatteringDistribution::FindEnd(double to) const
{
  const Medium& medium = this->ScatteringMedium;
  const double column = MaximumOpticalDepth / medium.Extinction;
  if (medium.Density.IsUniform())
  {
    return medium.Extinction > 0.0 ? std::min(to, this->From + column) : to;
  }
  if (medium.Density.Image)
  {
    return to;
  }
  const glm::dvec3 start = this->Origin + this->From * this->Direction;
  const double decay = medium.Density.Decay(this->Direction);
  const double extinguished = medium.Extinction > 0.0
    ? medium.Density.LengthOfColumn(start, this->Direction, column)
    : std::numeric_limits<double>::infinity();
  const double thin =
    decay > 0.0 ? MaximumOpticalDepth / decay : std::numeric_limits<double>::infinity();
  return std::min(to, this->From + std::min(extinguished, thin));
}

/// Returns the light scattered toward the camera per unit of length.
double InScatteringDistribution::Density(double t) const
{
  const Medium& medium = this->ScatteringMedium;
  const glm::dvec3 point = this->Origin + t * this->Direction;
  const LightDirection toLight = DirectionToLight(this->Source, point);
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
  double scattered = strength * medium.Scattering * medium.PhaseFunction(cosine);
  if (medium.Rayleigh > 0.0)
  {
    scattered += strength * medium.Rayleigh * rayleighPhase(cosine);
  }
  const double inside = medium.ColumnToLight(point, toLight.Direction, toLight.Distance);
  if (medium.Density.IsUniform())
  {
    return scattered * std::exp(-medium.Extinction * (t - this->From + inside));
  }
  return scattered * medium.Density.At(point) *
    Attenuate(medium.Extinction, this->ColumnFromCamera(t) + inside);
}

double InScatteringDistribution::ColumnFromCamera(double t) const
{
  return this->Columns.At(t - this->From);
}

double InScatteringDistribution::ToPosition(double t) const
{
  return this->IsInColumns ? this->ColumnFromCamera(std::clamp(t, this->From, this->To)) : t;
}

double InScatteringDistribution::FromPosition(double position) const
{
  if (!this->IsInColumns)
  {
    return position;
  }
  const glm::dvec3 start = this->Origin + this->From * this->Direction;
  const double length =
    this->ScatteringMedium.Density.LengthOfColumn(start, this->Direction, position);
  return std::min(this->From + length, this->To);
}

void InScatteringDistribution::AddSegment(double begin, double end, double slope, double weight)
{
  this->Segments.push_back(
    { begin, end - begin, slope, IntegrateExponential(slope, end - begin), this->Sum, weight });
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

// Per unit of column x, the in-scattered light is exponential, since the density and with it the
// column to the light are linear in x.
void InScatteringDistribution::AddFalloffSegments()
{
  const MediumDensity& density = this->ScatteringMedium.Density;
  const double extinction = this->ScatteringMedium.Extinction;
  const double decayToLight = density.Decay(-glm::dvec3(this->Source.Direction));
  const double end = this->ColumnFromCamera(this->To);
  if (!(decayToLight > 0.0 || extinction == 0.0) || !(end > 0.0))
  {
    return; // the light is below the horizon
  }
  this->IsInColumns = true;
  const double slope =
    extinction == 0.0 ? 0.0 : extinction * (1.0 - density.Decay(this->Direction) / decayToLight);
  // Only the part within MaximumOpticalDepth of the bright end contributes.
  const double length = std::min(end, MaximumOpticalDepth / std::max(std::abs(slope), 1e-300));
  const double bright = slope >= 0.0 ? 0.0 : end;
  const double t = slope >= 0.0 ? this->From : this->To;
  const double first = this->Density(t) / density.At(this->Origin + t * this->Direction);
  const double weight = first * IntegrateExponential(std::abs(slope), length);
  if (slope < 0.0 && length < end)
  {
    this->AddSegment(0.0, end - length, 0.0, 0.0);
  }
  this->AddSegment(
    slope >= 0.0 ? bright : end - length, slope >= 0.0 ? length : end, slope, weight);
}

/// Returns the ends of segments with equal angles, seen from the light, and with equal extinction.
std::vector<double> InScatteringDistribution::FindTabulatedEnds() const
{
  std::vector<double> ends{ this->From, this->To };
  if (this->Source.Kind != Light::Kinds::Directional)
  {
    const glm::dvec3 toLight = glm::dvec3(this->Source.Position) - this->Origin;
    const double closest = glm::dot(toLight, this->Direction);
    const double lightDistance = std::max(glm::length(toLight - closest * this->Direction),
      MinimumLightDistance * (this->To - this->From));
    const double low = std::atan((this->From - closest) / lightDistance);
    const double high = std::atan((this->To - closest) / lightDistance);
    for (int i = 1; i < AngularSegments; ++i)
    {
      ends.push_back(closest + lightDistance * std::tan(low + (high - low) * i / AngularSegments));
    }
  }
  const double opacity = -std::expm1(-this->ScatteringMedium.Extinction * (this->To - this->From));
  for (int i = 1; i < ExtinctionSegments; ++i)
  {
    const double fraction = static_cast<double>(i) / ExtinctionSegments;
    ends.push_back(opacity > 1e-6
        ? this->From - std::log1p(-fraction * opacity) / this->ScatteringMedium.Extinction
        : this->From + fraction * (this->To - this->From));
  }
  return ends;
}

/// Integrates the density by three-point Gauss-Legendre quadrature.
double InScatteringDistribution::Quadrature(double begin, double end) const
{
  const double length = end - begin;
  const double middle = begin + 0.5 * length;
  const double offset = 0.5 * length * std::sqrt(0.6);
  return length / 18.0 *
    (5.0 * this->Density(middle - offset) + 8.0 * this->Density(middle) +
      5.0 * this->Density(middle + offset));
}

void InScatteringDistribution::AddTabulatedSegments()
{
  std::vector<double> ends = this->FindTabulatedEnds();
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
    const double weight = this->Quadrature(ends[i], ends[i + 1]);
    const bool isPositive = density > 0.0 && next > 0.0;
    this->AddSegment(
      ends[i], ends[i + 1], isPositive ? std::log(density / next) / length : 0.0, weight);
    density = next;
  }
}

// Segments are divided until two quadratures of each agree. In an image, the first ones are not
// longer than its cells.
void InScatteringDistribution::AddAdaptiveSegments()
{
  std::vector<double> ends = this->FindTabulatedEnds();
  if (const DensityImage* image = this->ScatteringMedium.Density.Image.get())
  {
    const glm::dvec3 cells = glm::abs(this->Direction) * (this->To - this->From) / image->Spacing;
    const int count = static_cast<int>(
      std::clamp(std::ceil(std::max(cells.x, std::max(cells.y, cells.z))), 1.0, MaximumMarchSteps));
    for (int i = 1; i < count; ++i)
    {
      ends.push_back(this->From + (this->To - this->From) * i / count);
    }
  }
  std::sort(ends.begin(), ends.end());
  std::vector<Node> nodes;
  std::vector<double> weights;
  double total = 0.0;
  for (const double end : ends)
  {
    const double position = std::clamp(end, this->From, this->To);
    if (nodes.empty() || position > nodes.back().Position)
    {
      if (!nodes.empty())
      {
        weights.push_back(this->Quadrature(nodes.back().Position, position));
        total += weights.back();
      }
      nodes.push_back({ position, this->Density(position) });
    }
  }
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
  {
    this->Refine(
      nodes[i], nodes[i + 1], weights[i], SegmentTolerance * total, MaximumSegmentLevels);
  }
}

void InScatteringDistribution::Refine(
  Node first, Node last, double weight, double tolerance, int levels)
{
  const double middle = 0.5 * (first.Position + last.Position);
  const double before = this->Quadrature(first.Position, middle);
  const double after = this->Quadrature(middle, last.Position);
  if (std::abs(before + after - weight) > tolerance && levels > 0)
  {
    const Node center{ middle, this->Density(middle) };
    this->Refine(first, center, before, tolerance, levels - 1);
    this->Refine(center, last, after, tolerance, levels - 1);
    return;
  }
  const double length = last.Position - first.Position;
  const bool isPositive = first.Density > 0.0 && last.Density > 0.0;
  this->AddSegment(first.Position, last.Position,
    isPositive ? std::log(first.Density / last.Density) / length : 0.0, before + after);
}

double InScatteringDistribution::CDF(double t) const
{
  if (!(this->Sum > 0.0))
  {
    return 0.0;
  }
  const double position = this->ToPosition(t);
  const auto after = std::upper_bound(this->Segments.begin(), this->Segments.end(), position,
    [](double parameter, const Segment& segment) { return parameter < segment.Begin; });
  if (after == this->Segments.begin())
  {
    return 0.0;
  }
  const Segment& segment = *(after - 1);
  const double offset = std::clamp(position - segment.Begin, 0.0, segment.Length);
  const double part = segment.Weight * IntegrateExponential(segment.Slope, offset) / segment.Extent;
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
    return this->FromPosition(segment.Begin);
  }
  const double part = std::clamp((target - segment.Before) / segment.Weight, 0.0, 1.0);
  const double x = segment.Slope * segment.Length;
  const double offset =
    std::abs(x) < 1e-9 ? part * segment.Length : -std::log1p(part * std::expm1(-x)) / segment.Slope;
  return this->FromPosition(segment.Begin + std::clamp(offset, 0.0, segment.Length));
}

}
