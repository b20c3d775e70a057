// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces in front of a query point that do not continue its own. The rays of a record miss a
// thin plate beside it, which the points under the plate see; the distance of the plate, computed
// from its triangles, tells how far the record may reach.
#ifndef penumbra_Obstacles_h
#define penumbra_Obstacles_h

#include "BakeInput.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

class RayScene;

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT Obstacles
{
public:
  /// `rays` are of the occluders of `mesh`, whose patches are labeled. Both must outlive this
  /// object.
  Obstacles(const BakeInput& mesh, const RayScene& rays);

  /// Returns the distance of the nearest obstacle of a query point: of a triangle that rises above
  /// its tangent plane and belongs to another patch or is much steeper than the point; infinity if
  /// there is none within `radius`.
  float FindDistance(const RecordCandidate& site, float radius) const;

private:
  void FindSitesOfPoints();
  void FindSitesOfCells();
  bool IsObstacle(const RecordCandidate& site, float height, std::uint32_t surface,
    std::uint32_t primitive) const;

  const BakeInput& Mesh;
  const RayScene& Rays;
  /// Query points of the corners of each triangle of the first surface, or of its cell.
  std::vector<glm::uvec3> TriangleSites;
};

}
#endif
