// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A film: the frames of `penumbra animate` with the inputs, options and output files of each.
#ifndef penumbra_Film_h
#define penumbra_Film_h

#include "Files/JsonObject.h"
#include "FilmOptions.h"
#include "StepInput.h"

#include <optional>
#include <string>
#include <vector>

namespace penumbra
{

class Film
{
public:
  /// Plans the frames; reads the times of the files in worker processes if they may have time
  /// steps. Throws CommandError if the options do not fit the files.
  explicit Film(const FilmOptions& options);

  const FilmOptions& GetOptions() const { return this->Options; }
  int GetNumberOfFrames() const { return this->Options.Frames; }

  /// Exit status of reading the times; the film has no frames unless it is Done.
  int GetStatus() const { return this->Status; }

  /// Returns whether each frame shows another time step.
  bool IsSeries() const { return !this->Times.empty(); }

  /// Returns whether a frame belongs to the part of the film to render.
  bool IsWanted(int frame) const;

  /// Returns whether --resume keeps the image of a frame.
  bool IsUpToDate(int frame) const;

  /// Returns the text that identifies a frame by its input files, options and program version.
  std::string GetFingerprint(int frame) const;

  StepInput GetInput(int frame) const;

  /// Returns the render options of a frame. Defaults are fixed if they are known.
  RenderOptions GetFrameOptions(int frame) const;

  /// Computes the time in [0, 1] of a frame. Whole turns stop one step before 1, so that they loop
  /// without a repeated frame; other motions end at 1.
  double ComputeFraction(int frame) const;

  /// Reads the defaults that depend on the data in worker processes, from the first frame that
  /// shows a surface. A frame before it that cannot be read is an error if no image reports it.
  /// Returns an exit status.
  int FindDefaults();

  /// Returns whether defaults are known, by FindDefaults() or from the file of --defaults.
  bool HasDefaults() const { return !this->Defaults.empty(); }

  /// Writes the file of --prepare.
  void WriteDefaults() const;

private:
  void ReadDefaults();
  void PlanSteps();
  std::vector<StepInput> GetAllSteps() const;
  void CheckPart() const;
  void CheckOutputs() const;

  FilmOptions Options;
  int Status = 0;
  std::vector<double> Times; ///< of each frame; empty: the time does not change
  std::vector<std::string> TimeTexts;
  std::optional<double> FixedTime; ///< of all frames
  std::vector<double> AllTimes;    ///< of the files, also those that no frame shows
  JsonObject Defaults;             ///< of DescribeFrozen()
  std::string Identity;            ///< text that all frames have in common
};

}
#endif
