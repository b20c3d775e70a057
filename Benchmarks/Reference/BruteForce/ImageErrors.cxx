// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageErrors.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

Errors Compare(const std::vector<glm::dvec3>& image, const std::vector<glm::dvec3>& truth,
  const std::vector<bool>& isEdge)
{
  Errors errors;
  double full = 0.0;
  double edge = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const glm::dvec3 difference = glm::abs(image[i] - truth[i]);
    const double square = glm::dot(difference, difference) / 3.0;
    full += square;
    if (isEdge[i])
    {
      edge += square;
      ++errors.EdgePixels;
    }
    const double largest = std::max({ difference.x, difference.y, difference.z });
    if (largest > errors.Worst)
    {
      errors.Worst = largest;
      errors.WorstPixel = i;
    }
  }
  errors.Full = std::sqrt(full / std::max<std::size_t>(truth.size(), 1));
  errors.Edge = std::sqrt(edge / std::max<std::size_t>(errors.EdgePixels, 1));
  return errors;
}

std::vector<bool> SilhouettePixels(const BruteForceImage& truth)
{
  std::vector<bool> pixels(truth.Kinds.size());
  std::transform(truth.Kinds.begin(), truth.Kinds.end(), pixels.begin(),
    [](PixelKind kind) { return kind == PixelKind::Silhouette; });
  return pixels;
}

std::vector<bool> PartlyCoveredPixels(const std::vector<double>& shares)
{
  std::vector<bool> pixels(shares.size());
  std::transform(shares.begin(), shares.end(), pixels.begin(),
    [](double share) { return share > 1e-9 && share < 1.0 - 1e-9; });
  return pixels;
}

std::vector<glm::dvec3> WhiteOnBlack(const std::vector<double>& shares)
{
  std::vector<glm::dvec3> colors(shares.size());
  std::transform(
    shares.begin(), shares.end(), colors.begin(), [](double share) { return glm::dvec3(share); });
  return colors;
}

double ErrorCalibration::ConservativeFraction() const
{
  return this->Tiles ? static_cast<double>(this->ConservativeTiles) / this->Tiles : 1.0;
}

double ErrorCalibration::MedianRatio() const
{
  std::vector<double> sorted = this->Ratios;
  if (sorted.empty())
  {
    return 0.0;
  }
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  return sorted[sorted.size() / 2];
}

void AddTiles(ErrorCalibration& honesty, const std::vector<glm::dvec3>& image,
  const std::vector<glm::dvec3>& truth, const std::vector<double>& estimates, int width)
{
  constexpr int size = 16;
  // A sampled reference has an error of this size itself.
  constexpr double exactness = 2e-5;
  const int height = static_cast<int>(truth.size()) / width;
  for (int tileY = 0; tileY < height; tileY += size)
  {
    for (int tileX = 0; tileX < width; tileX += size)
    {
      double error = 0.0;
      double estimate = 0.0;
      int count = 0;
      for (int y = tileY; y < std::min(tileY + size, height); ++y)
      {
        for (int x = tileX; x < std::min(tileX + size, width); ++x, ++count)
        {
          const std::size_t i = static_cast<std::size_t>(y) * width + x;
          const glm::dvec3 difference = image[i] - truth[i];
          error += glm::dot(difference, difference) / 3.0;
          estimate += estimates[i] * estimates[i];
        }
      }
      error = std::sqrt(error / count);
      estimate = std::sqrt(estimate / count);
      ++honesty.Tiles;
      honesty.ConservativeTiles += estimate + exactness >= error;
      honesty.LargestError = std::max(honesty.LargestError, error);
      if (error > 1e-4)
      {
        honesty.Ratios.push_back(estimate / error);
      }
    }
  }
}

bool IsExtrapolated(const std::vector<glm::dvec2>& ladder, double error)
{
  const auto [minimum, maximum] = std::minmax_element(ladder.begin(), ladder.end(),
    [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; });
  return minimum == ladder.end() || error < minimum->x || error > maximum->x;
}

double CostAtError(std::vector<glm::dvec2> ladder, double error)
{
  std::sort(ladder.begin(), ladder.end(), [](auto a, auto b) { return a.y < b.y; });
  std::vector<glm::dvec2> steps;
  for (const glm::dvec2& step : ladder)
  {
    if (steps.empty() || step.x < steps.back().x)
    {
      steps.push_back(step);
    }
  }
  if (steps.size() < 2)
  {
    return steps.empty() ? 0.0 : steps.front().y;
  }
  std::size_t i = 1;
  while (i + 1 < steps.size() && steps[i].x > error)
  {
    ++i;
  }
  const glm::dvec2 a = glm::log(steps[i - 1]);
  const glm::dvec2 b = glm::log(steps[i]);
  return std::exp(a.y + (b.y - a.y) * (std::log(error) - a.x) / (b.x - a.x));
}

}
