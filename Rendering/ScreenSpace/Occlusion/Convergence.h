// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Stopping rule of a static view. Each time the number of samples has doubled, every tile of 16 x
// 16 pixels is compared with its previous values. Their difference estimates the remaining error.
// Tiles within the tolerance receive no more samples.
#ifndef penumbra_Convergence_h
#define penumbra_Convergence_h

#include "Frame/Stage.h"

#include "vtkType.h"

#include <functional>
#include <vector>

namespace penumbra
{

class Convergence
{
public:
  /// Starts again after the view or the scene changed: all tiles are active. `staleSamples`: weight
  /// of earlier samples on average, which may be wrong.
  void Restart(double staleSamples = 0.0);

  /// Activates all tiles because the tolerance has decreased. All samples remain valid.
  void ReactivateTiles();

  /// Records `samples` more samples in the active tiles and updates the errors when a check is due.
  /// `read` returns the image with its margin, which is negative: one value per pixel, row by row in rows of
  /// `width` pixels, negative at empty pixels. Active tiles end at `image`, so that the margin never has samples.
  void Add(int samples, int width, const Rectangle& image, double tolerance,
    const std::function<std::vector<float>()>& read);

  /// Sets the state of an image whose error is known: of the whole image, or of its worst tile.
  void SetError(int samples, double error, bool isDone);

  /// Number of samples per pixel in active tiles.
  int GetSamples() const { return this->Samples; }

  /// Number of samples until the next check.
  int GetSamplesUntilCheck() const;

  /// Number of samples at the last check.
  int GetSamplesAtCheck() const { return this->SamplesAtCheck; }

  /// Returns true if no tile is active.
  bool IsDone() const { return this->HasErrors && this->ActiveTiles.empty(); }

  /// Returns false if no errors have been computed yet: the whole image is active.
  bool HasTileErrors() const { return this->HasErrors; }

  /// Active tiles in pixels; adjacent tiles of a row are merged.
  const std::vector<Rectangle>& GetActiveTiles() const { return this->ActiveTiles; }

  /// Largest estimated error of a tile; VTK_DOUBLE_MAX before the first check.
  double GetLargestError() const { return this->LargestError; }

private:
  void UpdateTileErrors(
    const std::vector<float>& now, int width, const Rectangle& image, double tolerance);

  double StaleSamples = 0.0;
  int Samples = 0;
  int SamplesAtCheck = 0;
  bool HasErrors = false;
  std::vector<float> PreviousValues;
  std::vector<double> TileErrors; ///< squared; negative: the tile is active
  std::vector<Rectangle> ActiveTiles;
  double LargestError = VTK_DOUBLE_MAX;
};

}
#endif
