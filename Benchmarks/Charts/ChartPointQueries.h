// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Rows of a chart in which peer programs compute the light at points of surfaces.
#ifndef penumbra_ChartPointQueries_h
#define penumbra_ChartPointQueries_h

#include "ChartFamilies.h"
#include "PointQueries.h"

#include <functional>
#include <string>
#include <vector>

namespace penumbra
{

/// The queries for peer programs, and the error of their results.
struct PointQuerySteps
{
  std::string Scene;
  bool Emitters = false; ///< whether the scene has area lights; otherwise occlusion is queried
  std::function<PointQueryScene(const Peer& peer)> Prepare;
  std::function<double(const PointQueryScene& asked, const std::vector<glm::dvec3>& light)> Error;
};

/// Adds a step for each setting of the peers that support such a scene.
void AddPeers(ChartFamily& family, const std::vector<Peer>& peers, const PointQuerySteps& steps);

/// Ambient occlusion baked onto the points of a mesh.
void AddBaking(ChartFamily& family, const ChartMesh& mesh, const ChartRequest& request);

}
#endif
