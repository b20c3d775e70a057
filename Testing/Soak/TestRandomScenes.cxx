// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A few of the random scenes that `penumbra-random-scenes` draws by the hour.
#include "Random/SceneChecks.h"

#include "vtkLogger.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStringOutputWindow.h"
#include "vtkVersionMacros.h"

#include <gtest/gtest.h>

using namespace penumbra_soak;

namespace
{

class RandomScenes : public testing::TestWithParam<std::uint64_t>
{
};

}

TEST_P(RandomScenes, AreDrawnWithinTheToleranceAndLikeVTK)
{
  vtkNew<vtkStringOutputWindow> messages;
  vtkOutputWindow::SetInstance(messages);
  const RandomScene scene = MakeRandomScene(GetParam());
  SCOPED_TRACE(scene.Description);
  const CastImage image = CastScene(scene, false);
  EXPECT_TRUE(image.Finite);
  EXPECT_EQ(image.Values.Colors, CastScene(scene, false, 2).Values.Colors);
  const CastImage plain = CastScene(scene, true);
#ifndef __SANITIZE_ADDRESS__                             // which checks the code, not numbers
  const double factor = GetParam() == 93306 ? 1.0 : 2.0; // its error was 1 to 2 times the limit
  int misjudged = 0;
  const penumbra::StratifiedReference reference = DrawReference(scene, 1);
  for (const auto& tile : penumbra::CompareTiles(image.Values, reference, ImageSide))
  {
    misjudged +=
      scene.ComparesTiles && tile.Error > factor * TileLimit(scene) && tile.Estimate < tile.Error;
  }
  EXPECT_EQ(misjudged, 0);
  if (scene.ComparesWithVTK && plain.Warnings.empty())
  {
    EXPECT_LT(CountDifferentBlocks(plain.Values.Colors, DrawWithVTK(scene)), 2);
  }
#endif
  vtkOutputWindow::SetInstance(nullptr);
}

// Seeds whose references take less than a second. VTK 9.2 draws the scene of seed 11 differently. In
// 80006, a sphere emerges from a dense surface between the corners of a pixel. In 93176, the normal of a
// wide line is negated within a pixel; in 93306, points lie close behind each other and far from the
// camera; in 93334, surfaces intersect behind a translucent one.
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
INSTANTIATE_TEST_SUITE_P(
  Seeds, RandomScenes, testing::Values(3, 4, 5, 6, 10, 13, 14, 15, 16, 19, 20));
#else
INSTANTIATE_TEST_SUITE_P(Seeds, RandomScenes,
  testing::Values(3, 4, 5, 6, 10, 11, 13, 14, 15, 16, 19, 20, 80006, 93176, 93306, 93334));
#endif
