// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Extracts the surface of data sets and validates its attributes.
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

/// Updates `filter`. On a stop request by `progress`, aborts the filter and throws Stopped.
VTKPENUMBRAFILTERSSCENE_EXPORT void UpdateStoppably(
  vtkAlgorithm* filter, const ProgressCallback& progress);

/// Returns `data` if it is a vtkPolyData, otherwise its surface. The arrays vtkOriginalPointIds and
/// vtkOriginalCellIds of the surface hold the ids of its points and cells in `data`.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkSmartPointer<vtkPolyData> ExtractSurface(
  vtkDataSet* data, const ProgressCallback& progress = {});

/// Returns the id in `data` of each point or cell of its `surface`, or -1 if the surface filter
/// added the point. The result is empty if `data` is a vtkPolyData. `type` is vtkDataObject::POINT
/// or CELL. Throws std::runtime_error if the array of original ids is missing. Its value type does
/// not matter: VTK chooses it by the number of ids.
VTKPENUMBRAFILTERSSCENE_EXPORT std::vector<vtkIdType> OriginalIds(
  vtkPolyData* surface, vtkDataSet* data, int type);

/// Returns `surface` with all polygons reversed that face toward the interior of their volumetric
/// cell in `data`. Cells with mirrored point order have such polygons.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkSmartPointer<vtkPolyData> FacingOutwards(
  vtkPolyData* surface, vtkDataSet* data, const ProgressCallback& progress = {});

/// Returns `surface` without normals and texture coordinates whose number of tuples differs from
/// the number of points or cells, because reading them would exceed the array. Adds one sentence
/// per dropped array to `messages`.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkSmartPointer<vtkPolyData> DropMismatchedAttributes(
  vtkPolyData* surface, std::vector<std::string>& messages);

}
#endif
