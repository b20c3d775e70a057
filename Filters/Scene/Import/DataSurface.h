// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From any data set to polygons, and what of their attributes can be read.
#ifndef penumbra_DataSurface_h
#define penumbra_DataSurface_h

#include "vtkPenumbraFiltersSceneModule.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;

namespace penumbra
{

/// `data` itself where it holds polygons already; else its surface, with the point and cell that each of
/// its points and cells comes from in the arrays `vtkOriginalPointIds` and `vtkOriginalCellIds`.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkSmartPointer<vtkPolyData> PolyDataOf(vtkDataSet* data);

/// `surface` without normals and texture coordinates that are not one for each point or cell: reading them
/// would end beyond their last. `left` tells what was left out, a sentence each.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkSmartPointer<vtkPolyData> WithoutMisfits(
  vtkPolyData* surface, std::vector<std::string>& left);

}
#endif
