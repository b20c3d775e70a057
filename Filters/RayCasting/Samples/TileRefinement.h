// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Distributes samples over the pixels of a tile until the error of the tile is small enough.
#ifndef penumbra_TileRefinement_h
#define penumbra_TileRefinement_h

#include "PixelSampler.h"

#include <vector>

namespace penumbra
{

/**
 * Refines `pixels`, the sampled pixels of a tile of `count` pixels, until the estimated RMSE of the
 * tile is below the tolerance and no error of a pixel is far above it, or until the maximum number
 * of samples is reached. `squaredError` is the sum of the squared estimated errors of the other
 * pixels of the tile. Returns false if the limit of the integration ended the refinement.
 */
bool RefineTile(
  PixelSampler& sampler, const std::vector<SampledPixel*>& pixels, int count, double squaredError);

}
#endif
