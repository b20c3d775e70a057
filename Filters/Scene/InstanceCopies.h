// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces the instances of surfaces by copies of their triangles.
#ifndef penumbra_InstanceCopies_h
#define penumbra_InstanceCopies_h

#include "vtkPenumbraFiltersSceneModule.h"

namespace penumbra
{

struct Scene;

/// Replaces instances by copies of their triangles, for algorithms that need all triangles at once.
/// The index of each triangle stays the same.
VTKPENUMBRAFILTERSSCENE_EXPORT void CopyInstances(Scene& scene);

}
#endif
