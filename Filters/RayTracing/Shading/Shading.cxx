// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The formulas are those of VTK's polygon shader, so that images agree with rasterization. With a
// single headlight, diffuse and specular terms depend on the cosine between normal and view axis.
// With other lights, the specular term uses the reflected light direction of the Phong model.
#include "Shading.h"

#include "Environment/EnvironmentLight.h"
#include "HemisphereSampling.h"
#include "LiftedStart.h"
#include "OwenSobolSequence.h"
#include "PhysicallyBased.h"
#include "RayTracingConstants.h"
#include "Scene.h"
#include "Surface.h"
#include "SurfaceColor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{
namespace
{

/// Returns the normal used for lighting (unit).
glm::vec3 LightingNormal(const Surface& surface, const Hit& hit, glm::vec3 weights, bool front,
  glm::vec3 geometricNormal, glm::vec3 forward)
{
  glm::vec3 normal(0.f);
  if (!surface.Normals.empty())
  {
    const std::array<glm::vec3, 3> normals = surface.GetNormals(hit.Primitive, surface.Normals);
    normal = weights.x * normals[0] + weights.y * normals[1] + weights.z * normals[2];
  }
  else if (!surface.TriangleNormals.empty())
  {
    normal = surface.GetTriangleNormal(hit.Primitive);
  }
  const float squaredLength = glm::dot(normal, normal);
  if (!(squaredLength > 0.f && squaredLength <= std::numeric_limits<float>::max()))
  {
    return glm::normalize(geometricNormal);
  }
  normal *= 1.f / std::sqrt(squaredLength);
  switch (surface.NormalRule)
  {
    case Surface::NormalRules::ByWinding:
      return front ? normal : -normal;
    case Surface::NormalRules::FacingCamera:
      return glm::dot(normal, forward) > 0.f ? -normal : normal;
    case Surface::NormalRules::Unchanged:
      break;
  }
  return normal;
}

}

Shading::Shading(const RayScene& scene, bool shadows)
  : Rays(scene)
{
  const std::vector<Light>& lights = scene.GetScene().Lights;
  this->OneHeadlight = lights.size() == 1 && lights[0].Headlight;
  this->Shadows = shadows &&
    std::any_of(lights.begin(), lights.end(), [](const Light& light) { return light.CastsShadow; });
  this->Penumbrae = this->Shadows &&
    std::any_of(
      lights.begin(), lights.end(), [](const Light& light) { return light.CastsPenumbra(); });
  EnvironmentLight* environment = scene.GetScene().EnvironmentReflections.get();
  for (const Surface& surface : scene.GetScene().Surfaces)
  {
    const bool reflects = environment && surface.Front.PhysicallyBased;
    if (reflects)
    {
      environment->Prepare();
    }
    SurfaceMaterial material;
    material.Front = MakePhongCoefficients(surface.Front);
    material.Back = surface.HasBackMaterial ? MakePhongCoefficients(surface.Back) : material.Front;
    material.AmbientCoefficient = surface.Front.Ambient;
    material.DiffuseCoefficient = surface.Front.Diffuse;
    material.Lit = surface.Front.Lighting && (!lights.empty() || reflects);
    material.Colored = HasMappedColor(surface);
    material.Constant = this->IsConstant(surface, material);
    material.UniformEmission = !material.Colored && !surface.HasBackMaterial &&
      !surface.BaseColorTexture && !surface.LitTexture && !material.Front.PbrMaterial;
    this->Materials.push_back(material);
    this->Translucent |= surface.IsTranslucent();
  }
}

Shading::PhongCoefficients Shading::MakePhongCoefficients(const Material& material)
{
  return { material.Ambient * material.AmbientColor, material.Diffuse * material.DiffuseColor,
    material.Specular * material.SpecularColor, material.SpecularPower, material.Opacity,
    material.PhysicallyBased ? &material : nullptr };
}

