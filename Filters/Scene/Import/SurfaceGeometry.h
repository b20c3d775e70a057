// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From any data set to polygons, and what of their attributes can be read.
#ifndef penumbra_SurfaceGeometry_h
#define penumbra_SurfaceGeometry_h

#include "Execution/ParallelFor.h"

#include "vtkPenumbraFiltersSceneModule.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataSet;
class vtkPolyData;

namespace penumbra
{

/// Executes `filter`; when `progress` asks to stop, the filter is told and Stopped is thrown.
VTKPENUMBRAFILTERSSCENE_EXPORT void UpdateStoppably(
  vtkAlgorithm* filter, const ProgressCallback& progress);

/// `data` itself where it holds polygons already; else its surface, with the point and cell that each of
/// its points and cells comes from in the arrays `vtkOriginalPointIds` and `vtkOriginalCellIds`.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkSmartPointer<vtkPolyData> ExtractSurface(
  vtkDataSet* data, const ProgressCallback& progress = {});

/// Which point or cell of `data` each one of its `surface` comes from, -1: none, a point that the surface
/// added; empty: `surface` is `data` itself. `type` is vtkDataObject::POINT or CELL. VTK chooses the type
/// of the array by the number of ids: whatever it is, it is read. Throws std::runtime_error without it.
VTKPENUMBRAFILTERSSCENE_EXPORT std::vector<vtkIdType> OriginalIds(
  vtkPolyData* surface, vtkDataSet* data, int type);

/// `surface` with those polygons reversed that face into the volumetric cell of `data` that they bound,
/// as all do of cells whose points are in the order of a mirror image.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkSmartPointer<vtkPolyData> FacingOutwards(
  vtkPolyData* surface, vtkDataSet* data, const ProgressCallback& progress = {});

/// `surface` without normals and texture coordinates that are not one for each point or cell: reading them
/// would end beyond their last. `left` tells what was left out, a sentence each.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkSmartPointer<vtkPolyData> DropMismatchedAttributes(
  vtkPolyData* surface, std::vector<std::string>& messages);

}
#endif
