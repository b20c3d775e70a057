// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Plain data of a scene for ray tracing. SceneExtraction fills it, RayScene traces rays through it,
// and Shading shades its surfaces.
#ifndef penumbra_Scene_h
#define penumbra_Scene_h

#include "Background.h"
#include "Camera.h"
#include "Light.h"
#include "SceneCoordinates.h"

#include <memory>
#include <string>
#include <vector>

namespace penumbra
{

class EnvironmentLight;
class Overlay;
struct Surface;

/// Default radius of ambient occlusion, as a fraction of the diagonal of the scene's bounds.
constexpr double DefaultRadiusFraction = 0.1;

/// Scene. All positions and directions are in scene coordinates.
struct Scene : SceneCoordinates
{
  /// If true, Origin, Scale and Surfaces do not depend on the camera, see UpdateScene().
  bool HasFixedOrigin = false;
  Camera ViewCamera;             ///< in scene coordinates
  std::vector<Surface> Surfaces; ///< Surface.h is needed to create and destroy scenes
  std::vector<Light> Lights;
  penumbra::Background BackgroundColors;
  std::shared_ptr<EnvironmentLight>
    EnvironmentReflections;              ///< of physically based materials; or null
  std::shared_ptr<Overlay> OverlayImage; ///< composited over the rendered image; or null
  std::vector<std::string> Warnings; ///< parts of the input that were skipped, one sentence each
};

}
#endif
