// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelEdges.h"

#include "CoverageConstants.h"
#include "PixelErrors.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <array>
#include <limits>

namespace penumbra
{

namespace
{

/// Returns the distance of p to the segment from a to b.
double ComputeDistanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b)
{
  const glm::dvec2 d = b - a;
  const double square = glm::dot(d, d);
  const double u = square > 0.0 ? glm::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + u * d);
}

}

PixelEdges::PixelEdges(PixelContext& pixel, const TileGeometry& tile)
  : Pixel(pixel),
    Tile(tile)
{
}

void PixelEdges::Begin()
{
  this->List = this->Tile.GetEdges(this->Pixel.Position);
  this->Segments.clear();
  this->VisiblePrimitives.clear();
  this->PairsTested = 0;
  this->MayIntersect = false;
  this->IsTubeIntersected = false;
  this->HasRoundShapes = false;
}

bool PixelEdges::AreConnected() const
{
  // A point has the most edges of a single shape. Its corners are projected to equal points for both of their edges.
  constexpr std::size_t EdgesOfPoint = 4;
  if (this->List.Count == 0 || this->List.Count > EdgesOfPoint)
  {
    return false;
  }
  const auto edgeOf = [&](std::size_t i) -> const ProjectedEdge& {
    return this->Tile.Edges[this->List.Edges[i]];
  };
  std::array<bool, EdgesOfPoint> reached{ true };
  for (std::size_t pass = 1; pass < this->List.Count; ++pass)
  {
    for (std::size_t i = 0; i < this->List.Count; ++i)
    {
      for (std::size_t j = 0; j < this->List.Count; ++j)
      {
        const ProjectedEdge& a = edgeOf(i);
        const ProjectedEdge& b = edgeOf(j);
        reached[j] =
          reached[j] || (reached[i] && (a.A == b.A || a.A == b.B || a.B == b.A || a.B == b.B));
      }
    }
  }
  return std::all_of(
    reached.begin(), reached.begin() + this->List.Count, [](bool is) { return is; });
}

void PixelEdges::Load(bool cull)
{
  this->Segments.clear();
  this->NearestHiddenShape = this->Tile.GetHiddenDepth(this->Pixel.Position);
  this->NearestCulledDepth = this->NearestHiddenShape;

  // An edge behind the opaque surfaces at all four corners is hidden, unless an edge in front of it
  // uncovers it. The exact integrator therefore loads the segments again without culling when a face is
  // deeper. In a valley the edge at the bottom is deeper than the corners, but not deeper than the
  // planes of the triangles that meet there. The limit is the maximum depth of these planes.
  double limit = std::numeric_limits<double>::infinity();
  if (cull && this->List.Count > 0)
  {
    limit = 0.0;
    for (const Sample& corner : this->Pixel.Corners)
    {
      limit = std::max(limit, this->MaximumOpaqueDepth(corner));
    }
    limit = this->ComputeDepthBehind(limit);
  }

  const bool parallel = this->Pixel.Tracer.GetCamera().Parallel;
  const glm::dvec2 origin = this->Pixel.GetOrigin();
  for (std::size_t i = 0; i < this->List.Count; ++i)
  {
    const ProjectedEdge& edge = this->Tile.Edges[this->List.Edges[i]];
    this->HasRoundShapes = this->HasRoundShapes || edge.IsRound();
    PixelSegment segment{ edge.A - origin, edge.B - origin };
    const glm::dvec2 a = segment.A;
    const glm::dvec2 d = segment.B - a;
    const bool inside = ClipToPixel(segment);
    if (inside && limit < std::numeric_limits<double>::infinity())
    {
      const double square = glm::dot(d, d);
      const double slope = edge.DepthB - edge.DepthA;
      const double u = edge.DepthA + slope * (glm::dot(segment.A - a, d) / square);
      const double v = edge.DepthA + slope * (glm::dot(segment.B - a, d) / square);
      const double depth = parallel ? std::min(u, v) : 1.0 / std::max(u, v);
      if (depth > limit)
      {
        this->NearestCulledDepth = std::min(this->NearestCulledDepth, depth);
        this->AddHiddenShape(edge, depth, limit);
        continue;
      }
    }
    for (int corner = 0; corner < 4; ++corner)
    {
      if (ComputeDistanceToSegment(GetCornerOffset(corner), a, a + d) < EdgePrecision)
      {
        this->Pixel.TrustedCorners &= ~(1u << corner);
      }
    }
    if (inside)
    {
      this->Segments.push_back(segment);
    }
  }
}

