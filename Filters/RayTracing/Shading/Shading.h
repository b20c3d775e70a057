// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Color of a hit: VTK's Phong model, mapped scalar colors, textures, shadows.
#ifndef penumbra_Shading_h
#define penumbra_Shading_h

#include "AreaLight.h"
#include "Embree/RayScene.h"
#include "Lights/LightAttenuation.h"
#include "Material.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <cstdint>
#include <vector>

namespace penumbra
{

struct Surface;
class PhysicallyBased;

/// Color and surface properties at a hit.
struct ShadedHit
{
  glm::vec4 Color{ 0.f };           ///< non-premultiplied RGB (not clamped) and opacity
  glm::vec3 Normal{ 0.f };          ///< shading normal (unit), as in VTK's lighting
  glm::vec3 GeometricNormal{ 0.f }; ///< triangle normal, not unit, facing the ray origin
  glm::vec3 Reflectance{ 0.f };     ///< diffuse reflectance; 0 on surfaces without lighting
  glm::vec3 Emission{ 0.f };        ///< part of Color that does not depend on lights
};

/// Sampling of lights with a size at one point, and its result.
struct PenumbraSampling
{
  // Input.
  std::uint32_t Estimated = 0; ///< lights whose visible fraction is estimated; others get one ray
  std::uint32_t Index = 0;     ///< index of the sample of this ray
  float Tolerance = 0.f;       ///< accepted standard error of the color
  PenumbraNeighbors* Neighbors = nullptr; ///< of each light, or null

  // Result.
  std::uint32_t Lit = 0;      ///< lights that a ray reached
  std::uint32_t Shadowed = 0; ///< lights that a ray did not reach
  float SquaredError = 0.f;   ///< squared standard error of the color

  /// Returns the bit of a light; the last lights share one.
  static std::uint32_t GetBit(std::size_t light) { return 1u << (light < 31 ? light : 31); }
};

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT Shading
{
public:
  /// `shadows`: if on, shadow rays are traced toward the lights with CastsShadow. `scene` must outlive this object.
  Shading(const RayScene& scene, bool shadows);

  /// Sets the attenuation of the lights that cast shadows; it must outlive this object. Null: none.
  void SetAttenuation(const LightAttenuation* attenuation) { this->Attenuation = attenuation; }

  /// Sets light that Shade() adds to All and Untextured, times the reflectance; not on lines and points. Default: 0.
  void SetUniformLight(glm::vec3 light) { this->UniformLight = light; }
  glm::vec3 GetUniformLight() const { return this->UniformLight; }

  /// Terms of the color that Shade() computes.
  enum class Terms
  {
    All,
    Untextured, ///< without the texture of the actor, which multiplies the color
    Diffuse,    ///< no specular highlights; surfaces without lighting are emitters, not reflectors
    Emission    ///< no lights
  };
  /// Shades a hit of `ray`. Adds the number of shadow rays traced to `shadowRays`. If `penumbrae`
  /// is null, one ray is traced toward each light.
  ShadedHit Shade(const Ray& ray, const Hit& hit, long long& shadowRays,
    PenumbraSampling* penumbrae = nullptr, Terms terms = Terms::All) const;

  /// Shades a hit without lights: Color is Emission. Normals may be left out.
  ShadedHit ShadeEmission(const Ray& ray, const Hit& hit) const;
  /// Returns true if it depends only on the surface of the hit.
  bool HasUniformEmission(std::uint32_t surface) const;

  /// Returns the transmittance of the scene along `ray`: 1 if unoccluded, 0 behind opaque surfaces.
  float TraceTransmittance(Ray ray, long long& shadowRays) const;

  /// Computes the transmittance along 16 rays. Rays with Near > Far are inactive.
  void TraceTransmittance16(const Ray* rays, float* transmittance, long long& shadowRays) const;

  /// Returns the fraction of a light with a size that is visible from a point on a surface with
  /// the geometric normal `normal`, with a standard error of at most `tolerance`.
  VisibleFraction ComputeVisibleFraction(const Light& light, glm::vec3 point, glm::vec3 normal,
    float tolerance, long long& shadowRays, PenumbraNeighbors* neighbors = nullptr) const;

  /// Returns true if a light casts penumbrae.
  bool HasPenumbrae() const { return this->Penumbrae; }

  /// Returns the opacity of the surface that `ray` hits, in [0, 1]: that of its material times the
  /// alpha of its colors and textures.
  static float ComputeOpacity(const RayScene& rays, const Hit& hit, const Ray& ray);

  const RayScene& GetRays() const { return this->Rays; }

  /// Returns the background at image point p, as non-premultiplied RGBA.
  glm::vec4 Background(const glm::dvec2& p) const;

  /// Returns true if the color is constant over each triangle (flat shading, directional lights, no
  /// highlight, no texture, no shadow), so that one sample per triangle suffices.
  bool IsConstantPerTriangle(std::uint32_t surface) const
  {
    return this->Materials[surface].Constant && !this->Attenuation;
  }

private:
  /// Colors of a material multiplied by their coefficients.
  struct PhongCoefficients
  {
    glm::vec3 Ambient;
    glm::vec3 Diffuse;
    glm::vec3 Specular;
    float SpecularPower;
    float Opacity;
    const Material* PbrMaterial; ///< null for Phong materials; Diffuse is the albedo
  };
  /// Shading data of a surface that do not depend on the hit.
  struct SurfaceMaterial
  {
    PhongCoefficients Front;
    PhongCoefficients Back;
    float AmbientCoefficient; ///< Material::Ambient, factor of mapped colors
    float DiffuseCoefficient; ///< Material::Diffuse, factor of mapped colors
    bool Lit;                 ///< lighting is on and there is a light
    bool Colored;             ///< the color is mapped from data
    bool Constant;            ///< see IsConstantPerTriangle()
    bool UniformEmission;     ///< ShadeEmission() depends only on the material
  };

  static PhongCoefficients MakePhongCoefficients(const Material& material);
  bool IsConstant(const Surface& surface, const SurfaceMaterial& material) const;
  glm::vec3 ApplyLights(const PhongCoefficients& phong, const Hit& hit, const ShadedHit& shaded,
    glm::vec3 point, long long& shadowRays, PenumbraSampling* penumbrae) const;
  glm::vec3 ApplyLightsPhysicallyBased(const PhysicallyBased& material, const Hit& hit,
    const ShadedHit& shaded, glm::vec3 point, bool diffuseOnly, long long& shadowRays,
    PenumbraSampling* penumbrae) const;
  glm::vec3 ComputeAttenuation(const Light& light, glm::vec3 point) const;
  glm::vec3 DirectionToCamera(glm::vec3 point) const;
  float SampleVisibleFraction(std::size_t light, glm::vec3 point, glm::vec3 normal,
    float brightness, long long& shadowRays, PenumbraSampling* penumbrae) const;

  /// Returns the fraction of a light at `distance` that arrives. `reflected`: what the surface reflects of all of it.
  float ComputeVisibility(std::size_t light, glm::vec3 point, glm::vec3 direction, float distance,
    const Hit& hit, const ShadedHit& shaded, glm::vec3 reflected, long long& shadowRays,
    PenumbraSampling* penumbrae) const;

  const RayScene& Rays;
  bool Shadows;
  bool Penumbrae = false;
  bool OneHeadlight;
  const LightAttenuation* Attenuation = nullptr;
  glm::vec3 UniformLight{ 0.f };
  bool Translucent = false; ///< at least one surface is translucent
  std::vector<SurfaceMaterial> Materials;
};

}
#endif
