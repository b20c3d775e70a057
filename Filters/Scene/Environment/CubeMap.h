// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Selection of the face of a cube map.
#ifndef penumbra_CubeMap_h
#define penumbra_CubeMap_h

#include <glm/glm.hpp>

#include <cstddef>

namespace penumbra
{

/// A point of a cube map.
template <typename T>
struct CubeMapPoint
{
  std::size_t Face;        ///< in the order of OpenGL: +x, -x, +y, -y, +z, -z
  glm::vec<2, T> Position; ///< in [0, 1]
};

/// Returns the point in a direction, which need not be a unit vector, of one of VTK's cube maps: they are
/// left-handed. Follows the OpenGL specification, section 8.13.
template <typename T>
CubeMapPoint<T> FindCubeMapPoint(glm::vec<3, T> direction)
{
  using Vector = glm::vec<2, T>;
  direction.z = -direction.z;
  const glm::vec<3, T> size = glm::abs(direction);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const T sign = direction[axis] < T(0) ? T(-1) : T(1);
  const Vector st = axis == 0 ? Vector(-sign * direction.z, -direction.y)
    : axis == 1               ? Vector(direction.x, sign * direction.z)
                              : Vector(sign * direction.x, -direction.y);
  return { 2 * static_cast<std::size_t>(axis) + (sign < T(0) ? 1 : 0),
    T(0.5) * (st / size[axis] + T(1)) };
}

}
#endif
