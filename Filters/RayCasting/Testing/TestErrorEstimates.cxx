// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Error estimates in scenes that no constant was chosen with, a subset of the benchmark `accuracy`.
// The reference has jittered samples and knows its own error.
#include "BruteForce/StratifiedReference.h"
#include "Scenes/AccuracyScenes.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkNew.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

using namespace penumbra;

class ErrorEstimates : public ::testing::TestWithParam<std::string>
{
};

TEST_P(ErrorEstimates, ExceedTheErrorsAboveTheTolerance)
{
  constexpr int Side = AccuracyImageSide;
  const auto& scenes = GetAccuracyScenes();
  const auto scene = std::find_if(scenes.begin(), scenes.end(),
    [](const AccuracyScene& candidate) { return candidate.Name == GetParam(); });
  ASSERT_NE(scene, scenes.end());
  vtkNew<vtkRenderer> renderer;
  scene->Build(renderer);
  double tolerance = 0.0;
  const Answer answer = Cast(renderer, Side, Side, [&](vtkPenumbraRayCaster* caster) {
    caster->SetShadows(scene->Shadows);
    tolerance = caster->GetTolerance();
  });
  const StratifiedReference reference = DrawStratified(renderer, Side, Side, 10, scene->Shadows);
  const std::vector<TileAccuracy> tiles = CompareTiles(answer, reference, Side);
  std::size_t above = 0;
  for (const TileAccuracy& tile : tiles)
  {
    above += tile.Error > tolerance && tile.Estimate < tile.Error ? 1 : 0;
  }
  EXPECT_LE(20 * above, tiles.size());
}

INSTANTIATE_TEST_SUITE_P(RayCaster, ErrorEstimates,
  ::testing::Values(
    "Foliage", "FoliageWithShadows", "Checkerboard", "Glass", "FlatTerrain", "Soup300WithShadows"),
  [](const ::testing::TestParamInfo<std::string>& row) { return row.param; });
