// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes whose pictures depend on rounding: what two machines are likely to draw differently.
#ifndef penumbra_BaselineScenes_h
#define penumbra_BaselineScenes_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkRenderer;

namespace penumbra
{

struct BaselineScene
{
  std::string Name;
  bool ByRays;    ///< the ray caster draws it, too
  bool AddsLight; ///< shadows and ambient occlusion where the ray caster draws it
  vtkSmartPointer<vtkRenderer> (*Make)();
};

/// All of them, smooth ones first.
const std::vector<BaselineScene>& Gallery();

}
#endif
