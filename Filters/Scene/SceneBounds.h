// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef penumbra_SceneBounds_h
#define penumbra_SceneBounds_h

#include "vtkPenumbraFiltersSceneModule.h"

namespace penumbra
{

struct Scene;

/// Returns the diagonal of the bounds of all surfaces, in world units; 1 for an empty scene.
VTKPENUMBRAFILTERSSCENE_EXPORT double ComputeSceneDiagonal(const Scene& scene);

}
#endif
