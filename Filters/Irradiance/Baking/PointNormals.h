// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Point normals of meshes without usable ones.
#ifndef penumbra_PointNormals_h
#define penumbra_PointNormals_h

#include "Execution/ParallelFor.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

class vtkDataArray;
class vtkPolyData;

namespace penumbra
{

/// Returns point normals from consistently oriented polygons; null if they cannot be computed. They
/// are 0 where polygons face opposite sides and their normals cancel. Of several polygons with the
/// same points, only the first one counts; `doubled` is set to the number of the others that have
/// the opposite orientation. Throws Stopped if `progress` requests a stop.
vtkSmartPointer<vtkDataArray> ComputePointNormals(
  vtkPolyData* surface, vtkIdType& doubled, const ProgressCallback& progress);

}
#endif
