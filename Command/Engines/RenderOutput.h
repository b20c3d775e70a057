// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Input and output shared by `render` and `animate`: reads meshes, saves an image with its
// statistics.
#ifndef penumbra_RenderOutput_h
#define penumbra_RenderOutput_h

#include "Engine.h"
#include "Files/AtomicFile.h"
#include "Input/Surfaces.h"
#include "Processes/Clock.h"

#include <optional>
#include <string>
#include <vector>

namespace penumbra
{

class ProgressLine;

/// Returns what `options` request of the input files.
InputOptions GetInputOptions(
  const RenderOptions& options, std::optional<double> time, bool allowEmpty = false);

/// Reads the surfaces of all files in order. Skipped points and missing textures are reported in
/// `warnings`.
Surfaces ReadMeshes(const std::vector<std::string>& files, const InputOptions& input,
  ProgressLine& progress, std::vector<std::string>& warnings);

/// Times of the phases before rendering.
struct PhaseTimes
{
  Clock::time_point Start; ///< of the program
  double ReadSeconds = 0.0;
  double SceneSeconds = 0.0;
};

/// The output files of one image. The constructor throws CommandError if they cannot be written.
class OutputFiles
{
public:
  explicit OutputFiles(const RenderOptions& options);

  /// Writes the image and its statistics and renames them to their final names. `note`: text stored
  /// in a .png. Returns the warnings of the engine and a warning if the image is empty.
  std::vector<std::string> Save(const RenderResult& result, vtkRenderer* renderer,
    const RenderOptions& options, const PhaseTimes& preparation, const std::string& note = "");

private:
  AtomicFile Output;
  std::optional<AtomicFile> Statistics;
};

/// Records the files that `options` name as inputs.
void RecordInputs(const RenderOptions& options);

/// Creates the folders of the output files if they do not exist. Throws CommandError if it fails.
void CreateFolders(const RenderOptions& options);

/// Throws CommandError if an output would overwrite an input or the other output.
void CheckFiles(const RenderOptions& options);

}
#endif
