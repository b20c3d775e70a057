// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion of all surface points of an image, interpolated between the records of an
// irradiance cache.
#ifndef penumbra_InterpolatedOcclusion_h
#define penumbra_InterpolatedOcclusion_h

#include "Camera.h"
#include "SurfaceFromDepth.h"

#include <vector>

namespace penumbra
{

struct ScreenTransform;

/// Camera of a view in scene coordinates.
Camera CameraFromView(const ScreenTransform& view, const Scene& scene);

/// Fills `means` with the occlusion of the points (0 open, 1 blocked), with an RMSE of about
/// `tolerance` over 16x16 pixels. The scene of `rays` must have the camera of the image. `radius`
/// is in world units. Returns the number of rays.
long long InterpolateOcclusion(const std::vector<SurfacePoint>& points, const RayScene& rays,
  double radius, double tolerance, std::vector<float>& means);

}
#endif
