// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Metrics of vtkPenumbraImageComparison over plain arrays. Private to this module.
#ifndef penumbra_ImageMetrics_h
#define penumbra_ImageMetrics_h

#include <array>
#include <cstddef>
#include <vector>

namespace penumbra
{

/// An image in four planes: red, green and blue times alpha, then alpha; row by row.
struct Planes
{
  int Width = 0;
  int Height = 0;
  bool Opaque = true; ///< true if alpha is 1 everywhere
  std::array<std::vector<double>, 4> Channels;
};

/// Mask of the pixels that count, row by row; empty: all. The two images must be equal in the other
/// pixels, because tiles and the windows of the similarity include them.
using Mask = std::vector<bool>;

/// Number of channels that count: three if both images are opaque, else four.
int ComparedChannels(const Planes& a, const Planes& b);

double RootMeanSquare(const Planes& a, const Planes& b, const Mask& mask);
double LargestDifference(const Planes& a, const Planes& b);
double StructuralDissimilarity(const Planes& a, const Planes& b, const Mask& mask);
double FractionOfDifferentPixels(const Planes& a, const Planes& b, const Mask& mask);

/// RMSE and fraction of differing pixels of the worst tile of 16x16 pixels at any position.
double WorstTileRootMeanSquare(const Planes& a, const Planes& b);
double WorstTileFractionOfDifferentPixels(const Planes& a, const Planes& b);

}
#endif
