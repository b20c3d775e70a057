// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Splits a mesh by the material of its cells.
#ifndef penumbra_MaterialSplit_h
#define penumbra_MaterialSplit_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataArray;
class vtkPolyData;

namespace penumbra
{

struct MaterialPart
{
  int Id = -1;
  vtkSmartPointer<vtkPolyData>
    Mesh; ///< with the arrays of the whole mesh and its cell ids, OriginalCellIds
};

/// Returns one mesh per value of `ids`, in ascending order.
std::vector<MaterialPart> SplitByMaterial(vtkPolyData* mesh, vtkDataArray* ids);

}
#endif
