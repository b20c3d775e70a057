// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CameraRayTracer.h"

#include "Shading/HemisphereSampling.h"
#include "vtkPenumbraIrradianceProvider.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{
// Maximum number of layers composited along one ray. Bounds the cost of stacked translucent
// surfaces.
constexpr int MaximumLayers = 256;
// Accumulated alpha above which layers behind are ignored. They would change the color by 1/4096 at
// most, which is below half a step of 8-bit colors.
constexpr float OpaqueAlpha = 1.f - 1.f / 4096.f;
// Default strength of occlusion on surfaces colored by scalars. Below 1, so that the colors still
// represent the data.
constexpr float StrengthOnScalars = 0.6f;

/// Returns the index of the sample of a light for the ray at image point p. The 4 x 4 pixel corners
/// of a block have the indices of one stratified set, which differs from that of other blocks.
std::uint32_t FindLightSample(glm::dvec2 p)
{
  const glm::dvec2 corner = glm::floor(p);
  if (p != corner)
  {
    return HashPoint(glm::vec3(p, 0.0), glm::vec3(0.f));
  }
  const auto x = static_cast<std::uint32_t>(corner.x);
  const auto y = static_cast<std::uint32_t>(corner.y);
  const std::uint32_t block = MixBits(x / 4 + MixBits(y / 4));
  return block << 4 | (y % 4 * 4 + x % 4);
}

glm::dvec3 WorldPoint(const Scene& scene, const Ray& ray, const Hit& hit)
{
  return scene.ToWorld(
    glm::dvec3(ray.Origin) + static_cast<double>(hit.Distance) * glm::dvec3(ray.Direction));
}

}

RayCounts& RayCounts::operator+=(const RayCounts& other)
{
  this->Primary += other.Primary;
  this->Refinement += other.Refinement;
  this->Auxiliary += other.Auxiliary;
  this->Shadow += other.Shadow;
  this->Shaft += other.Shaft;
  this->Occlusion += other.Occlusion;
  this->Indirect += other.Indirect;
  return *this;
}

CameraRayTracer::CameraRayTracer(const RayScene& rays, const Shading& shading, const Camera& camera)
  : Rays(rays),
    SurfaceShading(shading),
    ViewCamera(camera)
{
  const std::vector<Surface>& surfaces = rays.GetScene().Surfaces;
  this->Translucent = std::any_of(surfaces.begin(), surfaces.end(),
    [](const Surface& surface) { return surface.IsTranslucent(); });
  this->Kinds = LayerOrder::FindKinds(rays.GetScene());
}

Ray CameraRayTracer::MakeRay(glm::dvec2 p) const
{
  Ray ray;
  ray.Origin = glm::vec3(this->ViewCamera.RayOrigin(p));
  ray.Direction = glm::vec3(this->ViewCamera.RayDirection(p));
  ray.Near =
    static_cast<float>(std::max(this->ViewCamera.Near - this->ViewCamera.DepthOfRayOrigins(), 0.0));
  return ray;
}

glm::vec4 CameraRayTracer::GetBackground(glm::dvec2 p) const
{
  glm::vec4 c = this->SurfaceShading.Background(p);
  return { c.r * c.a, c.g * c.a, c.b * c.a, c.a };
}

void CameraRayTracer::SetOcclusion(
  const vtkPenumbraIrradianceProvider* provider, double strength, double tolerance)
{
  this->OcclusionTolerance = tolerance;
  this->OcclusionProvider = provider;
  this->OcclusionStrength = static_cast<float>(strength);
}

void CameraRayTracer::SetIndirectLight(
  const vtkPenumbraIrradianceProvider* provider, float albedo, double tolerance)
{
  this->IrradianceProvider = provider;
  this->Albedo = albedo;
  this->IrradianceTolerance = tolerance;
}

float CameraRayTracer::ComputeOcclusion(const Ray& ray, const Hit& hit, const ShadedHit& shaded,
  RayCounts& counts, double toleranceScale) const
{
  const glm::dvec3 point = WorldPoint(this->GetScene(), ray, hit);
  const glm::dvec3 geometric = glm::normalize(glm::dvec3(shaded.GeometricNormal));
  const glm::dvec3 normal = this->Rays.GetSmoothNormal(hit, geometric);
  const vtkPenumbraIrradianceProvider::Estimate estimate = this->OcclusionProvider->OcclusionWithin(
    &point.x, &normal.x, toleranceScale * this->OcclusionTolerance, &geometric.x);
  counts.Occlusion += estimate.Rays;
  return static_cast<float>(estimate.Value);
}

glm::vec3 CameraRayTracer::ComputeIndirectLight(const Ray& ray, const Hit& hit,
  const ShadedHit& shaded, RayCounts& counts, double toleranceScale) const
{
  const glm::vec3 reflectance = this->Albedo * shaded.Reflectance;
  if (reflectance == glm::vec3(0.f))
  {
    return reflectance;
  }
  const glm::dvec3 point = WorldPoint(this->GetScene(), ray, hit);
  const glm::dvec3 geometric = glm::normalize(glm::dvec3(shaded.GeometricNormal));
  const glm::dvec3 normal = this->Rays.GetSmoothNormal(hit, geometric);
  const vtkPenumbraIrradianceProvider::Light light = this->IrradianceProvider->Irradiance(
    &point.x, &normal.x, toleranceScale * this->IrradianceTolerance, &geometric.x);
  counts.Indirect += light.Rays;
  return reflectance * glm::vec3(light.Value[0], light.Value[1], light.Value[2]) / glm::pi<float>();
}

