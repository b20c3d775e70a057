// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Detection of surfaces whose triangles are smaller than pixels. Exact coverage of each of them
// would cost more than sampling.
#ifndef penumbra_SubpixelTriangles_h
#define penumbra_SubpixelTriangles_h

#include "Camera.h"

#include <vector>

namespace penumbra
{

struct Surface;

/// Returns true if the mean visible triangle is smaller than a pixel and the surface is dense.
bool HasSubpixelTriangles(const Surface& surface, const Camera& camera);

}
#endif
