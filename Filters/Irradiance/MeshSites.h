// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From a data set to what baking needs: the surface that blocks, and the places that ask.
#ifndef penumbra_MeshSites_h
#define penumbra_MeshSites_h

#include "Placement.h"
#include "Scene.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkPointSet;

namespace penumbra
{

struct MeshChoices
{
  bool OfCells = false;        ///< ask at the centres of cells, not at points
  bool ComputeNormals = false; ///< even where the data set brings some
  double PointRadius = 0.0;    ///< of the discs that stand for points without cells; world units
};

struct MeshSites
{
  Scene Blocking; ///< centred on the data set
  std::vector<Site> Sites;
  std::vector<vtkIdType> Ids; ///< point or cell of the data set that each site belongs to
  vtkIdType Unused = 0;       ///< points of no cell, or cells without area: they do not ask
  vtkIdType NotFinite = 0;    ///< points or normals that are not finite: they do not ask
  double Diagonal = 0.0;      ///< of the bounds, world units
  float Spacing = 0.f;        ///< usual distance of neighbouring sites, scene units
};

VTKPENUMBRAFILTERSIRRADIANCE_EXPORT MeshSites FindMeshSites(
  vtkPointSet* data, const MeshChoices& choices);

}
#endif
