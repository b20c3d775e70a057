// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Options that stay constant over all frames of an animation.
#ifndef penumbra_FrozenOptions_h
#define penumbra_FrozenOptions_h

class vtkRenderer;

namespace penumbra
{

struct RenderOptions;

/// Replaces automatic options with the values derived for `renderer`, which was built with
/// `options`: camera, color array and range, occlusion radius, scattering coefficient. `diagonal`
/// is that of the scene's bounds, in world units.
void FreezeOptions(vtkRenderer* renderer, double diagonal, RenderOptions& options);

}
#endif
