// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LayerLighting.h"

#include "SceneCoordinates.h"
#include "Shading/RayTracingConstants.h"
#include "Surface.h"
#include "Vectors.h"
#include "vtkPenumbraIrradianceProvider.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

// Default strength of occlusion on surfaces colored by scalars. Below 1, so that the colors still
// represent the data.
constexpr float StrengthOnScalars = 0.6f;
// Estimated errors up to this multiple of the accepted ones are not reported: an estimate from few
// rays exceeds the error.
constexpr double ReportedErrorFactor = 1.5;

/// Point and normals of a hit in the world.
struct SurfacePoint
{
  glm::dvec3 Position;
  glm::dvec3 Geometric;
  glm::dvec3 Normal;

  SurfacePoint(const RayScene& rays, const Ray& ray, const Hit& hit, const ShadedHit& shaded)
    : Position(rays.GetCoordinates().ToWorld(
        glm::dvec3(ray.Origin) + static_cast<double>(hit.Distance) * glm::dvec3(ray.Direction))),
      Geometric(glm::normalize(glm::dvec3(shaded.GeometricNormal))),
      Normal(rays.GetSmoothNormal(hit, this->Geometric))
  {
  }
};

/// Returns the error to report. A value without rays is interpolated between records, which are placed
/// so that it is within the tolerance; its own estimate may be far larger.
double ComputeReportedError(double error, long long rays, double tolerance)
{
  return rays == 0 ? std::min(error, tolerance) : error;
}

}

LayerLighting::LayerLighting(
  const LayerLightingSettings& settings, const RayScene& rays, double toleranceScale)
  : Settings(settings),
    Rays(rays),
    ToleranceScale(toleranceScale)
{
}

float LayerLightingSettings::GetStrength(const Surface& surface) const
{
  return this->OcclusionStrength >= 0.f ? this->OcclusionStrength
    : surface.ScalarColoring            ? StrengthOnScalars
                                        : 1.f;
}

float LayerLighting::EstimateOcclusion(
  const Ray& ray, const Hit& hit, const ShadedHit& shaded, RayCounts& counts, double weight)
{
  const SurfacePoint point(this->Rays, ray, hit, shaded);
  const double tolerance =
    this->ToleranceScale / std::sqrt(weight) * this->Settings.OcclusionTolerance;
  const vtkPenumbraIrradianceProvider::Estimate estimate =
    this->Settings.OcclusionProvider->OcclusionWithin(
      &point.Position.x, &point.Normal.x, tolerance, &point.Geometric.x);
  counts.Occlusion += estimate.Rays;
  this->SquaredError +=
    Square<double>(weight * ComputeReportedError(estimate.Error, estimate.Rays, tolerance));
  this->SquaredTolerance +=
    weight * Square<double>(this->ToleranceScale * this->Settings.OcclusionTolerance);
  return static_cast<float>(estimate.Value);
}

glm::vec3 LayerLighting::EstimateIrradiance(
  const Ray& ray, const Hit& hit, const ShadedHit& shaded, RayCounts& counts, double weight)
{
  const SurfacePoint point(this->Rays, ray, hit, shaded);
  const double tolerance =
    this->ToleranceScale / std::sqrt(weight) * this->Settings.IrradianceTolerance;
  const vtkPenumbraIrradianceProvider::Light light = this->Settings.IrradianceProvider->Irradiance(
    &point.Position.x, &point.Normal.x, tolerance, &point.Geometric.x);
  counts.Indirect += light.Rays;
  const double factor = this->Settings.Albedo / glm::pi<double>();
  this->SquaredError +=
    Square<double>(weight * factor * ComputeReportedError(light.Error, light.Rays, tolerance));
  this->SquaredTolerance +=
    weight * Square<double>(factor * this->ToleranceScale * this->Settings.IrradianceTolerance);
  return { light.Value[0], light.Value[1], light.Value[2] };
}

double LayerLighting::ComputeNegligibleWeight() const
{
  double tolerance = 1.0;
  if (this->Settings.OcclusionProvider)
  {
    tolerance = this->Settings.OcclusionTolerance;
  }
  if (this->Settings.IrradianceProvider)
  {
    tolerance = std::min(
      tolerance, this->Settings.Albedo * this->Settings.IrradianceTolerance / glm::pi<double>());
  }
  return SharedWeightFraction * this->ToleranceScale * tolerance;
}

