// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The colour of a hit: VTK's Phong model, mapper colours, textures, hard shadows.
#ifndef penumbra_Shading_h
#define penumbra_Shading_h

#include "RayScene.h"

namespace penumbra
{

/// What a surface is and shows at a hit.
struct Appearance
{
  glm::vec4 Color{ 0.f };  ///< straight rgb (unclamped) and opacity
  glm::vec3 Normal{ 0.f }; ///< shading normal, unit, as VTK's lighting uses it (facing the eye)
  glm::vec3 GeometricNormal{ 0.f }; ///< of the triangle, unit, facing the eye
};

class Shading
{
public:
  /// `shadows`: lights that cast shadows are asked for occlusion. `scene` must outlive this object.
  Shading(const RayScene& scene, bool shadows);

  /// Colour at a hit of `ray`. Adds the shadow rays it traced to `shadowRays`.
  Appearance Shade(const Ray& ray, const Hit& hit, long long& shadowRays) const;

  /// The background at picture point p, straight rgb and alpha.
  glm::vec4 Background(glm::dvec2 p) const;

  /// True where colour is one constant over each triangle (flat, directional lights, no
  /// highlight, no texture, no shadow): then one sample of a triangle serves all of it.
  bool IsConstantPerTriangle(std::uint32_t surface) const { return this->ConstantPerTriangle[surface]; }

private:
  const RayScene& Rays;
  bool Shadows;
  std::vector<bool> ConstantPerTriangle;
};

}
#endif
