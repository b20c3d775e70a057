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

/// Bounds of each kernel: the RMSE in front of a wall, with the closed form as reference, and the
/// occlusion between two facets of a coarse mesh, which is 0.030.
struct Bounds
{
  const char* Kernel;
  double (*Reference)(double);
  double Rmse;
  double BetweenFacets;
};

const Bounds BoundsTable[] = {
  { "volumetric", BehindWallFading, 0.02, 0.035 },
  { "patch", BehindWall, 0.3, 0.12 },            // no D: only bounds
  { "depth-difference", BehindWall, 0.2, 0.11 }, // no D: only bounds
  { "horizon", BehindWall, 0.02, 0.035 },
  { "march", BehindWall, 0.025, 0.035 },
};

class Kernels : public testing::TestWithParam<Bounds>
{
};

TEST(KernelTable, HasATestRowAndAParagraphForEveryKernel)
{
  std::stringstream page;
  page << std::ifstream(PENUMBRA_SOURCE_DIR "/Documentation/methods/Kernels.md").rdbuf();
  for (int kernel = 0; kernel < vtkPenumbraKernels::GetNumberOfKernels(); ++kernel)
  {
    const std::string name = vtkPenumbraKernels::GetName(kernel);
    EXPECT_TRUE(std::any_of(std::begin(BoundsTable), std::end(BoundsTable),
      [&](const Bounds& row) { return row.Kernel == name; }))
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

TEST_P(Kernels, ReturnZeroOnAnOpenPlane)
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
    // At the shared edge of the plane's two triangles, depth is off by the rounding of the depth
    // buffer.
    double squares = 0.0;
    for (const float value : occlusion)
    {
      squares += static_cast<double>(value) * value;
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(occlusion.size())), 0.003);
  }
}

TEST_P(Kernels, MatchTheClosedFormInFrontOfAWall)
{
  OcclusionScene scene;
  scene.AddOcclusionPass(1.0)->SetKernelName(GetParam().Kernel);
  const std::vector<double> errors = ErrorsBeforeAWall(scene, GetParam().Reference);
  EXPECT_STREQ(scene.Pass->GetActiveKernelName(), GetParam().Kernel);
  EXPECT_LT(RootMeanSquare(errors), GetParam().Rmse);
}

TEST_P(Kernels, StayBelowTheirBoundBetweenFacets)
{
  // Two planes that rise by 10 degrees from x = 0 to both sides, viewed from above.
  OcclusionScene scene;
  const double rise = std::tan(vtkMath::RadiansFromDegrees(10.0));
  scene.AddWall({ 0, -20, 0 }, { 20, 0, 20 * rise }, { 0, 40, 0 });
  scene.AddWall({ 0, -20, 0 }, { -20, 0, 20 * rise }, { 0, 40, 0 });
  scene.SetCamera({ 0, 0, 4 }, { 0, 0, 0 }, { 0, 1, 0 });
  scene.UseParallelProjection(true, 1.5);
  scene.AddOcclusionPass(1.0)->SetKernelName(GetParam().Kernel);
  scene.Window->Render();
  double maximum = 0.0;
  for (double x = 0.01; x < 1.0; x += 0.02)
  {
    maximum = std::max(maximum, scene.At("AmbientOcclusion", { x, 0, x * rise }));
  }
  EXPECT_GT(maximum, 0.0);
  EXPECT_LT(maximum, GetParam().BetweenFacets);
}

INSTANTIATE_TEST_SUITE_P(All, Kernels, testing::ValuesIn(BoundsTable), [](const auto& row) {
  std::string name = row.param.Kernel;
  name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
  return name;
});

}
