// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PhysicallyBased.h"

#include "Environment/EnvironmentLight.h"
#include "Surface.h"
#include "SurfaceColor.h"

#include "vtkVersionMacros.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

constexpr float Pi = 3.14159265f;

float ClampCosine(float cosine)
{
  return glm::clamp(cosine, 1e-5f, 1.f);
}

/// GGX distribution of microfacet normals.
float ComputeDistribution(float nh, float roughness)
{
  const float alpha = roughness * roughness;
  const float squared = alpha * alpha;
  const float d = (nh * squared - nh) * nh + 1.f;
  return squared / std::max(Pi * d * d, 1e-8f);
}

/// Correlated Smith visibility. VTK uses the second power of the roughness here, not the fourth.
float ComputeVisibility(float nv, float nl, float roughness)
{
  const float alpha = roughness * roughness;
  return 0.5f /
    (nl * std::sqrt(alpha + nv * (nv - alpha * nv)) +
      nv * std::sqrt(alpha + nl * (nl - alpha * nl)));
}

/// Schlick's approximation.
glm::vec3 ComputeFresnel(glm::vec3 atNormal, glm::vec3 atGrazing, float cosine)
{
  return atNormal + (atGrazing - atNormal) * std::pow(1.f - cosine, 5.f);
}

/// Returns a unit normal from a texture of normals in the frame `axes`.
glm::vec3 SampleNormal(
  const Texture& texture, glm::vec2 coordinates, float scale, const glm::mat3& axes)
{
  const glm::vec3 texel = glm::vec3(SampleTexture(texture, coordinates)) * 2.f - 1.f;
  return glm::normalize(axes * glm::normalize(texel * glm::vec3(scale, scale, 1.f)));
}

/// Rotates `tangent` around the unit vector `normal` by a fraction of a full turn.
glm::vec3 RotateTangent(glm::vec3 tangent, glm::vec3 normal, float turns)
{
  const float angle = 2.f * Pi * turns;
  const float cosine = std::cos(angle);
  return (1.f - cosine) * glm::dot(tangent, normal) * normal + cosine * tangent +
    std::sin(angle) * glm::cross(normal, tangent);
}

}

PhysicallyBased::PhysicallyBased(const Surface& surface, const Material& material, const Hit& hit,
  glm::vec3 weights, glm::vec3 albedo, glm::vec3 normal, glm::vec3 view)
  : Albedo(albedo),
    Normal(normal),
    View(view),
    Metallic(material.Metallic),
    Roughness(material.Roughness),
    CoatStrength(material.CoatStrength),
    CoatRoughness(material.CoatRoughness),
    CoatReflectance(material.CoatReflectance),
    CoatFilter(glm::mix(glm::vec3(1.f), material.CoatColor, material.CoatStrength)),
    CoatNormal(normal)
{
  const glm::uvec3 corners = surface.GetCorners(hit.Primitive);
  const MaterialTextures* textures = surface.DetailTextures.get();
  const glm::vec2 coordinates =
    textures ? Interpolate(surface.TextureCoordinates, corners, weights) : glm::vec2(0.f);
  if (textures && textures->OcclusionRoughnessMetallic)
  {
    const glm::vec4 texel = SampleTexture(*textures->OcclusionRoughnessMetallic, coordinates);
    this->Occlusion = glm::mix(1.f, texel.r, material.OcclusionStrength);
    this->Roughness *= texel.g;
    this->Metallic *= texel.b;
  }
  if (textures && textures->Emission)
  {
    this->Emission =
      material.EmissiveFactor * glm::vec3(SampleTexture(*textures->Emission, coordinates));
  }
  if (!surface.Tangents.empty())
  {
    this->SetFrame(surface, material, hit, weights, coordinates);
  }
  this->NormalReflectance =
    glm::mix(glm::vec3(material.BaseReflectance), this->Albedo, this->Metallic);
  const float grazing =
    glm::clamp(glm::dot(this->NormalReflectance, glm::vec3(50.f * .33f)), 0.f, 1.f);
  this->GrazingReflectance = glm::mix(glm::vec3(grazing), material.EdgeTint, this->Metallic);
}

