// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A row of the failure catalogue: a situation in which rendering methods of this kind are known to
// fail, the metric that shows it, and the bound on its value. Every row is also measured with the
// mechanism that it guards disabled, and must then exceed its bound, so every row is able to fail.
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
  Peer     ///< VTK's method, if it has a comparable one
};

struct ScenarioResult
{
  double Value;
  Frame Image; ///< image for the document; 1 is white
};

struct Scenario
{
  std::string Name; ///< name of the test and of the image file
  std::string Scene;
  std::string Motion;
  Metric Measured;
  double Bound;
  std::string AblatedMechanism; ///< what the ablated variant disables
  std::string Source;           ///< the published limitation; empty: none
  std::string Peer;             ///< VTK's comparable method; empty: none
  std::function<ScenarioResult(Variant)> Measure;
  /// If true, the value is known to exceed the bound, and the test requires that it still does.
  bool IsKnownFailure = false;
};

/// Returns all rows, in the order of the document.
const std::vector<Scenario>& Catalogue();

///@{
/// Returns the rows of one subject.
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
