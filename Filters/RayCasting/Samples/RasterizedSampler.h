// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sampling without rays: the triangles at the samples of a pixel full of edges are found by comparing
// all samples with all triangles of the pixel. Each visible triangle is then shaded at the mean position
// of its samples, or of a few parts if it covers much of the pixel.
#ifndef penumbra_RasterizedSampler_h
#define penumbra_RasterizedSampler_h

#include "Pixels/PixelContext.h"
#include "Rasterization/TileRasterizer.h"
#include "SampledPixel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

class RasterizedSampler
{
public:
  RasterizedSampler(PixelContext& pixel, TileRasterizer& rasterizer);

  /// Finds the triangles at more samples of the pixel that the rasterizer has selected, up to `total`,
  /// and adds their colors.
  void AddSamples(SampledPixel& pixel, std::size_t total);

private:
  /// Samples at which one triangle, or the background, is visible.
  struct VisibleTriangle
  {
    std::uint32_t Index; ///< see TileRasterizer::GetTriangle()
    std::uint32_t First; ///< of its samples in Grouped
    std::uint32_t Count; ///< number of its samples
  };

  void GroupSamples();
  std::uint32_t AddToTriangleColor(
    SampledPixel& pixel, std::size_t knownColors, const VisibleTriangle& triangle);
  glm::vec4 ShadeTriangle(
    const SampledPixel& pixel, const VisibleTriangle& triangle, PrimitiveId id, bool isConstant);

  PixelContext& Pixel;
  TileRasterizer& Rasterizer;
  SamplePoints Points;
  std::vector<std::uint32_t> Visible; ///< triangle at each of these points
  std::vector<VisibleTriangle> Triangles;
  std::vector<std::uint32_t> Grouped; ///< indices of points, by triangle
  std::vector<std::uint32_t> Groups;  ///< scratch memory of GroupSamples()
};

}
#endif
