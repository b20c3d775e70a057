// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Diffuse light between parallelograms by independent paths, in double, lights sampled by their area
// and by the cosine.
// It shares neither code nor method with the irradiance sources, so that the two can check each other.
#ifndef penumbra_PathTracer_h
#define penumbra_PathTracer_h

#include "Scene.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

/// A parallelogram; both sides reflect and shine.
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

/// The same as surfaces of a ray scene: emission is ambient light, and reflectance diffuse colour.
void AddSurfaces(Scene& scene, const std::vector<Panel>& panels);

/// A room open to the front (y = 0), 1 wide, deep and high: red on the left, green on the right, a
/// panel that shines below the ceiling, and two boxes.
std::vector<Panel> CornellLikeBox();

struct PathTracer
{
  std::vector<Panel> Panels;
  double Albedo = 1.0; ///< multiplies every reflectance
  int Bounces = 1;     ///< the reflection where the irradiance is asked for is the last of them
  glm::dvec3 Environment{ 0.0 };

  /// Irradiance at `point` about `normal` (unit), the mean of so many paths.
  glm::dvec3 Irradiance(glm::dvec3 point, glm::dvec3 normal, int paths, std::uint64_t seed) const;
};

}
#endif
