// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LightShafts.h"

#include "Scene.h"
#include "Shading/RayTracingConstants.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

LightShafts::LightShafts(const Shading& shading, const SpectralMedium& medium, MarchQuality quality)
  : SurfaceShading(shading),
    ScatteringMedium(medium),
    Quality(quality)
{
  const Scene& scene = shading.GetRays().GetScene();
  const std::vector<AxisAlignedBox> boxes = BoundOccluders(scene.Surfaces);
  for (const Light& light : scene.Lights)
  {
    const bool isLit = light.CastsShadow && (quality.CameraLights || !light.MovesWithCamera);
    if (isLit && light.DiffuseColor != glm::vec3(0.f))
    {
      this->Lights.push_back(light);
      this->Shadows.emplace_back(boxes, light);
    }
  }
}

LightShafts::Segment::Segment(const SpectralMedium& medium, const Ray& ray, double from, double to)
  : Origin(ray.Origin)
{
  const double length = glm::length(glm::dvec3(ray.Direction));
  this->Direction = glm::dvec3(ray.Direction) / length;
  this->Near = from * length;
  this->Far = to * length;
  const std::array<Medium, 3>& channels = medium.Channels;
  this->IsEmpty = !channels[0].Clip(this->Origin, this->Direction, this->Near, this->Far);
  if (!this->IsEmpty)
  {
    const double column = channels[0].Density.Column(
      this->Origin + this->Near * this->Direction, this->Direction, this->Far - this->Near);
    for (int i = 0; i < 3; ++i)
    {
      this->Transmittance[i] = static_cast<float>(Attenuate(channels[i].Extinction, column));
    }
  }
}

glm::vec3 LightShafts::ComputeTransmittance(const Ray& ray, double from, double to) const
{
  return Segment(this->ScatteringMedium, ray, from, to).Transmittance;
}

