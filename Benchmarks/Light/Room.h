// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renderers of panels, surface points of an image of a scene, and the irradiance of a cache there.
#ifndef penumbra_light_Room_h
#define penumbra_light_Room_h

#include "BruteForce/PathTracer.h"
#include "Embree/RayScene.h"
#include "Shading/Illumination.h"

#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

class vtkPenumbraIrradianceProvider;
class vtkRenderer;

namespace penumbra
{

/// Point of a surface at the center of a pixel, in world coordinates.
struct ImagePoint
{
  glm::ivec2 Pixel;
  glm::dvec3 Position;
  glm::dvec3 Normal;    ///< interpolated
  glm::dvec3 Geometric; ///< normal of the triangle
  std::uint32_t Surface = 0;
};

/// Makes a renderer of panels, with up = z and a dark light.
vtkSmartPointer<vtkRenderer> MakeRenderer(
  const std::vector<Panel>& panels, glm::dvec3 eye, glm::dvec3 target, double viewAngle);

/// Finds the points at the centers of every `step`-th pixel, without emitting surfaces.
std::vector<ImagePoint> FindImagePoints(const RayScene& rays, int step);

/// Returns true if a pixel and its eight neighbors show the same surface at their centers.
bool ShowsOneSurface(const RayScene& rays, glm::ivec2 pixel);

/// Irradiance over pi. `tolerance` has the same unit. Adds the number of rays to `rays`.
glm::dvec3 AskForMean(const vtkPenumbraIrradianceProvider* provider, const ImagePoint& point,
  double tolerance, long long& rays);

/// Work of the cache for one image.
struct CacheCost
{
  double Seconds = 0.0; ///< CPU seconds: records, then look-ups at all `points`
  double Records = 0.0;
  double Rays = 0.0;
};

/// Irradiance over pi at `queried`, by the cache with the tolerance `tolerance` of its values.
std::vector<glm::dvec3> AskCache(const Illumination& light, double tolerance,
  const std::vector<ImagePoint>& points, const std::vector<ImagePoint>& queried, CacheCost& cost);

/// The same by brute force with 16,384 rays per point.
std::vector<glm::dvec3> FindReference(
  const Illumination& light, const std::vector<ImagePoint>& queried);

}
#endif
