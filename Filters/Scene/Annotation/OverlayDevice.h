// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws what vtkContext2D paints into an overlay.
#ifndef penumbra_OverlayDevice_h
#define penumbra_OverlayDevice_h

class vtkContextScene;

namespace penumbra
{

class Overlay;

/// Paints all items into `overlay`, which has `scale` pixels per unit of the scene. Returns true if something was not
/// drawn as asked for.
bool PaintItems(vtkContextScene* items, Overlay& overlay, double scale);

}
#endif
