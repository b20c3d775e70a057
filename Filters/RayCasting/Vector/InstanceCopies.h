// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces the instances of surfaces by copies of their triangles.
#ifndef penumbra_InstanceCopies_h
#define penumbra_InstanceCopies_h

#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <vector>

namespace penumbra
{

struct Surface;

/// Replaces instances by copies of their triangles, for algorithms that need all triangles at once.
/// The index of each triangle stays the same.
VTKPENUMBRAFILTERSRAYCASTING_EXPORT void CopyInstances(std::vector<Surface>& surfaces);

}
#endif
