// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Exact coverage: projected edges and intersections of triangles cut the pixel into faces, and each
// face shows one surface.
#ifndef penumbra_ExactIntegrator_h
#define penumbra_ExactIntegrator_h

#include "Pixels/CoverageConstants.h"
#include "Pixels/PixelEdges.h"

#include <optional>
#include <vector>

namespace penumbra
{

class ExactIntegrator
{
public:
  ExactIntegrator(PixelContext& pixel, PixelEdges& edges, const TileGeometry& tile);

  /// Integrates the current pixel, whose edges are loaded. Gives up, without a result, as soon as the
  /// faces cost more than samples of the same accuracy, or their colors cannot be found from few rays:
  /// at intersections of tubes and on unsteady triangles. With `once`, it also gives up where hidden edges or
  /// intersections would divide the faces again.
  std::optional<PixelResult> Integrate(bool once = false);

private:
  /// Positions at which a face is probed by rays, and the result.
  struct FaceProbe
  {
    static constexpr int Sides = 8;

    glm::dvec2 ExtremePoints[Sides]; ///< farthest trapezoid corner in each direction
    bool IsEmpty = true;
    bool IsDiscontinuous = false; ///< the face contains an edge that the arrangement lacks

    void Add(glm::dvec2 point);
  };

  /// What a ray hits up to the first surface that is opaque, or that has MaximumIntersectedLayers in front.
  struct VisibleHits
  {
    Hit Layers[MaximumIntersectedLayers + 1];
    int Count = 0;
  };

  void UpdateMaximumFaceDepth(const Sample& sample);
  bool AreDisconnected(const Hit& a, const Hit& b) const;
  bool AreDisconnected(const VisibleHits& a, const VisibleHits& b) const;
  void ProbeLargeTrapezoids();
  VisibleHits ProbeAt(glm::dvec2 local);
  void ProbeTrapezoids();
  /// Returns how much the color of a round surface with little contrast may vary over a face.
  float ComputeRoundVariation(const Hit& hit, float area) const;
  bool ShowsOtherSurface(const PixelArrangement::Face& face, const Hit& expected);
  PixelResult ComputeFaceColor(std::size_t face);
  PixelResult SampleRoundFace(std::size_t face);
  PixelResult SplitFace(std::size_t face);
  void SplitTrapezoid(const PixelArrangement::Trapezoid& trapezoid, glm::dvec2 low, double side,
    const Sample& center, glm::vec4& color, float& squaredError);

  PixelContext& Pixel;
  PixelEdges& Edges;
  const TileGeometry& Tile;
  PixelArrangement Arrangement;
  std::vector<FaceProbe> FaceProbes; ///< per face; empty if the faces were not probed
  double MaximumFaceDepth = 0.0;
};

}
#endif
