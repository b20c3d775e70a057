// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Builds the vtkRenderer that both engines render, without a window.
#ifndef penumbra_SceneBuilder_h
#define penumbra_SceneBuilder_h

#include "vtkBoundingBox.h"
#include "vtkSmartPointer.h"

class vtkRenderer;

namespace penumbra
{

struct RenderOptions;
struct Surfaces;

/// Name of the field array with the name of a surface, see Surfaces::Names.
constexpr const char* SourceName = "PenumbraSourceName";

/// Builds actors, lights, background and camera. `unitsPerPoint`: units of VTK's line widths and
/// point sizes per point of 1/72 inch. Throws CommandError if a color
/// array or the camera of --camera-index does not exist.
vtkSmartPointer<vtkRenderer> BuildScene(
  const Surfaces& surfaces, const RenderOptions& options, double unitsPerPoint);

/// Returns the bounds of all actors, including the radii of spheres and tubes.
vtkBoundingBox ComputeBounds(vtkRenderer* renderer, const RenderOptions& options);

/// Places the camera of `renderer`, which must contain its actors, by options.Camera. The near
/// plane of the ray engine clips nothing.
void PlaceCamera(vtkRenderer* renderer, const RenderOptions& options);

}
#endif
