// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From a scene to a picture: two engines behind one shape.
#ifndef penumbra_Engine_h
#define penumbra_Engine_h

#include "vtkSmartPointer.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

class vtkImageData;
class vtkRenderer;

namespace penumbra
{

struct RenderOptions;

struct RenderResult
{
  /// Is anything in view, as far as the engine can tell?
  enum class Coverages
  {
    Unknown,
    Empty,
    Some
  };
  Coverages Coverage = Coverages::Unknown;
  vtkSmartPointer<vtkImageData> Image; ///< `Color`: 4 floats, straight alpha
  nlohmann::json Statistics = nlohmann::json::object();
  double Tolerance = 0.0;      ///< the error that was accepted
  double EstimatedError = 0.0; ///< NaN where the engine makes no estimate
  int Threads = 1;
  double BuildSeconds = 0.0;  ///< until the first ray
  double RenderSeconds = 0.0; ///< from there
  std::vector<std::string> Warnings;
};

/// Told the share that is done.
using ProgressListener = std::function<void(double share)>;

RenderResult RenderWithRays(
  vtkRenderer* renderer, const RenderOptions& options, const ProgressListener& progress);

/// A window about `renderer`, with the passes that are asked for. Each call draws what `renderer` then
/// shows; the occlusion of one picture helps the next.
std::function<RenderResult(const ProgressListener& progress)> PrepareRaster(
  vtkRenderer* renderer, const RenderOptions& options);

/// Make OpenGL windows of the kind that `window` names, tried first in a process of its own. To be
/// called before any other thread lives: a process split off inherits the locks that others hold, and
/// waits for them for ever. Throws Failure when the machine has none.
void ChooseWindow(const std::string& window, const std::string& option = "--engine raster",
  const std::string& otherwise = "--engine ray");

/// The same where the engine or the gatherer that is asked for draws with OpenGL.
void ChooseWindowFor(const RenderOptions& options);

struct WindowReport
{
  std::string Name; ///< as --window takes it
  bool Works = false;
  std::string Description; ///< renderer and version, or why not
};

/// What the machine offers, each tried in a process of its own; as ChooseWindow(), before other threads.
std::vector<WindowReport> TryWindows();

}
#endif
