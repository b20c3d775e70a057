// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From whatever a file holds to surfaces that can be drawn: sound, finite, one for each data set.
#ifndef penumbra_Surfaces_h
#define penumbra_Surfaces_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace penumbra
{

/// The cell array that says which cell of the file a cell of a surface comes from, where they differ.
constexpr const char* OriginalCellIds = "PenumbraOriginalCellIds";

struct Surfaces
{
  std::vector<vtkSmartPointer<vtkPolyData>> Meshes;
  vtkIdType DroppedPoints = 0; ///< not finite, left out with the cells around them
};

/// The surfaces of `data`, read from `path`. Throws Failure, naming the file, when nothing can be
/// drawn or the data contradict themselves.
Surfaces ExtractSurfaces(vtkDataObject* data, const std::string& path);

}
#endif
