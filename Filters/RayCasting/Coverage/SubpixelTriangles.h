// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Detection of surfaces whose triangles are smaller than pixels. Projecting each of their edges
// would cost more than sampling the pixels that they cover.
#ifndef penumbra_SubpixelTriangles_h
#define penumbra_SubpixelTriangles_h

#include "Scene.h"

#include <vector>

namespace penumbra
{

/// Returns true if the mean visible triangle is smaller than a pixel and the surface is dense.
bool HasSubpixelTriangles(const Surface& surface, const Camera& camera);

/// Sets the flag of every pixel in [low, high) that a triangle of `surface` may cover. Sets all
/// flags in the projected bounds if projecting the triangles would cost more than sampling these
/// pixels.
void MarkCoveredPixels(const Surface& surface, const Camera& camera, glm::ivec2 low,
  glm::ivec2 high, std::vector<char>& pixels);

}
#endif
