// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sphere or tube.
#ifndef penumbra_RoundShape_h
#define penumbra_RoundShape_h

#include <glm/glm.hpp>

namespace penumbra
{

/// A sphere if A and B are equal, otherwise a tube: the convex hull of two spheres. With flat ends,
/// a cylinder of the radius RadiusA between A and B, which does not exist if they are equal.
struct RoundShape
{
  glm::vec3 A;
  glm::vec3 B;
  float RadiusA;
  float RadiusB;
  bool HasFlatEnds = false;
};

}
#endif
