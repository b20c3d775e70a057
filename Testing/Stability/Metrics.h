// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Metrics of the failure catalogue. Values are brightness or occlusion in [0, 1] unless a metric
// says otherwise.
#ifndef penumbra_stability_Metrics_h
#define penumbra_stability_Metrics_h

#include <string>
#include <vector>

namespace penumbra
{

/// One channel of an image, row by row, bottom row first.
struct Frame
{
  int Width = 0;
  int Height = 0;
  std::vector<double> Values;
};

enum class Metric
{
  Flicker,
  Pop,
  GhostLength,
  HaloWidth,
  Leak,
  CoverageMiss,
  Bias,
  Drift,
  Energy,
  Symmetry,
  UnitIndependence,
  Rotation,
  Resolution,
  MaximumDifference
};

/// Name and definition of a metric, as printed in the document.
struct MetricText
{
  std::string Name;
  std::string Definition;
};
MetricText TextOf(Metric metric);

/// Returns the RMS difference, or a huge value if sizes differ or a value is not finite.
double Rmse(const std::vector<double>& a, const std::vector<double>& b);

/// Returns the largest absolute difference, or a huge value as Rmse() does.
double LargestDifference(const std::vector<double>& a, const std::vector<double>& b);

/// Flicker: RMS over points of the standard deviation over time. `times` holds the values of the
/// same surface points, one list per frame.
double Flicker(const std::vector<std::vector<double>>& times);

/// Pop: largest change of a value from one frame to the next.
double Pop(const std::vector<std::vector<double>>& times);

/// Ghost length: number of frames after which all errors are at most `limit`.
double GhostLength(const std::vector<double>& errors, double limit = 0.03);

/// Coverage miss: sum of absolute differences divided by the sum of the reference.
double CoverageMiss(const std::vector<double>& coverage, const std::vector<double>& reference);

/// Energy: (maximum - minimum) / mean of the sums of values, one sum per frame.
double EnergyChange(const std::vector<std::vector<double>>& times);

/// Returns the image mirrored left to right.
Frame Mirrored(const Frame& frame);

/// Returns the image rotated by 90 degrees counterclockwise. The image must be square.
Frame Turned(const Frame& frame);

/// Returns the image at half the resolution: means of 2x2 pixels.
Frame Halved(const Frame& frame);

}
#endif
