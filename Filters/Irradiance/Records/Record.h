// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One record of the cache [IC]: what was gathered at a point, and how far around it serves.
#ifndef penumbra_Record_h
#define penumbra_Record_h

#include "Gathering/HemisphereEstimate.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

/// A place that asks: scene coordinates.
struct ShadingPoint
{
  glm::vec3 Position{ 0.f };
  glm::vec3 Normal{ 0.f, 0.f, 1.f }; ///< unit
};

struct Record : ShadingPoint
{
  float Radius = 0.f;
  bool IsValid = true; ///< false: things change too fast here; brute force is to answer around it
  float MaximumPlaneDistance =
    0.f; ///< a pixel: how far off the surface through it a place may lie, along the normals
  glm::vec3 Tangent{ 1.f, 0.f, 0.f }; ///< the clearance's sectors begin here
  HemisphereEstimate Gathered;

  /// Weight at `place`, 0 to 1 [Tabellion, Lamorlette, after IC]: 1 - max(perr, nerr), with
  /// perr = |p - p_i| / R_i and nerr = normalFactor * sqrt(1 - n.n_i). 0 also behind a wall, and off
  /// the surface.
  float Weight(const ShadingPoint& place, float normalFactor) const
  {
    const glm::vec3 d = place.Position - this->Position;
    const float square = glm::dot(d, d);
    if (square >= this->Radius * this->Radius)
    {
      return 0.f;
    }
    return std::min(
      1.f - std::sqrt(square) / this->Radius, this->NormalWeight(place, normalFactor));
  }

  /// The part of the weight that has nothing to do with the distance.
  float NormalWeight(const ShadingPoint& place, float normalFactor) const
  {
    const glm::vec3 d = place.Position - this->Position;
    const float turned = std::max(0.f, 1.f - glm::dot(place.Normal, this->Normal));
    const float error = normalFactor * std::sqrt(turned);
    return error >= 1.f || this->IsOffPlane(d, place.Normal) || this->IsBehindWall(d) ? 0.f
                                                                                      : 1.f - error;
  }

private:
  /// On a smooth surface the chord is square to the mean of both normals up to the third order.
  bool IsOffPlane(glm::vec3 d, glm::vec3 normal) const
  {
    return std::abs(glm::dot(d, normal + this->Normal)) > 2.f * this->MaximumPlaneDistance;
  }

  bool IsBehindWall(glm::vec3 d) const
  {
    const float x = glm::dot(d, this->Tangent);
    const float y = glm::dot(d, glm::cross(this->Normal, this->Tangent));
    const float clear = this->Gathered.Clearance[SectorOf(x, y)];
    return x * x + y * y > clear * clear;
  }
};

}
#endif