bool Shading::IsConstant(const Surface& surface, const SurfaceMaterial& material) const
{
  if (!surface.PointColors.empty() || surface.ColorTexture || surface.LitTexture ||
    surface.BaseColorTexture || (material.Lit && surface.Front.PhysicallyBased))
  {
    return false;
  }
  if (!material.Lit)
  {
    return true;
  }
  const bool highlight =
    material.Front.Specular != glm::vec3(0.f) || material.Back.Specular != glm::vec3(0.f);
  const std::vector<Light>& lights = this->Rays.GetScene().Lights;
  return surface.Normals.empty() && !surface.IsRound() && !this->Shadows &&
    (this->OneHeadlight || !highlight) &&
    std::all_of(lights.begin(), lights.end(),
      [](const Light& light) { return light.Kind == Light::Kinds::Directional; });
}

bool Shading::HasUniformEmission(std::uint32_t surface) const
{
  return this->Materials[surface].UniformEmission;
}

ShadedHit Shading::ShadeEmission(const Ray& ray, const Hit& hit) const
{
  const SurfaceMaterial& material = this->Materials[hit.Surface];
  if (material.UniformEmission)
  {
    const PhongCoefficients& phong = material.Front;
    const Surface& surface = this->Rays.GetSurfaces()[hit.Surface];
    ShadedHit shaded;
    shaded.Reflectance = surface.Front.Lighting ? phong.Diffuse : glm::vec3(0.f);
    shaded.Emission =
      material.Lit ? phong.Ambient : phong.Ambient + phong.Diffuse - shaded.Reflectance;
    shaded.Color = glm::vec4(shaded.Emission, phong.Opacity);
    return shaded;
  }
  long long shadowRays = 0;
  return this->Shade(ray, hit, shadowRays, nullptr, Terms::Emission);
}

ShadedHit Shading::Shade(const Ray& ray, const Hit& hit, long long& shadowRays,
  PenumbraSampling* penumbrae, Terms terms) const
{
  const bool diffuseOnly = terms == Terms::Diffuse || terms == Terms::Emission;
  const Scene& scene = this->Rays.GetScene();
  const Surface& surface = scene.Surfaces[hit.Surface];
  const SurfaceMaterial& material = this->Materials[hit.Surface];
  const glm::uvec3 corners = surface.GetCorners(hit.Primitive);
  const auto [a, b, c] = surface.GetPoints(hit.Primitive);
  const glm::vec3 weights(1.f - hit.U - hit.V, hit.U, hit.V);
  const auto pointOfHit = [&]() {
    return surface.IsRound() ? ray.Origin + hit.Distance * ray.Direction
                             : weights.x * a + weights.y * b + weights.z * c;
  };
  ShadedHit shaded;
  shaded.GeometricNormal = this->Rays.GetNormal(ray, hit);
  const bool front = glm::dot(shaded.GeometricNormal, ray.Direction) < 0.f;
  if (!front)
  {
    shaded.GeometricNormal = -shaded.GeometricNormal;
  }
  const glm::vec3 forward(scene.ViewCamera.Forward);
  shaded.Normal = LightingNormal(surface, hit, weights, front, shaded.GeometricNormal, forward);
  const PhongCoefficients* coefficients = front ? &material.Front : &material.Back;
  PhongCoefficients modified = *coefficients;
  if (material.Colored)
  {
    const glm::vec4 color = MappedColor(surface, hit, corners, weights);
    modified.Ambient = material.AmbientCoefficient * glm::vec3(color);
    modified.Diffuse = material.DiffuseCoefficient * glm::vec3(color);
    if (coefficients->PbrMaterial)
    {
      modified.Ambient = PhysicallyBased::DecodeMappedColor(modified.Ambient);
      modified.Diffuse = PhysicallyBased::DecodeMappedColor(modified.Diffuse);
    }
    modified.Opacity *= color.a;
    coefficients = &modified;
  }
  if (diffuseOnly)
  {
    modified.Specular = glm::vec3(0.f);
    coefficients = &modified;
  }
  if (coefficients->PbrMaterial && surface.BaseColorTexture)
  {
    const glm::vec4 texel = SampleTexture(surface, *surface.BaseColorTexture, corners, weights);
    modified = *coefficients;
    modified.Diffuse *= glm::vec3(texel);
    modified.Opacity *= texel.a;
    coefficients = &modified;
  }
  const PhongCoefficients& phong = *coefficients;
  shaded.Reflectance = surface.Front.Lighting ? phong.Diffuse : glm::vec3(0.f);

  glm::vec3 rgb;
  shaded.Emission =
    material.Lit ? phong.Ambient : phong.Ambient + phong.Diffuse - shaded.Reflectance;
  if (!material.Lit)
  {
    rgb = diffuseOnly ? shaded.Emission : phong.Ambient + phong.Diffuse;
    if (phong.PbrMaterial && !diffuseOnly)
    {
      rgb = PhysicallyBased::EncodeColor(rgb);
    }
  }
  else if (terms == Terms::Emission)
  {
    rgb = shaded.Emission;
  }
  else if (phong.PbrMaterial)
  {
    const glm::vec3 point = pointOfHit();
    const PhysicallyBased model(surface, *phong.PbrMaterial, hit, weights, phong.Diffuse,
      shaded.Normal, this->DirectionToCamera(point));
    shaded.Normal = model.GetNormal();
    shaded.Emission = glm::vec3(0.f); // only textures emit, which are not sampled
    rgb = this->ApplyLightsPhysicallyBased(
      model, hit, shaded, point, diffuseOnly, shadowRays, penumbrae);
    shaded.Reflectance *= 1.f - model.GetMetallic();
  }
  else if (this->OneHeadlight)
  {
    const float cosine = std::max(1e-6f, -glm::dot(shaded.Normal, forward));
    rgb = cosine * phong.Diffuse;
    if (phong.Specular != glm::vec3(0.f))
    {
      rgb += std::pow(cosine, phong.SpecularPower) * phong.Specular;
    }
    rgb = phong.Ambient + rgb * scene.Lights[0].DiffuseColor;
  }
  else
  {
    const glm::vec3 point = pointOfHit();
    rgb = this->ApplyLights(phong, hit, shaded, point, shadowRays, penumbrae);
  }
  if (!diffuseOnly && this->UniformLight != glm::vec3(0.f) && !surface.IsLineOrPoint)
  {
    rgb += this->UniformLight * shaded.Reflectance;
  }
  shaded.Color = glm::vec4(rgb, phong.Opacity);
  if (surface.LitTexture && terms != Terms::Untextured && (front || surface.TextureOnBackfaces))
  {
    const glm::vec4 texel = SampleTexture(surface, *surface.LitTexture, corners, weights);
    shaded.Color *= texel;
    shaded.Emission *= glm::vec3(texel);
    shaded.Reflectance *= glm::vec3(texel);
  }
  return shaded;
}

