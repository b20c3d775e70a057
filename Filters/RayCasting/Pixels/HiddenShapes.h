// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Opaque surfaces at the corners of the pixels of a tile, and the shapes behind them.
#ifndef penumbra_HiddenShapes_h
#define penumbra_HiddenShapes_h

#include "Edges/EdgeSource.h"
#include "Sampling/CornerGrid.h"

#include <cstddef>
#include <vector>

namespace penumbra
{

struct Scene;

/// Returns the maximum depth, in the pixel with the lower left corner `origin`, of the opaque surface that a
/// sample hit; infinity if it is not bounded.
double MaximumOpaqueDepth(const Scene& scene, const Sample& sample, glm::dvec2 origin);

/// Returns the smallest depth that is behind `depth` in spite of rounding.
double ComputeDepthBehind(double depth, const Camera& camera);

/// The pixels [low, high) of a tile.
class HiddenShapes
{
public:
  /// The corners of pixels outside of `grid` are assumed to hide nothing.
  HiddenShapes(const Scene& scene, const CornerGrid& grid, glm::ivec2 low, glm::ivec2 high);

  /// Returns true if, in all its pixels, a shape is behind the opaque surfaces at all four corners. It may be
  /// visible between them.
  bool Add(const ShapeBounds& bounds);

  /// Returns a lower bound of the depths of the shapes in a pixel for which Add() was true.
  double GetNearestDepth(glm::ivec2 pixel) const { return this->NearestDepths[this->Index(pixel)]; }

private:
  std::size_t Index(glm::ivec2 pixel) const
  {
    const glm::ivec2 p = pixel - this->Low;
    return static_cast<std::size_t>(p.y) * (this->High.x - this->Low.x) + p.x;
  }

  glm::ivec2 Low, High;
  std::vector<double> OpaqueDepths; ///< maximum of each pixel
  std::vector<double> NearestDepths;
};

}
#endif
