// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CameraRayTracer.h"

#include "EdgeBlending.h"
#include "Embree/RayTriangle.h"
#include "LayerLighting.h"
#include "Scene.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/RayTracingConstants.h"
#include "Surface.h"
#include "vtkPenumbraIrradianceProvider.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{
// Number of shadow rays of one camera ray after which lights with a size get one ray per layer.
constexpr long long LightSampleBudget = LightSampleBudgetFactor * MaximumLightSamples;
// Largest variance of the fraction of a light that one ray estimates.
constexpr float UnsampledPenumbraVariance = 0.25f;

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

}

const float CameraRayTracer::OpaqueAlpha = 1.f - OpaqueTransmittance;

bool HasTextures(const Surface& surface)
{
  return surface.ColorTexture || surface.LitTexture || surface.BaseColorTexture ||
    surface.DetailTextures;
}

CameraRayTracer::CameraRayTracer(const RayScene& rays, const Shading& shading, const Camera& camera)
  : Rays(rays),
    SurfaceShading(shading),
    ViewCamera(camera)
{
  const std::vector<Surface>& surfaces = rays.GetSurfaces();
  this->Translucent = std::any_of(surfaces.begin(), surfaces.end(),
    [](const Surface& surface) { return surface.IsTranslucent(); });
  this->Textured = std::any_of(surfaces.begin(), surfaces.end(), penumbra::HasTextures);
  this->Kinds = LayerOrder::FindKinds(surfaces);
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

bool CameraRayTracer::HasBackgroundImage() const
{
  const penumbra::Background& background = this->Rays.GetScene().BackgroundColors;
  return background.Image != nullptr || background.Surroundings != nullptr;
}

glm::vec4 CameraRayTracer::GetBackground(const glm::dvec2& p) const
{
  glm::vec4 c = this->SurfaceShading.Background(p);
  return { c.r * c.a, c.g * c.a, c.b * c.a, c.a };
}

void CameraRayTracer::SetOcclusion(
  const vtkPenumbraIrradianceProvider* provider, double strength, double tolerance)
{
  this->Lighting.OcclusionTolerance = tolerance;
  this->Lighting.OcclusionProvider = provider;
  this->Lighting.OcclusionStrength = static_cast<float>(strength);
}

void CameraRayTracer::SetIndirectLight(
  const vtkPenumbraIrradianceProvider* provider, float albedo, double tolerance)
{
  this->Lighting.IrradianceProvider = provider;
  this->Lighting.Albedo = albedo;
  this->Lighting.IrradianceTolerance = tolerance;
}

float CameraRayTracer::ComputeOcclusion(
  const Ray& ray, const Hit& hit, const ShadedHit& shaded, RayCounts& counts) const
{
  LayerLighting lighting(this->Lighting, this->Rays, 1.0);
  return lighting.EstimateOcclusion(ray, hit, shaded, counts, 1.0);
}

// The alpha of the medium is that of its most transparent channel; `tint` is the transmittance of the
// other channels relative to it.
void CameraRayTracer::AddMedium(const Ray& ray, double from, double to, bool scatters,
  Sample& sample, glm::vec3& tint, RayCounts& counts) const
{
  const float weight = 1.f - sample.Color.a;
  LightShafts::InScattering scattered;
  if (scatters)
  {
    scattered = this->Shafts->Along(ray, from, to, weight, counts.Shaft);
  }
  else
  {
    scattered.Transmittance = this->Shafts->ComputeTransmittance(ray, from, to);
  }
  const glm::vec3& through = scattered.Transmittance;
  const float most = std::max(through.r, std::max(through.g, through.b));
  sample.Color += weight * glm::vec4(tint * scattered.Light, 1.f - most);
  sample.Error += weight * scattered.Error;
  tint *= most > 0.f ? through / most : glm::vec3(1.f);
}

void CameraRayTracer::CompositeLayers(const glm::dvec2& p, const Ray& ray, Sample& sample,
  RayCounts& counts, double toleranceScale, std::uint32_t penumbrae,
  std::vector<PenumbraNeighbors>* neighbors, std::vector<LitLayer>* layers) const
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
  EdgeBlending edges(this->ViewCamera);
  LayerLighting lighting(this->Lighting, this->Rays, toleranceScale);
  const long long shadowRays = counts.Shadow;
  for (int layer = 0; hit.IsHit() && layer < MaximumLayers; ++layer)
  {
    if (!this->Kinds.empty() && !this->IsDrawn({ hit.Surface, hit.Primitive }, order))
    {
      continuation = ContinueBehind(continuation, hit);
      hit = this->Rays.Intersect(continuation);
      continue;
    }
    const Surface& surface = this->Rays.GetSurfaces()[hit.Surface];
    if (this->Shafts &&
      (this->Shafts->GetMedium().IncludesTranslucentSurfaces || !surface.IsTranslucent()))
    {
      this->AddMedium(ray, distance, hit.Distance, !layers, sample, tint, counts);
      distance = hit.Distance;
    }
    const float remaining = 1.f - color.a;
    PenumbraSampling lights;
    if (hasPenumbrae)
    {
      // The squared errors of all layers add up to the tolerance, because their weights add up to 1.
      const double scale = toleranceScale / std::sqrt(remaining);
      const bool overBudget = counts.Shadow - shadowRays > LightSampleBudget;
      lights.Estimated = overBudget ? 0u : penumbrae;
      lights.Index = FindLightSample(p);
      lights.Tolerance = static_cast<float>(scale * this->PenumbraTolerance);
      lights.Neighbors = neighbors && layer == 0 ? neighbors->data() : nullptr;
      lights.SquaredError = overBudget && penumbrae != 0 ? UnsampledPenumbraVariance : 0.f;
    }
    const ShadedHit shaded =
      this->SurfaceShading.Shade(ray, hit, counts.Shadow, hasPenumbrae ? &lights : nullptr);
    glm::vec4 c = shaded.Color;
    c.a = edges.FindOpacity(surface, ray, hit, shaded);
    if (layers && this->IsLitLayer(surface) && remaining * c.a > 0.f)
    {
      layers->push_back(this->MakeLitLayer(ray, hit, glm::dvec3(shaded.GeometricNormal)));
      LitLayer& lit = layers->back();
      const glm::vec3 factor = remaining * c.a * tint;
      lit.Reflectance = factor * shaded.Reflectance;
      lit.Color = this->Lighting.GetStrength(surface) * remaining * c.a * tint *
        (glm::vec3(c) - this->SurfaceShading.GetUniformLight() * shaded.Reflectance);
    }
    else if (!layers && this->UsesIrradianceProvider() && !surface.IsLineOrPoint)
    {
      lighting.Apply(ray, hit, shaded, remaining * c.a, tint, c, sample.Color, counts);
    }
    const float weight = remaining * c.a;
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
    continuation = ContinueBehind(continuation, hit);
    hit = this->Rays.Intersect(continuation);
  }
  if (this->Shafts && !hit.IsHit())
  {
    this->AddMedium(
      ray, distance, std::numeric_limits<double>::infinity(), !layers, sample, tint, counts);
  }
  sample.Error += lighting.Finish(ray, sample.Color, counts);
  if (hit.IsHit() && sample.OpaqueDepth == std::numeric_limits<float>::infinity())
  {
    sample.Error += 1.f - color.a; // of layers beyond the maximum
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

Sample CameraRayTracer::ShadeSample(
  glm::dvec2 p, const PrimitiveId* triangle, RayCounts& counts, double toleranceScale) const
{
  const Ray ray = this->MakeRay(p);
  Sample sample;
  if (triangle)
  {
    sample.FirstHit =
      ComputeHit(this->Rays.GetSurfaces(), triangle->Surface, triangle->Primitive, ray);
  }
  this->CompositeLayers(p, ray, sample, counts, toleranceScale, 0, nullptr);
  return sample;
}

LayerColor CameraRayTracer::ShadeLayer(glm::dvec2 p, PrimitiveId triangle, RayCounts& counts) const
{
  const Ray ray = this->MakeRay(p);
  const Hit hit = ComputeHit(this->Rays.GetSurfaces(), triangle.Surface, triangle.Primitive, ray);
  const ShadedHit shaded =
    this->SurfaceShading.Shade(ray, hit, counts.Shadow, nullptr, Shading::Terms::Untextured);
  return { triangle, shaded.Color, EdgeBlending::ComputeSlope(ray, shaded) };
}

void CameraRayTracer::TraceHits(
  const glm::dvec2* points, unsigned int active, Ray* rays, Hit* hits) const
{
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
}

void CameraRayTracer::TracePacket(const glm::dvec2* points, unsigned int active, Sample* samples,
  RayCounts& counts, double toleranceScale, std::uint32_t penumbrae,
  std::vector<PenumbraNeighbors>* neighbors) const
{
  Ray rays[PacketSize];
  Hit hits[PacketSize];
  this->TraceHits(points, active, rays, hits);
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

bool CameraRayTracer::IsLitLayer(const Surface& surface) const
{
  return !surface.IsLineOrPoint && (this->FindsUnlitLayers || surface.Front.Lighting);
}

LitLayer CameraRayTracer::MakeLitLayer(const Ray& ray, const Hit& hit, glm::dvec3 normal) const
{
  const glm::dvec3 geometric = glm::normalize(normal);
  LitLayer layer;
  layer.Where = hit;
  layer.Position = ray.Origin + hit.Distance * ray.Direction;
  layer.Normal = glm::vec3(this->Rays.GetSmoothNormal(hit, geometric));
  layer.Geometric = glm::vec3(geometric);
  return layer;
}

void CameraRayTracer::TraceLayers(const glm::dvec2* points, unsigned int active,
  unsigned int shaded, Sample* samples, std::vector<LitLayer>* layers, RayCounts& counts) const
{
  Ray rays[PacketSize];
  Hit hits[PacketSize];
  this->TraceHits(points, active, rays, hits);
  for (int i = 0; i < PacketSize; ++i)
  {
    layers[i].clear();
    if (!(active >> i & 1u))
    {
      continue;
    }
    samples[i] = Sample();
    samples[i].FirstHit = hits[i];
    if (!hits[i].IsHit())
    {
      samples[i].Color = this->GetBackground(points[i]);
    }
    else if (shaded >> i & 1u || this->Translucent || !this->Kinds.empty() ||
      this->Rays.GetSurfaces()[hits[i].Surface].IsLineOrPoint)
    {
      this->CompositeLayers(points[i], rays[i], samples[i], counts, 1.0, 0, nullptr, &layers[i]);
    }
    else if (this->IsLitLayer(this->Rays.GetSurfaces()[hits[i].Surface]))
    {
      const glm::dvec3 normal(this->Rays.GetNormal(rays[i], hits[i]));
      const bool isBehind = glm::dot(normal, glm::dvec3(rays[i].Direction)) > 0.0;
      layers[i].push_back(this->MakeLitLayer(rays[i], hits[i], isBehind ? -normal : normal));
    }
  }
}

}
