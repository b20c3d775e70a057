// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where a picture may need records: pixel centres of the whole picture in levels, each level with
// about as many as all before, from a coarse grid to every second pixel.
#ifndef penumbra_PixelCandidates_h
#define penumbra_PixelCandidates_h

#include "Execution/ParallelFor.h"
#include "RecordPlacement.h"

#include <vector>

namespace penumbra
{

class RayScene;

/// Levels alternate between the middles of the squares of a grid and the grid half as wide.
constexpr int CoarsestStride = 128;
constexpr int FinestStride = 2;
constexpr int PictureLevels = 13;

/// Distance of the pixels of a level.
int LevelStride(int level);

/// What is seen first through picture point `at`, lines and points aside; false: nothing.
bool FindCandidate(const RayScene& rays, glm::dvec2 at, RecordCandidate& site);

/// What is seen first through the pixels that `level` adds to the levels before.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT std::vector<RecordCandidate> CandidatesInImage(
  const RayScene& rays, int level, const ProgressCallback& progress = {});

}
#endif
