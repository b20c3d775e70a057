// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders the same scene with POV-Ray: one mesh2, one parallel light along the view direction, no
// shadows.
#ifndef penumbra_PovRay_h
#define penumbra_PovRay_h

#include "BruteForce/BruteForce.h"

#include <string>
#include <vector>

class vtkRenderer;

namespace penumbra
{

/// Adaptive antialiasing: a pixel that differs from its neighbors by more than Threshold is
/// subdivided Depth times. With a depth of 0, one ray is traced through the center of each pixel.
struct PovRayStep
{
  double Threshold;
  int Depth;
};

/// Settings from coarse to fine.
const std::vector<PovRayStep>& PovRayLadder();

struct PovRayAnswer
{
  std::vector<glm::dvec3> Colors;
  double RaysPerPixel = 0.0;
  double TraceSeconds = 0.0;   ///< CPU seconds that POV-Ray reports for tracing
  double ProcessSeconds = 0.0; ///< CPU seconds of the whole process
};

/// Writes the scene file. Requires a perspective camera.
void WritePovRayScene(const std::string& path, vtkRenderer* renderer, const BruteForceScene& scene,
  int width, int height);

/// Renders on one thread with adaptive antialiasing (+AM2), without jitter of the rays. Throws
/// std::runtime_error if the program fails.
PovRayAnswer RunPovRay(const std::string& program, const std::string& scene, int width, int height,
  const PovRayStep& step);

}
#endif
