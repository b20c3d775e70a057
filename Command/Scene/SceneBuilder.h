// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From surfaces and options to the renderer that both engines draw. It needs no window.
#ifndef penumbra_SceneBuilder_h
#define penumbra_SceneBuilder_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkPolyData;
class vtkRenderer;

namespace penumbra
{

struct CameraOptions;
struct RenderOptions;

/// Actors, lights, background and camera. `unitsPerPoint`: what VTK's line widths and point sizes
/// count, for each point of 1/72 inch. Throws Failure for an array that does not exist.
vtkSmartPointer<vtkRenderer> BuildScene(const std::vector<vtkSmartPointer<vtkPolyData>>& meshes,
  const RenderOptions& options, double unitsPerPoint);

/// Place the camera of `renderer`, whose actors are there already.
void PlaceCamera(vtkRenderer* renderer, const CameraOptions& options, double aspect);

}
#endif