glm::vec3 Shading::ApplyLights(const PhongCoefficients& phong, const Hit& hit,
  const ShadedHit& shaded, glm::vec3 point, long long& shadowRays,
  PenumbraSampling* penumbrae) const
{
  const Scene& scene = this->Rays.GetScene();
  const glm::vec3 towardCamera = this->DirectionToCamera(point);
  glm::vec3 diffuse(0.f);
  glm::vec3 specular(0.f);
  for (std::size_t i = 0; i < scene.Lights.size(); ++i)
  {
    const Light& light = scene.Lights[i];
    glm::vec3 direction;
    float distance;
    float strength = light.ComputeStrength(point, direction, distance);
    const float irradiance = strength * -glm::dot(shaded.Normal, direction);
    if (!(irradiance > 0.f))
    {
      continue;
    }
    if (this->Shadows && light.CastsShadow)
    {
      strength *= this->ComputeVisibility(i, point, -direction, distance, hit, shaded,
        irradiance * (phong.Diffuse * light.DiffuseColor + phong.Specular * light.SpecularColor),
        shadowRays, penumbrae);
    }
    const glm::vec3 attenuation = this->ComputeAttenuation(light, point);
    diffuse += strength * -glm::dot(shaded.Normal, direction) * light.DiffuseColor * attenuation;
    if (phong.Specular != glm::vec3(0.f))
    {
      const float cosine = glm::dot(glm::reflect(direction, shaded.Normal), towardCamera);
      specular += strength * std::pow(std::max(1e-5f, cosine), phong.SpecularPower) *
        light.SpecularColor * attenuation;
    }
  }
  return phong.Ambient + diffuse * phong.Diffuse + specular * phong.Specular;
}

