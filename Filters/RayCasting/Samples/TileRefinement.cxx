// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TileRefinement.h"

#include "Pixels/CoverageConstants.h"
#include "Pixels/PixelErrors.h"
#include "Vectors.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Number of pixels of a tile that the border of the image does not clip.
constexpr int PixelsPerTile = 256;

/// Returns the power of the number of samples that reduces the squared error of a pixel.
double GetDecay(const SampledPixel& pixel)
{
  return pixel.Source == SampleSource::LitRays ? LitErrorDecay : SampledErrorDecay;
}

/// Estimates of the errors of pixels. Few samples estimate their own error poorly. Such a pixel is
/// therefore assigned a part of the mean over all sampled pixels.
class PooledErrors
{
public:
  explicit PooledErrors(const std::vector<SampledPixel*>& pixels)
  {
    double sum = 0.0;
    double count = 0.0;
    for (const SampledPixel* pixel : pixels)
    {
      if (pixel->GetNumberOfSamples() > 0)
      {
        sum += Square<double>(pixel->Result.Error) * ComputeDecay(*pixel);
        count += 1.0;
      }
    }
    this->Mean = count > 0.0 ? sum / count : 0.0;
  }

  double ComputeSquaredError(const SampledPixel& pixel) const
  {
    const double own = Square<double>(pixel.Result.Error);
    if (pixel.GetNumberOfSamples() == 0)
    {
      return own;
    }
    const double weight = PooledSamples / static_cast<double>(pixel.GetNumberOfSamples());
    return (own + weight * this->Mean / ComputeDecay(pixel)) / (1.0 + weight);
  }

private:
  /// Returns the factor by which samples reduce the squared error.
  static double ComputeDecay(const SampledPixel& pixel)
  {
    return std::pow(static_cast<double>(pixel.GetNumberOfSamples()), GetDecay(pixel));
  }

  double Mean = 0.0;
};

/// Returns the cost of the next samples of a pixel, in rays.
double ComputeCost(const SampledPixel& pixel)
{
  const double samples = std::max<double>(pixel.GetNumberOfSamples(), MinimumSamples);
  return !pixel.Textures.empty() ? samples / TexturedSamplesPerRay
    : pixel.IsTraced()           ? samples
                                 : samples / RasterizedSamplesPerRay;
}

struct Candidate
{
  SampledPixel* Pixel;
  double SquaredError;
  double Gain; ///< per ray
};

}

bool RefineTile(
  PixelSampler& sampler, const std::vector<SampledPixel*>& pixels, int count, double squaredError)
{
  const IntegrationSettings& settings = sampler.GetSettings();
  const bool isLit = !pixels.empty() && pixels.front()->Source == SampleSource::LitRays;
  // Samples show color and light together. Where light is to be more accurate than color, both are, so that the
  // part of the error that is reported for light is at most sqrt(2) times too small.
  const double lightTolerance = isLit ? settings.Light->GetTolerance() : 0.0;
  const double colorTolerance = isLit
    ? std::min<double>(settings.GetTileTolerance(), lightTolerance)
    : settings.GetTileTolerance();
  const double limit = Square<double>(colorTolerance) + Square<double>(lightTolerance);
  const double tileLimit = limit * count;
  const double pixelLimit = limit * Square<double>(MaximumPixelError);
  const int maximumSamples =
    std::min(SampleBudgetFactor * ComputeMaximumSamples(settings.Tolerance), MaximumSamples);
  // A few pixels may use the budget of the whole tile, even at the edge of the image.
  double budget = sampler.GetSampleBudget(isLit) * PixelsPerTile;
  std::vector<Candidate> candidates;
  bool isEnded = false;
  for (;;)
  {
    const PooledErrors pooled(pixels);
    double sum = squaredError;
    candidates.clear();
    for (SampledPixel* pixel : pixels)
    {
      const double square = pooled.ComputeSquaredError(*pixel);
      sum += square;
      if (static_cast<int>(pixel->GetNumberOfSamples()) < maximumSamples)
      {
        candidates.push_back({ pixel, square, square / ComputeCost(*pixel) });
      }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.Gain > b.Gain; });
    bool refined = false;
    for (const Candidate& candidate : candidates)
    {
      const double rays = ComputeCost(*candidate.Pixel);
      if ((sum > tileLimit || candidate.SquaredError > pixelLimit) && rays <= budget)
      {
        isEnded = isEnded || IsReached(settings.Limit);
        if (isEnded)
        {
          break;
        }
        sampler.Refine(*candidate.Pixel);
        sum -= (1.0 - std::exp2(-GetDecay(*candidate.Pixel))) * candidate.SquaredError;
        budget -= rays;
        refined = true;
      }
    }
    if (!refined || isEnded)
    {
      break;
    }
  }
  const PooledErrors pooled(pixels);
  for (SampledPixel* pixel : pixels)
  {
    pixel->Result.Error = static_cast<float>(std::sqrt(pooled.ComputeSquaredError(*pixel)));
    pixel->Result.LightError = isLit
      ? static_cast<float>(lightTolerance / std::sqrt(limit)) * pixel->Result.Error
      : std::min(pixel->Result.LightError, pixel->Result.Error);
  }
  return !isEnded;
}

}
