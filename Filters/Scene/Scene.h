// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the ray caster knows of a scene: plain data, filled by SceneExtraction, traced by RayScene,
// coloured by Shading. Private to the ray side.
//
// Scene coordinates are (world - Origin) * Scale in single precision, Origin the eye (or, under a
// parallel camera, before the scene), so that scenes at 1e7 or of size 1e-6 lose nothing. Every position and direction below is in scene coordinates;
// every projection is done in double from these rounded positions, so that projected edges and
// traced triangles are the same geometry.
#ifndef penumbra_Scene_h
#define penumbra_Scene_h

#include "Camera.h"
#include "Overlay.h"
#include "Surface.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace penumbra
{

struct Light
{
  enum class Kinds
  {
    Directional,
    Positional,
    Spot
  };
  Kinds Kind = Kinds::Directional;
  glm::vec3 Position{ 0.f };              ///< Positional, Spot
  glm::vec3 Direction{ 0.f, 0.f, -1.f };  ///< unit, the way the light travels
  glm::vec3 DiffuseColor{ 1.f };          ///< times intensity
  glm::vec3 SpecularColor{ 1.f };         ///< times intensity
  glm::vec3 Attenuation{ 1.f, 0.f, 0.f }; ///< constant, linear, quadratic in scene units
  float ConeCosine = -1.f;                ///< Spot: cosine of VTK's cone angle
  float Exponent = 1.f;                   ///< Spot
  bool CastsShadow = true;
  bool Headlight =
    false; ///< Directional and along the view axis; alone, VTK lights in a simpler way
};

/// What is seen where nothing is: a colour, or a gradient from bottom to top.
struct Background
{
  glm::vec4 Bottom{ 0.f, 0.f, 0.f, 0.f };
  glm::vec4 Top{ 0.f, 0.f, 0.f, 0.f };
};

/// How far occluders reach where nothing is told, of the diagonal of the bounds.
constexpr double DefaultRadiusFraction = 0.1;

struct Scene
{
  glm::dvec3 Origin{ 0.0 };
  double Scale = 1.0;
  Camera ViewCamera; ///< in scene coordinates
  std::vector<Surface> Surfaces;
  std::vector<Light> Lights;
  penumbra::Background BackgroundColors;
  Overlay OverlayImage;              ///< drawn over the finished picture
  std::vector<std::string> Warnings; ///< what was left out, one sentence each

  /// From world to scene coordinates and back.
  glm::dvec3 FromWorld(const double x[3]) const
  {
    return (glm::dvec3(x[0], x[1], x[2]) - this->Origin) * this->Scale;
  }
  glm::dvec3 ToWorld(glm::dvec3 x) const { return x / this->Scale + this->Origin; }
};

}
#endif
