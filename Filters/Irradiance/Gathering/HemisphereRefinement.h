// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Supersampling of the cells of a hemisphere.
#ifndef penumbra_HemisphereRefinement_h
#define penumbra_HemisphereRefinement_h

#include "Gatherer.h"
#include "HemisphereGrid.h"

#include <vector>

namespace penumbra
{

/// Samples of a hemisphere, one per cell of a grid.
struct SampledHemisphere
{
  glm::vec3 Position{ 0.f };
  SurfaceNormals Normals{ glm::vec3(0.f) };
  glm::mat3 Frame{ 1.f }; ///< local to scene coordinates
  const HemisphereGrid& Grid;
  const std::vector<glm::vec3>& Directions; ///< of the samples, scene coordinates
  std::vector<HemisphereSample>& Samples;
};

/// Replaces samples of cells by means of further ones, until the estimated standard error of the
/// mean over the hemisphere is at most `tolerance`. In the first round, at most about
/// MaximumRayFactor times as many rays as cells are traced. Cells that differ most from their
/// neighbors, or where `emitterSamples` (of all emitters) lie, get most of them. Returns the number of rays.
long long RefineHemisphere(const Gatherer& gatherer, SampledHemisphere& hemisphere,
  const std::vector<EmitterSample>& emitterSamples, double tolerance);

}
#endif
