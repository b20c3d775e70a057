// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A row of the failure catalogue: where methods like ours are known to fail, by which metric that
// shows, and how much of it is allowed. Every row is also measured with the mechanism that it guards
// taken away, and must then be above its bound: no row is one that cannot fail.
#ifndef penumbra_stability_Scenario_h
#define penumbra_stability_Scenario_h

#include "Metrics.h"

#include <functional>
#include <string>
#include <vector>

namespace penumbra
{

enum class Variant
{
  Ours,
  Ablated, ///< without the mechanism that the row guards
  Peer     ///< VTK's own way, where it has one
};

struct ScenarioResult
{
  double Value;
  Frame Picture; ///< to look at; white for 1
};

struct Scenario
{
  std::string Name; ///< of the test and of the picture
  std::string Scene;
  std::string Motion;
  Metric Measured;
  double Bound;
  std::string AblatedMechanism; ///< what the broken variant lacks
  std::string Source;           ///< the published weakness; empty: none
  std::string Peer;             ///< VTK's own way; empty: it has none
  std::function<ScenarioResult(Variant)> Measure;
  bool IsKnownFailure =
    false; ///< known to be above its bound: the test demands that, so that this stays true
};

/// All rows, in the order of the document.
const std::vector<Scenario>& Catalogue();

///@{
/// Rows by subject.
std::vector<Scenario> CoverageScenarios();
std::vector<Scenario> GeometryScenarios();
std::vector<Scenario> IrradianceScenarios();
std::vector<Scenario> OcclusionKernelScenarios();
std::vector<Scenario> OcclusionMotionScenarios();
std::vector<Scenario> OcclusionOverlayScenarios();
std::vector<Scenario> OcclusionStillScenarios();
std::vector<Scenario> RecordScenarios();
std::vector<Scenario> ShaftScenarios();
///@}

}
#endif
