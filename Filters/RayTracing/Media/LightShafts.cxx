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
double Hidden(const std::vector<float>& seen)
{
  int borders = 0;
  for (std::size_t i = 1; i < seen.size(); ++i)
  {
    borders += seen[i] != seen[i - 1];
  }
  return (HiddenAtBorder * borders + HiddenElsewhere) / static_cast<double>(seen.size());
}

}

LightShafts::LightShafts(const Shading& shading, const Medium& medium, Effort effort)
  : Shades(shading),
    Fog(medium),
    Work(effort)
{
  const Scene& scene = shading.GetScene();
  const std::vector<Box> boxes = BoundTriangles(scene);
  for (const Light& light : scene.Lights)
  {
    if (light.CastsShadow && light.DiffuseColor != glm::vec3(0.f))
    {
      this->Lights.push_back(light);
      this->Regions.emplace_back(boxes, light);
    }
  }
}

LightShafts::Seen LightShafts::Along(
  const Ray& ray, double from, double to, float weight, long long& shadowRays) const
{
  Seen seen;
  const glm::dvec3 origin(ray.Origin);
  const double length = glm::length(glm::dvec3(ray.Direction));
  const glm::dvec3 direction = glm::dvec3(ray.Direction) / length;
  double near = from * length;
  double far = to * length;
  if (!this->Fog.Clip(origin, direction, near, far))
  {
    return seen;
  }
  seen.Transmittance = static_cast<float>(std::exp(-this->Fog.Extinction * (far - near)));
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    const Light& light = this->Lights[i];
    const ScatteringProfile profile(this->Fog, light, origin, direction, near, far);
    const glm::vec3 color = light.DiffuseColor;
    const double brightest = std::max(color.r, std::max(color.g, color.b));
    const double worth = weight * brightest * profile.Total() / this->Work.Tolerance;
    if (worth > 0.0)
    {
      March march{ profile, light, origin, direction, worth, {}, 0.0, 1.0, 0.0, 0.0, 0.0, 0 };
      this->Walk(march, this->Regions[i].Along(origin, direction, near, far));
      seen.Light += static_cast<float>(march.Lit * profile.Total()) * color;
      seen.Error += static_cast<float>(brightest * profile.Total() * march.Doubt);
      shadowRays += march.Rays;
    }
  }
  return seen;
}

/// Through all that may be in shadow; everything else is lit, unless a spot's cone ends.
void LightShafts::Walk(March& march, std::vector<Span> spans) const
{
  if (march.Source.Kind == Light::Kinds::Spot)
  {
    spans = { { -std::numeric_limits<double>::infinity(), march.Profile.PlaceOf(1.0) } };
  }
  double possible = 0.0;
  for (Span& span : spans)
  {
    span = { march.Profile.ShareAt(span.From), march.Profile.ShareAt(span.To) };
    possible += span.To - span.From;
  }
  march.Lit = 1.0 - possible;
  for (const Span& span : spans)
  {
    const double size = span.To - span.From;
    if (!(size > 0.0))
    {
      continue;
    }
    march.Low = span.From;
    march.High = span.To;
    const bool free = this->Work.Steps == 0;
    const double wanted =
      free ? march.Worth * size / LightPerStep : this->Work.Steps * size / possible;
    this->Look(march, static_cast<int>(std::clamp(std::ceil(wanted), FewestSteps, MostSteps)));
    while (free && march.Worth * size * Hidden(march.Seen) > HiddenTolerance &&
      static_cast<double>(march.Seen.size()) < MostSteps)
    {
      this->LookCloser(march);
    }
    march.Finest =
      free ? BorderShare / std::max(march.Worth, 1.0) : BorderShareOfStep * size / wanted;
    march.Lit += this->LitShare(march);
    march.Doubt += size * Hidden(march.Seen) + 0.5 * march.Finest;
  }
}

double LightShafts::PlaceOfStep(const March& march, int i, int steps)
{
  const double place = EndOfSteps + (1.0 - 2.0 * EndOfSteps) * i / (steps - 1);
  return march.Low + (march.High - march.Low) * place;
}

/// Visibility at `steps` places that scatter equally much, from the eye to the end.
void LightShafts::Look(March& march, int steps) const
{
  march.Seen.resize(steps);
  for (int i = 0; i < steps; ++i)
  {
    march.Seen[i] = this->Visible(march, PlaceOfStep(march, i, steps));
  }
}

/// One more look between any two.
void LightShafts::LookCloser(March& march) const
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
double LightShafts::LitShare(March& march) const
{
  const int steps = static_cast<int>(march.Seen.size());
  double sum = EndOfSteps * (march.High - march.Low) * (march.Seen.front() + march.Seen.back());
  for (int i = 1; i < steps; ++i)
  {
    sum += this->Between(march, PlaceOfStep(march, i - 1, steps), march.Seen[i - 1],
      PlaceOfStep(march, i, steps), march.Seen[i]);
  }
  return sum;
}

float LightShafts::Visible(March& march, double share) const
{
  const glm::dvec3 point = march.Origin + march.Profile.PlaceOf(share) * march.Direction;
  const WayToLight way = FindWay(march.Source, point);
  if (!way.InCone)
  {
    return 0.f;
  }
  Ray ray;
  ray.Origin = glm::vec3(point);
  ray.Direction = glm::vec3(way.Direction);
  ray.Far = static_cast<float>(way.Distance);
  return this->Shades.LightAlong(ray, march.Rays);
}

double LightShafts::Between(March& march, double low, float atLow, double high, float atHigh) const
{
  if (atLow == atHigh)
  {
    return (high - low) * atLow;
  }
  if (high - low <= march.Finest)
  {
    return (high - low) * 0.5 * (atLow + atHigh);
  }
  const double middle = 0.5 * (low + high);
  if (middle <= low || middle >= high) // neighbours as numbers: Finest may be less
  {
    return (high - low) * 0.5 * (atLow + atHigh);
  }
  const float atMiddle = this->Visible(march, middle);
  return this->Between(march, low, atLow, middle, atMiddle) +
    this->Between(march, middle, atMiddle, high, atHigh);
}

}
