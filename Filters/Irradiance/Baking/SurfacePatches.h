// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Connected parts of a surface without sharp edges. Values are only interpolated within a patch, so
// that coarse polygons get no values of others that are parallel, behind, or beyond a gap.
#ifndef penumbra_SurfacePatches_h
#define penumbra_SurfacePatches_h

#include "BakeInput.h"

namespace penumbra
{

/// Sets the patch of each query point of `mesh`. Two points of one triangle, at one position, or
/// two cells with a common edge are connected if their normals agree. Disks form one patch.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT void LabelPatches(BakeInput& mesh);

}
#endif
