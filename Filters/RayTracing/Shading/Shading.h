// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The colour of a hit: VTK's Phong model, mapper colours, textures, hard shadows.
#ifndef penumbra_Shading_h
#define penumbra_Shading_h

#include "Embree/RayScene.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <cstdint>
#include <vector>

namespace penumbra
{

/// What a surface is and shows at a hit.
struct ShadedHit
{
  glm::vec4 Color{ 0.f };           ///< straight rgb (unclamped) and opacity
  glm::vec3 Normal{ 0.f };          ///< shading normal, unit, as VTK's lighting uses it
  glm::vec3 GeometricNormal{ 0.f }; ///< of the triangle, of any length, facing the eye
  glm::vec3 Reflectance{ 0.f };     ///< diffuse; 0 on surfaces without lighting
};

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT Shading
{
public:
  /// `shadows`: lights that cast shadows are asked for occlusion. `scene` must outlive this object.
  Shading(const RayScene& scene, bool shadows);

  /// Colour at a hit of `ray`. Adds the shadow rays it traced to `shadowRays`.
  ShadedHit Shade(const Ray& ray, const Hit& hit, long long& shadowRays) const;

  /// What leaves the hit diffusely: no highlights, and nothing where no light shines.
  ShadedHit ShadeDiffuse(const Ray& ray, const Hit& hit, long long& shadowRays) const;

  /// The share of light that reaches the origin of `ray` from its far end.
  float TraceTransmittance(Ray ray, long long& shadowRays) const;

  const Scene& GetScene() const { return this->Rays.GetScene(); }

  /// The background at picture point p, straight rgb and alpha.
  glm::vec4 Background(glm::dvec2 p) const;

  /// True where colour is one constant over each triangle (flat, directional lights, no
  /// highlight, no texture, no shadow): then one sample of a triangle serves all of it.
  bool IsConstantPerTriangle(std::uint32_t surface) const
  {
    return this->Materials[surface].Constant;
  }

private:
  /// A material with its coefficients multiplied in.
  struct PhongCoefficients
  {
    glm::vec3 Ambient;
    glm::vec3 Diffuse;
    glm::vec3 Specular;
    float SpecularPower;
    float Opacity;
  };
  /// What is known of a surface before any hit.
  struct SurfaceMaterial
  {
    PhongCoefficients Front;
    PhongCoefficients Back;
    float AmbientShare; ///< Material::Ambient, for surfaces that bring their own colours
    float DiffuseShare;
    bool Lit;
    bool Colored;
    bool Constant;
  };

  ShadedHit ShadeAs(bool matte, const Ray& ray, const Hit& hit, long long& shadowRays) const;
  static PhongCoefficients MakeFinish(const Material& material);
  bool IsConstant(const Surface& surface, const SurfaceMaterial& look) const;
  glm::vec3 ApplyLights(const PhongCoefficients& finish, const ShadedHit& at, glm::vec3 point,
    long long& shadowRays) const;
  float Transmittance(glm::vec3 point, glm::vec3 towards, float distance, glm::vec3 normal,
    long long& shadowRays) const;

  /// The share of light that a surface lets pass where `ray` hits it.
  float SurfaceTransmittance(const Hit& hit, const Ray& ray) const;

  const RayScene& Rays;
  bool Shadows;
  bool OneHeadlight;
  bool Translucent = false; ///< some surface lets light through
  std::vector<SurfaceMaterial> Materials;
};

}
#endif
