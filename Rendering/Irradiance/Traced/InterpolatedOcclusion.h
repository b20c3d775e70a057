// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The occlusion of all points that a picture shows at once: rays at few of them, interpolated between
// by the irradiance cache.
#ifndef penumbra_InterpolatedOcclusion_h
#define penumbra_InterpolatedOcclusion_h

#include "SurfaceFromDepth.h"

#include <vector>

namespace penumbra
{

struct ScreenTransform;

/// The eye of a view, in the coordinates of a scene.
Camera CameraFromView(const ScreenTransform& view, const Scene& scene);

/// Fills `means`, 0 open, 1 blocked, with an RMSE of about `tolerance` in 16x16 pixels. `rays` is of a
/// scene with the eye of the picture; `radius` in world units. Returns the number of rays.
long long InterpolateOcclusion(const std::vector<SurfacePoint>& points, const RayScene& rays,
  double radius, double tolerance, std::vector<float>& means);

}
#endif
