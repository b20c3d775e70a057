// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The nearest triangle at each sample of a pixel.
#ifndef penumbra_NearestTriangles_h
#define penumbra_NearestTriangles_h

#include "PixelTriangles.h"
#include "SamplePoints.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

class NearestTriangles
{
public:
  static constexpr std::uint32_t None = 0xffffffffu;

  /// Finds the triangles at points. `visible` receives their indices in the tile, or None.
  void Find(
    const PixelTriangles& pixel, const SamplePoints& points, std::vector<std::uint32_t>& visible);

private:
  void CoverCoincident(const PixelTriangles& pixel, const SamplePoints& points);

  std::vector<float> Nearest;
  std::vector<float> Errors;
  std::vector<std::int32_t> Found;
};

}
#endif
