// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef penumbra_SceneBounds_h
#define penumbra_SceneBounds_h

#include "AxisAlignedBox.h"
#include "vtkPenumbraFiltersSceneModule.h"

namespace penumbra
{

struct Scene;
struct Surface;

/// Returns the bounds of the primitives of a surface, in scene coordinates; empty if there are none.
VTKPENUMBRAFILTERSSCENE_EXPORT AxisAlignedBox ComputeDrawnBounds(const Surface& surface);

/// Returns the diagonal of the bounds of all surfaces, in world units; 1 for an empty scene.
VTKPENUMBRAFILTERSSCENE_EXPORT double ComputeSceneDiagonal(const Scene& scene);

/// Returns the bounds, in scene coordinates, of the triangles of a surface without Instances; empty if
/// there are none.
VTKPENUMBRAFILTERSSCENE_EXPORT AxisAlignedBox ComputeTriangleBounds(const Surface& surface);

/// Returns the bounds, in scene coordinates, of a surface with Instances.
VTKPENUMBRAFILTERSSCENE_EXPORT AxisAlignedBox ComputeInstanceBounds(const Surface& surface);

}
#endif
