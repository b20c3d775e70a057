// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Record of the cache [IC]: the hemisphere estimate at a point and the radius in which it is used.
#ifndef penumbra_Record_h
#define penumbra_Record_h

#include "Gathering/HemisphereEstimate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace penumbra
{

/// Point of a surface, in scene coordinates.
struct ShadingPoint
{
  glm::vec3 Position{ 0.f };
  glm::vec3 Normal{ 0.f, 0.f, 1.f }; ///< unit, axis of the hemisphere
  glm::vec3 GeometricNormal{ 0.f };  ///< unit, of the polygon; 0 if it equals Normal

  /// Connected surface that the point belongs to. Records are not used on other surfaces, such as
  /// a parallel one. Points of images belong to 0.
  std::uint32_t Patch = 0;

  /// Maximum distance of a record and a point from their common tangent plane, along the normals:
  /// the size of a pixel at each, of which the smaller one applies.
  float MaximumPlaneDistance = std::numeric_limits<float>::infinity();

  SurfaceNormals GetNormals() const
  {
    return this->GeometricNormal == glm::vec3(0.f)
      ? SurfaceNormals(this->Normal)
      : SurfaceNormals(this->Normal, this->GeometricNormal);
  }

  /// Returns true if `other` is not on the surface of this point but on another patch or, for
  /// example, on a parallel fold. On a smooth surface, a chord is perpendicular to the mean of both
  /// normals up to third order.
  bool IsOffPlane(const ShadingPoint& other) const
  {
    return this->Patch != other.Patch ||
      std::abs(glm::dot(other.Position - this->Position, other.Normal + this->Normal)) >
      2.f * std::min(this->MaximumPlaneDistance, other.MaximumPlaneDistance);
  }
};

struct Record : ShadingPoint
{
  float Radius = 0.f;

  /// False if the mean changes too fast around this record for interpolation: brute force is used
  /// instead.
  bool IsValid = true;

  glm::vec3 Tangent{ 1.f, 0.f, 0.f }; ///< start of the first sector of Clearance
  HemisphereEstimate Gathered;

  /// Returns the weight at `point`, in [0, 1] [Tabellion, Lamorlette, after IC]: 1 - max(perr,
  /// nerr), with perr = |p - p_i| / R_i and nerr = normalFactor * sqrt(1 - n.n_i). It is 0 behind
  /// walls and away from the tangent plane.
  float Weight(const ShadingPoint& point, float normalFactor) const
  {
    const glm::vec3 d = point.Position - this->Position;
    const float square = glm::dot(d, d);
    if (square >= this->Radius * this->Radius)
    {
      return 0.f;
    }
    return std::min(
      1.f - std::sqrt(square) / this->Radius, this->NormalWeight(point, normalFactor));
  }

  /// Returns the weight without its distance term.
  float NormalWeight(const ShadingPoint& point, float normalFactor) const
  {
    const glm::vec3 d = point.Position - this->Position;
    const float normalDistance = std::max(0.f, 1.f - glm::dot(point.Normal, this->Normal));
    const float error = normalFactor * std::sqrt(normalDistance);
    return error >= 1.f || this->IsOffPlane(point) || this->IsBehindWall(d) ? 0.f : 1.f - error;
  }

private:
  bool IsBehindWall(glm::vec3 d) const
  {
    const float x = glm::dot(d, this->Tangent);
    const float y = glm::dot(d, glm::cross(this->Normal, this->Tangent));
    const float clearance = this->Gathered.Clearance[SectorOf(x, y)];
    return x * x + y * y > clearance * clearance;
  }
};

}
#endif
