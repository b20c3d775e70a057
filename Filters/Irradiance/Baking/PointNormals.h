// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Point normals of meshes without usable ones.
#ifndef penumbra_PointNormals_h
#define penumbra_PointNormals_h

#include "Execution/ParallelFor.h"

#include "vtkSmartPointer.h"

class vtkDataArray;
class vtkPolyData;

namespace penumbra
{

/// Returns point normals from consistently oriented polygons; null if they cannot be computed.
/// Throws Stopped if `progress` requests a stop.
vtkSmartPointer<vtkDataArray> ComputePointNormals(
  vtkPolyData* surface, const ProgressCallback& progress);

}
#endif
