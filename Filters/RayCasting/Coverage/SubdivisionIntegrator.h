// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Recursive subdivision of pixels [AA], controlled by surface ids or by the estimated error.
#ifndef penumbra_SubdivisionIntegrator_h
#define penumbra_SubdivisionIntegrator_h

#include "Pixels/PixelEdges.h"
#include "Sampling/CameraRayTracer.h"

#include <cstdint>
#include <unordered_map>

namespace penumbra
{

/// Integrates pixels of one tile, which share rays.
class SubdivisionIntegrator
{
public:
  SubdivisionIntegrator(PixelContext& pixel, const PixelEdges& edges);

  /// Integrates the current pixel. If `byObject` is on, only squares with an edge or whose corners are
  /// on several surfaces are subdivided; else also those with a larger error than the tolerance.
  PixelResult Integrate(bool byObject);

private:
  /// A square of the subdivision of a pixel.
  struct Square
  {
    glm::ivec2 Low; ///< lower left corner, in units of the finest level
    int Level;
    Sample Corners[4]; ///< (0, 0), (1, 0), (0, 1), (1, 1)
  };

  void Subdivide(const Square& square, bool byObject, glm::vec4& color, float& squaredError);
  bool NeedsSubdivision(const Square& square) const;
  const Sample& GetGridSample(glm::ivec2 fine);

  PixelContext& Pixel;
  const PixelEdges& Edges;
  /// By position on the finest grid, so that rays at shared corners and sides of squares are traced once [AA].
  std::unordered_map<std::uint64_t, Sample> Samples;
};

}
#endif
