// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Plain data of a scene for ray tracing. SceneExtraction fills it, RayScene traces rays through it,
// and Shading shades its surfaces.
//
// Scene coordinates are (world - Origin) * Scale in single precision. Origin is the camera
// position, or a point in front of the scene if the projection is parallel or the scene is far
// away, or, for scenes that are kept while the camera moves, a point beside the bounds
// (FixedOrigin.h). Scenes at a distance of 1e7 from the world's origin and scenes of size 1e-6 therefore keep
// their precision. All positions and directions below are in scene coordinates. Projections are
// computed in double precision from the rounded positions, so that projected edges match the traced
// triangles.
#ifndef penumbra_Scene_h
#define penumbra_Scene_h

#include "Camera.h"
#include "Overlay.h"
#include "Surface.h"

#include <glm/glm.hpp>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace penumbra
{

/// Light source, as in vtkLight.
struct Light
{
  enum class Kinds
  {
    Directional,
    Positional,
    Spot
  };
  Kinds Kind = Kinds::Directional;
  glm::vec3 Position{ 0.f };             ///< Positional, Spot
  glm::vec3 Direction{ 0.f, 0.f, -1.f }; ///< unit vector in which the light travels
  glm::vec3 DiffuseColor{ 1.f };         ///< multiplied by the intensity
  glm::vec3 SpecularColor{ 1.f };        ///< multiplied by the intensity
  /// Constant, linear and quadratic coefficients of the attenuation, in scene units.
  glm::vec3 Attenuation{ 1.f, 0.f, 0.f };
  float ConeCosine = -1.f;   ///< Spot: cosine of vtkLight's cone angle
  float Exponent = 1.f;      ///< Spot: exponent of vtkLight
  float Radius = 0.f;        ///< Positional: of the sphere; Spot: of the disk across Direction
  float AngularRadius = 0.f; ///< Directional: half the angular diameter, in radians
  bool CastsShadow = true;
  /// If true, the light is directional and along the view axis. VTK uses a simpler lighting model
  /// if this is the only light.
  bool Headlight = false;

  /// Returns true if the light casts penumbrae.
  bool HasSize() const
  {
    return (this->Kind == Kinds::Directional ? this->AngularRadius : this->Radius) > 0.f;
  }
};

/// Images of the surroundings, infinitely far away, as in vtkSkybox.
struct Sky
{
  /// Faces of a cube (+x, -x, +y, -y, +z, -z, oriented as in OpenGL), or one image of all
  /// directions, whose coordinates are longitude and latitude.
  std::vector<std::shared_ptr<const Texture>> Faces;
  glm::dmat3 FromScene{ 1.0 };   ///< converts directions to the coordinates of the images
  double Depth = 1.0;            ///< parallel projection: distance at which VTK samples the images
  bool IsGammaCorrected = false; ///< if true, colors are raised to the power 1 / 2.2
};

/// Color of rays that miss the scene: constant, a gradient, an image that fills the view, or a sky.
struct Background
{
  /// Direction of the gradient from First to Second, as vtkViewport::GradientModes.
  enum class Gradients
  {
    Vertical,
    Horizontal,
    RadialToSide,  ///< ellipse around the center that touches the sides
    RadialToCorner ///< ellipse around the center that touches the corners
  };
  Gradients Gradient = Gradients::Vertical;
  glm::vec4 First{ 0.f, 0.f, 0.f, 0.f };   ///< at the bottom, the left or the center
  glm::vec4 Second{ 0.f, 0.f, 0.f, 0.f };  ///< at the top, the right or the ellipse
  std::shared_ptr<const Texture> Image;    ///< if set, replaces the gradient
  std::shared_ptr<const Sky> Surroundings; ///< if set, replaces the image
};

/// Default radius of ambient occlusion, as a fraction of the diagonal of the scene's bounds.
constexpr double DefaultRadiusFraction = 0.1;

/// Scene in scene coordinates, see above.
struct Scene
{
  glm::dvec3 Origin{ 0.0 };
  double Scale = 1.0;
  /// If true, Origin, Scale and Surfaces do not depend on the camera, see UpdateView().
  bool HasFixedOrigin = false;
  std::array<double, 6> VisibleBounds{}; ///< world bounds of the visible props, if HasFixedOrigin
  std::array<double, 6>
    OriginBounds{};  ///< those that determine Origin and Scale, if HasFixedOrigin
  Camera ViewCamera; ///< in scene coordinates
  std::vector<Surface> Surfaces;
  std::vector<Light> Lights;
  penumbra::Background BackgroundColors;
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