/// Returns a factor on the color of a light at a point on a surface.
glm::vec3 Shading::ComputeAttenuation(const Light& light, glm::vec3 point) const
{
  return this->Attenuation && light.CastsShadow
    ? this->Attenuation->TransmittanceToLight(light, point)
    : glm::vec3(1.f);
}

glm::vec3 Shading::DirectionToCamera(glm::vec3 point) const
{
  const Camera& view = this->Rays.GetScene().ViewCamera;
  const double advance = view.Advance - view.DepthOfRayOrigins();
  return glm::normalize(glm::vec3(view.Position - advance * view.Forward) - point);
}

glm::vec3 Shading::ApplyLightsPhysicallyBased(const PhysicallyBased& material, const Hit& hit,
  const ShadedHit& shaded, glm::vec3 point, bool diffuseOnly, long long& shadowRays,
  PenumbraSampling* penumbrae) const
{
  glm::vec3 radiance(0.f);
  const std::vector<Light>& lights = this->Rays.GetScene().Lights;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const Light& light = lights[i];
    glm::vec3 direction;
    float distance;
    float strength = light.ComputeStrength(point, direction, distance);
    if (strength > 0.f && this->Shadows && light.CastsShadow)
    {
      strength *= this->ComputeVisibility(i, point, -direction, distance, hit, shaded,
        strength * (shaded.Reflectance * light.DiffuseColor), shadowRays, penumbrae);
    }
    if (strength > 0.f)
    {
      // VTK's shader assumes that a single headlight is at the camera.
      const glm::vec3 toward = this->OneHeadlight ? this->DirectionToCamera(point) : -direction;
      radiance += strength * light.DiffuseColor * this->ComputeAttenuation(light, point) *
        material.Reflect(toward, diffuseOnly);
    }
  }
  const EnvironmentLight* environment = this->Rays.GetScene().EnvironmentReflections.get();
  if (environment && !diffuseOnly)
  {
    radiance += material.ReflectEnvironment(*environment);
  }
  return material.ToDisplayColor(radiance);
}

float Shading::ComputeVisibility(std::size_t light, glm::vec3 point, glm::vec3 direction,
  float distance, const Hit& hit, const ShadedHit& shaded, glm::vec3 reflected,
  long long& shadowRays, PenumbraSampling* penumbrae) const
{
  const Light& source = this->Rays.GetScene().Lights[light];
  const SurfaceNormals normals(shaded.Normal, glm::normalize(shaded.GeometricNormal));
  glm::vec3 up = normals.Geometric;
  if (LiftRayStart(*this, point, hit, normals, direction, shadowRays))
  {
    up = normals.Shading;
    source.ComputeStrength(point, direction, distance);
    direction = -direction;
  }
  if (source.HasSize())
  {
    const float brightness = std::max({ reflected.r, reflected.g, reflected.b });
    return this->SampleVisibleFraction(light, point, up, brightness, shadowRays, penumbrae);
  }
  const Ray ray{ point + RayOriginOffset(point) * up, direction, 0.f, distance };
  return glm::dot(direction, up) > 0.f ? this->TraceTransmittance(ray, shadowRays) : 0.f;
}

VisibleFraction Shading::ComputeVisibleFraction(const Light& light, glm::vec3 point,
  glm::vec3 normal, float tolerance, long long& shadowRays, PenumbraNeighbors* neighbors) const
{
  const glm::vec3 up = glm::normalize(normal);
  const AreaLight source(light, point + RayOriginOffset(point) * up);
  if (source.ContainsPoint())
  {
    return { 1.f, 0.f };
  }
  const auto visibility = [&](glm::vec2 disk) {
    const Ray ray = source.MakeRay(disk);
    return glm::dot(ray.Direction, up) > 0.f ? this->TraceTransmittance(ray, shadowRays) : 0.f;
  };
  return EstimateVisibleFraction(visibility, HashPoint(point, up), tolerance, neighbors);
}

