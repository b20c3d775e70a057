// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A scene for comparisons of traced occlusion with brute force.
#ifndef penumbra_TracedScene_h
#define penumbra_TracedScene_h

#include "../../ScreenSpace/Testing/OcclusionScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace penumbra_testing
{

/// Adds spheres at several heights over a floor.
inline void AddSpheres(OcclusionScene& scene)
{
  scene.AddFloor();
  for (int i = 0; i < 25; ++i)
  {
    const int x = i % 5;
    const int y = i / 5;
    scene.AddSphere({ x - 2.0, y - 2.0, .4 + .3 * ((7 * x + 3 * y) % 5) }, .6);
  }
  scene.SetCamera({ 0, -7, 6 }, { 0, 0, 0 });
}

/// Returns the RMS difference of two images.
inline double Rmse(const std::vector<float>& a, const std::vector<float>& b)
{
  EXPECT_EQ(a.size(), b.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    squares += std::pow(a[i] - b[i], 2.0);
  }
  return std::sqrt(squares / static_cast<double>(a.size()));
}

}
#endif
