// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Physically based material at one hit, with the formulas of VTK's shader for VTK_PBR: Lambert's
// diffuse term, a GGX lobe that may be anisotropic, and an isotropic clear coat on top.
#ifndef penumbra_PhysicallyBased_h
#define penumbra_PhysicallyBased_h

#include "Embree/RayScene.h"
#include "Material.h"

namespace penumbra
{

class EnvironmentLight;
struct Surface;

class PhysicallyBased
{
public:
  /// @param material Material of the side of the surface that is seen.
  /// @param albedo   Linear base color at the hit.
  /// @param normal   Shading normal (unit), before normal textures are applied.
  /// @param view     Unit vector toward the camera.
  PhysicallyBased(const Surface& surface, const Material& material, const Hit& hit,
    glm::vec3 weights, glm::vec3 albedo, glm::vec3 normal, glm::vec3 view);

  /// Returns the reflected radiance of a light of radiance 1 from the unit vector `towardLight`,
  /// including the cosine.
  /// @param diffuseOnly Leaves out specular reflections.
  glm::vec3 Reflect(glm::vec3 towardLight, bool diffuseOnly) const;

  /// Returns the reflected radiance of an environment that nothing occludes.
  glm::vec3 ReflectEnvironment(const EnvironmentLight& environment) const;

  /// Returns the display color of the radiance that all lights reflect.
  glm::vec3 ToDisplayColor(glm::vec3 radiance) const;

  /// Returns the color that VTK 9.7 displays for a linear one.
  static glm::vec3 EncodeColor(glm::vec3 linear);

  /// Returns the linear color of mapped scalars or colors of vertices, which VTK 9.7 treats as
  /// display colors.
  static glm::vec3 DecodeMappedColor(glm::vec3 color);

  /// Returns the normal after the normal texture was applied.
  glm::vec3 GetNormal() const { return this->Normal; }
  float GetMetallic() const { return this->Metallic; }

private:
  glm::vec3 ComputeSpecular(
    glm::vec3 light, glm::vec3 half, float nl, float nh, glm::vec3 fresnel) const;
  void SetFrame(const Surface& surface, const Material& material, const Hit& hit, glm::vec3 weights,
    glm::vec2 coordinates);

  glm::vec3 Albedo;
  glm::vec3 Normal;
  glm::vec3 View;
  float Metallic;
  float Roughness;
  float Occlusion = 1.f;
  glm::vec3 Emission{ 0.f };
  glm::vec3 NormalReflectance;  ///< Fresnel term at normal incidence
  glm::vec3 GrazingReflectance; ///< Fresnel term at grazing incidence

  bool Anisotropic = false;
  float Anisotropy = 0.f;
  glm::vec3 Tangent{ 0.f };
  glm::vec3 Bitangent{ 0.f };
  float TangentRoughness = 0.f;
  float BitangentRoughness = 0.f;

  float CoatStrength;
  float CoatRoughness;
  float CoatReflectance;
  glm::vec3 CoatFilter; ///< color of light that passes the coat
  glm::vec3 CoatNormal;
};

}
#endif
