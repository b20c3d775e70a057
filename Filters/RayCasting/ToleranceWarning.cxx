// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ToleranceWarning.h"

#include "Vectors.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace penumbra
{
namespace
{

constexpr int TileSide = 16;
// Number and fraction of tiles above the tolerance from which on there is a warning.
constexpr vtkIdType ReportedTiles = 4;
constexpr double ReportedFraction = 0.01;
// Relative rounding error of the estimated errors, which are floats.
constexpr double RoundingError = 1e-6;

/// Mean squared errors of a tile.
struct TileError
{
  double Total = 0.0;
  double Light = 0.0; ///< part that light effects cause
};

/// Estimated errors of the tiles of an image.
struct TileErrors
{
  vtkIdType Tiles = 0;
  vtkIdType AboveTolerance = 0;
  vtkIdType AboveLightTolerance = 0; ///< number of them whose light error exceeds its own tolerance
  vtkIdType AboveOther = 0;          ///< number of them whose other error exceeds its own tolerance
  double MaximumError = 0.0;         ///< largest RMSE of a tile
};

/// Pixels outside of the extent of `image` count as exact.
TileError ComputeTileError(vtkImageData* image, const glm::ivec2& resolution, int x, int y)
{
  const auto find = [image](const char* name) {
    return vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(name));
  };
  vtkFloatArray* errors = find("EstimatedError");
  vtkFloatArray* lightErrors = find("EstimatedLightError");
  int extent[6];
  image->GetExtent(extent);
  TileError error;
  for (int j = std::max(y, extent[2]); j <= std::min(y + TileSide - 1, extent[3]); ++j)
  {
    for (int i = std::max(x, extent[0]); i <= std::min(x + TileSide - 1, extent[1]); ++i)
    {
      const vtkIdType pixel =
        static_cast<vtkIdType>(j - extent[2]) * (extent[1] - extent[0] + 1) + i - extent[0];
      error.Total += Square<double>(errors->GetValue(pixel));
      error.Light += lightErrors ? Square<double>(lightErrors->GetValue(pixel)) : 0.0;
    }
  }
  const int count = std::min(TileSide, resolution.x - x) * std::min(TileSide, resolution.y - y);
  error.Total /= count;
  error.Light /= count;
  return error;
}

TileErrors EvaluateTiles(
  vtkImageData* image, const glm::ivec2& resolution, const IntegrationSettings& settings)
{
  int extent[6];
  image->GetExtent(extent);
  const double limit = (1.0 + RoundingError) * settings.GetTileTolerance();
  TileErrors tiles;
  for (int y = extent[2] / TileSide * TileSide; y <= extent[3]; y += TileSide)
  {
    for (int x = extent[0] / TileSide * TileSide; x <= extent[1]; x += TileSide)
    {
      const TileError error = ComputeTileError(image, resolution, x, y);
      ++tiles.Tiles;
      tiles.MaximumError = std::max(tiles.MaximumError, std::sqrt(error.Total));
      if (std::sqrt(error.Total) > limit)
      {
        ++tiles.AboveTolerance;
        tiles.AboveLightTolerance += error.Light > Square<double>(settings.LightTolerance) ? 1 : 0;
        tiles.AboveOther += error.Total - error.Light > Square<double>(settings.Tolerance) ? 1 : 0;
      }
    }
  }
  return tiles;
}

/// Returns the properties whose increase brings most of the tiles within the tolerance; empty if the caller's
/// property does not.
std::string FindRemedy(const TileErrors& tiles, const std::string& property)
{
  const bool light = tiles.AboveLightTolerance > 0;
  if (!property.empty())
  {
    return light ? " Increase " + property + "." : "";
  }
  if (light && tiles.AboveOther > 0)
  {
    return " Increase Tolerance and LightTolerance.";
  }
  return light ? " Increase LightTolerance." : " Increase Tolerance.";
}

}

ToleranceReport CheckTolerance(const IntegrationSettings& settings,
  const RayCasterConstants& constants, const ImageTotals& totals, double timeLimit,
  vtkImageData* image, const glm::ivec2& resolution)
{
  const TileErrors tiles = EvaluateTiles(image, resolution, settings);
  const double limit = settings.GetTileTolerance();
  const double error = totals.ComputeError(image->GetNumberOfPoints());
  const bool isReported = timeLimit > 0.0 || tiles.AboveTolerance >= ReportedTiles ||
    tiles.AboveTolerance >= ReportedFraction * static_cast<double>(tiles.Tiles) ||
    error > (1.0 + RoundingError) * limit;
  const bool hasMethod = timeLimit > 0.0 || settings.Method != CoverageMethods::Uniform;
  ToleranceReport report{ tiles.AboveTolerance, {} };
  if (!isReported || !hasMethod || tiles.AboveTolerance == 0)
  {
    return report;
  }
  std::ostringstream text;
  if (timeLimit > 0.0)
  {
    text << "The time limit of " << timeLimit << " s ended the work. ";
  }
  const std::string& property = constants.ToleranceProperty;
  text << "The tolerance of " << (property.empty() ? limit : constants.ToleranceValue)
       << " was not reached in " << tiles.AboveTolerance << " of " << tiles.Tiles
       << " tiles of 16x16 pixels. The largest estimated error of a tile is " << tiles.MaximumError
       << "." << (timeLimit > 0.0 ? " Increase TimeLimit." : FindRemedy(tiles, property));
  report.Warning = text.str();
  return report;
}

}
