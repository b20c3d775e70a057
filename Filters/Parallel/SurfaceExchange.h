// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Exchanges surfaces between ranks. All functions except ExtractCompositeSurface() are collective:
// every rank must call them.
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

/// Returns the surface of a data object, with the blocks of a composite data set appended in order.
/// Point normals are kept if every block has them; all other arrays are dropped.
vtkSmartPointer<vtkPolyData> ExtractCompositeSurface(vtkDataObject* data);

/// Returns the bounds of the surface of each rank. The bounds of an empty surface are invalid.
std::vector<vtkBoundingBox> GatherBounds(vtkMultiProcessController* controller, vtkPolyData* local);

/// Returns the polygons of the other ranks whose bounds intersect the local bounds inflated by
/// `radius`, in world units. `radius` may be infinite.
vtkSmartPointer<vtkPolyData> GatherRemoteOccluders(vtkMultiProcessController* controller,
  vtkPolyData* local, const std::vector<vtkBoundingBox>& bounds, double radius);

}
#endif
