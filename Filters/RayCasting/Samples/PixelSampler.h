// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Samples of the pixels of a tile: those of dense surfaces, and those whose exact coverage would cost
// more than samples of the same accuracy. TileRefinement.h decides the number of samples.
#ifndef penumbra_PixelSampler_h
#define penumbra_PixelSampler_h

#include "LayerSampler.h"
#include "Pixels/PixelEdges.h"
#include "Pixels/PixelErrors.h"
#include "RasterizedSampler.h"
#include "SampledPixel.h"
#include "Sampling/SampleLight.h"

#include <optional>
#include <vector>

namespace penumbra
{

class PixelSampler
{
public:
  PixelSampler(PixelContext& pixel, PixelEdges& edges, const TileGeometry& tile);

  /// Adds the current pixel with its first samples. Returns their estimate.
  PixelResult Sample(SampleSource source);

  /// Adds the current pixel with the faces between its edges, whose colors samples correct: the
  /// triangles of a dense surface have no edges, so colors vary within faces. Gives up, without a
  /// result, if the arrangement of the edges costs more than samples.
  /// @param isUnknown The variation of the colors is not known from corners and faces, so that the
  /// first samples are traced at once.
  std::optional<PixelResult> SampleFaces(bool isUnknown);

  /// Doubles the number of samples of a pixel; the first MinimumSamples are traced at once.
  void Refine(SampledPixel& pixel);

  /// Returns the maximum number of samples of a tile, per pixel. `isLit`: the samples are lit.
  double GetSampleBudget(bool isLit) const
  {
    const double tolerance = this->Pixel.Settings.Tolerance;
    return isLit            ? LitSampleBudgetFactor * ComputeMaximumSamples(tolerance)
      : this->IsExactCostly ? ComputeMaximumSamples(tolerance)
                            : ComputeSampleBudget(tolerance);
  }

  std::vector<SampledPixel>& GetPixels() { return this->Sampled; }
  const IntegrationSettings& GetSettings() const { return this->Pixel.Settings; }

private:
  SampledPixel& AddPixel();
  bool BuildFaces();
  void ComputeFaceColors(SampledPixel& pixel);
  template <typename Trace>
  void TracePackets(SampledPixel& pixel, std::size_t total, const Trace& trace);
  void TraceSamples(SampledPixel& pixel, std::size_t total);
  void TraceLitSamples(SampledPixel& pixel, std::size_t total);

  PixelContext& Pixel;
  PixelEdges& Edges;
  TileRasterizer* const Rasterizer;
  const bool IsExactCostly; ///< so that all pixels of the tile are sampled
  std::optional<RasterizedSampler> Rasterized;
  std::optional<LayerSampler> Layers;
  PixelArrangement Arrangement;
  SampleLight::Packet Lit;
  std::vector<SampledPixel> Sampled;
};

}
#endif
