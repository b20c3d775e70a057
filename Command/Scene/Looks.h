// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Camera and lights of a look.
#ifndef penumbra_Looks_h
#define penumbra_Looks_h

class vtkRenderer;

namespace penumbra
{

struct RenderOptions;

/// Returns the options with the view direction of the look, and a focal point and zoom factor at
/// which the surfaces of `renderer` fill the image, in place of those that are not given.
RenderOptions UseLookCamera(vtkRenderer* renderer, RenderOptions options);

/// Adds the lights of the look relative to the camera of `renderer`. Returns false if it has none.
bool AddLookLights(vtkRenderer* renderer, const RenderOptions& options);

}
#endif
