// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Scenario.h"

namespace penumbra
{

const std::vector<Scenario>& Catalogue()
{
  static const std::vector<Scenario> catalogue = [] {
    std::vector<Scenario> rows;
    for (const auto& part : { CoverageScenarios(), GeometryScenarios(), OcclusionStillScenarios(),
           OcclusionOverlayScenarios(), OcclusionMotionScenarios(), OcclusionKernelScenarios(),
           ShaftScenarios(), IrradianceScenarios(), RecordScenarios() })
    {
      rows.insert(rows.end(), part.begin(), part.end());
    }
    return rows;
  }();
  return catalogue;
}

}
