// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws vtkScalarBarActor with the layout that VTK computes, without a graphics context.
#ifndef penumbra_SceneExtractionScalarBar_h
#define penumbra_SceneExtractionScalarBar_h

class vtkRenderer;
class vtkScalarBarActor;

namespace penumbra
{

struct Scene;

/// Draws `bar` into scene.OverlayImage. A copy of the bar renders its parts into the overlay
/// instead of a window. The grid behind translucent colors is omitted. Returns false if VTK cannot
/// render text.
bool DrawScalarBar(vtkScalarBarActor* bar, vtkRenderer* renderer, int dpi, Scene& scene);

}
#endif
