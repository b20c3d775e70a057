// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes of switches of vtkRenderer and vtkActor for the table of VTK's rendering features.
#ifndef FeatureRenderers_h
#define FeatureRenderers_h

#include "FeatureScenes.h"

#include <vector>

/// Adds scenes with shadows, hidden lines and forced opacity.
void AddRendererScenes(std::vector<FeatureScene>& scenes);

#endif
