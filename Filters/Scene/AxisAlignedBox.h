// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Axis-aligned bounding box.
#ifndef penumbra_AxisAlignedBox_h
#define penumbra_AxisAlignedBox_h

#include <glm/glm.hpp>

#include <limits>

namespace penumbra
{

/// An empty box has Low > High.
struct AxisAlignedBox
{
  glm::vec3 Low{ std::numeric_limits<float>::infinity() };
  glm::vec3 High{ -std::numeric_limits<float>::infinity() };

  bool IsEmpty() const { return !(this->Low.x <= this->High.x); }

  /// Returns the area of the surface.
  double ComputeArea() const
  {
    const glm::dvec3 size = glm::dvec3(this->High) - glm::dvec3(this->Low);
    return 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
  }

  void Add(glm::vec3 point)
  {
    this->Low = glm::min(this->Low, point);
    this->High = glm::max(this->High, point);
  }

  void Add(const AxisAlignedBox& box)
  {
    this->Low = glm::min(this->Low, box.Low);
    this->High = glm::max(this->High, box.High);
  }
};

}
#endif