// Sets what depends on the tangent: the axes of anisotropy and the normals of textures.
void PhysicallyBased::SetFrame(const Surface& surface, const Material& material, const Hit& hit,
  glm::vec3 weights, glm::vec2 coordinates)
{
  const MaterialTextures* textures = surface.DetailTextures.get();
  const glm::vec3 normal = this->Normal;
  const std::array<glm::vec3, 3> tangents = surface.GetNormals(hit.Primitive, surface.Tangents);
  glm::vec3 tangent = weights.x * tangents[0] + weights.y * tangents[1] + weights.z * tangents[2];
  float anisotropy = material.Anisotropy;
  if (anisotropy != 0.f)
  {
    float rotation = material.AnisotropyRotation;
    if (textures && textures->Anisotropy)
    {
      const glm::vec4 texel = SampleTexture(*textures->Anisotropy, coordinates);
      anisotropy *= texel.r;
      rotation *= texel.g;
    }
    tangent = RotateTangent(tangent, normal, rotation);
  }
  tangent -= glm::dot(tangent, normal) * normal;
  const float length = glm::length(tangent);
  if (!(length > 0.f) || !std::isfinite(length))
  {
    return;
  }
  this->Tangent = tangent / length;
  this->Bitangent = glm::cross(normal, this->Tangent);
  if (material.Anisotropy != 0.f)
  {
    this->Anisotropic = true;
    this->Anisotropy = anisotropy;
    const float alpha = this->Roughness * this->Roughness;
    const float aspect = std::sqrt(1.f - .9f * anisotropy);
    this->TangentRoughness = std::max(alpha / aspect, .001f);
    this->BitangentRoughness = std::max(alpha * aspect, .001f);
  }
  const glm::mat3 axes(this->Tangent, this->Bitangent, normal);
  if (textures && textures->Normal)
  {
    this->Normal = SampleNormal(*textures->Normal, coordinates, material.NormalScale, axes);
  }
  if (textures && textures->CoatNormal)
  {
    this->CoatNormal =
      SampleNormal(*textures->CoatNormal, coordinates, material.CoatNormalScale, axes);
  }
}

glm::vec3 PhysicallyBased::ComputeSpecular(
  glm::vec3 light, glm::vec3 half, float nl, float nh, glm::vec3 fresnel) const
{
  const float nv = ClampCosine(glm::dot(this->Normal, this->View));
  if (!this->Anisotropic)
  {
    return ComputeDistribution(nh, this->Roughness) * ComputeVisibility(nv, nl, this->Roughness) *
      fresnel;
  }
  const float at = this->TangentRoughness;
  const float ab = this->BitangentRoughness;
  const float area = at * ab;
  const glm::vec3 d(
    ab * glm::dot(this->Tangent, half), at * glm::dot(this->Bitangent, half), area * nh);
  const float ratio = area / glm::dot(d, d);
  const float distribution = area * ratio * ratio / Pi;
  const auto stretch = [&](glm::vec3 direction, float cosine) {
    return glm::length(glm::vec3(
      at * glm::dot(this->Tangent, direction), ab * glm::dot(this->Bitangent, direction), cosine));
  };
  const float visibility = .5f / (nl * stretch(this->View, nv) + nv * stretch(light, nl));
  return distribution * visibility * fresnel;
}

