// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Convergence.h"

#include "Frame/ScreenSpaceConstants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace penumbra
{

namespace
{

/// Width and height of a tile, in pixels.
constexpr int TileSide = 16;

/// Returns the tile at a position, as far as it lies in the image.
Rectangle MakeTile(int x, int y, const Rectangle& image)
{
  const int left = std::max(x, image.X);
  const int bottom = std::max(y, image.Y);
  return { left, bottom, std::min(x + TileSide, image.X + image.Width) - left,
    std::min(y + TileSide, image.Y + image.Height) - bottom };
}

}

void Convergence::Restart(double staleSamples)
{
  *this = Convergence();
  this->StaleSamples = staleSamples;
}

void Convergence::ReactivateTiles()
{
  // Converged tiles have fewer samples than active ones, so the next check overestimates their
  // error.
  this->HasErrors = false;
  this->TileErrors.clear();
  this->ActiveTiles.clear();
  this->LargestError = VTK_DOUBLE_MAX;
}

void Convergence::SetError(int samples, double error, bool isDone)
{
  *this = Convergence();
  this->Samples = samples;
  this->HasErrors = isDone;
  this->LargestError = error;
}

int Convergence::GetSamplesUntilCheck() const
{
  return std::max(FirstConvergenceCheck, 2 * this->SamplesAtCheck) - this->Samples;
}

void Convergence::Add(int samples, int width, const Rectangle& image, double tolerance,
  const std::function<std::vector<float>()>& read)
{
  this->Samples += samples;
  if (this->GetSamplesUntilCheck() > 0)
  {
    return;
  }
  std::vector<float> now = read();
  if (now.size() == this->PreviousValues.size() && width > 0)
  {
    this->UpdateTileErrors(now, width, image, tolerance);
  }
  this->PreviousValues = std::move(now);
  this->SamplesAtCheck = this->Samples;
}

void Convergence::UpdateTileErrors(
  const std::vector<float>& now, int width, const Rectangle& image, double tolerance)
{
  const int height = static_cast<int>(now.size()) / width;
  // If c stale samples have the error e, c e / (c + 2 n) remains after 2 n new samples: the change
  // since n new samples, times 1 + c / n.
  const double scale =
    ErrorPerDifference * (1.0 + this->StaleSamples / std::max(this->SamplesAtCheck, 1));
  const int columns = (width + TileSide - 1) / TileSide;
  const int rows = (height + TileSide - 1) / TileSide;
  std::vector<double> squaredSums(static_cast<std::size_t>(columns) * rows, 0.0);
  std::vector<double> offsetSums(squaredSums.size(), 0.0);
  std::vector<int> counts(squaredSums.size(), 0);
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i)
    {
      const std::size_t pixel = static_cast<std::size_t>(j) * width + i;
      const std::size_t tile = static_cast<std::size_t>(j / TileSide) * columns + i / TileSide;
      const double difference =
        scale * (static_cast<double>(now[pixel]) - this->PreviousValues[pixel]);
      squaredSums[tile] += now[pixel] >= 0.f ? difference * difference : 0.0;
      offsetSums[tile] += now[pixel] >= 0.f ? difference : 0.0;
      counts[tile] += now[pixel] >= 0.f;
    }
  }

  // Converged tiles keep their error, because they received no samples.
  this->TileErrors.resize(squaredSums.size(), -1.0);
  this->ActiveTiles.clear();
  this->LargestError = 0.0;
  for (int tile = 0; tile < static_cast<int>(squaredSums.size()); ++tile)
  {
    const double converged = this->TileErrors[tile];
    const double error =
      converged >= 0.0 ? converged : squaredSums[tile] / std::max(counts[tile], 1);
    this->LargestError = std::max(this->LargestError, std::sqrt(error));
    const double offset = TileOffsetWeight * offsetSums[tile] / std::max(counts[tile], 1);
    if (converged >= 0.0 || std::max(error, offset * offset) <= tolerance * tolerance)
    {
      this->TileErrors[tile] = error;
      continue;
    }
    const Rectangle rectangle =
      MakeTile(tile % columns * TileSide, tile / columns * TileSide, image);
    const bool joins = !this->ActiveTiles.empty() && this->ActiveTiles.back().Y == rectangle.Y &&
      this->ActiveTiles.back().X + this->ActiveTiles.back().Width == rectangle.X;
    if (joins)
    {
      this->ActiveTiles.back().Width += rectangle.Width;
    }
    else
    {
      this->ActiveTiles.push_back(rectangle);
    }
  }
  this->HasErrors = true;
}

}
