// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which of several surfaces a ray meets first, where they are nearer to each other than single precision
// can tell. Distances are compared in double; surfaces in one plane are drawn one over the other by their
// looks, so that neither the order of the actors nor rounding shows: lines and points first, then what
// is opaque, then the brighter.
#ifndef penumbra_CoincidentSurfaces_h
#define penumbra_CoincidentSurfaces_h

#include "RayScene.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

/// What a ray met, by single precision.
struct CandidateHit
{
  std::uint32_t Surface;
  std::uint32_t Triangle;
  float U;
  float V;
  float Distance;
};

/// All that a ray met within reach of the nearest.
struct CandidateHits
{
  static constexpr int Capacity = 8;

  CandidateHit Met[Capacity];
  int Count = 0;
  float Far = 0.f; ///< the ray's

  /// Adds `met` and drops what is farther than `reach` behind the nearest, whose distance is returned.
  /// Where there are too many the farthest goes.
  float Add(const CandidateHit& met, float reach);
};

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT CoincidentSurfaces
{
public:
  /// Finds the surfaces of `scene`, which must outlive this object, that come near another.
  explicit CoincidentSurfaces(const Scene& scene);

  /// How far apart single precision may take two surfaces for one, along a ray, in scene units; 0: no
  /// other surface comes near this one.
  float DepthTolerance(std::uint32_t surface) const { return this->DepthTolerances[surface]; }

  /// Does no surface come near another?
  bool IsEmpty() const { return this->Empty; }

  /// The one that is seen, where `last` is what Embree ended with. Its Beyond is the distance of the
  /// last one in the same place.
  Hit Resolve(const Ray& ray, const Hit& last, CandidateHits& contenders) const;

private:
  const Scene& TracedScene;
  std::vector<float> DepthTolerances; ///< per surface
  bool Empty = true;
  std::vector<int> DrawOrder; ///< per surface; the lower lies over the higher
};

}
#endif
