// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TileGeometry.h"

#include "CoverageConstants.h"
#include "Scene.h"
#include "Surface.h"

namespace penumbra
{

TileGeometry::TileGeometry(const TileEdges& edges, glm::ivec2 origin, int side,
  TileRasterizer* rasterizer, const SurfaceFlags& flags)
  : Edges(edges.All),
    Rasterizer(rasterizer),
    AreEdgesLeftOut(edges.AreLeftOut),
    Hidden(edges.Hidden),
    Origin(origin),
    Side(side),
    Flags(flags)
{
  BinEdges(
    edges.All, edges.Indices, edges.Count, glm::dvec2(origin), 1.0, glm::ivec2(side), this->Lists);
  const std::size_t area = static_cast<std::size_t>(side) * side;
  const std::size_t count = this->Lists.GetNumberOfValues();
  this->IsCrowded = count > CrowdedEdgesPerPixel * area;
  this->RasterizesAll = rasterizer && count > RasterizedEdgesPerPixel * area;
}

Steadiness TileGeometry::FindSteadiness(const CameraRayTracer& tracer, const Hit& hit) const
{
  if (!hit.IsHit() || this->Flags.Unsteady.empty() || !this->Flags.Unsteady[hit.Surface])
  {
    return Steadiness::Steady;
  }
  const Surface& surface = tracer.GetRays().GetSurfaces()[hit.Surface];
  if (HasUnsteadyNormal(surface, surface.GetStoredTriangle(hit.Primitive)))
  {
    return Steadiness::Unsteady;
  }
  return IsPartlyNegated(surface, hit.Primitive, tracer.GetCamera()) ? Steadiness::PartlyNegated
                                                                     : Steadiness::Steady;
}

}
