// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LightShafts.h"

#include "Shading/RayTracingConstants.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

/// Returns the estimated fraction of light that steps with these visibilities miss.
double EstimateMissedLight(const std::vector<float>& visibility)
{
  int boundaries = 0;
  for (std::size_t i = 1; i < visibility.size(); ++i)
  {
    boundaries += visibility[i] != visibility[i - 1];
  }
  return (MissedPerBoundary * boundaries + MissedPerInterval) /
    static_cast<double>(visibility.size());
}

}

LightShafts::LightShafts(const Shading& shading, const SpectralMedium& medium, MarchQuality quality)
  : SurfaceShading(shading),
    ScatteringMedium(medium),
    Quality(quality)
{
  const Scene& scene = shading.GetScene();
  const std::vector<AxisAlignedBox> boxes = BoundOccluders(scene);
  for (const Light& light : scene.Lights)
  {
    if (light.CastsShadow && light.DiffuseColor != glm::vec3(0.f))
    {
      this->Lights.push_back(light);
      this->Shadows.emplace_back(boxes, light);
    }
  }
}

LightShafts::InScattering LightShafts::Along(
  const Ray& ray, double from, double to, float weight, long long& shadowRays) const
{
  InScattering result;
  const glm::dvec3 origin(ray.Origin);
  const double length = glm::length(glm::dvec3(ray.Direction));
  const glm::dvec3 direction = glm::dvec3(ray.Direction) / length;
  double near = from * length;
  double far = to * length;
  const std::array<Medium, 3>& channels = this->ScatteringMedium.Channels;
  if (!channels[0].Clip(origin, direction, near, far))
  {
    return result;
  }
  const double column =
    channels[0].Density.Column(origin + near * direction, direction, far - near);
  for (int i = 0; i < 3; ++i)
  {
    result.Transmittance[i] = static_cast<float>(Attenuate(channels[i].Extinction, column));
  }
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    const Light& light = this->Lights[i];
    const SpectralDistribution profile(this->ScatteringMedium, light, origin, direction, near, far);
    const double importance =
      weight * profile.GetBrightness() * profile.GetScatteredSum() / this->Quality.Tolerance;
    if (importance > 0.0)
    {
      RayMarch march{ profile, light, origin, direction, importance, {}, 0.0, 1.0, 0.0,
        glm::dvec3(0.0), 0.0, 0 };
      this->MarchIntervals(march, this->Shadows[i].Along(origin, direction, near, far));
      result.Light += profile.ComputeLight(march.Lit);
      result.Error +=
        static_cast<float>(profile.GetBrightness() * profile.GetScatteredSum() * march.LitError);
      shadowRays += march.Rays;
    }
  }
  return result;
}

/// Marches through the intervals that may be in shadow; the rest of the ray is lit. For spotlights
/// the whole ray is marched, since points outside the cone are unlit.
void LightShafts::MarchIntervals(RayMarch& march, std::vector<RayInterval> intervals) const
{
  if (march.Source.Kind == Light::Kinds::Spot)
  {
    intervals = { { -std::numeric_limits<double>::infinity(), march.Profile.InvertCDF(1.0) } };
  }
  double possible = 0.0;
  glm::dvec3 shadowed(0.0);
  for (RayInterval& interval : intervals)
  {
    interval = { march.Profile.CDF(interval.From), march.Profile.CDF(interval.To) };
    possible += interval.To - interval.From;
    shadowed += march.Profile.Between(interval.From, interval.To);
  }
  march.Lit = 1.0 - shadowed;
  for (const RayInterval& interval : intervals)
  {
    const double size = interval.To - interval.From;
    if (!(size > 0.0))
    {
      continue;
    }
    march.Low = interval.From;
    march.High = interval.To;
    const bool isAdaptive = this->Quality.Steps == 0;
    const double wanted =
      isAdaptive ? march.Importance * size / LightPerStep : this->Quality.Steps * size / possible;
    this->SampleVisibility(
      march, static_cast<int>(std::clamp(std::ceil(wanted), MinimumMarchSteps, MaximumMarchSteps)));
    while (isAdaptive &&
      march.Importance * size * EstimateMissedLight(march.Visibility) > MissedLightTolerance &&
      static_cast<double>(march.Visibility.size()) < MaximumMarchSteps)
    {
      this->BisectSamples(march);
    }
    march.BoundaryTolerance = isAdaptive
      ? BoundaryFractionOfTolerance / std::max(march.Importance, 1.0)
      : BoundaryFractionOfStep * size / wanted;
    march.Lit += this->IntegrateVisibility(march);
    march.LitError += size * EstimateMissedLight(march.Visibility) + 0.5 * march.BoundaryTolerance;
  }
}

