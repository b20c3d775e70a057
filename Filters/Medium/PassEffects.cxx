// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PassEffects.h"

#include "vtkObjectBase.h"

namespace penumbra
{

// Here, so that all libraries share the type, which dynamic_cast compares.
PassEffects::~PassEffects() = default;

EffectList FindEffectsOfClass(vtkObjectBase* pass)
{
  EffectList effects;
  effects.AmbientOcclusion = pass->IsA("vtkPenumbraTemporalSSAOPass");
  effects.LightShafts = pass->IsA("vtkPenumbraLightShaftPass");
  effects.Other = !effects.AmbientOcclusion && !effects.LightShafts;
  return effects;
}

}
