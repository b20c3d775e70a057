// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LightShafts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

// One step may hide so much light, in tolerances, where no borders are seen.
constexpr double LightPerStep = 2.0;
constexpr double FewestSteps = 3.0;
constexpr double MostSteps = 4096.0;
// Steps of light that are believed to be hidden between steps: for each border, and without any.
constexpr double HiddenAtBorder = 0.2;
constexpr double HiddenElsewhere = 0.05;
// More steps are made while more than so many tolerances are believed to be hidden.
constexpr double HiddenTolerance = 0.75;
// Borders of shadow are found to this share of the tolerance; with a given number of steps, of one.
constexpr double BorderShare = 0.1;
constexpr double BorderShareOfStep = 1.0 / 64.0;
// The ends of a ray are left out: there a surface shadows itself by rounding.
constexpr double EndOfSteps = 1e-4;

/// The share of light that steps with these visibilities are believed to overlook.
double EstimateMissedLight(const std::vector<float>& seen)
{
  int borders = 0;
  for (std::size_t i = 1; i < seen.size(); ++i)
  {
    borders += seen[i] != seen[i - 1];
  }
  return (HiddenAtBorder * borders + HiddenElsewhere) / static_cast<double>(seen.size());
}

}

LightShafts::LightShafts(const Shading& shading, const Medium& medium, MarchQuality effort)
  : SurfaceShading(shading),
    ScatteringMedium(medium),
    Quality(effort)
{
  const Scene& scene = shading.GetScene();
  const std::vector<AxisAlignedBox> boxes = BoundOccluders(scene);
  for (const Light& light : scene.Lights)
  {
    if (light.CastsShadow && light.DiffuseColor != glm::vec3(0.f))
    {
      this->Lights.push_back(light);
      this->Regions.emplace_back(boxes, light);
    }
  }
}

LightShafts::InScattering LightShafts::Along(
  const Ray& ray, double from, double to, float weight, long long& shadowRays) const
{
  InScattering seen;
  const glm::dvec3 origin(ray.Origin);
  const double length = glm::length(glm::dvec3(ray.Direction));
  const glm::dvec3 direction = glm::dvec3(ray.Direction) / length;
  double near = from * length;
  double far = to * length;
  if (!this->ScatteringMedium.Clip(origin, direction, near, far))
  {
    return seen;
  }
  seen.Transmittance =
    static_cast<float>(std::exp(-this->ScatteringMedium.Extinction * (far - near)));
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    const Light& light = this->Lights[i];
    const InScatteringDistribution profile(
      this->ScatteringMedium, light, origin, direction, near, far);
    const glm::vec3 color = light.DiffuseColor;
    const double brightest = std::max(color.r, std::max(color.g, color.b));
    const double worth = weight * brightest * profile.Integral() / this->Quality.Tolerance;
    if (worth > 0.0)
    {
      RayMarch march{ profile, light, origin, direction, worth, {}, 0.0, 1.0, 0.0, 0.0, 0.0, 0 };
      this->MarchIntervals(march, this->Regions[i].Along(origin, direction, near, far));
      seen.Light += static_cast<float>(march.Lit * profile.Integral()) * color;
      seen.Error += static_cast<float>(brightest * profile.Integral() * march.LitError);
      shadowRays += march.Rays;
    }
  }
  return seen;
}

