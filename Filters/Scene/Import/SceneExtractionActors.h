// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Converts props, mappers and data objects to draw items.
#ifndef penumbra_SceneExtractionActors_h
#define penumbra_SceneExtractionActors_h

#include "Tessellation/SceneExtractionItem.h"

#include "vtkPenumbraFiltersSceneModule.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkMapper;
class vtkProp;
class vtkRenderer;

namespace penumbra
{

/// Returns true if `mapper` generates its shapes in shaders, so that they cannot be ray traced.
VTKPENUMBRAFILTERSSCENE_EXPORT bool DrawsByShadersAlone(vtkMapper* mapper);

/// What a prop of a renderer draws.
struct PropItems
{
  int NumberOfObjects = 0; ///< they have consecutive ids
  std::vector<DrawItem> Items;
  std::vector<std::string> Warnings; ///< of its parts that are not supported
};

/// Returns the draw items of a prop of `renderer`, whose first object has the id `firstObject`.
PropItems CollectPropItems(
  vtkRenderer* renderer, vtkProp* prop, int firstObject, const ProgressCallback& progress);

/// Returns draw items for data sets and the leaves of composite data sets, with VTK's default
/// property.
std::vector<DrawItem> CollectDrawItems(const std::vector<vtkDataObject*>& data,
  std::vector<std::string>& warnings, const ProgressCallback& progress);

}
#endif
