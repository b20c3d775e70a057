// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Metrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace penumbra
{

namespace
{

/// What no bound allows.
constexpr double Huge = 1e9;

bool AreComparable(const std::vector<double>& a, const std::vector<double>& b)
{
  const auto isFinite = [](double value) { return std::isfinite(value); };
  return a.size() == b.size() && !a.empty() && std::all_of(a.begin(), a.end(), isFinite) &&
    std::all_of(b.begin(), b.end(), isFinite);
}

}

MetricText TextOf(Metric metric)
{
  switch (metric)
  {
    case Metric::Flicker:
      return { "flicker",
        "standard deviation over time of what the same surface point shows, RMS over points" };
    case Metric::Pop:
      return { "pop", "largest change of a pixel between one frame and the next" };
    case Metric::GhostLength:
      return { "ghost length", "frames until the error stays below .03" };
    case Metric::HaloWidth:
      return { "halo width", "pixels beside an edge that are darker by .03 than they should be" };
    case Metric::Leak:
      return { "leak", "largest share of what lies behind that shines through a closed surface" };
    case Metric::CoverageMiss:
      return { "coverage miss",
        "sum of the differences of covered shares from the truth, over the sum of the truth" };
    case Metric::Bias:
      return { "bias", "RMSE against the truth" };
    case Metric::Drift:
      return { "drift", "RMSE between a view and the same view after a closed loop of the camera" };
    case Metric::Energy:
      return { "energy", "(largest - least) / mean, of the sum of all pixels" };
    case Metric::Symmetry:
      return { "symmetry", "RMSE between the mirrored picture and that of the mirrored scene" };
    case Metric::UnitIndependence:
      return { "unit independence", "RMSE between pictures of a scene in two units of length" };
    case Metric::Rotation:
      return { "rotation",
        "RMSE between the turned picture and that of a camera turned by 90 degrees" };
    case Metric::Resolution:
      return { "resolution", "RMSE between a picture and the 2x2 means of one twice as large" };
    case Metric::MaximumDifference:
      return { "sameness", "largest difference of two pictures that must be the same" };
  }
  return {};
}

double Rmse(const std::vector<double>& a, const std::vector<double>& b)
{
  if (!AreComparable(a, b))
  {
    return Huge;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double LargestDifference(const std::vector<double>& a, const std::vector<double>& b)
{
  if (!AreComparable(a, b))
  {
    return Huge;
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

double Flicker(const std::vector<std::vector<double>>& times)
{
  const auto instants = static_cast<double>(times.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < times.front().size(); ++i)
  {
    double mean = 0.0;
    double square = 0.0;
    for (const std::vector<double>& values : times)
    {
      mean += values[i] / instants;
      square += values[i] * values[i] / instants;
    }
    sum += std::max(0.0, square - mean * mean);
  }
  const double flicker = std::sqrt(sum / static_cast<double>(times.front().size()));
  return std::isfinite(flicker) ? flicker : Huge;
}

double Pop(const std::vector<std::vector<double>>& times)
{
  double largest = 0.0;
  for (std::size_t i = 1; i < times.size(); ++i)
  {
    largest = std::max(largest, LargestDifference(times[i - 1], times[i]));
  }
  return largest;
}

double GhostLength(const std::vector<double>& errors, double limit)
{
  std::size_t last = errors.size();
  while (last > 0 && errors[last - 1] <= limit)
  {
    --last;
  }
  return static_cast<double>(last);
}

double CoverageMiss(const std::vector<double>& shares, const std::vector<double>& truth)
{
  if (!AreComparable(shares, truth))
  {
    return Huge;
  }
  double missed = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    missed += std::abs(shares[i] - truth[i]);
  }
  return missed / std::accumulate(truth.begin(), truth.end(), 0.0);
}

double EnergyChange(const std::vector<std::vector<double>>& times)
{
  std::vector<double> sums;
  for (const std::vector<double>& values : times)
  {
    sums.push_back(std::accumulate(values.begin(), values.end(), 0.0));
  }
  const auto [least, largest] = std::minmax_element(sums.begin(), sums.end());
  const double mean =
    std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(sums.size());
  const double change = (*largest - *least) / mean;
  return std::isfinite(change) ? change : Huge;
}

Frame Mirrored(const Frame& frame)
{
  Frame result = frame;
  for (int row = 0; row < frame.Height; ++row)
  {
    const auto first = result.Values.begin() + static_cast<std::ptrdiff_t>(row) * frame.Width;
    std::reverse(first, first + frame.Width);
  }
  return result;
}

Frame Turned(const Frame& frame)
{
  Frame result = frame;
  const int size = frame.Width;
  for (int i = 0; i < size * size; ++i)
  {
    const int x = i % size;
    const int y = i / size;
    result.Values[x * size + size - 1 - y] = frame.Values[i];
  }
  return result;
}

Frame Halved(const Frame& frame)
{
  Frame result{ frame.Width / 2, frame.Height / 2, {} };
  for (int i = 0; i < result.Width * result.Height; ++i)
  {
    const std::size_t corner = static_cast<std::size_t>(i / result.Width) * 2 * frame.Width +
      static_cast<std::size_t>(i % result.Width) * 2;
    result.Values.push_back(.25 *
      (frame.Values[corner] + frame.Values[corner + 1] + frame.Values[corner + frame.Width] +
        frame.Values[corner + frame.Width + 1]));
  }
  return result;
}

}
