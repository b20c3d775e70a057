// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes whose images depend on rounding, so that two machines are likely to render them
// differently.
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
  bool ByRays;    ///< if true, the ray caster renders it, too
  bool AddsLight; ///< if true, the ray caster adds shadows and ambient occlusion
  vtkSmartPointer<vtkRenderer> (*Make)();
};

/// Returns all scenes, smooth ones first.
const std::vector<BaselineScene>& Gallery();

}
#endif