LightShafts::InScattering LightShafts::Along(
  const Ray& ray, double from, double to, float weight, long long& shadowRays) const
{
  InScattering result;
  const Segment segment(this->ScatteringMedium, ray, from, to);
  if (segment.IsEmpty)
  {
    return result;
  }
  const glm::dvec3& origin = segment.Origin;
  const glm::dvec3& direction = segment.Direction;
  result.Transmittance = segment.Transmittance;
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    const Light& light = this->Lights[i];
    const SpectralDistribution profile(
      this->ScatteringMedium, light, origin, direction, segment.Near, segment.Far);
    const double importance =
      weight * profile.GetBrightness() * profile.GetScatteredSum() / this->Quality.Tolerance;
    if (importance > 0.0)
    {
      RayMarch march{ profile, light, origin, direction, importance, {}, {}, {}, 0.0,
        glm::dvec3(0.0), 0.0, 0 };
      this->MarchIntervals(
        march, this->Shadows[i].Along(origin, direction, segment.Near, segment.Far));
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
void LightShafts::MarchIntervals(RayMarch& march, const std::vector<RayInterval>& intervals) const
{
  const SpectralDistribution& profile = march.Profile;
  std::vector<std::pair<Point, Point>> ends;
  if (march.Source.Kind == Light::Kinds::Spot)
  {
    ends.emplace_back(profile.PointAt(-std::numeric_limits<double>::infinity()), profile.End());
  }
  else
  {
    for (const RayInterval& interval : intervals)
    {
      ends.emplace_back(profile.PointAt(interval.From), profile.PointAt(interval.To));
    }
  }
  double possible = 0.0;
  glm::dvec3 shadowed(0.0);
  for (const auto& [low, high] : ends)
  {
    possible += high.CDF - low.CDF;
    shadowed += profile.Between(low, high);
  }
  march.Lit = 1.0 - shadowed;
  for (const auto& [low, high] : ends)
  {
    march.Low = low;
    march.High = high;
    const double size = march.Size();
    if (size > 0.0)
    {
      this->MarchInterval(march,
        this->Quality.Steps == 0 ? march.Importance * size / LightPerStep
                                 : this->Quality.Steps * size / possible);
    }
  }
}

void LightShafts::MarchInterval(RayMarch& march, double wantedSteps) const
{
  const bool isAdaptive = this->Quality.Steps == 0;
  const double size = march.Size();
  this->SampleVisibility(march,
    static_cast<int>(std::clamp(std::ceil(wantedSteps), MinimumMarchSteps, MaximumMarchSteps)));
  while (isAdaptive &&
    march.Importance * size * EstimateMissedLight(march.Steps) > MissedLightTolerance &&
    static_cast<double>(march.Steps.size()) < MaximumMarchSteps)
  {
    this->BisectSamples(march);
  }
  march.BoundaryTolerance = isAdaptive
    ? BoundaryFractionOfTolerance / std::max(march.Importance, 1.0)
    : BoundaryFractionOfStep * size / wantedSteps;
  march.Lit += this->IntegrateVisibility(march);
  march.LitError += size * EstimateMissedLight(march.Steps) + 0.5 * march.BoundaryTolerance;
}

/// Computes the visibility at `steps` positions that divide the in-scattered light equally.
void LightShafts::SampleVisibility(RayMarch& march, int steps) const
{
  const double spacing = march.Size() / (steps - 1);
  march.Steps.clear();
  for (int i = 0; i < steps; ++i)
  {
    const double fraction = MarchEndMargin + (1.0 - 2.0 * MarchEndMargin) * i / (steps - 1);
    const double cdf = march.Low.CDF + march.Size() * fraction;
    const double accuracy = i == 0 || i == steps - 1 ? MarchEndMargin : StepAccuracy;
    march.Steps.push_back(this->TraceVisibility(march,
      march.Profile.Find(
        i == 0 ? march.Low : march.Steps.back().At, march.High, cdf, accuracy * spacing)));
  }
}

/// Adds a visibility sample between each pair of neighboring samples.
void LightShafts::BisectSamples(RayMarch& march) const
{
  std::vector<Step> steps;
  steps.reserve(2 * march.Steps.size());
  for (const Step& next : march.Steps)
  {
    if (!steps.empty())
    {
      const Point& low = steps.back().At;
      const double size = next.At.CDF - low.CDF;
      steps.push_back(this->TraceVisibility(
        march, march.Profile.Find(low, next.At, low.CDF + 0.5 * size, StepAccuracy * size)));
    }
    steps.push_back(next);
  }
  march.Steps.swap(steps);
}

/// Returns the unshadowed fraction of the in-scattered light in the current interval.
glm::dvec3 LightShafts::IntegrateVisibility(RayMarch& march) const
{
  const Step& front = march.Steps.front();
  const Step& back = march.Steps.back();
  glm::dvec3 sum =
    march.Profile.Between(march.Low, front.At) * static_cast<double>(front.Visibility) +
    march.Profile.Between(back.At, march.High) * static_cast<double>(back.Visibility);
  for (std::size_t i = 1; i < march.Steps.size(); ++i)
  {
    sum += this->IntegrateBetween(march, march.Steps[i - 1], march.Steps[i]);
  }
  return sum;
}

/// Returns the estimated fraction of light that these steps miss.
double LightShafts::EstimateMissedLight(const std::vector<Step>& steps)
{
  int boundaries = 0;
  for (std::size_t i = 1; i < steps.size(); ++i)
  {
    boundaries += steps[i].Visibility != steps[i - 1].Visibility;
  }
  return (MissedPerBoundary * boundaries + MissedPerInterval) / static_cast<double>(steps.size());
}

LightShafts::Step LightShafts::TraceVisibility(RayMarch& march, const Point& point) const
{
  const glm::dvec3 position = march.Origin + point.Parameter * march.Direction;
  const LightDirection toLight = DirectionToLight(march.Source, position);
  if (!toLight.InCone)
  {
    return { point, 0.f };
  }
  Ray ray;
  ray.Origin = glm::vec3(position);
  ray.Direction = glm::vec3(toLight.Direction);
  ray.Far = static_cast<float>(toLight.Distance);
  return { point, this->SurfaceShading.TraceTransmittance(ray, march.Rays) };
}

/// Returns the unshadowed fraction of the in-scattered light between two neighboring steps.
glm::dvec3 LightShafts::IntegrateBetween(RayMarch& march, const Step& low, const Step& high) const
{
  const glm::dvec3 light = march.Profile.Between(low.At, high.At);
  if (low.Visibility == high.Visibility)
  {
    return light * static_cast<double>(low.Visibility);
  }
  if (!(high.At.CDF - low.At.CDF <= march.BoundaryTolerance))
  {
    const Point middle = march.Profile.Middle(low.At, high.At);
    // BoundaryTolerance may be below the resolution of a double.
    if (middle.CDF > low.At.CDF && middle.CDF < high.At.CDF)
    {
      const Step atMiddle = this->TraceVisibility(march, middle);
      return this->IntegrateBetween(march, low, atMiddle) +
        this->IntegrateBetween(march, atMiddle, high);
    }
  }
  return light * (0.5 * (low.Visibility + high.Visibility));
}

}
