// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes of physically based materials for the table of VTK's rendering features.
#ifndef FeatureMaterials_h
#define FeatureMaterials_h

#include "FeatureScenes.h"

#include <vector>

/// Adds scenes with the textures, the anisotropy and the clear coat of physically based materials.
void AddMaterialScenes(std::vector<FeatureScene>& scenes);

#endif
