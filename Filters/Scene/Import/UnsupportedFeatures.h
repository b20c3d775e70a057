// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What an actor or a renderer asks for and the ray caster does not draw, by name.
#ifndef penumbra_UnsupportedFeatures_h
#define penumbra_UnsupportedFeatures_h

#include <string>
#include <vector>

class vtkActor;
class vtkRenderer;

namespace penumbra
{

void WarnUnsupportedActor(
  vtkActor* actor, const std::string& name, std::vector<std::string>& warnings);
void WarnUnsupportedRenderer(vtkRenderer* renderer, std::vector<std::string>& warnings);

}
#endif
