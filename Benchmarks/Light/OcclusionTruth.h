// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reference images of ambient occlusion on white unlit surfaces before a black background: jittered
// camera rays, each with a few random rays over the hemisphere. They share intersection and normals
// with the ray caster, but neither edges, sequences, records nor error estimates.
#ifndef penumbra_light_OcclusionTruth_h
#define penumbra_light_OcclusionTruth_h

#include <string>
#include <vector>

class vtkRenderer;

namespace penumbra
{

/// Two independent estimates of each pixel, row by row from the bottom. The product of the errors of
/// an image against both is an unbiased estimate of its squared error.
struct ReferenceOcclusion
{
  std::vector<float> Means[2];
  std::vector<float> Coverage;
};

/// Renders, or reads from `file` if it exists, and writes to `file` unless it is empty.
ReferenceOcclusion FindOcclusionTruth(
  vtkRenderer* renderer, int width, int height, double radius, const std::string& file);

/// Returns the default radius of occluders of the ray caster.
double FindDefaultRadius(vtkRenderer* renderer);

}
#endif
