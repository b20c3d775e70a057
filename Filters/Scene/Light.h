// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light source.
#ifndef penumbra_Light_h
#define penumbra_Light_h

#include <glm/glm.hpp>

#include <cmath>
#include <limits>

namespace penumbra
{

/// Light source, as in vtkLight.
struct Light
{
  enum class Kinds
  {
    Directional,
    Positional,
    Spot
  };
  Kinds Kind = Kinds::Directional;
  glm::vec3 Position{ 0.f };             ///< Positional, Spot
  glm::vec3 Direction{ 0.f, 0.f, -1.f }; ///< unit vector in which the light travels
  glm::vec3 DiffuseColor{ 1.f };         ///< multiplied by the intensity
  glm::vec3 SpecularColor{ 1.f };        ///< multiplied by the intensity
  /// Constant, linear and quadratic coefficients of the attenuation, in scene units.
  glm::vec3 Attenuation{ 1.f, 0.f, 0.f };
  float ConeCosine = -1.f;   ///< Spot: cosine of vtkLight's cone angle
  float Exponent = 1.f;      ///< Spot: exponent of vtkLight
  float Radius = 0.f;        ///< Positional: of the sphere; Spot: of the disk across Direction
  float AngularRadius = 0.f; ///< Directional: half the angular diameter, in radians
  bool CastsShadow = true;
  bool MovesWithCamera = false; ///< a camera light of vtkLight
  /// If true, the light is directional and along the view axis. VTK uses a simpler lighting model
  /// if this is the only light.
  bool Headlight = false;

  /// Returns true if the light is not a point or a direction.
  bool HasSize() const
  {
    return (this->Kind == Kinds::Directional ? this->AngularRadius : this->Radius) > 0.f;
  }
  bool CastsPenumbra() const { return this->CastsShadow && this->HasSize(); }

  /// Returns the fraction of its color that arrives at a point without occlusion. `direction` receives the unit vector
  /// from the light, `distance` its distance.
  float ComputeStrength(glm::vec3 point, glm::vec3& direction, float& distance) const;
};

inline float Light::ComputeStrength(glm::vec3 point, glm::vec3& direction, float& distance) const
{
  direction = this->Direction;
  distance = std::numeric_limits<float>::infinity();
  if (this->Kind == Kinds::Directional)
  {
    return 1.f;
  }
  direction = point - this->Position;
  distance = glm::length(direction);
  direction /= distance;
  const glm::vec3 factors = this->Attenuation;
  const float strength = 1.f / (factors.x + distance * (factors.y + distance * factors.z));
  if (this->Kind != Kinds::Spot)
  {
    return strength;
  }
  const float cosine = glm::dot(direction, this->Direction);
  return cosine >= this->ConeCosine ? strength * std::pow(cosine, this->Exponent) : 0.f;
}

}
#endif
