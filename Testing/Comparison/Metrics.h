// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The metrics of vtkPenumbraImageComparison over plain planes of numbers. Private to this module.
#ifndef penumbra_Metrics_h
#define penumbra_Metrics_h

#include <array>
#include <cstddef>
#include <vector>

namespace penumbra
{

/// A picture in four planes: red, green, blue times alpha, then alpha; row by row.
struct Planes
{
  int Width = 0;
  int Height = 0;
  bool Opaque = true; ///< alpha is 1 everywhere
  std::array<std::vector<double>, 4> Channels;
};

/// Which pixels count, row by row; empty: all. Two pictures must be alike where none counts: tiles
/// and the windows of the similarity reach across.
using Mask = std::vector<bool>;

/// Channels that count: three where both pictures are opaque, else four.
int ComparedChannels(const Planes& a, const Planes& b);

double RootMeanSquare(const Planes& a, const Planes& b, const Mask& mask);
double LargestDifference(const Planes& a, const Planes& b);
double StructuralDissimilarity(const Planes& a, const Planes& b, const Mask& mask);
double ShareOfPixelsOff(const Planes& a, const Planes& b, const Mask& mask);

/// Of all tiles of 16x16 pixels, wherever they lie, the worst: its RMSE, and its share of pixels off.
double WorstTileRootMeanSquare(const Planes& a, const Planes& b);
double WorstTileShareOfPixelsOff(const Planes& a, const Planes& b);

}
#endif
