// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Features that the first random scenes lack. They follow from a stream of their own, so that scenes without them keep
// their seeds.
#ifndef penumbra_soak_RandomExtras_h
#define penumbra_soak_RandomExtras_h

#include "Random.h"
#include "RandomProps.h"

class vtkRenderer;

namespace penumbra_soak
{

/// Gives a prop a matrix with shear or a reflection, a logarithmic or categorical table, a texture with alpha, light of
/// its own, interpolated normals, or a copy in the same place, which is added to the renderer. `unit`: of the scene.
void AddRandomExtras(Random& random, vtkRenderer* renderer, double unit, RandomProp& prop);

}
#endif
