// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces of grids with quadratic and other curved cells.
#ifndef penumbra_CurvedCells_h
#define penumbra_CurvedCells_h

#include "Execution/ParallelFor.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include "vtkSmartPointer.h"

class vtkDataSet;
class vtkPolyData;

namespace penumbra
{

/// Name of the cell array of a subdivided surface that holds the face of a cell, or the cell in two
/// dimensions, of which each triangle is a part. No edges are drawn between parts of one face. The name
/// is the one that vtkRecoverGeometryWireframe requires before VTK 9.3.
constexpr const char* CurvedFaceIds = "vtkOriginalFaceIds";

/// Returns the surface of a grid with curved cells. These are subdivided until the triangles deviate
/// from the cells by at most 1e-4 of the diagonal of the bounds, unless there would be too many of
/// them. Returns null if `data` has no curved cells. The cell array `cellIds`, if not null, holds the
/// ids of the cells in `data`, and the array CurvedFaceIds those of their faces.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkSmartPointer<vtkPolyData> ExtractCurvedSurface(
  vtkDataSet* data, const char* cellIds, const ProgressCallback& progress = {});

}
#endif