glm::vec3 PhysicallyBased::Reflect(glm::vec3 towardLight, bool diffuseOnly) const
{
  const glm::vec3 half = glm::normalize(this->View + towardLight);
  const float nl = ClampCosine(glm::dot(this->Normal, towardLight));
  const float nh = ClampCosine(glm::dot(this->Normal, half));
  const float hl = ClampCosine(glm::dot(half, towardLight));
  const glm::vec3 fresnel = ComputeFresnel(this->NormalReflectance, this->GrazingReflectance, hl);
  glm::vec3 diffuse = (1.f - this->Metallic) / Pi * (glm::vec3(1.f) - fresnel) * this->Albedo;
  glm::vec3 specular =
    diffuseOnly ? glm::vec3(0.f) : this->ComputeSpecular(towardLight, half, nl, nh, fresnel);
  if (!(this->CoatStrength > 0.f))
  {
    return nl * (diffuse + specular);
  }
  const float coatNl = ClampCosine(glm::dot(this->CoatNormal, towardLight));
  const float coatNh = ClampCosine(glm::dot(this->CoatNormal, half));
  const float coatNv = ClampCosine(glm::dot(this->CoatNormal, this->View));
  const float coatFresnel = ComputeFresnel(glm::vec3(this->CoatReflectance), glm::vec3(1.f), hl).x;
  const float reflected = coatFresnel * this->CoatStrength;
  diffuse *= 1.f - reflected;
  specular *= (1.f - reflected) * (1.f - reflected);
  const float coat = diffuseOnly
    ? 0.f
    : coatNl * this->CoatStrength * coatFresnel * ComputeDistribution(coatNh, this->CoatRoughness) *
      ComputeVisibility(coatNv, coatNl, this->CoatRoughness);
  return glm::vec3(coat) + nl * this->CoatFilter * (diffuse + specular);
}

// Split sum with multiple scattering by Fdez-Aguera, A Multiple-Scattering Microfacet Model for
// Real-Time Image Based Lighting, 2019.
glm::vec3 PhysicallyBased::ReflectEnvironment(const EnvironmentLight& environment) const
{
  glm::vec3 normal = this->Normal;
  if (this->Anisotropic)
  {
    const glm::vec3 across = glm::cross(this->Bitangent, this->View);
    normal =
      glm::normalize(glm::mix(normal, glm::cross(across, this->Bitangent), this->Anisotropy));
  }
  const auto reflect = [&](glm::vec3 about, float roughness) {
    return environment.ComputeReflection(glm::reflect(-this->View, about), roughness);
  };
  const float cosine = ClampCosine(glm::dot(this->Normal, this->View));
  const glm::vec2 factors = environment.ComputeReflectance(cosine, this->Roughness);
  const glm::vec3 once =
    ComputeFresnel(this->NormalReflectance,
      glm::max(glm::vec3(1.f - this->Roughness), this->NormalReflectance), cosine) *
      factors.x +
    this->GrazingReflectance * factors.y;
  const float lost = 1.f - factors.x - factors.y;
  const glm::vec3 mean =
    this->NormalReflectance + (glm::vec3(1.f) - this->NormalReflectance) / 21.f;
  const glm::vec3 again = lost * once * mean / glm::max(1.f - mean * lost, glm::vec3(1e-5f));
  const glm::vec3 body = (1.f - this->Metallic) * (1.f - .04f) * this->Albedo;
  const glm::vec3 radiance = once * reflect(normal, this->Roughness) +
    (again + body * (glm::vec3(1.f) - once - again)) * environment.ComputeIrradiance(this->Normal);
  if (!(this->CoatStrength > 0.f))
  {
    return radiance;
  }
  const float coatCosine = ClampCosine(glm::dot(this->CoatNormal, this->View));
  const glm::vec2 coatFactors = environment.ComputeReflectance(coatCosine, this->CoatRoughness);
  const float fresnel = this->CoatStrength *
    ComputeFresnel(glm::vec3(this->CoatReflectance), glm::vec3(1.f), coatCosine).x;
  return this->CoatFilter * radiance +
    fresnel * (this->CoatReflectance * coatFactors.x + coatFactors.y) *
    reflect(this->CoatNormal, this->CoatRoughness);
}

glm::vec3 PhysicallyBased::ToDisplayColor(glm::vec3 radiance) const
{
  return EncodeColor(this->Occlusion * radiance + this->Emission);
}

glm::vec3 PhysicallyBased::EncodeColor(glm::vec3 linear)
{
  return glm::pow(glm::max(linear, glm::vec3(0.f)), glm::vec3(1.f / 2.2f));
}

glm::vec3 PhysicallyBased::DecodeMappedColor(glm::vec3 color)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  return glm::pow(glm::max(color, glm::vec3(0.f)), glm::vec3(2.2f));
#else
  return color; // linear in VTK's rasterizer, too
#endif
}

}
