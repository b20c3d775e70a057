// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The two render engines: ray casting and OpenGL.
#ifndef penumbra_Engine_h
#define penumbra_Engine_h

#include "Files/Report.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkImageData;
class vtkRenderer;

namespace penumbra
{

struct RenderOptions;

struct RenderResult
{
  /// Whether a surface is in view; Unknown if the engine does not report it.
  enum class Coverages
  {
    Unknown,
    Empty,
    Some
  };
  Coverages Coverage = Coverages::Unknown;
  vtkSmartPointer<vtkImageData> Image; ///< `Color`: 4 floats, straight alpha
  std::string VectorGraphics;          ///< contents of the file if the output is .svg or .pdf
  ReportTable Statistics;
  double Tolerance = 0.0;           ///< accepted error
  double LightTolerance = 0.0;      ///< accepted error that light effects add
  double EstimatedError = 0.0;      ///< NaN if the engine makes no estimate
  double EstimatedLightError = 0.0; ///< part that light effects cause
  int Threads = 1;
  double BuildSeconds = 0.0;  ///< before the first ray
  double RenderSeconds = 0.0; ///< from the first ray
  std::vector<std::string> Warnings;
};

/// Called with the completed fraction of the work.
using ProgressListener = std::function<void(double fraction)>;

RenderResult RenderWithRays(
  vtkRenderer* renderer, const RenderOptions& options, const ProgressListener& progress);

/// Creates a ray caster that keeps the scene while only the camera moves. Each call of the returned
/// function renders the current state of `renderer`. The images do not depend on earlier calls.
std::function<RenderResult(const ProgressListener& progress)> PrepareRays(
  vtkRenderer* renderer, const RenderOptions& options);

/// Creates an offscreen window with `renderer` and the requested passes. Each call of the returned
/// function renders the current state of `renderer`; occlusion is accumulated across calls.
std::function<RenderResult(const ProgressListener& progress)> PrepareRaster(
  vtkRenderer* renderer, const RenderOptions& options);

/// Selects the class of OpenGL windows that `window` names, after testing it in a separate process.
/// Call before any thread is started: a forked process inherits locks that other threads hold and
/// would wait for them forever. Throws CommandError, with `option` and `otherwise` in the message,
/// if no window works.
void ChooseWindow(const std::string& window, const std::string& option = "--engine raster",
  const std::string& otherwise = "--engine ray");

/// Calls ChooseWindow() if the selected engine or gatherer renders with OpenGL.
void ChooseWindowFor(const RenderOptions& options);

struct WindowReport
{
  std::string Name; ///< name for --window
  bool Works = false;
  std::string Description; ///< renderer and version, or "not available"
};

/// Tests each kind of window in a separate process. Call before any thread is started, as
/// ChooseWindow().
std::vector<WindowReport> TryWindows();

}
#endif
