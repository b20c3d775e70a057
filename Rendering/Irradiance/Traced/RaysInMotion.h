// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Distributes the rays of a frame in motion over its pixels: those with few samples get the most.
#ifndef penumbra_RaysInMotion_h
#define penumbra_RaysInMotion_h

#include "Frame/Stage.h"
#include "TracedOcclusion.h"

#include <vector>

namespace penumbra
{

/// Number of phases of sparse frames: in each, one of as many pixels has its turn.
constexpr int MotionPhases = 4;

/// The rays that a frame in motion may have.
struct MotionRayLimits
{
  double Affordable = 0.0; ///< number of rays of all pixels; exceeded for the requested ones
  int PerPixel = 1;        ///< requested number at a pixel with a long history
  bool Sparse = true;      ///< one of MotionPhases pixels gets them, if more are not affordable
  int Phase = 0;           ///< of these pixels, in [0, MotionPhases)
};

struct RaysInMotion
{
  PixelRays LongHistory;    ///< of pixels that have enough samples
  PixelRays ShortHistory;   ///< of the others
  std::vector<char> Traced; ///< flags of the pixels with rays
  int PerPixel = 1;         ///< largest number in LongHistory
  int WithoutHistory = 1;   ///< number at a pixel without history
  bool IsSparse = false;
};

/// Fills the numbers of rays of the pixels in `parts` of an image with `width` columns, and adds them to the
/// numbers of samples. Each pixel without history gets at least one. `depths`: eye depths. `history`: sum
/// and number of the samples of each pixel.
void DistributeRays(const std::vector<float>& depths, std::vector<float>& history, int width,
  const std::vector<Rectangle>& parts, const MotionRayLimits& limits, RaysInMotion& result);

}
#endif
