// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The formulas are those of VTK's polygon shader, so that pictures of both agree: one headlight
// is lit by the normal's share along the view axis; any other set of lights by Phong's mirrored
// ray; a highlight takes the light's diffuse colour.
#include "Shading.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{
namespace
{

/// Bound on the translucent layers that one shadow ray looks through.
constexpr int MaximumLayers = 64;

template <typename T>
T Interpolate(const std::vector<T>& values, glm::uvec3 corners, glm::vec3 weights)
{
  return weights.x * values[corners.x] + weights.y * values[corners.y] +
    weights.z * values[corners.z];
}

glm::vec4 Unpack(glm::u8vec4 color)
{
  return glm::vec4(color) * (1.f / 255.f);
}

int Wrap(int i, int size, bool repeat)
{
  if (repeat)
  {
    i %= size;
    return i < 0 ? i + size : i;
  }
  return std::clamp(i, 0, size - 1);
}

glm::vec4 Sample(const Texture& texture, glm::vec2 at)
{
  const auto texel = [&](int i, int j) {
    i = Wrap(i, texture.Width, texture.Repeat);
    j = Wrap(j, texture.Height, texture.Repeat);
    return Unpack(texture.Texels[static_cast<std::size_t>(j) * texture.Width + i]);
  };
  if (!std::isfinite(at.x) || !std::isfinite(at.y))
  {
    return texel(0, 0);
  }
  const float limit = 1e6f;
  const float x = glm::clamp(at.x, -limit, limit) * texture.Width;
  const float y = glm::clamp(at.y, -limit, limit) * texture.Height;
  if (!texture.Interpolate)
  {
    return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
  }
  const float left = std::floor(x - .5f);
  const float bottom = std::floor(y - .5f);
  const int i = static_cast<int>(left);
  const int j = static_cast<int>(bottom);
  const float s = x - .5f - left;
  const float t = y - .5f - bottom;
  return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), s),
    glm::mix(texel(i, j + 1), texel(i + 1, j + 1), s), t);
}

/// The colour that a surface brings for itself at a hit.
glm::vec4 MappedColor(const Surface& surface, const Hit& hit, glm::uvec3 corners, glm::vec3 weights)
{
  if (!surface.PointColors.empty())
  {
    return weights.x * Unpack(surface.PointColors[corners.x]) +
      weights.y * Unpack(surface.PointColors[corners.y]) +
      weights.z * Unpack(surface.PointColors[corners.z]);
  }
  if (!surface.CellColors.empty())
  {
    return Unpack(surface.CellColors[hit.Triangle]);
  }
  return Sample(*surface.ColorTexture, Interpolate(surface.ColorCoordinates, corners, weights));
}

bool HasOwnColor(const Surface& surface)
{
  return !surface.PointColors.empty() || !surface.CellColors.empty() || surface.ColorTexture;
}

/// The normal that lighting sees.
glm::vec3 LightingNormal(const Surface& surface, const Hit& hit, glm::uvec3 corners,
  glm::vec3 weights, bool front, glm::vec3 geometricNormal, glm::vec3 forward)
{
  glm::vec3 normal(0.f);
  if (!surface.Normals.empty())
  {
    normal = Interpolate(surface.Normals, corners, weights);
  }
  else if (!surface.TriangleNormals.empty())
  {
    normal = surface.TriangleNormals[hit.Triangle];
  }
  const float square = glm::dot(normal, normal);
  if (!(square > 0.f && square <= std::numeric_limits<float>::max()))
  {
    return glm::normalize(geometricNormal);
  }
  normal *= 1.f / std::sqrt(square);
  switch (surface.NormalRule)
  {
    case Surface::NormalRules::ByWinding:
      return front ? normal : -normal;
    case Surface::NormalRules::TowardsEye:
      return glm::dot(normal, forward) > 0.f ? -normal : normal;
    case Surface::NormalRules::AsTheyAre:
      break;
  }
  return normal;
}

}

Shading::Shading(const RayScene& scene, bool shadows)
  : Rays(scene),
    Shadows(shadows)
{
  const std::vector<Light>& lights = scene.GetScene().Lights;
  this->OneHeadlight = lights.size() == 1 && lights[0].Headlight;
  this->Shadows = shadows &&
    std::any_of(lights.begin(), lights.end(), [](const Light& light) { return light.CastsShadow; });
  for (const Surface& surface : scene.GetScene().Surfaces)
  {
    SurfaceMaterial look;
    look.Front = MakeFinish(surface.Front);
    look.Back = surface.HasBackMaterial ? MakeFinish(surface.Back) : look.Front;
    look.AmbientShare = surface.Front.Ambient;
    look.DiffuseShare = surface.Front.Diffuse;
    look.Lit = surface.Front.Lighting && !lights.empty();
    look.Colored = HasOwnColor(surface);
    look.Constant = this->IsConstant(surface, look);
    this->Materials.push_back(look);
    this->Translucent |= surface.IsTranslucent();
  }
}

