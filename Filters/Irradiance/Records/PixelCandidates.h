// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Record candidates of an image: the visible points at pixel centers, in levels from a coarse grid
// to every second pixel. Each level has about as many candidates as all previous levels together.
#ifndef penumbra_PixelCandidates_h
#define penumbra_PixelCandidates_h

#include "Execution/ParallelFor.h"
#include "RecordPlacement.h"

#include <vector>

namespace penumbra
{

class RayScene;

/// Levels alternate between the centers of the squares of a grid and the grid of half the stride.
/// Strides are in pixels.
constexpr int CoarsestStride = 128;
constexpr int ImageLevels = 13;

/// Returns the distance in pixels between the candidates of a level.
int LevelStride(int level);

/// Finds the first surface hit through pixel position `at`, ignoring lines and points. Returns
/// false for the background.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT bool FindCandidate(
  const RayScene& rays, glm::dvec2 at, RecordCandidate& site);

/// Returns the visible points of the pixels that `level` adds to the previous levels.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT std::vector<RecordCandidate> CandidatesInImage(
  const RayScene& rays, int level, const ProgressCallback& progress = {});

}
#endif
