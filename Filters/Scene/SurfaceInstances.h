// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Instances of the triangles of a Surface: a transform, a color and an id each.
#ifndef penumbra_SurfaceInstances_h
#define penumbra_SurfaceInstances_h

#include "AxisAlignedBox.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace penumbra
{

struct SurfaceInstances
{
  std::vector<glm::dmat4x3> Transforms; ///< from coordinates of the surface to scene coordinates
  std::vector<glm::u8vec4> Colors;      ///< RGBA, as Surface::CellColors
  std::vector<std::uint32_t> Ids;       ///< as Surface::CellIds
  glm::dvec3 Center{ 0.0 };             ///< of the bounding box of the surface's positions
  glm::dvec3 HalfSize{ 0.0 };           ///< half the size of this box
  double Radius = 0.0;                  ///< of a sphere around Center that contains the positions

  std::size_t GetCount() const { return this->Transforms.size(); }

  glm::dmat3 GetLinear(std::size_t instance) const
  {
    return glm::dmat3(this->Transforms[instance]);
  }

  glm::vec3 TransformPoint(std::size_t instance, glm::vec3 x) const
  {
    const glm::dmat4x3& transform = this->Transforms[instance];
    return glm::vec3(glm::dmat3(transform) * glm::dvec3(x) + transform[3]);
  }

  /// Returns the transform of normals: the inverse transpose, without its scale.
  glm::dmat3 GetNormalMatrix(std::size_t instance) const
  {
    const glm::dmat3 linear = this->GetLinear(instance);
    const double size = std::cbrt(std::abs(glm::determinant(linear)));
    return glm::transpose(glm::inverse(linear / size));
  }

  /// Returns a box in scene coordinates that contains an instance.
  AxisAlignedBox GetBox(std::size_t instance) const
  {
    const glm::dmat3 linear = this->GetLinear(instance);
    const glm::dvec3 center = linear * this->Center + this->Transforms[instance][3];
    AxisAlignedBox box;
    for (int axis = 0; axis < 3; ++axis)
    {
      const glm::dvec3 row(linear[0][axis], linear[1][axis], linear[2][axis]);
      const double exact =
        std::min(glm::dot(glm::abs(row), this->HalfSize), glm::length(row) * this->Radius);
      const double half = exact + BoxSlack * (std::abs(center[axis]) + exact);
      box.Low[axis] = static_cast<float>(center[axis] - half);
      box.High[axis] = static_cast<float>(center[axis] + half);
    }
    return box;
  }

private:
  /// Relative bound of the rounding of positions and boxes to single precision.
  static constexpr double BoxSlack = 4.0 * std::numeric_limits<float>::epsilon();
};

}
#endif
