// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Resolution of coincident surfaces: selects the visible hit if several surfaces are closer to each
// other along a ray than single precision can resolve. Distances are compared in double precision.
// Coplanar surfaces are ordered as VTK draws them, so that the image does not depend on rounding:
// lines and points are in front, then surfaces whose mappers shift them toward the camera, then
// translucent surfaces, then those that are drawn later. Of coincident translucent surfaces, a ray meets
// only the first one.
#ifndef penumbra_CoincidentSurfaces_h
#define penumbra_CoincidentSurfaces_h

#include "RayScene.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

/// A hit in single precision, as Embree computes it.
struct CandidateHit
{
  std::uint32_t Surface;
  std::uint32_t Primitive;
  float U;
  float V;
  float Distance;
};

/// The hits of a ray that are within the depth tolerance of the nearest one.
struct CandidateHits
{
  static constexpr int Capacity = 8;

  CandidateHit Hits[Capacity];
  int Count = 0;
  float Far = 0.f; ///< Ray::Far

  /// Adds `hit` and removes hits farther than `tolerance` behind the nearest one. If the capacity
  /// is exceeded, the farthest hit of the surfaces that have several is dropped, or else the
  /// farthest one. Returns the distance of the nearest hit.
  float Add(const CandidateHit& hit, float tolerance);
};

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT CoincidentSurfaces
{
public:
  /// Finds the surfaces whose bounding boxes are within the depth tolerance of another one. `scene`
  /// must outlive this object.
  explicit CoincidentSurfaces(const Scene& scene);

  /// Returns the distance along a ray, in scene units, below which single precision may not
  /// separate this surface from another one; 0 if no other surface is near.
  float DepthTolerance(std::uint32_t surface) const { return this->DepthTolerances[surface]; }

  /// Returns the position of this surface in the order of coplanar surfaces, 0 in front. It is
  /// meaningful if DepthTolerance() is positive.
  int GetDrawOrder(std::uint32_t surface) const { return this->DrawOrder[surface]; }

  /// Returns the first position behind this surface that a ray meets where they coincide.
  int GetNextInOrder(std::uint32_t surface) const { return this->NextInOrder[surface]; }

  /// Returns true if no two surfaces are near each other.
  bool IsEmpty() const { return this->Empty; }

  /// Returns the visible hit of the candidates; `embreeHit` is what Embree returned.
  /// Hit::NextNear of the result is the distance of the farthest coincident hit. Returns a miss if
  /// the ray skips all candidates.
  Hit Resolve(const Ray& ray, const Hit& embreeHit, CandidateHits& candidates) const;

private:
  const Scene& TracedScene;
  std::vector<float> DepthTolerances; ///< per surface
  bool Empty = true;
  std::vector<int> DrawOrder;   ///< per surface; lower values are in front
  std::vector<int> NextInOrder; ///< place in this order of the next one that a ray meets
};

}
#endif
