// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Fixtures of the occlusion pass's scenarios.
#ifndef penumbra_stability_OcclusionScenes_h
#define penumbra_stability_OcclusionScenes_h

#include "Metrics.h"
#include "OcclusionScene.h"

#include <vector>

namespace penumbra
{

constexpr const char* VtksOcclusion = "vtkSSAOPass, 128 samples, blurred";

/// Adds a sphere on a floor in front of a wall, scaled by `unit`.
void Furnish(OcclusionScene& scene, double unit = 1.0);

/// Returns the occlusion that the pass computed in the last frame.
Frame OcclusionOf(OcclusionScene& scene);

/// Returns 1 - occlusion of the last frame, for display.
Frame OpennessOf(OcclusionScene& scene);

/// Renders a frame with vtkSSAOPass and returns 1 - brightness.
Frame OcclusionByVtk(OcclusionScene& scene, double radius);

/// Returns 1 - values.
Frame Inverted(const Frame& frame);

/// Returns the converged occlusion of the current view, without history of earlier frames.
Frame Limit(OcclusionScene& scene);

/// Returns the occlusion at world points, interpolated bilinearly between pixels.
std::vector<double> OnFloor(OcclusionScene& scene, const std::vector<Vector>& points);

}
#endif
