// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures of triangles by brute force: thousands of samples in every pixel, found by scan
// conversion with a depth buffer in double. It shares neither code nor method with the ray caster,
// so that the two can check each other. No part of the scene may lie behind the camera.
#ifndef penumbra_BruteForce_h
#define penumbra_BruteForce_h

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace penumbra
{

/// Triangles under one directional light without attenuation, or none.
struct BruteForceScene
{
  std::vector<glm::dvec3> Positions;
  std::vector<glm::uvec3> Triangles; ///< triangles that hang together share positions
  std::vector<glm::dvec3> Normals;   ///< per position; empty: flat
  bool Lighting = true;
  glm::dvec3 Color{ 1.0 };
  glm::dvec3 Background{ 0.0 };

  /// World to clip coordinates, as OpenGL's (x, y, z of the view volume in [-w, w]).
  glm::dmat4 Projection{ 1.0 };
  glm::dvec3 Eye{ 0.0 }; ///< position, of a perspective camera
  bool Parallel = false;
  glm::dvec3 LightTravel{ 0.0, 0.0, -1.0 }; ///< unit, the way the light travels; the headlight's
                                            ///< is also the view direction
};

/// What a pixel holds, told from its samples.
enum class PixelKind : std::uint8_t
{
  Inside,    ///< the background alone, or one triangle
  Crease,    ///< several triangles that hang together
  Silhouette ///< background and surface, or surfaces that do not hang together inside the pixel
};

struct BruteForcePicture
{
  int Width = 0;
  int Height = 0;
  std::vector<glm::dvec3> Colors; ///< row after row from below
  std::vector<PixelKind> Kinds;
};

/// `samples` x `samples` in every pixel, 16 times as many where silhouettes are; each row of samples
/// is shifted against the next.
BruteForcePicture DrawByBruteForce(
  const BruteForceScene& scene, int width, int height, int samples);

}
#endif
