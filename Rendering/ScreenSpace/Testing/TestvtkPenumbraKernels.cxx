// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionScene.h"
#include "vtkPenumbraKernels.h"

#include "vtkMath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace
{

/// A row for every kernel: how far from the closed form it may be at the foot of a wall, and how dark where
/// two facets of a coarse mesh meet: .030 of the sky is blocked there.
struct Row
{
  const char* Kernel;
  double (*Truth)(double);
  double Rmse;
  double BetweenFacets;
};

const Row Rows[] = {
  { "volumetric", BehindWallFading, .02, .035 },
  { "patch", BehindWall, .3, .12 },           // no D: only bounds
  { "depth-difference", BehindWall, .2, .1 }, // no D: only bounds
  { "horizon", BehindWall, .02, .035 },
  { "march", BehindWall, .025, .035 },
};

class Kernels : public testing::TestWithParam<Row>
{
};

TEST(KernelTable, HasATestRowAndAParagraphForEveryKernel)
{
  std::stringstream page;
  page << std::ifstream(PENUMBRA_SOURCE_DIR "/Documentation/methods/Kernels.md").rdbuf();
  for (int kernel = 0; kernel < vtkPenumbraKernels::GetNumberOfKernels(); ++kernel)
  {
    const std::string name = vtkPenumbraKernels::GetName(kernel);
    EXPECT_TRUE(std::any_of(
      std::begin(Rows), std::end(Rows), [&](const Row& row) { return row.Kernel == name; }))
      << name;
    EXPECT_NE(page.str().find("\n## " + name + "\n"), std::string::npos) << name;
    EXPECT_EQ(vtkPenumbraKernels::Find(name.c_str()), kernel);
    EXPECT_GE(vtkPenumbraKernels::GetFetchesPerPoint(kernel), 1);
    EXPECT_GT(vtkPenumbraKernels::GetBias(kernel), 0.0) << name;
  }
  EXPECT_EQ(vtkPenumbraKernels::Find("steam"), -1);
  EXPECT_EQ(vtkPenumbraKernels::GetName(-1), nullptr);
  EXPECT_EQ(vtkPenumbraKernels::GetBias(-1), 0.0);
}

TEST_P(Kernels, SeeNoOcclusionOnAnOpenPlane)
{
  for (const bool parallel : { false, true })
  {
    OcclusionScene scene;
    scene.AddFloor();
    scene.SetCamera({ 1, -4, 2 }, { 0, 0, 0 });
    scene.UseParallelProjection(parallel, 1.5);
    scene.AddOcclusionPass(1.0)->SetKernelName(GetParam().Kernel);
    scene.Window->Render();
    const std::vector<float> occlusion = scene.Array("AmbientOcclusion");
    // The seam between the plane's two triangles may be off by the depth buffer's rounding.
    double squares = 0.0;
    for (const float value : occlusion)
    {
      squares += static_cast<double>(value) * value;
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(occlusion.size())), .003);
  }
}

TEST_P(Kernels, SeeHalfTheSkyAtTheFootOfAWall)
{
  OcclusionScene scene;
  scene.AddOcclusionPass(1.0)->SetKernelName(GetParam().Kernel);
  const std::vector<double> errors = ErrorsBeforeAWall(scene, GetParam().Truth);
  EXPECT_STREQ(scene.Pass->GetActiveKernelName(), GetParam().Kernel);
  EXPECT_LT(RootMeanSquare(errors), GetParam().Rmse);
}

TEST_P(Kernels, DarkenAShallowValleyBetweenFacetsNoMoreThanTheirRow)
{
  // Two planes that each rise by 10 degrees from x = 0, seen from above.
  OcclusionScene scene;
  const double rise = std::tan(vtkMath::RadiansFromDegrees(10.0));
  scene.AddWall({ 0, -20, 0 }, { 20, 0, 20 * rise }, { 0, 40, 0 });
  scene.AddWall({ 0, -20, 0 }, { -20, 0, 20 * rise }, { 0, 40, 0 });
  scene.SetCamera({ 0, 0, 4 }, { 0, 0, 0 }, { 0, 1, 0 });
  scene.UseParallelProjection(true, 1.5);
  scene.AddOcclusionPass(1.0)->SetKernelName(GetParam().Kernel);
  scene.Window->Render();
  double darkest = 0.0;
  for (double x = .01; x < 1.0; x += .02)
  {
    darkest = std::max(darkest, scene.At("AmbientOcclusion", { x, 0, x * rise }));
  }
  EXPECT_GT(darkest, 0.0);
  EXPECT_LT(darkest, GetParam().BetweenFacets);
}

INSTANTIATE_TEST_SUITE_P(All, Kernels, testing::ValuesIn(Rows), [](const auto& row) {
  std::string name = row.param.Kernel;
  name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
  return name;
});

}