Shading::PhongCoefficients Shading::MakeFinish(const Material& material)
{
  return { material.Ambient * material.AmbientColor, material.Diffuse * material.DiffuseColor,
    material.Specular * material.SpecularColor, material.SpecularPower, material.Opacity };
}

bool Shading::IsConstant(const Surface& surface, const SurfaceMaterial& look) const
{
  if (!surface.PointColors.empty() || surface.ColorTexture || surface.LitTexture)
  {
    return false;
  }
  if (!look.Lit)
  {
    return true;
  }
  const bool highlight =
    look.Front.Specular != glm::vec3(0.f) || look.Back.Specular != glm::vec3(0.f);
  const std::vector<Light>& lights = this->Rays.GetScene().Lights;
  return surface.Normals.empty() && !this->Shadows && (this->OneHeadlight || !highlight) &&
    std::all_of(lights.begin(), lights.end(),
      [](const Light& light) { return light.Kind == Light::Kinds::Directional; });
}

ShadedHit Shading::Shade(const Ray& ray, const Hit& hit, long long& shadowRays) const
{
  return this->ShadeAs(false, ray, hit, shadowRays);
}

ShadedHit Shading::ShadeDiffuse(const Ray& ray, const Hit& hit, long long& shadowRays) const
{
  return this->ShadeAs(true, ray, hit, shadowRays);
}

ShadedHit Shading::ShadeAs(bool matte, const Ray& ray, const Hit& hit, long long& shadowRays) const
{
  const Scene& scene = this->Rays.GetScene();
  const Surface& surface = scene.Surfaces[hit.Surface];
  const SurfaceMaterial& look = this->Materials[hit.Surface];
  const glm::uvec3 corners = surface.Triangles[hit.Triangle];
  const glm::vec3 a = surface.Positions[corners.x];
  const glm::vec3 b = surface.Positions[corners.y];
  const glm::vec3 c = surface.Positions[corners.z];
  const glm::vec3 weights(1.f - hit.U - hit.V, hit.U, hit.V);

  ShadedHit at;
  at.GeometricNormal = surface.NormalOf(hit.Triangle);
  const bool front = glm::dot(at.GeometricNormal, ray.Direction) < 0.f;
  if (!front)
  {
    at.GeometricNormal = -at.GeometricNormal;
  }
  const glm::vec3 forward(scene.ViewCamera.Forward);
  at.Normal = LightingNormal(surface, hit, corners, weights, front, at.GeometricNormal, forward);

  const PhongCoefficients* known = front ? &look.Front : &look.Back;
  PhongCoefficients colored = *known;
  if (look.Colored)
  {
    const glm::vec4 own = MappedColor(surface, hit, corners, weights);
    colored.Ambient = look.AmbientShare * glm::vec3(own);
    colored.Diffuse = look.DiffuseShare * glm::vec3(own);
    colored.Opacity *= own.a;
    known = &colored;
  }
  if (matte)
  {
    colored.Specular = glm::vec3(0.f);
    known = &colored;
  }
  const PhongCoefficients& finish = *known;
  at.Reflectance = surface.Front.Lighting ? finish.Diffuse : glm::vec3(0.f);

  glm::vec3 rgb;
  if (!look.Lit)
  {
    rgb =
      matte ? finish.Ambient + finish.Diffuse - at.Reflectance : finish.Ambient + finish.Diffuse;
  }
  else if (this->OneHeadlight)
  {
    const float share = std::max(1e-6f, -glm::dot(at.Normal, forward));
    rgb = share * finish.Diffuse;
    if (finish.Specular != glm::vec3(0.f))
    {
      rgb += std::pow(share, finish.SpecularPower) * finish.Specular;
    }
    rgb = finish.Ambient + rgb * scene.Lights[0].DiffuseColor;
  }
  else
  {
    const glm::vec3 point = weights.x * a + weights.y * b + weights.z * c;
    rgb = this->ApplyLights(finish, at, point, shadowRays);
  }
  at.Color = glm::vec4(rgb, finish.Opacity);
  if (surface.LitTexture && (front || surface.TextureOnBackfaces))
  {
    const glm::vec4 texel =
      Sample(*surface.LitTexture, Interpolate(surface.TextureCoordinates, corners, weights));
    at.Color *= texel;
    at.Reflectance *= glm::vec3(texel);
  }
  return at;
}

