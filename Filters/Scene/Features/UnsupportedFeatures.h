// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Adds a warning for each feature of an actor that the ray caster does not support.
#ifndef penumbra_UnsupportedFeatures_h
#define penumbra_UnsupportedFeatures_h

#include <string>
#include <vector>

class vtkActor;

namespace penumbra
{

void WarnUnsupportedActor(
  vtkActor* actor, const std::string& name, std::vector<std::string>& warnings);

}
#endif
