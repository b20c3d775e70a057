// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Brute-force rendering of triangles: thousands of samples per pixel, by scan conversion with a
// depth buffer in double precision. Shares neither code nor method with the ray caster, so that
// each can validate the other. No part of the scene may lie behind the camera.
#ifndef penumbra_BruteForce_h
#define penumbra_BruteForce_h

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace penumbra
{

/// Triangles lit by one directional light without attenuation, or unlit.
struct BruteForceScene
{
  std::vector<glm::dvec3> Positions;
  std::vector<glm::uvec3> Triangles; ///< connected triangles have common position indices
  std::vector<glm::dvec3> Normals;   ///< per position; empty: flat
  bool Lighting = true;
  glm::dvec3 Color{ 1.0 };
  glm::dvec3 Background{ 0.0 };

  /// World to clip coordinates, as in OpenGL (x, y, z in [-w, w] inside the view volume).
  glm::dmat4 Projection{ 1.0 };
  glm::dvec3 Eye{ 0.0 }; ///< position, of a perspective camera
  bool Parallel = false;
  /// Unit direction in which the light travels. For the headlight this is also the view direction.
  glm::dvec3 LightTravel{ 0.0, 0.0, -1.0 };
};

/// Contents of a pixel, derived from its samples.
enum class PixelKind : std::uint8_t
{
  Inside,    ///< only background, or one triangle
  Crease,    ///< several connected triangles
  Silhouette ///< background and surface, or surfaces that are not connected within the pixel
};

struct BruteForceImage
{
  int Width = 0;
  int Height = 0;
  std::vector<glm::dvec3> Colors; ///< row by row from the bottom
  std::vector<PixelKind> Kinds;
};

/// Renders with `samples` x `samples` samples per pixel, and 16 times as many in pixels with
/// silhouettes. Consecutive rows of samples are shifted.
BruteForceImage DrawByBruteForce(const BruteForceScene& scene, int width, int height, int samples);

}
#endif
