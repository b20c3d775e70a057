// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Validation of data sets: damaged files can contain indices of missing points, or cells without area.
#ifndef penumbra_DataSetValidation_h
#define penumbra_DataSetValidation_h

#include <string>

class vtkDataSet;
class vtkPolyData;

namespace penumbra
{

/// Returns the first inconsistency of `data`: an index out of range, a cell with too few points, or
/// an array that is too short. Empty if the data set is valid.
std::string FindInconsistency(vtkDataSet* data);

/// Returns whether `mesh` has cells, but neither vertices, nor lines between different points, nor polygons
/// and strips whose area is larger than the rounding of its coordinates. False for the faces of curved cells.
bool HasOnlyZeroArea(vtkPolyData* mesh);

}
#endif
