// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Baked values as an array of the mesh.
#ifndef penumbra_BakedArrays_h
#define penumbra_BakedArrays_h

#include "BakeInput.h"
#include "Baking.h"

#include "vtkFloatArray.h"
#include "vtkSmartPointer.h"

#include <array>
#include <string>

namespace penumbra
{

class RankAgreement;

/// Returns an array of `scale` times the means at all points or cells, 0 for those without a query
/// point. A point or cell with several query points gets their weighted mean.
vtkSmartPointer<vtkFloatArray> CreateArray(const BakeInput& mesh, const BakedValues& baked,
  vtkIdType size, const char* name, int components, float scale);

/// Returns the numbers of points or cells by BakingMethod. One with several query points counts as the most
/// expensive of them.
std::array<double, 3> CountMethods(const BakeInput& mesh, const BakedValues& baked, vtkIdType size);

/// Returns one sentence if nearly all points, of all ranks together, are occluded: the normals face into the mesh, or
/// the mesh is a cave. It is empty otherwise, and on other ranks than the first one. Collective. `ranks` may be null.
std::string DescribeOccluded(const BakedValues& baked, RankAgreement* ranks);

/// In the same way, if nearly all values are 0.
std::string DescribeBlack(const BakedValues& baked, RankAgreement* ranks);

}
#endif
