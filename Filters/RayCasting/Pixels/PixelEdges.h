// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The edges of one pixel: projected edges of the scene that are not hidden, and the intersections of
// the surfaces that rays hit.
#ifndef penumbra_PixelEdges_h
#define penumbra_PixelEdges_h

#include "PixelArrangement.h"
#include "PixelContext.h"
#include "TileGeometry.h"
#include "TriangleIntersection.h"

#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace penumbra
{

/// Edges of the pixels of one tile, one pixel at a time.
class PixelEdges
{
public:
  /// Both arguments must outlive this object.
  PixelEdges(PixelContext& pixel, const TileGeometry& tile);

  /// Begins with the current position of the pixel, without segments.
  void Begin();

  /// Returns the number of projected edges that cross the pixel, hidden ones included.
  std::size_t GetNumberOfEdges() const { return this->List.Count; }

  /// Returns whether these edges form one chain, as those of a single point or of the end of a line do.
  bool AreConnected() const;

  /// Loads the segments of the projected edges. If `cull` is on, edges behind the opaque surfaces at
  /// all four corners are left out. Corners near an edge are no longer trusted.
  void Load(bool cull);

  /// Forgets the projected edges, so that Load() finds none.
  void ForgetEdges() { this->List = {}; }

  /// Returns true if an edge was left out that surfaces down to `depth` do not hide. `depth`: maximum
  /// of MaximumOpaqueDepth() over the faces of the pixel.
  bool UncoversHiddenEdge(double depth) const
  {
    return this->ComputeDepthBehind(depth) >= this->NearestCulledDepth;
  }
  /// Returns true if such an edge may be one that cannot be loaded.
  bool UncoversHiddenShape(double depth) const
  {
    return this->NearestHiddenShape < std::numeric_limits<double>::infinity() &&
      this->ComputeDepthBehind(depth) >= this->NearestHiddenShape;
  }
  bool HasHiddenEdges() const
  {
    return this->NearestCulledDepth < std::numeric_limits<double>::infinity();
  }

  /// Returns the maximum depth in this pixel of the opaque surface that a sample hit.
  double MaximumOpaqueDepth(const Sample& sample) const
  {
    return penumbra::MaximumOpaqueDepth(
      this->Pixel.Tracer.GetScene(), sample, this->Pixel.GetOrigin());
  }

  /// Adds what a sample hit to the primitives whose intersections are edges.
  void AddPrimitive(const Hit& hit);
  bool HasPrimitives() const { return !this->VisiblePrimitives.empty(); }

  /// Intersects the primitives at the corners. If any intersect, also those at neighboring corners,
  /// because intersections continue there.
  void FindNearbyIntersections();

  /// Adds the intersections of new primitives to the segments. Returns false if there are none.
  bool AddIntersections();

  /// Adds all intersections again, after Load().
  bool AddIntersectionsAgain()
  {
    this->PairsTested = 0;
    return this->AddIntersections();
  }

  /// Searches all following pixels with edges for intersecting triangles.
  void SearchAllPixels() { this->SearchesAllPixels = true; }

  std::vector<PixelSegment> Segments;
  bool MayIntersect = false;      ///< some visible triangles intersect, or may
  bool IsTubeIntersected = false; ///< a visible tube may intersect another surface here
  bool HasRoundShapes = false;    ///< outlines of spheres or tubes, or hidden ones, cross the pixel
  bool HasFoundIntersection = false; ///< intersecting triangles were found in a pixel of the tile
  bool SearchesAllPixels = false;

private:
  double ComputeDepthBehind(double depth) const
  {
    return penumbra::ComputeDepthBehind(depth, this->Pixel.Tracer.GetCamera());
  }
  void AddPrimitive(PrimitiveId id);
  void AddLayersBehind(int corner);
  void AddHiddenShape(const ProjectedEdge& edge, double depth, double limit);

  PixelContext& Pixel;
  const TileGeometry& Tile;
  EdgeList List;
  double NearestCulledDepth = 0.0;
  double NearestHiddenShape = 0.0;
  std::vector<PrimitiveId> VisiblePrimitives; ///< hit by samples
  /// What is behind translucent surfaces at a corner of the grid.
  std::map<std::pair<int, int>, std::vector<PrimitiveId>> LayersBehind;
  std::size_t PairsTested = 0; ///< number of primitives whose pairs were intersected
};

}
#endif
