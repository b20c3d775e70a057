// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Opacities of the edges of translucent surfaces and of the surfaces directly behind them, along a ray.
#ifndef penumbra_EdgeBlending_h
#define penumbra_EdgeBlending_h

#include "Camera.h"
#include "Embree/RayScene.h"
#include "Shading/Shading.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

/// State of one ray. Hits are passed front to back.
class EdgeBlending
{
public:
  explicit EdgeBlending(const Camera& camera)
    : PixelSize(static_cast<float>(camera.PixelSize)),
      Origin(static_cast<float>(camera.DepthOfRayOrigins())),
      IsParallel(camera.Parallel)
  {
  }

  /// Returns the opacity of a hit. An edge and what it belongs to are one layer: with the opacities a
  /// of the edge and b of the face, (b - a) / (1 - a) remains for the face.
  float FindOpacity(const Surface& surface, const Ray& ray, const Hit& hit, const ShadedHit& shaded)
  {
    const float slope = this->Covered > 0.f ? ComputeSlope(ray, shaded) : 0.f;
    return this->FindOpacity(surface, hit.Distance, slope, shaded.Color.a);
  }

  /// Returns true if an edge may change the opacity of the next hit.
  bool IsBehindEdge() const { return this->Covered > 0.f; }

  /// The same for a hit at a distance on a surface with its opacity and a slope from ComputeSlope().
  float FindOpacity(const Surface& surface, float distance, float slope, float opacity)
  {
    const bool isEdge = surface.EdgeWidth > 0.f;
    if (this->Covered > 0.f && surface.ObjectId == this->ObjectId &&
      distance <= this->Edge + this->ComputeReach(slope))
    {
      const float own = opacity;
      opacity = own > this->Covered ? (own - this->Covered) / (1.f - this->Covered) : 0.f;
      this->Covered = isEdge ? std::max(this->Covered, own) : 0.f;
    }
    else if (isEdge)
    {
      this->ObjectId = surface.ObjectId;
      this->Edge = distance;
      this->Width = surface.EdgeWidth;
      this->Covered = opacity;
    }
    return opacity;
  }

  /// Returns the change of depth across the image of the surface at a hit, per length.
  static float ComputeSlope(const Ray& ray, const ShadedHit& shaded)
  {
    const glm::vec3 n = shaded.GeometricNormal;
    const float cosine = std::abs(glm::dot(n, ray.Direction)) / glm::length(ray.Direction);
    const float squared = glm::dot(n, n);
    const float slope = std::sqrt(std::max(squared - cosine * cosine, 0.f));
    return cosine > 0.f ? slope / cosine : 0.f;
  }

private:
  /// Returns the largest distance along the ray between an edge, which is moved toward the camera by
  /// its width, and its face, which may be inclined.
  float ComputeReach(float slope) const
  {
    const float pixels = this->Width * (2.f + 0.5f * slope);
    const float distance = this->IsParallel ? 1.f : this->Edge + this->Origin;
    return pixels * this->PixelSize * distance;
  }

  const float PixelSize; ///< see Camera
  const float Origin;    ///< depth of the origins of rays
  const bool IsParallel;
  int ObjectId = 0;
  float Edge = 0.f;    ///< distance of the nearest edge
  float Width = 0.f;   ///< of the edge, in pixels
  float Covered = 0.f; ///< opacity of the edges so far; 0 if the last hit was no edge
};

}
#endif