double LightShafts::ComputeStepPosition(const RayMarch& march, int i, int steps)
{
  const double fraction = MarchEndMargin + (1.0 - 2.0 * MarchEndMargin) * i / (steps - 1);
  return march.Low + (march.High - march.Low) * fraction;
}

/// Computes the visibility at `steps` positions that divide the in-scattered light equally.
void LightShafts::SampleVisibility(RayMarch& march, int steps) const
{
  march.Visibility.resize(steps);
  for (int i = 0; i < steps; ++i)
  {
    march.Visibility[i] = this->TraceVisibility(march, ComputeStepPosition(march, i, steps));
  }
}

/// Adds a visibility sample between each pair of neighboring samples.
void LightShafts::BisectSamples(RayMarch& march) const
{
  const int steps = 2 * static_cast<int>(march.Visibility.size()) - 1;
  std::vector<float> visibility(steps);
  for (int i = 0; i < steps; ++i)
  {
    visibility[i] = i % 2 ? this->TraceVisibility(march, ComputeStepPosition(march, i, steps))
                          : march.Visibility[i / 2];
  }
  march.Visibility.swap(visibility);
}

/// Returns the unshadowed fraction of the in-scattered light in the current interval.
glm::dvec3 LightShafts::IntegrateVisibility(RayMarch& march) const
{
  const int steps = static_cast<int>(march.Visibility.size());
  const double margin = MarchEndMargin * (march.High - march.Low);
  const float front = march.Visibility.front();
  const float back = march.Visibility.back();
  glm::dvec3 sum = march.Profile.IsGray()
    ? glm::dvec3(margin * (front + back))
    : march.Profile.Between(march.Low, march.Low + margin) * static_cast<double>(front) +
      march.Profile.Between(march.High - margin, march.High) * static_cast<double>(back);
  for (int i = 1; i < steps; ++i)
  {
    sum += this->IntegrateInterval(march, ComputeStepPosition(march, i - 1, steps),
      march.Visibility[i - 1], ComputeStepPosition(march, i, steps), march.Visibility[i]);
  }
  return sum;
}

float LightShafts::TraceVisibility(RayMarch& march, double position) const
{
  const glm::dvec3 point = march.Origin + march.Profile.InvertCDF(position) * march.Direction;
  const LightDirection toLight = DirectionToLight(march.Source, point);
  if (!toLight.InCone)
  {
    return 0.f;
  }
  Ray ray;
  ray.Origin = glm::vec3(point);
  ray.Direction = glm::vec3(toLight.Direction);
  ray.Far = static_cast<float>(toLight.Distance);
  return this->SurfaceShading.TraceTransmittance(ray, march.Rays);
}

glm::dvec3 LightShafts::IntegrateInterval(
  RayMarch& march, double low, float atLow, double high, float atHigh) const
{
  if (atLow == atHigh)
  {
    return atLow > 0.f ? march.Profile.Between(low, high) * static_cast<double>(atLow)
                       : glm::dvec3(0.0);
  }
  if (high - low <= march.BoundaryTolerance)
  {
    return march.Profile.Between(low, high) * (0.5 * (atLow + atHigh));
  }
  const double middle = 0.5 * (low + high);
  // BoundaryTolerance may be below the resolution of a double.
  if (middle <= low || middle >= high)
  {
    return march.Profile.Between(low, high) * (0.5 * (atLow + atHigh));
  }
  const float atMiddle = this->TraceVisibility(march, middle);
  return this->IntegrateInterval(march, low, atLow, middle, atMiddle) +
    this->IntegrateInterval(march, middle, atMiddle, high, atHigh);
}

}
