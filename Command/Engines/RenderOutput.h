// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What `render` and `animate` share: meshes are read, and a picture is saved with its statistics.
#ifndef penumbra_RenderOutput_h
#define penumbra_RenderOutput_h

#include "Engine.h"
#include "Files/AtomicFile.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace penumbra
{

class ProgressLine;

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start);

/// `pattern` with every `place` in it replaced by `value`.
std::string ReplaceAll(std::string pattern, const std::string& place, const std::string& value);

/// The surfaces of all files, one after the other; what was left out of them goes to `warnings`.
std::vector<vtkSmartPointer<vtkPolyData>> ReadMeshes(const std::vector<std::string>& files,
  ProgressLine& progress, std::vector<std::string>& warnings);

/// What a picture took before it was drawn.
struct PhaseTimes
{
  Clock::time_point Start; ///< of all
  double ReadSeconds = 0.0;
  double SceneSeconds = 0.0;
};

/// The files of one picture; refused before any work is done where they cannot be written.
class OutputFiles
{
public:
  explicit OutputFiles(const RenderOptions& options);

  /// Write the picture and its statistics and give them their names. `note`: into a .png. The
  /// warnings are those of the drawing, and why the picture shows nothing where it does.
  std::vector<std::string> Save(const RenderResult& picture, vtkRenderer* renderer,
    const RenderOptions& options, const PhaseTimes& preparation, const std::string& note = "");

private:
  AtomicFile Output;
  std::optional<AtomicFile> Statistics;
};

/// Record the files that `options` name as inputs.
void RecordInputs(const RenderOptions& options);

/// Throws Failure where a file that is read, or the other one that is written, would be written over.
void CheckFiles(const RenderOptions& picture);

}
#endif
