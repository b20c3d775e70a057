// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What must not jump from one picture of an animation to the next.
#ifndef penumbra_FrozenOptions_h
#define penumbra_FrozenOptions_h

class vtkRenderer;

namespace penumbra
{

struct RenderOptions;

/// Sets the options that would be found from the data to what was found for `renderer`, which was
/// built with them: camera, array and range of the colours, reach of occluders, density of the fog.
void FreezeOptions(vtkRenderer* renderer, RenderOptions& options);

}
#endif
