// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Effects of the render pass of a renderer. The ray caster, which does not include the passes, warns of those that it
// does not compute.
#ifndef penumbra_PassEffects_h
#define penumbra_PassEffects_h

#include "vtkPenumbraFiltersMediumModule.h" // for export macro

class vtkObjectBase;

namespace penumbra
{

struct EffectList
{
  bool AmbientOcclusion = false;
  bool LightShafts = false;
  bool Other = false;
};

/// Interface of a render pass that can say which effects it and the passes that it delegates to compute.
class VTKPENUMBRAFILTERSMEDIUM_EXPORT PassEffects
{
public:
  virtual ~PassEffects();
  virtual EffectList GetEffects() = 0;
};

/// Returns the effects of a pass alone, by its class: other classes than the two passes of effects have `Other`.
VTKPENUMBRAFILTERSMEDIUM_EXPORT EffectList FindEffectsOfClass(vtkObjectBase* pass);

}
#endif
