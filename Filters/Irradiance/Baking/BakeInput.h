// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From a data set to what baking needs: the surface that blocks, and the places that ask.
#ifndef penumbra_BakeInput_h
#define penumbra_BakeInput_h

#include "Records/RecordPlacement.h"
#include "Scene.h"

#include "vtkBoundingBox.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkPointSet;
class vtkPolyData;

namespace penumbra
{

struct BakeInputOptions
{
  bool OfCells = false;        ///< ask at the centres of cells, not at points
  bool ComputeNormals = false; ///< even where the data set brings some
  double PointRadius = 0.0;    ///< of the discs that stand for points without cells; world units
};

struct BakeInput
{
  Scene OccluderScene; ///< centred on the data set
  std::vector<RecordCandidate> Sites;
  std::vector<vtkIdType> Ids;       ///< point or cell of the data set that each site belongs to
  std::vector<std::string> LeftOut; ///< attributes that do not fit, a sentence each
  vtkIdType Unused = 0;             ///< points of no cell, or cells without area: they do not ask
  vtkIdType NotFinite = 0;          ///< points or normals that are not finite: they do not ask
  vtkBoundingBox Bounds;            ///< of all that is finite, world units
  double Diagonal = 0.0;            ///< of the bounds, world units
  float Spacing = 0.f;              ///< usual distance of neighbouring sites, scene units
};

/// Throws Stopped when `progress` asks to stop, as AddOccluders() does.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT BakeInput PrepareBakeInput(
  vtkPointSet* data, const BakeInputOptions& choices, const ProgressCallback& progress = {});

/// Polygons that block, too, but do not ask. The bounds are then those of both; points without
/// polygons count there.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT void AddOccluders(
  vtkPolyData* surroundings, BakeInput& mesh, const ProgressCallback& progress = {});

}
#endif