// A sphere or tube whose outline is hidden may emerge from the surface in front of it.
void PixelEdges::AddHiddenShape(const ProjectedEdge& edge, double depth, double limit)
{
  if (!edge.IsRound())
  {
    return;
  }
  const RoundShape shape =
    this->Pixel.GetSurfaces()[edge.RoundSurface].GetRoundShape(edge.RoundPrimitive);
  if (depth - 2.0 * std::max(shape.RadiusA, shape.RadiusB) <= limit)
  {
    this->AddPrimitive(PrimitiveId{ edge.RoundSurface, edge.RoundPrimitive });
  }
}

void PixelEdges::AddPrimitive(const Hit& hit)
{
  if (hit.IsHit())
  {
    this->AddPrimitive(PrimitiveId{ hit.Surface, hit.Primitive });
  }
}

void PixelEdges::AddPrimitive(PrimitiveId id)
{
  if (this->VisiblePrimitives.size() < MaximumTriangles &&
    std::find(this->VisiblePrimitives.begin(), this->VisiblePrimitives.end(), id) ==
      this->VisiblePrimitives.end())
  {
    this->VisiblePrimitives.push_back(id);
  }
}

// Surfaces behind translucent ones may intersect, too.
void PixelEdges::AddLayersBehind(int corner)
{
  if (!this->Pixel.Tracer.HasTranslucentSurfaces())
  {
    return;
  }
  const glm::ivec2 at = this->Pixel.Position + glm::ivec2(GetCornerOffset(corner));
  const auto [entry, isNew] = this->LayersBehind.try_emplace({ at.x, at.y });
  if (isNew)
  {
    const Sample sample = this->Pixel.Grid.At(at.x, at.y);
    Hit hit = sample.FirstHit;
    Ray ray = this->Pixel.Tracer.MakeRay(glm::dvec2(at));
    for (int layer = 0; layer <= MaximumIntersectedLayers && hit.Distance < sample.OpaqueDepth;
         ++layer)
    {
      hit = this->Pixel.Tracer.GetRays().Intersect(
        ray); // the first one again, since corners lack what is behind
      ++this->Pixel.Rays.Refinement;
      ray = ContinueBehind(ray, hit);
      if (layer > 0 && hit.IsHit())
      {
        entry->second.push_back({ hit.Surface, hit.Primitive });
      }
    }
  }
  for (const PrimitiveId id : entry->second)
  {
    this->AddPrimitive(id);
  }
}

bool PixelEdges::AddIntersections()
{
  const std::size_t before = this->Segments.size();
  const glm::dvec2 origin = this->Pixel.GetOrigin();
  const Scene& scene = this->Pixel.Tracer.GetScene();
  bool found = false;
  for (std::size_t i = this->PairsTested; i < this->VisiblePrimitives.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const PrimitiveId a = this->VisiblePrimitives[i];
      const PrimitiveId b = this->VisiblePrimitives[j];
      PixelSegment segment;
      if (scene.Surfaces[a.Surface].IsRound() || scene.Surfaces[b.Surface].IsRound())
      {
        IntersectSphere(scene, a, b, origin, this->Segments);
        this->IsTubeIntersected = this->IsTubeIntersected || MayIntersectTube(scene, a, b, origin);
      }
      else if (IntersectTriangles(scene, a, b, origin, segment))
      {
        this->Segments.push_back(segment);
        found = true;
      }
    }
  }
  this->PairsTested = this->VisiblePrimitives.size();
  this->MayIntersect = this->MayIntersect || found;
  this->HasFoundIntersection = this->HasFoundIntersection || found;
  return this->Segments.size() > before;
}

void PixelEdges::FindNearbyIntersections()
{
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    const Sample& corner = this->Pixel.Corners[i];
    this->AddPrimitive(corner.FirstHit);
    this->AddLayersBehind(i);
    nearest = std::min(nearest, static_cast<double>(corner.OpaqueDepth));
    farthest = std::max(farthest, static_cast<double>(corner.OpaqueDepth));
  }
  // Two surfaces at similar depths may intersect even if the triangles at the corners do not.
  const double footprint = this->Pixel.ComputePixelSize(nearest);
  this->MayIntersect = this->SearchesAllPixels ||
    (!this->Pixel.CornersAgree() && farthest - nearest < TouchingDepth * footprint);
  if (!this->AddIntersections() && !this->MayIntersect)
  {
    return;
  }
  this->Pixel.AnyNeighborCorner([this](const Sample& neighbor) {
    this->AddPrimitive(neighbor.FirstHit);
    return false;
  });
  this->AddIntersections();
}

}
