// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Depths of the first opaque surfaces at points of the image.
#ifndef penumbra_OpaqueDepths_h
#define penumbra_OpaqueDepths_h

#include "Embree/RayScene.h"

#include <vector>

namespace penumbra
{

/// Returns the depth of the first surface that is opaque, in scene units along the view axis, at each
/// point of the image; infinity if there is none.
std::vector<double> FindOpaqueDepths(const RayScene& rays, const std::vector<glm::dvec2>& points);

}
#endif