glm::vec3 Shading::ApplyLights(const PhongCoefficients& finish, const ShadedHit& at,
  glm::vec3 point, long long& shadowRays) const
{
  const Scene& scene = this->Rays.GetScene();
  const double moved = scene.ViewCamera.Advance - scene.ViewCamera.DepthOfRayOrigins();
  const glm::vec3 eye(scene.ViewCamera.Position - moved * scene.ViewCamera.Forward);
  const glm::vec3 towardsEye = glm::normalize(eye - point);
  glm::vec3 diffuse(0.f);
  glm::vec3 specular(0.f);
  for (const Light& light : scene.Lights)
  {
    glm::vec3 direction = light.Direction;
    float distance = std::numeric_limits<float>::infinity();
    float strength = 1.f;
    if (light.Kind != Light::Kinds::Directional)
    {
      direction = point - light.Position;
      distance = glm::length(direction);
      direction /= distance;
      strength = 1.f /
        (light.Attenuation.x + distance * (light.Attenuation.y + distance * light.Attenuation.z));
      if (light.Kind == Light::Kinds::Spot)
      {
        const float cosine = glm::dot(direction, light.Direction);
        strength = cosine >= light.ConeCosine ? strength * std::pow(cosine, light.Exponent) : 0.f;
      }
    }
    const float share = strength * -glm::dot(at.Normal, direction);
    if (!(share > 0.f))
    {
      continue;
    }
    if (this->Shadows && light.CastsShadow)
    {
      strength *= this->Transmittance(point, -direction, distance, at.GeometricNormal, shadowRays);
    }
    diffuse += strength * -glm::dot(at.Normal, direction) * light.DiffuseColor;
    if (finish.Specular != glm::vec3(0.f))
    {
      const float mirrored = glm::dot(glm::reflect(direction, at.Normal), towardsEye);
      specular +=
        strength * std::pow(std::max(1e-5f, mirrored), finish.SpecularPower) * light.SpecularColor;
    }
  }
  return finish.Ambient + diffuse * finish.Diffuse + specular * finish.Specular;
}

float Shading::Transmittance(
  glm::vec3 point, glm::vec3 towards, float distance, glm::vec3 normal, long long& shadowRays) const
{
  if (glm::dot(towards, normal) <= 0.f)
  {
    return 0.f; // the light is behind the triangle itself
  }
  // Rounding of positions and of the hit: some units in the last place of the largest coordinate.
  const glm::vec3 size = glm::abs(point);
  const float gap = 1e-5f * std::max(size.x, std::max(size.y, size.z));
  return this->TraceTransmittance(
    Ray{ point + gap * glm::normalize(normal), towards, 0.f, distance }, shadowRays);
}

float Shading::TraceTransmittance(Ray ray, long long& shadowRays) const
{
  if (!this->Translucent)
  {
    ++shadowRays;
    return this->Rays.Occluded(ray) ? 0.f : 1.f;
  }
  const glm::vec3 size = glm::abs(ray.Origin);
  const float gap = 1e-5f * std::max(size.x, std::max(size.y, size.z));
  float left = 1.f;
  for (int i = 0; i < MaximumLayers && left > 0.f; ++i)
  {
    ++shadowRays;
    const Hit hit = this->Rays.Intersect(ray);
    if (!hit.IsHit())
    {
      return left;
    }
    left *= this->SurfaceTransmittance(hit, ray);
    ray.Near = hit.NextNear + gap;
  }
  return left;
}

float Shading::SurfaceTransmittance(const Hit& hit, const Ray& ray) const
{
  const Surface& surface = this->Rays.GetScene().Surfaces[hit.Surface];
  if (surface.IsLineOrPoint)
  {
    return 1.f;
  }
  const SurfaceMaterial& look = this->Materials[hit.Surface];
  const glm::uvec3 corners = surface.Triangles[hit.Triangle];
  const glm::vec3 weights(1.f - hit.U - hit.V, hit.U, hit.V);
  const glm::vec3 a = surface.Positions[corners.x];
  const glm::vec3 normal =
    glm::cross(surface.Positions[corners.y] - a, surface.Positions[corners.z] - a);
  float opacity = glm::dot(normal, ray.Direction) < 0.f ? look.Front.Opacity : look.Back.Opacity;
  if (look.Colored)
  {
    opacity *= MappedColor(surface, hit, corners, weights).a;
  }
  if (surface.LitTexture)
  {
    opacity *=
      Sample(*surface.LitTexture, Interpolate(surface.TextureCoordinates, corners, weights)).a;
  }
  return 1.f - std::min(opacity, 1.f);
}

glm::vec4 Shading::Background(glm::dvec2 p) const
{
  const Scene& scene = this->Rays.GetScene();
  const auto height = static_cast<float>(p.y / scene.ViewCamera.Height);
  return glm::mix(scene.BackgroundColors.Bottom, scene.BackgroundColors.Top, height);
}

}
