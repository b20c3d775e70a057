// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the scenarios of the occlusion pass share.
#ifndef penumbra_stability_OcclusionScenes_h
#define penumbra_stability_OcclusionScenes_h

#include "Metrics.h"
#include "OcclusionScene.h"

#include <vector>

namespace penumbra
{

constexpr const char* VtksOcclusion = "vtkSSAOPass, 128 samples, blurred";

/// A sphere on a floor before a wall, everything `unit` times as large.
void Furnish(OcclusionScene& scene, double unit = 1.0);

/// The occlusion that our pass showed in the last frame.
Frame OcclusionOf(OcclusionScene& scene);

/// The same of openness, to look at.
Frame OpennessOf(OcclusionScene& scene);

/// 1 - brightness after a frame of VTK's own pass.
Frame OcclusionByVtk(OcclusionScene& scene, double radius);

/// 1 - values.
Frame Inverted(const Frame& frame);

/// What the pass converges to at this camera, nothing kept from before.
Frame Limit(OcclusionScene& scene);

/// The occlusion at points of the floor, bilinear between pixels.
std::vector<double> OnFloor(OcclusionScene& scene, const std::vector<Vector>& points);

}
#endif
