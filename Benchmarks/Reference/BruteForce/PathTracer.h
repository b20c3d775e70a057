// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Diffuse interreflection between parallelograms by independent paths in double precision. Emitters
// are sampled by area and by the cosine. Shares neither code nor method with the irradiance
// providers, so that each can validate the other.
#ifndef penumbra_PathTracer_h
#define penumbra_PathTracer_h

#include "Scene.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

/// A parallelogram; both sides reflect and emit.
struct Panel
{
  glm::dvec3 Corner;
  glm::dvec3 Side;
  glm::dvec3 Other;
  glm::dvec3 Reflectance{ 1.0 };
  glm::dvec3 Emission{ 0.0 };
};

/// The six sides of a box.
void AddPanels(std::vector<Panel>& panels, glm::dvec3 low, glm::dvec3 high, glm::dvec3 reflectance);

/// The same panels as surfaces of a ray scene: emission as ambient light, reflectance as diffuse
/// color.
void AddSurfaces(Scene& scene, const std::vector<Panel>& panels);

/// A room of width, depth and height 1, open to the front (y = 0): a red left wall, a green right
/// wall, an emitting panel below the ceiling, and two boxes.
std::vector<Panel> CornellLikeBox();

/// Returns the fraction of side * side cosine-distributed rays that hit a panel within `radius`,
/// stratified over the hemisphere about the unit vector `normal`.
double ComputePanelOcclusion(
  const std::vector<Panel>& panels, glm::dvec3 point, glm::dvec3 normal, double radius, int side);

struct PathTracer
{
  std::vector<Panel> Panels;
  double Albedo = 1.0; ///< multiplies every reflectance
  int Bounces = 1;     ///< includes the reflection at the queried point, which is the last one
  glm::dvec3 Environment{ 0.0 };

  /// Irradiance at `point` with the unit vector `normal`, averaged over the given number of paths.
  glm::dvec3 Irradiance(glm::dvec3 point, glm::dvec3 normal, int paths, std::uint64_t seed) const;
};

}
#endif
