// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks of the ray caster's image of a scene: finite values, independence of the number of threads,
// errors and estimates against stratified samples, large regions against VTK's image.
#ifndef penumbra_soak_SceneChecks_h
#define penumbra_soak_SceneChecks_h

#include "BruteForce/StratifiedReference.h"
#include "RandomScenes.h"

#include <string>
#include <vector>

namespace penumbra_soak
{

struct CastImage
{
  penumbra::Answer Values;
  std::string Warnings; ///< without those that the tolerance was not reached
  bool Finite = true;   ///< all colors and estimates are
};

/// Casts a scene with all of its settings, or with those that VTK has too.
CastImage CastScene(const RandomScene& scene, bool plain, int threads = 1);

/// Draws a reference by stratified samples; with effects, layers and 2-D props by uniform samples of
/// the ray caster. `quality`: multiplies the side of the grid of samples.
penumbra::StratifiedReference DrawReference(const RandomScene& scene, int quality);

/// Error that a tile may have.
double TileLimit(const RandomScene& scene);

/// Whether the error is above the limit and the estimate does not say so.
bool IsMisjudged(const RandomScene& scene, const penumbra::TileAccuracy& tile);

/// Colors of VTK's image, 3 components in [0, 1] per pixel.
std::vector<glm::dvec3> DrawWithVTK(const RandomScene& scene);

/// Number of blocks of 8 x 8 pixels that differ from VTK's image: by more than 0.06 on average, and
/// in a third of the pixels from all neighbors of VTK's pixel.
int CountDifferentBlocks(const std::vector<glm::dvec3>& cast, const std::vector<glm::dvec3>& vtk);

/// Writes images of ImageSide x ImageSide pixels side by side as PNG.
void WriteSheet(const std::vector<std::vector<glm::dvec3>>& images, const std::string& path);

}
#endif
