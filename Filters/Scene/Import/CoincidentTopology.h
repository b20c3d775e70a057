// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads the settings of vtkMapper for coincident topology.
#ifndef penumbra_CoincidentTopology_h
#define penumbra_CoincidentTopology_h

#include "Tessellation/SceneExtractionItem.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro

#include <vector>

class vtkActor;
class vtkRenderer;

namespace penumbra
{

/// Sets the offsets of `item` to those with which VTK draws the mapper of `actor`.
void ReadDepthOffsets(vtkActor* actor, DrawItem& item);

/// Returns true if `item` has polygons that are drawn as surfaces.
bool HasPolygons(const DrawItem& item);

/// Returns the farthest offset of polygons.
DepthOffset FindFarthestOffset(const std::vector<DrawItem>& items);

/// Makes all offsets relative to the farthest one. Surfaces whose polygons have the same offset keep their
/// place.
void MakeDepthOffsetsRelative(DepthOffset farthest, std::vector<DrawItem>& items);

/// Returns the value of Camera::DepthUnit for a scene within `bounds`.
double ComputeDepthUnit(vtkRenderer* renderer, const double bounds[6], const Scene& scene);

/// Returns the offsets of the visible actors; empty if all are 0. Changing them does not change the
/// modification times of the mappers.
VTKPENUMBRAFILTERSSCENE_EXPORT std::vector<double> GetDepthOffsetSettings(vtkRenderer* renderer);

}
#endif