// The alpha of the medium is that of its most transparent channel; `tint` is the transmittance of the
// other channels relative to it.
void CameraRayTracer::AddMedium(
  const Ray& ray, double from, double to, Sample& sample, glm::vec3& tint, RayCounts& counts) const
{
  const float weight = 1.f - sample.Color.a;
  const LightShafts::InScattering scattered =
    this->Shafts->Along(ray, from, to, weight, counts.Shaft);
  const glm::vec3& through = scattered.Transmittance;
  const float most = std::max(through.r, std::max(through.g, through.b));
  sample.Color += weight * glm::vec4(tint * scattered.Light, 1.f - most);
  sample.Error += weight * scattered.Error;
  tint *= most > 0.f ? through / most : glm::vec3(1.f);
}

void CameraRayTracer::CompositeLayers(glm::dvec2 p, const Ray& ray, Sample& sample,
  RayCounts& counts, double toleranceScale, std::uint32_t penumbrae,
  std::vector<PenumbraNeighbors>* neighbors) const
{
  if (neighbors)
  {
    for (PenumbraNeighbors& light : *neighbors)
    {
      light.MoveTo(glm::vec2(p));
    }
  }
  glm::vec4& color = sample.Color;
  const bool hasPenumbrae = this->SurfaceShading.HasPenumbrae();
  float squaredNoise = 0.f;
  glm::vec3 tint(1.f);
  Hit hit = sample.FirstHit;
  Ray continuation = ray;
  double distance = -this->ViewCamera.Advance;
  LayerOrder order;
  for (int layer = 0; hit.IsHit() && layer < MaximumLayers; ++layer)
  {
    if (!this->Kinds.empty() && !order.IsDrawn(this->Kinds[hit.Surface], hit))
    {
      continuation.Near = hit.NextNear;
      hit = this->Rays.Intersect(continuation);
      continue;
    }
    const Surface& surface = this->GetScene().Surfaces[hit.Surface];
    if (this->Shafts &&
      (this->Shafts->GetMedium().IncludesTranslucentSurfaces || !surface.IsTranslucent()))
    {
      this->AddMedium(ray, distance, hit.Distance, sample, tint, counts);
      distance = hit.Distance;
    }
    PenumbraSampling lights;
    if (hasPenumbrae)
    {
      lights.Estimated = penumbrae;
      lights.Index = FindLightSample(p);
      lights.Tolerance = static_cast<float>(toleranceScale * this->PenumbraTolerance);
      lights.Neighbors = neighbors && layer == 0 ? neighbors->data() : nullptr;
    }
    const ShadedHit shaded =
      this->SurfaceShading.Shade(ray, hit, counts.Shadow, hasPenumbrae ? &lights : nullptr);
    glm::vec4 c = shaded.Color;
    if (this->OcclusionProvider && !surface.IsLineOrPoint)
    {
      const float strength = this->OcclusionStrength >= 0.f ? this->OcclusionStrength
        : surface.ScalarColoring                            ? StrengthOnScalars
                                                            : 1.f;
      const float unoccluded =
        1.f - strength * this->ComputeOcclusion(ray, hit, shaded, counts, toleranceScale);
      c = glm::vec4(unoccluded * glm::vec3(c), c.a);
    }
    if (this->IrradianceProvider && !surface.IsLineOrPoint)
    {
      c += glm::vec4(this->ComputeIndirectLight(ray, hit, shaded, counts, toleranceScale), 0.f);
    }
    const float weight = (1.f - color.a) * c.a;
    color += glm::vec4(tint * glm::vec3(weight * c.r, weight * c.g, weight * c.b),
      surface.IsAdditive ? 0.f : weight);
    squaredNoise += weight * weight * lights.SquaredError;
    sample.LitBy |= lights.Lit;
    sample.ShadowedFrom |= lights.Shadowed;
    if ((c.a >= 1.f && !surface.IsAdditive) || color.a > OpaqueAlpha)
    {
      sample.OpaqueDepth = hit.Distance;
      break;
    }
    // NextNear is the smallest distance that excludes this hit.
    continuation.Near = hit.NextNear;
    hit = this->Rays.Intersect(continuation);
  }
  if (this->Shafts && !hit.IsHit())
  {
    this->AddMedium(ray, distance, std::numeric_limits<double>::infinity(), sample, tint, counts);
  }
  sample.Noise = std::sqrt(squaredNoise);
  if (color.a < 1.f)
  {
    color += glm::vec4(tint, 1.f) * ((1.f - color.a) * this->GetBackground(p));
  }
}

Sample CameraRayTracer::TraceSample(glm::dvec2 p, RayCounts& counts, double toleranceScale,
  std::uint32_t penumbrae, std::vector<PenumbraNeighbors>* neighbors) const
{
  const Ray ray = this->MakeRay(p);
  Sample sample;
  sample.FirstHit = this->Rays.Intersect(ray);
  this->CompositeLayers(p, ray, sample, counts, toleranceScale, penumbrae, neighbors);
  return sample;
}

void CameraRayTracer::TracePacket(const glm::dvec2* points, unsigned int active, Sample* samples,
  RayCounts& counts, double toleranceScale, std::uint32_t penumbrae,
  std::vector<PenumbraNeighbors>* neighbors) const
{
  Ray rays[PacketSize];
  Hit hits[PacketSize];
  for (int i = 0; i < PacketSize; ++i)
  {
    if (active >> i & 1u)
    {
      rays[i] = this->MakeRay(points[i]);
    }
    else
    {
      rays[i].Near = 1.f;
      rays[i].Far = 0.f;
    }
  }
  this->Rays.Intersect16(rays, hits);
  for (int i = 0; i < PacketSize; ++i)
  {
    if (active >> i & 1u)
    {
      samples[i] = Sample();
      samples[i].FirstHit = hits[i];
      this->CompositeLayers(
        points[i], rays[i], samples[i], counts, toleranceScale, penumbrae, neighbors);
    }
  }
}

}