// One ray per light suffices where all rays of a neighborhood agree, see CornerGrid.
float Shading::SampleVisibleFraction(std::size_t light, glm::vec3 point, glm::vec3 normal,
  float brightness, long long& shadowRays, PenumbraSampling* penumbrae) const
{
  const Light& source = this->Rays.GetScene().Lights[light];
  const std::uint32_t bit = PenumbraSampling::GetBit(light);
  if (penumbrae && (penumbrae->Estimated & bit) != 0)
  {
    const float tolerance = penumbrae->Tolerance / std::max(brightness, 1e-6f);
    const VisibleFraction fraction = this->ComputeVisibleFraction(source, point, normal, tolerance,
      shadowRays, penumbrae->Neighbors ? penumbrae->Neighbors + light : nullptr);
    penumbrae->SquaredError += brightness * fraction.Error * brightness * fraction.Error;
    return fraction.Value;
  }
  const glm::vec3 up = glm::normalize(normal);
  const std::uint32_t index = penumbrae ? penumbrae->Index : HashPoint(point, up);
  const glm::vec2 at = OwenSobolSequence(static_cast<std::uint32_t>(light)).At(index);
  const AreaLight area(source, point + RayOriginOffset(point) * up);
  const Ray ray = area.MakeRay(SampleUniformDiskConcentric(at.x, at.y));
  const float visible = area.ContainsPoint() ? 1.f
    : glm::dot(ray.Direction, up) > 0.f      ? this->TraceTransmittance(ray, shadowRays)
                                             : 0.f;
  if (penumbrae)
  {
    penumbrae->Lit |= visible > 0.f ? bit : 0u;
    penumbrae->Shadowed |= visible < 1.f ? bit : 0u;
  }
  return visible;
}

float Shading::TraceTransmittance(Ray ray, long long& shadowRays) const
{
  if (!this->Translucent)
  {
    ++shadowRays;
    return this->Rays.Occluded(ray) ? 0.f : 1.f;
  }
  const float offset = RayOriginOffset(ray.Origin);
  float transmittance = 1.f;
  for (int i = 0; i < MaximumLayers && transmittance > OpaqueTransmittance; ++i)
  {
    ++shadowRays;
    const Hit hit = this->Rays.Intersect(ray);
    if (!hit.IsHit())
    {
      return transmittance;
    }
    if (!this->Rays.GetSurfaces()[hit.Surface].IsLineOrPoint)
    {
      transmittance *= 1.f - ComputeOpacity(this->Rays, hit, ray);
    }
    ray = ContinueBehind(ray, hit);
    ray.Near += hit.NextInOrder > 0 ? 0.f : offset;
  }
  return transmittance > OpaqueTransmittance ? transmittance : 0.f;
}

void Shading::TraceTransmittance16(
  const Ray* rays, float* transmittance, long long& shadowRays) const
{
  constexpr int Size = 16;
  const auto isActive = [](const Ray& ray) { return ray.Near <= ray.Far; };
  if (this->Translucent)
  {
    std::transform(rays, rays + Size, transmittance, [&](const Ray& ray) {
      return isActive(ray) ? this->TraceTransmittance(ray, shadowRays) : 0.f;
    });
    return;
  }
  bool occluded[Size];
  this->Rays.Occluded16(rays, occluded);
  shadowRays += std::count_if(rays, rays + Size, isActive);
  std::transform(occluded, occluded + Size, transmittance,
    [](bool isOccluded) { return isOccluded ? 0.f : 1.f; });
}

float Shading::ComputeOpacity(const RayScene& rays, const Hit& hit, const Ray& ray)
{
  const Surface& surface = rays.GetSurfaces()[hit.Surface];
  const std::array<glm::vec3, 3> points = surface.GetPoints(hit.Primitive);
  const glm::vec3 normal = surface.IsRound()
    ? rays.GetNormal(ray, hit)
    : glm::cross(points[1] - points[0], points[2] - points[0]);
  const bool isFront = glm::dot(normal, ray.Direction) < 0.f || !surface.HasBackMaterial;
  const float opacity = isFront ? surface.Front.Opacity : surface.Back.Opacity;
  return std::min(MultiplyOpacity(surface, hit, opacity), 1.f);
}

glm::vec4 Shading::Background(const glm::dvec2& p) const
{
  return SampleBackground(this->Rays.GetScene(), p);
}

}
