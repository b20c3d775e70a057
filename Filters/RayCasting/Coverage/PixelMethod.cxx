// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelMethod.h"

#include "Pixels/CoverageConstants.h"
#include "Pixels/TextureBorders.h"
#include "Sampling/SampleLight.h"

#include <algorithm>

namespace penumbra
{

namespace
{

/// Returns true if the pixel that was selected last can be sampled by layers.
bool HasLayers(const PixelContext& pixel, const TileRasterizer& rasterizer)
{
  return rasterizer.HasLayers() && !pixel.Tracer.HasShafts() &&
    !pixel.Tracer.UsesIrradianceProvider();
}

/// Chooses where the samples of a pixel come from.
PixelMethod ChooseSamples(const PixelContext& pixel, const TileGeometry& tile)
{
  if (!tile.Rasterizer)
  {
    return PixelMethod::Rays;
  }
  if (tile.Rasterizer->SelectPixel(pixel.Position))
  {
    return tile.RasterizesAll ? PixelMethod::Triangles : PixelMethod::Rays;
  }
  return HasLayers(pixel, *tile.Rasterizer) ? PixelMethod::Layers : PixelMethod::Rays;
}

/// Returns true if rasterized samples of a pixel with this number of edges take less time than exact
/// coverage.
bool IsRasterized(const PixelContext& pixel, const TileGeometry& tile, std::size_t edges)
{
  if (!tile.Rasterizer || edges < MinimumLayeredEdges)
  {
    return false;
  }
  const bool isOpaque = tile.Rasterizer->SelectPixel(pixel.Position);
  const bool isFull = edges >= MinimumRasterizedEdges && tile.RasterizesAll;
  return isOpaque ? isFull
                  : (isFull || tile.Rasterizer->HasLines()) && HasLayers(pixel, *tile.Rasterizer);
}

/// Chooses the method that replaces one that gave up.
PixelMethod ChooseReplacement(
  PixelMethod gaveUp, const PixelContext& pixel, const PixelEdges& edges, const TileGeometry& tile)
{
  if (gaveUp == PixelMethod::Corners)
  {
    return !edges.Segments.empty() || edges.IsTubeIntersected ? PixelMethod::Exact
                                                              : PixelMethod::Refinement;
  }
  return pixel.ShowsUnsteadyTriangle ? PixelMethod::Rays : ChooseSamples(pixel, tile);
}

template <typename Test>
bool AnyCorner(const PixelContext& pixel, const Test& test)
{
  return std::any_of(
    pixel.Corners, pixel.Corners + 4, [&](const Sample& corner) { return test(corner.FirstHit); });
}

}

PixelMethod ChooseMethod(const PixelContext& pixel, PixelEdges& edges, const TileGeometry& tile,
  std::optional<PixelMethod> gaveUp)
{
  const IntegrationSettings& settings = pixel.Settings;
  if (settings.Method == CoverageMethods::Uniform)
  {
    return PixelMethod::Uniform;
  }
  if (settings.Light && settings.Light->LightsSamples(pixel.Position))
  {
    return PixelMethod::LitRays;
  }
  if (settings.Method == CoverageMethods::Subdivision)
  {
    return PixelMethod::Subdivision;
  }
  if (gaveUp)
  {
    return ChooseReplacement(*gaveUp, pixel, edges, tile);
  }
  // A rasterized triangle has only few colors.
  if (AnyCorner(pixel, [&](const Hit& hit) { return tile.IsUnsteady(pixel.GetScene(), hit); }))
  {
    return PixelMethod::Rays;
  }
  // The pole of a sphere or the center of a fan: too many edges to arrange.
  if (tile.AreEdgesLeftOut || edges.GetNumberOfEdges() > MaximumEdges ||
    IsRasterized(pixel, tile, edges.GetNumberOfEdges()))
  {
    return ChooseSamples(pixel, tile);
  }
  edges.Load(true);
  const bool hasEdges = !edges.Segments.empty();
  const bool hasTexels = IsTextureDiscontinuous(pixel, hasEdges);
  if (hasTexels && tile.Rasterizer && !tile.Rasterizer->SelectPixel(pixel.Position) &&
    HasLayers(pixel, *tile.Rasterizer))
  {
    return PixelMethod::Texels;
  }
  const bool isCrowded = edges.Segments.size() > MaximumEdgesInCrowdedTile;
  const bool isUnknown =
    (settings.Shadows && hasEdges) || pixel.IsNearShadowBoundary() || hasTexels;
  if (isUnknown || AnyCorner(pixel, [&](const Hit& hit) { return tile.IsDense(hit); }))
  {
    // Hidden spheres and tubes may emerge from a dense surface between the corners.
    return isCrowded                       ? ChooseSamples(pixel, tile)
      : isUnknown || edges.HasPrimitives() ? PixelMethod::SampledFaces
                                           : PixelMethod::Faces;
  }
  if (tile.IsCrowded && isCrowded)
  {
    return ChooseSamples(pixel, tile);
  }
  return !hasEdges || (!settings.FindSmallObjects && pixel.CornersAgree()) ? PixelMethod::Corners
                                                                           : PixelMethod::Exact;
}

}
