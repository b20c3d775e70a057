// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a render pass of a renderer computes, for the ray caster, which does not know the passes: it warns of
// effects that it was not told to compute itself.
#ifndef penumbra_PassEffects_h
#define penumbra_PassEffects_h

#include "vtkPenumbraFiltersMediumModule.h" // for export macro

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

}
#endif
