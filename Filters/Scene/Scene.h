// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Plain data of a scene for ray tracing. SceneExtraction fills it, RayScene traces rays through it,
// and Shading shades its surfaces.
//
// Scene coordinates are (world - Origin) * Scale in single precision. Origin is the camera
// position, or a point in front of the scene if the projection is parallel or the scene is far
// away, or, for scenes that are kept while the camera moves, a point beside the bounds
// (Geometry/FixedOrigin.h). Scenes at a distance of 1e7 from the world's origin and scenes of size 1e-6 therefore keep
// their precision. All positions and directions below are in scene coordinates. Projections are
// computed in double precision from the rounded positions, so that projected edges match the traced
// triangles.
#ifndef penumbra_Scene_h
#define penumbra_Scene_h

#include "Background.h"
#include "Camera.h"
#include "Light.h"
#include "Overlay.h"

#include <glm/glm.hpp>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace penumbra
{

class EnvironmentLight;
struct Surface;

/// Default radius of ambient occlusion, as a fraction of the diagonal of the scene's bounds.
constexpr double DefaultRadiusFraction = 0.1;

/// Scene in scene coordinates, see above.
struct Scene
{
  glm::dvec3 Origin{ 0.0 };
  double Scale = 1.0;
  /// If true, Origin, Scale and Surfaces do not depend on the camera, see UpdateScene().
  bool HasFixedOrigin = false;
  Camera ViewCamera;             ///< in scene coordinates
  std::vector<Surface> Surfaces; ///< Surface.h is needed to create and destroy scenes
  std::vector<Light> Lights;
  penumbra::Background BackgroundColors;
  std::shared_ptr<EnvironmentLight>
    EnvironmentReflections;          ///< of physically based materials; or null
  Overlay OverlayImage;              ///< composited over the rendered image
  std::vector<std::string> Warnings; ///< parts of the input that were skipped, one sentence each

  /// Convert world to scene coordinates and back.
  glm::dvec3 FromWorld(const double x[3]) const
  {
    return (glm::dvec3(x[0], x[1], x[2]) - this->Origin) * this->Scale;
  }
  glm::dvec3 ToWorld(glm::dvec3 x) const { return x / this->Scale + this->Origin; }
};

}
#endif
