// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the failure catalogue measures, each defined once. Values are brightness or occlusion in [0, 1]
// unless a metric says otherwise.
#ifndef penumbra_stability_Metrics_h
#define penumbra_stability_Metrics_h

#include <string>
#include <vector>

namespace penumbra
{

/// One channel, row after row from below.
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

/// Name and definition, for people.
struct MetricText
{
  std::string Name;
  std::string Definition;
};
MetricText TextOf(Metric metric);

/// RMS of the difference; huge where sizes differ or a value is not finite.
double Rmse(const std::vector<double>& a, const std::vector<double>& b);

/// Largest difference; huge likewise.
double LargestDifference(const std::vector<double>& a, const std::vector<double>& b);

/// Flicker: RMS over points of the standard deviation over time. `times`: the values of the same
/// surface points, one list an instant.
double Flicker(const std::vector<std::vector<double>>& times);

/// Pop: largest change of a value from one instant to the next.
double Pop(const std::vector<std::vector<double>>& times);

/// Ghost length: instants until the error of all that follow is at most `limit`.
double GhostLength(const std::vector<double>& errors, double limit = .03);

/// Coverage miss: sum of |difference| over what the truth covers.
double CoverageMiss(const std::vector<double>& shares, const std::vector<double>& truth);

/// Energy: (largest - least) / mean of the sums of values, an instant each.
double EnergyChange(const std::vector<std::vector<double>>& times);

/// The picture seen in a mirror that stands upright beside it.
Frame Mirrored(const Frame& frame);

/// The picture turned by 90 degrees, counter-clockwise. Square ones only.
Frame Turned(const Frame& frame);

/// Means of 2x2 pixels.
Frame Halved(const Frame& frame);

}
#endif
