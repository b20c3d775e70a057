// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Paints the scenes of vtkContextActor, such as 2-D charts, into an overlay.
#ifndef penumbra_ChartPainter_h
#define penumbra_ChartPainter_h

class vtkContextActor;
class vtkRenderer;

namespace penumbra
{

struct Scene;

/// Paints as in the window of `renderer`, enlarged to the image; without a window, a unit of the
/// chart has `dpi` / 72 pixels. Warns of what is not painted.
void PaintChart(vtkContextActor* actor, vtkRenderer* renderer, int dpi, Scene& scene);

}
#endif
