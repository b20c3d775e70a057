// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Options that stay constant over all frames of an animation.
#ifndef penumbra_FrozenOptions_h
#define penumbra_FrozenOptions_h

#include "Files/JsonObject.h"

class vtkRenderer;

namespace penumbra
{

struct ColoringOptions;
struct RenderOptions;

/// Sets the array and the range to those of the first colored actor of `renderer`, if there is one.
void FreezeColoring(vtkRenderer* renderer, ColoringOptions& options);

/// Replaces automatic options with the values derived for `renderer`, which was built with
/// `options`: camera, color array and range, occlusion radius, scattering coefficient. `diagonal`
/// is that of the scene's bounds, in world units.
void FreezeOptions(vtkRenderer* renderer, double diagonal, RenderOptions& options);

/// Returns the values that FreezeOptions() set.
JsonObject DescribeFrozen(const RenderOptions& options);

/// Sets the values of DescribeFrozen(). Throws std::exception if one is missing or has
/// the wrong type.
void ApplyFrozen(const JsonObject& values, RenderOptions& options);

}
#endif
