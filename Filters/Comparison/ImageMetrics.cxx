// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageMetrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace penumbra
{

int ComparedChannels(const Planes& a, const Planes& b)
{
  return a.Opaque && b.Opaque ? 3 : 4;
}

namespace
{

// Differences of up to four steps of 8 bits count as equal. The half step absorbs rounding.
constexpr double PixelThreshold = 4.0 / 255.0 + 1e-6;

constexpr int TileSize = 16;

double CountedPixels(const Planes& a, const Mask& mask)
{
  return static_cast<double>(
    mask.empty() ? a.Channels[0].size() : std::count(mask.begin(), mask.end(), true));
}

double LargestDifferenceOfPixel(const Planes& a, const Planes& b, std::size_t pixel)
{
  double largest = 0.0;
  for (int c = 0; c < ComparedChannels(a, b); ++c)
  {
    largest = std::max(largest, std::abs(a.Channels[c][pixel] - b.Channels[c][pixel]));
  }
  return largest;
}

// Returns the mean over the channels of every pixel.
std::vector<double> SquaredDifferences(const Planes& a, const Planes& b)
{
  const int channels = ComparedChannels(a, b);
  std::vector<double> squares(a.Channels[0].size(), 0.0);
  for (int c = 0; c < channels; ++c)
  {
    for (std::size_t i = 0; i < squares.size(); ++i)
    {
      const double difference = a.Channels[c][i] - b.Channels[c][i];
      squares[i] += difference * difference / channels;
    }
  }
  return squares;
}

// Returns 1 for every pixel that differs, else 0.
std::vector<double> PixelsOff(const Planes& a, const Planes& b)
{
  std::vector<double> off(a.Channels[0].size());
  for (std::size_t i = 0; i < off.size(); ++i)
  {
    off[i] = LargestDifferenceOfPixel(a, b, i) > PixelThreshold ? 1.0 : 0.0;
  }
  return off;
}

// Returns the largest mean over a tile. An image smaller than a tile is a single tile.
double WorstTileMean(const std::vector<double>& values, int width, int height)
{
  const int tileWidth = std::min(TileSize, width);
  const int tileHeight = std::min(TileSize, height);
  const int columns = width - tileWidth + 1;
  std::vector<double> rows(static_cast<std::size_t>(columns) * height, 0.0);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      const double* first = &values[static_cast<std::size_t>(y) * width + x];
      rows[static_cast<std::size_t>(y) * columns + x] =
        std::accumulate(first, first + tileWidth, 0.0);
    }
  }
  double worst = 0.0;
  for (int y = 0; y + tileHeight <= height; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      double sum = 0.0;
      for (int row = y; row < y + tileHeight; ++row)
      {
        sum += rows[static_cast<std::size_t>(row) * columns + x];
      }
      worst = std::max(worst, sum);
    }
  }
  return worst / (static_cast<double>(tileWidth) * tileHeight);
}

}

double RootMeanSquare(const Planes& a, const Planes& b, const Mask& mask)
{
  const std::vector<double> squares = SquaredDifferences(a, b);
  return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / CountedPixels(a, mask));
}

double LargestDifference(const Planes& a, const Planes& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.Channels[0].size(); ++i)
  {
    largest = std::max(largest, LargestDifferenceOfPixel(a, b, i));
  }
  return largest;
}

double FractionOfDifferentPixels(const Planes& a, const Planes& b, const Mask& mask)
{
  const std::vector<double> off = PixelsOff(a, b);
  return std::accumulate(off.begin(), off.end(), 0.0) / CountedPixels(a, mask);
}

double WorstTileRootMeanSquare(const Planes& a, const Planes& b)
{
  return std::sqrt(WorstTileMean(SquaredDifferences(a, b), a.Width, a.Height));
}

double WorstTileFractionOfDifferentPixels(const Planes& a, const Planes& b)
{
  return WorstTileMean(PixelsOff(a, b), a.Width, a.Height);
}

