// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Computes the color of one pixel from its corners, the edges that cross it, and additional rays as
// required by the tolerance: the four cases of [AA], exact coverage, and error-driven refinement.
#ifndef penumbra_PixelIntegrator_h
#define penumbra_PixelIntegrator_h

#include "ExactIntegrator.h"
#include "Samples/PixelSampler.h"
#include "SubdivisionIntegrator.h"

#include <optional>

namespace penumbra
{

enum class PixelMethod;

/// Integrates the pixels of one tile, one at a time, by the method that ChooseMethod() returns.
class PixelIntegrator
{
public:
  /// All arguments must outlive this object.
  PixelIntegrator(const CameraRayTracer& tracer, const CornerGrid& corners,
    const TileGeometry& tile, const IntegrationSettings& settings);

  /// Computes a pixel. If it is sampled, GetSampler() contains it afterwards, and the result is its
  /// first estimate.
  PixelResult Integrate(glm::ivec2 position);

  /// Returns true if intersecting triangles were found in a pixel.
  bool HasFoundIntersection() const { return this->Edges.HasFoundIntersection; }

  /// Begins again with the first pixel and searches all pixels with edges for intersecting triangles.
  void SearchAllPixelsForIntersections();

  PixelSampler& GetSampler() { return this->Sampler; }
  /// Returns the last pixel, and the counts of all.
  PixelContext& GetPixel() { return this->Pixel; }

private:
  /// Returns no result if the method gives up.
  std::optional<PixelResult> Apply(PixelMethod method);
  std::optional<PixelResult> IntegrateCorners();

  const TileGeometry& Tile;
  PixelContext Pixel;
  PixelEdges Edges;
  ExactIntegrator Exact;
  SubdivisionIntegrator Subdivided;
  PixelSampler Sampler;
};

}
#endif
