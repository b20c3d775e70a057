// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces whose triangles are smaller than pixels: looking at each of their edges would cost more
// than sampling the pixels that they touch.
#ifndef penumbra_SubpixelTriangles_h
#define penumbra_SubpixelTriangles_h

#include "Scene.h"

#include <vector>

namespace penumbra
{

/// Is the mean triangle that the camera sees smaller than a pixel?
bool HasSubpixelTriangles(const Surface& surface, const Camera& camera);

/// Sets the flag of every pixel of [low, high) that a triangle of `surface` may touch; of all within
/// its bounds, where finding out would cost more than sampling them.
void MarkCoveredPixels(const Surface& surface, const Camera& camera, glm::ivec2 low,
  glm::ivec2 high, std::vector<char>& pixels);

}
#endif
