// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RegionTiles.h"

#include "Pixels/CoverageConstants.h"
#include "Pixels/PixelErrors.h"
#include "Samples/TileRefinement.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace penumbra
{

namespace
{

// Side of a tile in pixels. A tile is the unit of work of a thread.
constexpr int TileSide = 32;
/// Number of edges for which memory is reserved for each outline in a tile.
constexpr std::size_t EdgesPerOutline = 80;
// Side of the tiles in pixels whose RMSE the tolerance bounds.
constexpr int ErrorTileSide = 16;

/// Refines the sampled pixels of [low, high), which contains whole tiles of ErrorTileSide pixels. Returns
/// the number of pixels in tiles whose refinement the limit of the integration ended.
int RefineTiles(glm::ivec2 low, glm::ivec2 high, PixelIntegrator& integrator, ImageRegion& region)
{
  int unfinished = 0;
  if (integrator.GetSampler().GetPixels().empty())
  {
    return unfinished;
  }
  for (glm::ivec2 first = low; first.y < high.y; first = first.x + ErrorTileSide < high.x
         ? first + glm::ivec2(ErrorTileSide, 0)
         : glm::ivec2(low.x, first.y + ErrorTileSide))
  {
    const glm::ivec2 last = glm::min(first + ErrorTileSide, high);
    std::vector<SampledPixel*> pixels;
    double squares = 0.0;
    for (int y = first.y; y < last.y; ++y)
    {
      for (int x = first.x; x < last.x; ++x)
      {
        const double error = region.Errors[region.Index(x, y)];
        squares += error * error;
      }
    }
    for (SampledPixel& pixel : integrator.GetSampler().GetPixels())
    {
      if (pixel.X >= first.x && pixel.X < last.x && pixel.Y >= first.y && pixel.Y < last.y)
      {
        const double error = region.Errors[region.Index(pixel.X, pixel.Y)];
        squares -= error * error;
        region.RaysPerPixel[region.Index(pixel.X, pixel.Y)] -= static_cast<float>(pixel.Rays);
        pixels.push_back(&pixel);
      }
    }
    const int count = (last.x - first.x) * (last.y - first.y);
    const bool finished =
      RefineTile(integrator.GetSampler(), pixels, count, std::max(squares, 0.0));
    unfinished += finished ? 0 : static_cast<int>(pixels.size());
    for (const SampledPixel* pixel : pixels)
    {
      const std::size_t index = region.Index(pixel->X, pixel->Y);
      StorePixel(pixel->Result, pixel->MediumError, index, region);
      region.RaysPerPixel[index] += static_cast<float>(pixel->Rays);
      PixelCounts& counts = integrator.GetPixel().Pixels;
      pixel->GetNumberOfSamples() == 0 ? ++counts.Interior : ++counts.Uniform;
    }
  }
  return unfinished;
}

/// Returns the number of outlines of a shape in the pixels of a tile, about the length of its outline there.
double CountCrossings(const ShapeBounds& bounds, glm::dvec2 low, glm::dvec2 high)
{
  const glm::dvec2 size = bounds.IsKnown
    ? glm::max(glm::min(bounds.High, high) - glm::max(bounds.Low, low), 0.0)
    : high - low;
  return 2.0 * (size.x + size.y);
}

/// Returns a flag for each tile: the samples of its pixels may be rasterized.
std::vector<char> SelectRasterizedTiles(
  const Scene& scene, const IntegrationSettings& integration, const EdgeBins& tileEdges)
{
  std::vector<char> selected(tileEdges.GetNumberOfBins(), 0);
  if (integration.Rasterize && !integration.Shadows &&
    integration.Method == CoverageMethods::Silhouettes &&
    !TileRasterizer::RequiresRays(scene.Surfaces))
  {
    const auto any = [&](const auto& test) {
      return std::any_of(scene.Surfaces.begin(), scene.Surfaces.end(), test);
    };
    const bool hasLines = any([](const Surface& surface) { return surface.IsLineOrPoint; });
    const bool hasTextures =
      any([](const Surface& surface) { return surface.LitTexture != nullptr; });
    const std::size_t minimum = hasTextures ? 0
      : hasLines                            ? MinimumLayeredEdges
                                            : MinimumEdgesOfRasterizedTile;
    for (std::size_t tile = 0; tile < selected.size(); ++tile)
    {
      selected[tile] = tileEdges.GetCount(tile) >= minimum;
    }
  }
  return selected;
}

}

void StorePixel(
  const PixelResult& result, float mediumError, std::size_t index, ImageRegion& region)
{
  const float alpha = result.Color.a;
  region.Colors[index] =
    alpha > 0.f ? glm::vec4(glm::vec3(result.Color) / alpha, alpha) : glm::vec4(0.f);
  region.Errors[index] = std::hypot(result.Error, mediumError);
  if (!region.LightErrors.empty())
  {
    region.LightErrors[index] = std::hypot(result.LightError, mediumError);
  }
  if (!region.Occlusions.empty())
  {
    region.Occlusions[index] = result.Occlusion;
  }
}

RegionTiles::RegionTiles(const CameraRayTracer& tracer, const CornerGrid& grid,
  const SceneEdges& sceneEdges, const RenderSettings& settings, const ImageRegion& region,
  const ProgressCallback& progress, double fraction)
  : Tracer(tracer),
    Grid(grid),
    MeshEdges(sceneEdges),
    Settings(settings),
    Low(region.Low),
    High(region.High),
    First(region.Low / TileSide),
    Count((region.High + TileSide - 1) / TileSide - region.Low / TileSide),
    Cells{ glm::dvec2(this->First * TileSide), TileSide, this->Count },
    Instances(tracer.GetScene(), sceneEdges.EdgesBySurface, this->Cells),
    Outlines(tracer.GetScene(),
      sceneEdges.EdgesBySurface.empty() ? TileGrid{ this->Cells.Origin, TileSide, glm::ivec2(0) }
                                        : this->Cells)
{
  const Scene& scene = tracer.GetScene();
  const ImagePart part(scene.ViewCamera, region.Low, region.High);
  for (std::size_t i = 0; i < sceneEdges.EdgesBySurface.size(); ++i)
  {
    ThrowIfStopped(progress, fraction);
    if (!scene.Surfaces[i].Instances)
    {
      this->NumberOfEdges += ProjectEdges(
        scene.Surfaces[i], sceneEdges.EdgesBySurface[i], scene.ViewCamera, part, this->Edges);
    }
  }
  this->NumberOfEdges += this->Instances.ProjectLarge(part, this->Edges);
  BinEdges(this->Edges, nullptr, this->Edges.size(), this->Cells.Origin, TileSide, this->Count,
    this->EdgesByTile);
  this->Triangles.emplace(
    scene, this->Cells, SelectRasterizedTiles(scene, settings.Integration, this->EdgesByTile));
}

// The error estimate needs the neighbors for second differences of colors. Whether a shape is hidden in a
// tile must not depend on the region.
RegionTiles::Rectangle RegionTiles::FindPixelsOfCorners(
  const Scene& scene, glm::ivec2 low, glm::ivec2 high)
{
  const glm::ivec2 size(scene.ViewCamera.Width, scene.ViewCamera.Height);
  std::size_t shapes = 0;
  for (const Surface& surface : scene.Surfaces)
  {
    shapes += surface.IsRound() ? surface.GetNumberOfPrimitives()
      : surface.Instances       ? surface.Instances->GetCount()
                                : 0;
  }
  Rectangle pixels{ glm::max(low - 1, 0), glm::min(high + 1, size) };
  if (shapes >= MinimumOutlinesOfSampledTile)
  {
    pixels.Low = glm::min(pixels.Low, low / TileSide * TileSide);
    pixels.High =
      glm::max(pixels.High, glm::min((high + TileSide - 1) / TileSide * TileSide, size));
  }
  return pixels;
}

glm::ivec2 RegionTiles::GetOrigin(int tile) const
{
  return (this->First + glm::ivec2(tile % this->Count.x, tile / this->Count.x)) * TileSide;
}

RegionTiles::Rectangle RegionTiles::GetPixels(int tile) const
{
  const glm::ivec2 origin = this->GetOrigin(tile);
  return { glm::max(origin, this->Low), glm::min(origin + TileSide, this->High) };
}

// The order of edges decides the rounding of sums over the faces between them. It must not depend on how
// triangles are numbered, because a part of a surface (Surface::Whole) numbers them otherwise.
std::vector<std::uint32_t> RegionTiles::SortEdges(int tile) const
{
  const std::uint32_t* const first = this->EdgesByTile.Get(tile);
  std::vector<std::uint32_t> indices(first, first + this->EdgesByTile.GetCount(tile));
  const auto makeKey = [this](std::uint32_t i) {
    const ProjectedEdge& e = this->Edges[i];
    return std::make_tuple(e.A.x, e.A.y, e.B.x, e.B.y, e.DepthA, e.DepthB);
  };
  std::sort(indices.begin(), indices.end(),
    [&](std::uint32_t a, std::uint32_t b) { return makeKey(a) < makeKey(b); });
  return indices;
}

bool RegionTiles::IsLit(int tile) const
{
  const SampleLight* const light = this->Settings.Integration.Light;
  const Rectangle pixels = this->GetPixels(tile);
  bool isLit = light != nullptr;
  for (int y = pixels.Low.y; y < pixels.High.y && isLit; y += ErrorTileSide)
  {
    for (int x = pixels.Low.x; x < pixels.High.x && isLit; x += ErrorTileSide)
    {
      isLit = light->LightsSamples({ x, y });
    }
  }
  return isLit;
}

template <typename Use>
void RegionTiles::UseEdges(int tile, const Use& use) const
{
  if (this->IsLit(tile))
  {
    const std::vector<ProjectedEdge> none;
    use(TileEdges{ none, nullptr, 0, true });
    return;
  }
  const std::vector<std::uint32_t> sorted = this->SortEdges(tile);
  const std::uint32_t* const indices = sorted.data();
  const std::size_t count = sorted.size();
  const std::size_t all = this->Outlines.GetCount(tile) + this->Instances.GetCount(tile);
  if (all == 0)
  {
    use(TileEdges{ this->Edges, indices, count });
    return;
  }
  const Scene& scene = this->Tracer.GetScene();
  const glm::ivec2 first = this->GetOrigin(tile);
  const glm::ivec2 last =
    glm::min(first + TileSide, glm::ivec2(scene.ViewCamera.Width, scene.ViewCamera.Height));
  std::optional<HiddenShapes> hidden;
  double crossings = 0.0;
  EdgeSource::BoundsTest isHidden; // not set: the bounds are not needed
  if (all >= MinimumOutlinesOfSampledTile)
  {
    hidden.emplace(scene, this->Grid, first, last);
    isHidden = [&](const ShapeBounds& bounds) {
      if (hidden->Add(bounds))
      {
        return true;
      }
      crossings += CountCrossings(bounds, glm::dvec2(first), glm::dvec2(last));
      return false;
    };
  }
  std::vector<std::uint32_t> outlines = this->Outlines.Select(tile, isHidden);
  std::vector<std::uint32_t> instances = this->Instances.Select(tile, isHidden);
  const double area = static_cast<double>(last.x - first.x) * (last.y - first.y);
  const bool isSampled = hidden &&
    RaysPerOutline * crossings >
      area * ComputeRequiredSamples(this->Settings.Integration.Tolerance);
  if (hidden && all <= MaximumOutlinesInTile && !isSampled)
  {
    hidden.reset();
    outlines = this->Outlines.Select(tile);
    instances = this->Instances.Select(tile);
  }
  const std::size_t shapes = outlines.size() + instances.size();
  std::vector<ProjectedEdge> withOutlines;
  if (isSampled || shapes > MaximumOutlinesInTile)
  {
    use(TileEdges{ withOutlines, nullptr, 0, true });
    return;
  }
  // Pages of memory are used only if they are written; growing would write twice as many.
  withOutlines.reserve(count + shapes * EdgesPerOutline);
  std::transform(indices, indices + count, std::back_inserter(withOutlines),
    [&](std::uint32_t i) { return this->Edges[i]; });
  const glm::dvec2 low(first);
  const glm::dvec2 high(last); // not beyond the image, as edges of meshes
  this->Outlines.Project(outlines, low, high, withOutlines);
  this->Instances.Project(instances, low, high, withOutlines);
  use(TileEdges{ withOutlines, nullptr, withOutlines.size(), false, hidden ? &*hidden : nullptr });
}

int RegionTiles::Render(int tile, ImageRegion& region, Totals& totals) const
{
  int unfinished = 0;
  this->UseEdges(tile, [&](const TileEdges& edges) {
    const bool hasShapes = &edges.All != &this->Edges;
    TileRasterizer rasterizer(this->Tracer.GetRays(), this->Cells, *this->Triangles, tile);
    const bool mayRasterize = this->Triangles->GetCount(tile) > 0 && !hasShapes;
    const TileGeometry geometry(edges, this->GetOrigin(tile), TileSide,
      mayRasterize ? &rasterizer : nullptr, this->MeshEdges.Flags);
    PixelIntegrator integrator(this->Tracer, this->Grid, geometry, this->Settings.Integration);
    const Rectangle pixels = this->GetPixels(tile);
    unfinished = this->RenderPixels(pixels, integrator, region);
    // Triangles that intersect in one pixel also intersect in its neighbors.
    if (unfinished == 0 && integrator.HasFoundIntersection())
    {
      integrator.SearchAllPixelsForIntersections();
      this->RenderPixels(pixels, integrator, region);
    }
    unfinished += RefineTiles(pixels.Low, pixels.High, integrator, region);
    totals.Edges += edges.AreLeftOut || !hasShapes
      ? 0
      : static_cast<long long>(edges.Count - this->EdgesByTile.GetCount(tile));
    totals.Rays += integrator.GetPixel().Rays;
    totals.Pixels += integrator.GetPixel().Pixels;
  });
  return unfinished;
}

// Renders the pixels of a tile once. Returns the number of pixels that a limit left as they were.
int RegionTiles::RenderPixels(
  const Rectangle& pixels, PixelIntegrator& integrator, ImageRegion& region) const
{
  int left = pixels.GetArea();
  for (int y = pixels.Low.y; y < pixels.High.y; ++y)
  {
    for (int x = pixels.Low.x; x < pixels.High.x; ++x)
    {
      if (IsReached(this->Settings.Integration.Limit))
      {
        return left;
      }
      const std::size_t index = region.Index(x, y);
      const RayCounts& rays = integrator.GetPixel().Rays;
      const long long before = rays.GetImageRays();
      const PixelResult result = integrator.Integrate({ x, y });
      StorePixel(result, integrator.GetPixel().MediumError, index, region);
      region.RaysPerPixel[index] += static_cast<float>(rays.GetImageRays() - before);
      --left;
    }
  }
  return left;
}

}
