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