void LayerLighting::Apply(const Ray& ray, const Hit& hit, const ShadedHit& shaded, float weight,
  const glm::vec3& tint, glm::vec4& c, glm::vec4& color, RayCounts& counts)
{
  if (!(weight > 0.f))
  {
    return;
  }
  const bool occlusion = this->Settings.OcclusionProvider != nullptr;
  const Surface& surface = this->Rays.GetSurfaces()[hit.Surface];
  const float strength = occlusion ? this->Settings.GetStrength(surface) : 0.f;
  const glm::vec3 reflectance =
    this->Settings.IrradianceProvider ? this->Settings.Albedo * shaded.Reflectance : glm::vec3(0.f);
  const bool light = reflectance != glm::vec3(0.f);
  const double limit = std::clamp(SharedWeightGrowth * (this->Estimates - FullEstimates),
    this->ComputeNegligibleWeight(), MaximumSharedWeight);
  if (this->Estimates > 0 && (this->HasIrradiance || !light) && this->SharedWeight + weight < limit)
  {
    this->SharedWeight += weight;
    this->SharedColor += weight * strength * tint * glm::vec3(c);
    this->SharedReflectance += weight * tint * reflectance;
    this->SharedHit = hit;
    this->SharedShaded = shaded;
    return;
  }
  // An estimate also serves layers around it, of a weight of up to the limit.
  const Estimate estimate = this->MakeEstimate(
    ray, hit, shaded, std::clamp(limit, static_cast<double>(weight), 1.0), light, counts);
  if (occlusion)
  {
    const float unoccluded = 1.f - strength * estimate.Occlusion;
    c = glm::vec4(unoccluded * glm::vec3(c), c.a);
  }
  if (light)
  {
    c += glm::vec4(reflectance * estimate.Irradiance / glm::pi<float>(), 0.f);
  }
  this->CompleteShared(estimate, color);
}

LayerLighting::Estimate LayerLighting::MakeEstimate(const Ray& ray, const Hit& hit,
  const ShadedHit& shaded, double weight, bool light, RayCounts& counts)
{
  Estimate estimate = this->Last;
  if (this->Settings.OcclusionProvider)
  {
    estimate.Occlusion = this->EstimateOcclusion(ray, hit, shaded, counts, weight);
  }
  if (light)
  {
    estimate.Irradiance = this->EstimateIrradiance(ray, hit, shaded, counts, weight);
    this->HasIrradiance = true;
  }
  return estimate;
}

// The mean of both ends: their difference is distributed between the layers, about evenly.
void LayerLighting::CompleteShared(const Estimate& next, glm::vec4& color)
{
  if (this->SharedWeight > 0.f)
  {
    const float occlusion = 0.5f * (this->Last.Occlusion + next.Occlusion);
    const glm::vec3 irradiance = 0.5f * (this->Last.Irradiance + next.Irradiance);
    color += glm::vec4(
      this->SharedReflectance * irradiance / glm::pi<float>() - occlusion * this->SharedColor, 0.f);
    this->SharingError += Square<double>(0.25f * MaximumComponent(this->SharedColor) *
                            std::abs(next.Occlusion - this->Last.Occlusion)) +
      Square<double>(0.25f * MaximumComponent(this->SharedReflectance) / glm::pi<float>() *
        MaximumComponent(glm::abs(next.Irradiance - this->Last.Irradiance)));
  }
  this->SharedWeight = 0.f;
  this->SharedColor = glm::vec3(0.f);
  this->SharedReflectance = glm::vec3(0.f);
  this->Last = next;
  ++this->Estimates;
}

float LayerLighting::Finish(const Ray& ray, glm::vec4& color, RayCounts& counts)
{
  if (this->SharedWeight > this->ComputeNegligibleWeight())
  {
    const bool light = this->SharedReflectance != glm::vec3(0.f);
    this->CompleteShared(this->MakeEstimate(ray, this->SharedHit, this->SharedShaded,
                           this->SharedWeight, light, counts),
      color);
  }
  else if (this->SharedWeight > 0.f)
  {
    this->CompleteShared(this->Last, color);
  }
  if (this->Estimates < 2)
  {
    return 0.f;
  }
  const double excess =
    this->SquaredError - Square<double>(ReportedErrorFactor) * this->SquaredTolerance;
  return static_cast<float>(std::sqrt(this->SharingError + std::max(excess, 0.0)));
}

}
