// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Convergence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace penumbra
{

namespace
{

constexpr int TileSide = 16;

/// The first comparison is not worth its reading before this many samples.
constexpr int FirstReading = 32;

/// The mean of 2 n samples is off by about its difference to the mean of n: with independent samples
/// exactly. More, because tiles are closed where that difference happens to be small; measured,
/// `./penumbra benchmark ambient-occlusion --only noise`.
constexpr double ErrorOfDifference = 1.25;

/// What all pixels of a tile have in common shows as a step to the next one, and counts so many times.
constexpr double WeightOfSteps = 4.0;

}

void Convergence::Restart(double carried)
{
  *this = Convergence();
  this->StaleSamples = carried;
}

void Convergence::Reopen()
{
  // Tiles that were closed have had fewer samples than others, so that the error that the next
  // comparison finds in them is too large rather than too small.
  this->Known = false;
  this->TileErrors.clear();
  this->Open.clear();
  this->LargestError = VTK_DOUBLE_MAX;
}

void Convergence::MarkConverged(int samples, double error)
{
  *this = Convergence();
  this->Samples = samples;
  this->Known = true;
  this->LargestError = error;
}

int Convergence::GetSamplesUntilCheck() const
{
  return std::max(FirstReading, 2 * this->SamplesAtReading) - this->Samples;
}

void Convergence::Add(
  int samples, int width, double tolerance, const std::function<std::vector<float>()>& read)
{
  this->Samples += samples;
  if (this->GetSamplesUntilCheck() > 0)
  {
    return;
  }
  std::vector<float> now = read();
  if (now.size() == this->PreviousValues.size() && width > 0)
  {
    this->UpdateTileErrors(now, width, tolerance);
  }
  this->PreviousValues = std::move(now);
  this->SamplesAtReading = this->Samples;
}

void Convergence::UpdateTileErrors(const std::vector<float>& now, int width, double tolerance)
{
  const int height = static_cast<int>(now.size()) / width;
  // Of c samples carried over, wrong by e, c e / (c + 2 n) is left after 2 n new ones: the change since
  // n new ones, times 1 + c / n.
  const double scale =
    ErrorOfDifference * (1.0 + this->StaleSamples / std::max(this->SamplesAtReading, 1));
  const int columns = (width + TileSide - 1) / TileSide;
  const int rows = (height + TileSide - 1) / TileSide;
  std::vector<double> sums(static_cast<std::size_t>(columns) * rows, 0.0);
  std::vector<double> steps(sums.size(), 0.0);
  std::vector<int> counts(sums.size(), 0);
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i)
    {
      const std::size_t at = static_cast<std::size_t>(j) * width + i;
      const std::size_t tile = static_cast<std::size_t>(j / TileSide) * columns + i / TileSide;
      const double difference = scale * (static_cast<double>(now[at]) - this->PreviousValues[at]);
      sums[tile] += now[at] >= 0.f ? difference * difference : 0.0;
      steps[tile] += now[at] >= 0.f ? difference : 0.0;
      counts[tile] += now[at] >= 0.f;
    }
  }

  // What was closed keeps its error: it has had no new samples.
  this->TileErrors.resize(sums.size(), -1.0);
  this->Open.clear();
  this->LargestError = 0.0;
  for (int tile = 0; tile < static_cast<int>(sums.size()); ++tile)
  {
    const double closed = this->TileErrors[tile];
    const double error = closed >= 0.0 ? closed : sums[tile] / std::max(counts[tile], 1);
    this->LargestError = std::max(this->LargestError, std::sqrt(error));
    const double step = WeightOfSteps * steps[tile] / std::max(counts[tile], 1);
    if (closed >= 0.0 || std::max(error, step * step) <= tolerance * tolerance)
    {
      this->TileErrors[tile] = error;
      continue;
    }
    const Rectangle part{ tile % columns * TileSide, tile / columns * TileSide, TileSide,
      TileSide };
    const bool joins = !this->Open.empty() && this->Open.back().Y == part.Y &&
      this->Open.back().X + this->Open.back().Width == part.X;
    if (joins)
    {
      this->Open.back().Width += TileSide;
    }
    else
    {
      this->Open.push_back(part);
    }
  }
  this->Known = true;
}

}
