// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Computes the light at given surface points of the same scene with a peer program, driven by a
// script in Benchmarks/Peers/scripts.
#ifndef penumbra_PointQueries_h
#define penumbra_PointQueries_h

#include "Peers.h"
#include "Scene.h"

#include <string>
#include <vector>

namespace penumbra
{

struct PointQuery
{
  glm::dvec3 Position; ///< world
  glm::dvec3 Normal;   ///< unit
};

/// The scene that is passed on: triangles as in `Drawn`, with emission as ambient light.
struct PointQueryScene
{
  const Scene* Drawn = nullptr;
  double Albedo = 0.0; ///< multiplies every diffuse color
  int Bounces = 1;     ///< including the reflection at the point
  double Sky = 1.0;    ///< radiance of the background
  std::vector<PointQuery> Questions;
  double Share = 1.0; ///< fraction of all points that these are; seconds are scaled to all
};

struct PointQueryResult
{
  std::vector<glm::dvec3>
    Light; ///< irradiance over pi; the unoccluded fraction if the sky is 1 and the albedo 0
  double Seconds = 0.0; ///< CPU seconds, without the acceleration structure if reported
  double RaysPerPlace = 0.0;
};

void WritePlaces(const std::string& path, const PointQueryScene& scene);

/// Runs the queries at one of the peer's settings. Throws std::runtime_error if the program fails.
PointQueryResult RunPlaces(
  const Peer& peer, const std::string& scene, const std::string& setting, std::size_t places);

}
#endif
