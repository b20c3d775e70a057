// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How far a picture is from its truth, and whether its own estimate of that is honest. Colours in
// [0, 1], three channels a pixel; every error is a root mean square over pixels and channels.
#ifndef penumbra_ImageErrors_h
#define penumbra_ImageErrors_h

#include "BruteForce.h"

#include <vector>

namespace penumbra
{

struct Errors
{
  double Full = 0.0;          ///< over the whole picture
  double Edge = 0.0;          ///< over edge pixels
  double Worst = 0.0;         ///< largest difference of one channel
  std::size_t WorstPixel = 0; ///< where
  std::size_t EdgePixels = 0;
};

/// `isEdge`: per pixel, by the truth.
Errors Compare(const std::vector<glm::dvec3>& picture, const std::vector<glm::dvec3>& truth,
  const std::vector<bool>& isEdge);

/// Where the truth shows a silhouette.
std::vector<bool> SilhouettePixels(const BruteForcePicture& truth);

/// Where a covered share lies strictly between none and all.
std::vector<bool> PartlyCoveredPixels(const std::vector<double>& shares);

/// One pixel's colours from shares, white on black.
std::vector<glm::dvec3> WhiteOnBlack(const std::vector<double>& shares);

/// Estimated against true error of every tile of 16 x 16 pixels.
struct ErrorCalibration
{
  std::size_t Tiles = 0;
  std::size_t ConservativeTiles = 0; ///< the RMS of the estimate is at least the true RMSE
  std::vector<double> Ratios;        ///< estimate / truth, of tiles with a true RMSE above 1e-4
  double ConservativeFraction() const;
  double MedianRatio() const; ///< 0 without such tiles
};

/// Adds the tiles of one picture. `estimates`: per pixel.
void AddTiles(ErrorCalibration& honesty, const std::vector<glm::dvec3>& picture,
  const std::vector<glm::dvec3>& truth, const std::vector<double>& estimates, int width);

/// Cost at which a ladder of (error, cost) reaches `error`: straight lines between logarithms,
/// carried on beyond both ends. Steps that cost more and are no better than an earlier one do not
/// count.
double CostAtError(std::vector<glm::dvec2> ladder, double error);

}
#endif
