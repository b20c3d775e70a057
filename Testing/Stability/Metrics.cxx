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

/// Above every bound of the catalogue.
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
        "standard deviation over time of the value of a surface point, RMS over points" };
    case Metric::Pop:
      return { "pop", "largest change of a pixel between one frame and the next" };
    case Metric::GhostLength:
      return { "ghost length", "frames until the error stays below 0.03" };
    case Metric::HaloWidth:
      return { "halo width",
        "number of pixels next to an edge that are darker than the reference by more than 0.03" };
    case Metric::Leak:
      return { "leak",
        "largest fraction of light from behind a closed surface that passes through it" };
    case Metric::CoverageMiss:
      return { "coverage miss",
        "sum of absolute errors of pixel coverage, divided by the sum of the exact coverage" };
    case Metric::Bias:
      return { "bias", "RMSE against the reference" };
    case Metric::Drift:
      return { "drift", "RMSE between a view and the same view after a closed camera path" };
    case Metric::Energy:
      return { "energy", "(maximum - minimum) / mean of the sum over all pixels, over frames" };
    case Metric::Symmetry:
      return { "symmetry", "RMSE between the mirrored image and an image of the mirrored scene" };
    case Metric::UnitIndependence:
      return { "unit independence", "RMSE between images of a scene in two units of length" };
    case Metric::Rotation:
      return { "rotation",
        "RMSE between the rotated image and an image of a camera rotated by 90 degrees" };
    case Metric::Resolution:
      return { "resolution",
        "RMSE between an image and the 2x2 means of one with twice the resolution" };
    case Metric::MaximumDifference:
      return { "maximum difference", "largest difference of two images that must be equal" };
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
  const auto frames = static_cast<double>(times.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < times.front().size(); ++i)
  {
    double mean = 0.0;
    double square = 0.0;
    for (const std::vector<double>& values : times)
    {
      mean += values[i] / frames;
      square += values[i] * values[i] / frames;
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

double CoverageMiss(const std::vector<double>& coverage, const std::vector<double>& reference)
{
  if (!AreComparable(coverage, reference))
  {
    return Huge;
  }
  double missed = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i)
  {
    missed += std::abs(coverage[i] - reference[i]);
  }
  return missed / std::accumulate(reference.begin(), reference.end(), 0.0);
}

double EnergyChange(const std::vector<std::vector<double>>& times)
{
  std::vector<double> sums;
  for (const std::vector<double>& values : times)
  {
    sums.push_back(std::accumulate(values.begin(), values.end(), 0.0));
  }
  const auto [minimum, largest] = std::minmax_element(sums.begin(), sums.end());
  const double mean =
    std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(sums.size());
  const double change = (*largest - *minimum) / mean;
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
