// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From props, mappers and data objects to pieces: one poly data each, with all that says how it is
// drawn.
#ifndef penumbra_SceneExtractionActors_h
#define penumbra_SceneExtractionActors_h

#include "Tessellation/SceneExtractionItem.h"

#include "vtkPenumbraFiltersSceneModule.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkMapper;
class vtkRenderer;

namespace penumbra
{

/// Does it draw by shaders alone what no triangle of its input shows? Then no ray can meet it.
VTKPENUMBRAFILTERSSCENE_EXPORT bool DrawsByShadersAlone(vtkMapper* mapper);

/// What `renderer` draws. Names in `warnings` what it cannot turn into pieces.
std::vector<DrawItem> CollectDrawItems(
  vtkRenderer* renderer, std::vector<std::string>& warnings, const ProgressCallback& progress);

/// Data sets and the leaves of composite ones, in VTK's default look.
std::vector<DrawItem> CollectDrawItems(const std::vector<vtkDataObject*>& data,
  std::vector<std::string>& warnings, const ProgressCallback& progress);

}
#endif
