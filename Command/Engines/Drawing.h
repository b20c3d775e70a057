// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What `render` and `animate` share: meshes are read, and a picture is saved with its statistics.
#ifndef penumbra_Drawing_h
#define penumbra_Drawing_h

#include "Engine.h"
#include "Files/PendingFile.h"

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
struct Preparation
{
  Clock::time_point Start; ///< of all
  double ReadSeconds = 0.0;
  double SceneSeconds = 0.0;
};

/// The files of one picture; refused before any work is done where they cannot be written.
class PictureFiles
{
public:
  explicit PictureFiles(const RenderOptions& options);

  /// Write the picture and its statistics and give them their names. `note`: into a .png. The
  /// warnings are those of the drawing, and why the picture shows nothing where it does.
  std::vector<std::string> Save(const Picture& picture, vtkRenderer* renderer,
    const RenderOptions& options, const Preparation& preparation, const std::string& note = "");

private:
  PendingFile Output;
  std::optional<PendingFile> Statistics;
};

/// Record the files that `options` name as inputs.
void RecordInputs(const RenderOptions& options);

/// Throws Failure where a file that is read, or the other one that is written, would be written over.
void CheckFiles(const RenderOptions& picture);

}
#endif
