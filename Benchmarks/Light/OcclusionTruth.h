// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reference images of ambient occlusion on white unlit surfaces before a black background, and of white
// surfaces under a sun and a white sky: jittered camera rays, each with a few random rays over the
// hemisphere. They share intersection and normals
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
struct ReferenceLight
{
  std::vector<float> Means[2];
  std::vector<float> Coverage;
};

/// What a reference shows: occlusion within a radius (world units), or the light of a sun with shadows, which
/// surfaces reflect once more, and of a sky of radiance 1.
struct ReferenceSettings
{
  double Radius = 0.0;               ///< of occlusion; 0: light
  double Sun[3] = { 0.0, 0.0, 1.0 }; ///< direction toward it, unit
  double Albedo = 0.5;               ///< factor of the light from sky and surfaces
};

/// Renders, or reads from `file` if it exists, and writes to `file` unless it is empty.
ReferenceLight FindLightTruth(vtkRenderer* renderer, int width, int height,
  const ReferenceSettings& settings, const std::string& file);

/// Returns the default radius of occluders of the ray caster.
double FindDefaultRadius(vtkRenderer* renderer);

}
#endif
