// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Steps of a chart in which programs of others tell what light arrives at places on surfaces.
#ifndef penumbra_ChartPlaces_h
#define penumbra_ChartPlaces_h

#include "ChartFamilies.h"
#include "Places.h"

#include <functional>
#include <string>
#include <vector>

namespace penumbra
{

/// What programs of others are asked, and the error of their answers.
struct PlacesSteps
{
  std::string Scene;
  bool Lamps = false; ///< light, not occlusion
  std::function<LitPlaces(const Peer& peer)> Prepare;
  std::function<double(const LitPlaces& asked, const std::vector<glm::dvec3>& light)> Error;
};

/// Adds a step for each setting of those peers that know such a scene.
void AddPeers(ChartFamily& family, const std::vector<Peer>& peers, const PlacesSteps& steps);

/// Occlusion baked onto the points of a mesh.
void AddBaking(ChartFamily& family, const ChartMesh& mesh, const ChartRequest& request);

}
#endif
