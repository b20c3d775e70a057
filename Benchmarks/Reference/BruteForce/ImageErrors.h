// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Errors of an image against a reference, and the quality of the image's own error estimate. Colors
// are in [0, 1] with three channels per pixel; every error is an RMSE over pixels and channels.
#ifndef penumbra_ImageErrors_h
#define penumbra_ImageErrors_h

#include "BruteForce.h"

#include <vector>

namespace penumbra
{

struct Errors
{
  double Full = 0.0;          ///< over the whole image
  double Edge = 0.0;          ///< over edge pixels
  double Worst = 0.0;         ///< largest difference of one channel
  std::size_t WorstPixel = 0; ///< where
  std::size_t EdgePixels = 0;
};

/// `isEdge`: one flag per pixel, from the reference.
Errors Compare(const std::vector<glm::dvec3>& image, const std::vector<glm::dvec3>& truth,
  const std::vector<bool>& isEdge);

/// Pixels in which the reference contains a silhouette.
std::vector<bool> SilhouettePixels(const BruteForceImage& truth);

/// Pixels with a coverage strictly between 0 and 1.
std::vector<bool> PartlyCoveredPixels(const std::vector<double>& shares);

/// Colors of pixels from their coverage, white on black.
std::vector<glm::dvec3> WhiteOnBlack(const std::vector<double>& shares);

/// Estimated and actual errors of all tiles of 16 x 16 pixels.
struct ErrorCalibration
{
  std::size_t Tiles = 0;
  std::size_t ConservativeTiles = 0; ///< the RMS of the estimate is at least the true RMSE
  double LargestError = 0.0;         ///< largest actual RMSE of a tile
  std::vector<double> Ratios; ///< estimated / actual RMSE, of tiles with an actual RMSE above 1e-4
  double ConservativeFraction() const;
  double MedianRatio() const; ///< 0 without such tiles
};

/// Adds the tiles of one image. `estimates`: one value per pixel.
void AddTiles(ErrorCalibration& honesty, const std::vector<glm::dvec3>& image,
  const std::vector<glm::dvec3>& truth, const std::vector<double>& estimates, int width);

/// Returns the cost at which a series of (error, cost) pairs attains `error`, by linear
/// interpolation between logarithms, with extrapolation beyond both ends. Pairs that cost more than
/// an earlier one without a smaller error are ignored.
double CostAtError(std::vector<glm::dvec2> ladder, double error);

/// Whether CostAtError() extrapolates: `error` is outside the range of the series.
bool IsExtrapolated(const std::vector<glm::dvec2>& ladder, double error);

}
#endif
