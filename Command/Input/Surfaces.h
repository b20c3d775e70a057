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

class vtkPolyData;

namespace penumbra
{

/// The cell array that says which cell of the file a cell of a surface comes from, where they differ.
constexpr const char* OriginalCellIds = "PenumbraOriginalCellIds";

struct Surfaces
{
  std::vector<vtkSmartPointer<vtkPolyData>> Meshes;
  vtkIdType Points = 0;        ///< in the file
  vtkIdType DroppedPoints = 0; ///< not finite, left out with the cells around them
};

/// The surfaces in the file at `path`. Throws Failure, naming it, when it cannot be read, when
/// nothing of it can be drawn, or when it contradicts itself.
Surfaces ReadSurfaces(const std::string& path);

}
#endif
