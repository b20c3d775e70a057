// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces of other ranks. All but ExtractCompositeSurface() are collective: every rank has to call them.
#ifndef penumbra_SurfaceExchange_h
#define penumbra_SurfaceExchange_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkBoundingBox;
class vtkDataObject;
class vtkMultiProcessController;
class vtkPolyData;

namespace penumbra
{

/// All cells on the surface of a data object; composite: of its blocks, one after the other. Of their
/// arrays the normals of points stay where every block has them.
vtkSmartPointer<vtkPolyData> ExtractCompositeSurface(vtkDataObject* data);

/// Of each rank's surface.
std::vector<vtkBoundingBox> GatherBounds(vtkMultiProcessController* controller, vtkPolyData* local);

/// The polygons of the other ranks whose bounds come nearer than `reach` to those of this rank's; `reach`
/// may be infinite.
vtkSmartPointer<vtkPolyData> GatherRemoteOccluders(vtkMultiProcessController* controller,
  vtkPolyData* local, const std::vector<vtkBoundingBox>& bounds, double radius);

/// The surfaces of all ranks, in their order.
vtkSmartPointer<vtkPolyData> AllGatherSurfaces(
  vtkMultiProcessController* controller, vtkPolyData* local);

}
#endif
