// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The same scene, and the same places on its surfaces, through a program that a script of Benchmarks/Peers/scripts
// drives: what light arrives there.
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

/// What is handed over: triangles as `Drawn` has them, emission as ambient light.
struct PointQueryScene
{
  const Scene* Drawn = nullptr;
  double Albedo = 0.0; ///< multiplies every diffuse colour
  int Bounces = 1;     ///< the one at the place is the last
  double Sky = 1.0;    ///< radiance from where nothing is
  std::vector<PointQuery> Questions;
  double Share = 1.0; ///< that these are of all: seconds are told for all
};

struct PointQueryResult
{
  std::vector<glm::dvec3>
    Light; ///< irradiance over pi; under a sky of 1 and at an albedo of 0 the open share
  double Seconds = 0.0; ///< CPU seconds, the tree ready where the program lets one tell
  double RaysPerPlace = 0.0;
};

void WritePlaces(const std::string& path, const PointQueryScene& scene);

/// Asks at one of the peer's settings. Throws std::runtime_error where the program fails.
PointQueryResult RunPlaces(
  const Peer& peer, const std::string& scene, const std::string& setting, std::size_t places);

}
#endif
