// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sampling without rays where surfaces are translucent: the triangles at each sample of a pixel are
// found front to back, each is shaded once or a few times per pixel, and their colors are composited
// per sample as along a ray.
#ifndef penumbra_LayerSampler_h
#define penumbra_LayerSampler_h

#include "Pixels/PixelContext.h"
#include "Rasterization/TileRasterizer.h"
#include "SampledPixel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

/// Shades a triangle of the selected pixel at the center of the part of the pixel that it covers, or,
/// if that part is large, near some of its corners. Adds its texture to `pixel`.
void ShadePartOfLayer(PixelContext& context, const TileRasterizer& rasterizer, std::uint32_t layer,
  SampledPixel& pixel, PixelLayerColor& color);

/// Samples the pixels of one tile.
class LayerSampler
{
public:
  LayerSampler(PixelContext& pixel, TileRasterizer& rasterizer);

  /// Adds samples of the pixel that the rasterizer has selected, up to `total`.
  void AddSamples(SampledPixel& pixel, std::size_t total);

private:
  void ShadeLayer(SampledPixel& pixel, std::uint32_t layer, PixelLayerColor& color);
  void LoadBackground(const SampledPixel& pixel);
  glm::vec4 CompositeLayers(
    SampledPixel& pixel, glm::vec2 point, const LayerCandidate* begin, const LayerCandidate* end);

  PixelContext& Pixel;
  TileRasterizer& Rasterizer;
  SamplePoints Points;
  /// Per triangle of the tile: its color, if it is constant and was found.
  std::vector<PixelLayerColor> ConstantLayers;
  PixelLayerColor Background; ///< in the current pixel, premultiplied by alpha; not of images
};

}
#endif
