// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// When is a still picture good enough? Each time its samples have doubled every tile of 16 x 16
// pixels is compared with what it was: by as much as the two differ it may still be wrong. Tiles
// within the tolerance get no more samples.
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
  /// The picture has moved: nothing is known, all is open. `carried` samples of before still weigh
  /// in the mean, and may be wrong.
  void Restart(double carried = 0.0);

  /// A smaller tolerance applies from now on: all is open again, all samples count.
  void Reopen();

  /// Tells of `samples` more samples in the open tiles; `read` fetches the picture when it is
  /// needed: one value a pixel, row after row, negative where there is nothing.
  void Add(
    int samples, int width, double tolerance, const std::function<std::vector<float>()>& read);

  /// All is known with this error: nothing is open.
  void MarkConverged(int samples, double error);

  /// What open tiles have had.
  int GetSamples() const { return this->Samples; }

  /// How many more make it look at the picture again.
  int GetSamplesUntilCheck() const;

  /// What they had when the picture was last looked at.
  int GetSamplesAtReading() const { return this->SamplesAtReading; }

  /// Nothing is open any more.
  bool IsDone() const { return this->Known && this->Open.empty(); }

  /// False: all of the picture is open.
  bool IsKnown() const { return this->Known; }

  /// Where tiles are open, neighbours joined.
  const std::vector<Rectangle>& GetActiveTiles() const { return this->Open; }

  /// The largest of the errors believed in of the tiles; infinite before they are known.
  double GetLargestError() const { return this->LargestError; }

private:
  void UpdateTileErrors(const std::vector<float>& now, int width, double tolerance);

  double StaleSamples = 0.0;
  int Samples = 0;
  int SamplesAtReading = 0;
  bool Known = false;
  std::vector<float> PreviousValues;
  std::vector<double> TileErrors; ///< squared; negative: open
  std::vector<Rectangle> Open;
  double LargestError = VTK_DOUBLE_MAX;
};

}
#endif