/// Through all that may be in shadow; everything else is lit, unless a spot's cone ends.
void LightShafts::MarchIntervals(RayMarch& march, std::vector<RayInterval> spans) const
{
  if (march.Source.Kind == Light::Kinds::Spot)
  {
    spans = { { -std::numeric_limits<double>::infinity(), march.Profile.InvertCDF(1.0) } };
  }
  double possible = 0.0;
  for (RayInterval& span : spans)
  {
    span = { march.Profile.CDF(span.From), march.Profile.CDF(span.To) };
    possible += span.To - span.From;
  }
  march.Lit = 1.0 - possible;
  for (const RayInterval& span : spans)
  {
    const double size = span.To - span.From;
    if (!(size > 0.0))
    {
      continue;
    }
    march.Low = span.From;
    march.High = span.To;
    const bool free = this->Quality.Steps == 0;
    const double wanted =
      free ? march.Importance * size / LightPerStep : this->Quality.Steps * size / possible;
    this->SampleVisibility(
      march, static_cast<int>(std::clamp(std::ceil(wanted), FewestSteps, MostSteps)));
    while (free && march.Importance * size * EstimateMissedLight(march.Seen) > HiddenTolerance &&
      static_cast<double>(march.Seen.size()) < MostSteps)
    {
      this->BisectSamples(march);
    }
    march.BoundaryTolerance =
      free ? BorderShare / std::max(march.Importance, 1.0) : BorderShareOfStep * size / wanted;
    march.Lit += this->LitShare(march);
    march.LitError += size * EstimateMissedLight(march.Seen) + 0.5 * march.BoundaryTolerance;
  }
}

double LightShafts::PlaceOfStep(const RayMarch& march, int i, int steps)
{
  const double place = EndOfSteps + (1.0 - 2.0 * EndOfSteps) * i / (steps - 1);
  return march.Low + (march.High - march.Low) * place;
}

/// Visibility at `steps` places that scatter equally much, from the eye to the end.
void LightShafts::SampleVisibility(RayMarch& march, int steps) const
{
  march.Seen.resize(steps);
  for (int i = 0; i < steps; ++i)
  {
    march.Seen[i] = this->Visible(march, PlaceOfStep(march, i, steps));
  }
}

/// One more look between any two.
void LightShafts::BisectSamples(RayMarch& march) const
{
  const int steps = 2 * static_cast<int>(march.Seen.size()) - 1;
  std::vector<float> seen(steps);
  for (int i = 0; i < steps; ++i)
  {
    seen[i] = i % 2 ? this->Visible(march, PlaceOfStep(march, i, steps)) : march.Seen[i / 2];
  }
  march.Seen.swap(seen);
}

/// The share of the profile's light that is not shadowed.
double LightShafts::LitShare(RayMarch& march) const
{
  const int steps = static_cast<int>(march.Seen.size());
  double sum = EndOfSteps * (march.High - march.Low) * (march.Seen.front() + march.Seen.back());
  for (int i = 1; i < steps; ++i)
  {
    sum += this->IntegrateInterval(march, PlaceOfStep(march, i - 1, steps), march.Seen[i - 1],
      PlaceOfStep(march, i, steps), march.Seen[i]);
  }
  return sum;
}

float LightShafts::Visible(RayMarch& march, double share) const
{
  const glm::dvec3 point = march.Origin + march.Profile.InvertCDF(share) * march.Direction;
  const LightDirection way = DirectionToLight(march.Source, point);
  if (!way.InCone)
  {
    return 0.f;
  }
  Ray ray;
  ray.Origin = glm::vec3(point);
  ray.Direction = glm::vec3(way.Direction);
  ray.Far = static_cast<float>(way.Distance);
  return this->SurfaceShading.TraceTransmittance(ray, march.Rays);
}

double LightShafts::IntegrateInterval(
  RayMarch& march, double low, float atLow, double high, float atHigh) const
{
  if (atLow == atHigh)
  {
    return (high - low) * atLow;
  }
  if (high - low <= march.BoundaryTolerance)
  {
    return (high - low) * 0.5 * (atLow + atHigh);
  }
  const double middle = 0.5 * (low + high);
  if (middle <= low || middle >= high) // neighbours as numbers: Finest may be less
  {
    return (high - low) * 0.5 * (atLow + atHigh);
  }
  const float atMiddle = this->Visible(march, middle);
  return this->IntegrateInterval(march, low, atLow, middle, atMiddle) +
    this->IntegrateInterval(march, middle, atMiddle, high, atHigh);
}

}
