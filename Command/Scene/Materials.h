// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Actors with the materials of files and the appearance that options request.
#ifndef penumbra_Materials_h
#define penumbra_Materials_h

#include "vtkSmartPointer.h"

class vtkActor;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;

namespace penumbra
{

struct RenderOptions;

/// Returns `mesh` with tangents if the normal texture of `material` needs them. `material` may be
/// null, as in the functions below.
vtkSmartPointer<vtkPolyData> AddTangents(vtkPolyData* mesh, vtkActor* material);

/// Makes a mapper that shows the colors of vertices of the file, if it has any.
vtkSmartPointer<vtkPolyDataMapper> MakeMapper(vtkPolyData* mesh, vtkActor* material);

/// Makes an actor with a material, and with the options on top of it.
vtkSmartPointer<vtkActor> MakeActor(vtkPolyDataMapper* mapper, vtkActor* material,
  const RenderOptions& options, double unitsPerPoint);

/// Removes the materials of actors that ColorByData() colors.
void RemoveMaterialsOfColored(
  vtkRenderer* renderer, const RenderOptions& options, double unitsPerPoint);

}
#endif
