// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Instances of a BVH of triangles as primitives of Embree's BVH. Embree's own instances need about
// 400 bytes each, these about 60 besides their transforms.
#ifndef penumbra_InstanceGeometry_h
#define penumbra_InstanceGeometry_h

#include "EmbreeQuery.h"
#include "SurfaceInstances.h"
#include "TracedSurface.h"

#include <glm/glm.hpp>

#include <cmath>

namespace penumbra
{

/// Transform to the coordinates of an instance.
struct InstanceFrame
{
  glm::dmat3 Linear;
  glm::dvec3 Origin; ///< in scene coordinates

  InstanceFrame(const SurfaceInstances& instances, std::size_t instance)
    : Linear(glm::inverse(instances.GetLinear(instance))),
      Origin(instances.Transforms[instance][3])
  {
  }
  glm::dvec3 ConvertPoint(const glm::dvec3& x) const { return this->Linear * (x - this->Origin); }
  /// Returns a bound of the ratio of lengths in these and in scene coordinates.
  double GetScale() const
  {
    return std::sqrt(glm::dot(this->Linear[0], this->Linear[0]) +
      glm::dot(this->Linear[1], this->Linear[1]) + glm::dot(this->Linear[2], this->Linear[2]));
  }
};

/// Returns the geometry of a surface with Instances. TracedSurface::Shape is the BVH of its
/// triangles, as of MakeTriangleGeometry(). `traced` must outlive it.
RTCGeometry MakeInstanceGeometry(RTCDevice device, TracedSurface& traced);

}
#endif
