// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays of static views, and errors of their tiles against brute force.
#include "TracedScene.h"
#include "vtkPenumbraTracedEstimator.h"

#include "BruteForceOcclusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace penumbra_testing;

namespace
{

constexpr int Width = 128;
constexpr int Height = 96;
constexpr int TileSide = 16;

/// A static view, rendered to a tolerance.
struct SettledView
{
  explicit SettledView(double tolerance)
    : Scene(Width, Height)
  {
    AddSpheres(this->Scene);
    vtkNew<vtkPenumbraTracedEstimator> estimator;
    vtkPenumbraTemporalSSAOPass* const pass = this->Scene.AddOcclusionPass(1.0);
    pass->SetEstimator(estimator);
    pass->SetTolerance(tolerance);
    this->Scene.Window->Render();
    this->Rays = estimator->GetNumberOfRays();
    this->Image = this->Scene.Array("AmbientOcclusion");
  }

  OcclusionScene Scene;
  long long Rays = 0;
  std::vector<float> Image;
};

/// Returns the number of tiles whose RMSE exceeds `tolerance`.
int CountTilesAbove(
  const std::vector<float>& image, const std::vector<float>& reference, double tolerance)
{
  int above = 0;
  for (int tile = 0; tile < Width / TileSide * (Height / TileSide); ++tile)
  {
    double squares = 0.0;
    for (int i = 0; i < TileSide * TileSide; ++i)
    {
      const int x = tile % (Width / TileSide) * TileSide + i % TileSide;
      const int y = tile / (Width / TileSide) * TileSide + i / TileSide;
      squares += std::pow(image[y * Width + x] - reference[y * Width + x], 2.0);
    }
    above += std::sqrt(squares / (TileSide * TileSide)) > tolerance ? 1 : 0;
  }
  return above;
}

// Before rays of later rounds shared one range of directions, 1.64 million rays left two tiles above the tolerance.
TEST(SettledRays, MeetTheToleranceOfTilesWithFewRays)
{
  constexpr double Tolerance = .015;
  const SettledView view(Tolerance);
  const std::vector<float> reference =
    ComputeBruteForceOcclusion(view.Scene.Renderer, Width, Height, 1.0, 40);
  EXPECT_LE(CountTilesAbove(view.Image, reference, Tolerance), 1);
  EXPECT_LT(view.Rays, 1'340'000);
}

// With directions that repeat in every second pixel of a row, 254 pixels are off by more than a tenth, and the RMSE is
// .034.
TEST(SettledRays, HaveNoPatternsInTheFirstRound)
{
  const SettledView view(.1);
  const std::vector<float> reference =
    ComputeBruteForceOcclusion(view.Scene.Renderer, Width, Height, 1.0, 40);
  int off = 0;
  for (std::size_t i = 0; i < reference.size(); ++i)
  {
    off += std::abs(view.Image[i] - reference[i]) > .1f ? 1 : 0;
  }
  EXPECT_LT(off, 200);
  EXPECT_LT(Rmse(view.Image, reference), .03);
}

}