namespace
{

// The window of Wang et al. (2004): 11 x 11, sigma 1.5, a product of two of these.
constexpr int HalfWindow = 5;

std::array<double, 2 * HalfWindow + 1> GaussianWindow()
{
  std::array<double, 2 * HalfWindow + 1> weights;
  double sum = 0.0;
  for (int i = -HalfWindow; i <= HalfWindow; ++i)
  {
    weights[i + HalfWindow] = std::exp(-0.5 * i * i / (1.5 * 1.5));
    sum += weights[i + HalfWindow];
  }
  for (double& weight : weights)
  {
    weight /= sum;
  }
  return weights;
}

// Returns the mean of `line` around `center` under the window, normalized over the part inside.
double WeightedMean(const double* line, int stride, int length, int center)
{
  static const std::array<double, 2 * HalfWindow + 1> weights = GaussianWindow();
  double sum = 0.0;
  double weightSum = 0.0;
  const int first = std::max(center - HalfWindow, 0);
  const int last = std::min(center + HalfWindow, length - 1);
  for (int i = first; i <= last; ++i)
  {
    const double weight = weights[i - center + HalfWindow];
    sum += weight * line[static_cast<std::size_t>(i) * stride];
    weightSum += weight;
  }
  return sum / weightSum;
}

std::vector<double> Smooth(const std::vector<double>& plane, int width, int height)
{
  std::vector<double> rows(plane.size());
  std::vector<double> both(plane.size());
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      rows[static_cast<std::size_t>(y) * width + x] =
        WeightedMean(&plane[static_cast<std::size_t>(y) * width], 1, width, x);
    }
  }
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      both[static_cast<std::size_t>(y) * width + x] = WeightedMean(&rows[x], width, height, y);
    }
  }
  return both;
}

std::vector<double> SmoothProduct(
  const std::vector<double>& a, const std::vector<double>& b, int width, int height)
{
  std::vector<double> product(a.size());
  std::transform(a.begin(), a.end(), b.begin(), product.begin(),
    [](double left, double right) { return left * right; });
  return Smooth(product, width, height);
}

double SimilarityOfChannel(const std::vector<double>& a, const std::vector<double>& b, int width,
  int height, const Mask& mask)
{
  const double c1 = 0.01 * 0.01;
  const double c2 = 0.03 * 0.03;
  const std::vector<double> meanA = Smooth(a, width, height);
  const std::vector<double> meanB = Smooth(b, width, height);
  const std::vector<double> squareA = SmoothProduct(a, a, width, height);
  const std::vector<double> squareB = SmoothProduct(b, b, width, height);
  const std::vector<double> product = SmoothProduct(a, b, width, height);

  // Centers whose window lies inside the image, or all pixels if the image is smaller than the
  // window.
  const int marginX = width > 2 * HalfWindow ? HalfWindow : 0;
  const int marginY = height > 2 * HalfWindow ? HalfWindow : 0;
  double sum = 0.0;
  int centers = 0;
  for (int y = marginY; y < height - marginY; ++y)
  {
    for (int x = marginX; x < width - marginX; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      if (!mask.empty() && !mask[i])
      {
        continue;
      }
      const double varianceA = squareA[i] - meanA[i] * meanA[i];
      const double varianceB = squareB[i] - meanB[i] * meanB[i];
      const double covariance = product[i] - meanA[i] * meanB[i];
      sum += (2.0 * meanA[i] * meanB[i] + c1) * (2.0 * covariance + c2) /
        ((meanA[i] * meanA[i] + meanB[i] * meanB[i] + c1) * (varianceA + varianceB + c2));
      ++centers;
    }
  }
  return centers > 0 ? sum / centers : 1.0;
}

}

double StructuralDissimilarity(const Planes& a, const Planes& b, const Mask& mask)
{
  const int channels = ComparedChannels(a, b);
  double sum = 0.0;
  for (int c = 0; c < channels; ++c)
  {
    sum += SimilarityOfChannel(a.Channels[c], b.Channels[c], a.Width, a.Height, mask);
  }
  return 1.0 - sum / channels;
}

}
