// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageRegion.h"

#include "Coverage/CoverageConstants.h"
#include "Coverage/TileRefinement.h"
#include "Edges/RoundOutlines.h"
#include "Edges/SubpixelTriangles.h"
#include "Edges/UnsteadyNormals.h"
#include "Execution/ParallelFor.h"
#include "InstanceEdges.h"
#include "Light/OcclusionField.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>

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

// Fraction of the progress for ambient occlusion.
constexpr double OcclusionProgress = 0.6;

/// Returns a callback that reports a fraction of the work as one of [from, to].
ProgressCallback ScaleProgress(const ProgressCallback& progress, double from, double to)
{
  if (!progress)
  {
    return {};
  }
  return [=, &progress](double fraction) { return progress(from + (to - from) * fraction); };
}

/// The tiles that cover the pixels [low, high).
struct Tiles
{
  glm::ivec2 First; ///< lower left tile, in units of tiles
  glm::ivec2 Count;

  Tiles(glm::ivec2 low, glm::ivec2 high)
    : First(low / TileSide),
      Count((high + TileSide - 1) / TileSide - low / TileSide)
  {
  }
};

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
}

/// Refines the sampled pixels of [low, high), which contains whole tiles of ErrorTileSide pixels.
void RefineTiles(glm::ivec2 low, glm::ivec2 high, PixelIntegrator& integrator, ImageRegion& region)
{
  if (integrator.GetSampledPixels().empty())
  {
    return;
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
    for (SampledPixel& pixel : integrator.GetSampledPixels())
    {
      if (pixel.X >= first.x && pixel.X < last.x && pixel.Y >= first.y && pixel.Y < last.y)
      {
        const double error = region.Errors[region.Index(pixel.X, pixel.Y)];
        squares -= error * error;
        region.RaysPerPixel[region.Index(pixel.X, pixel.Y)] -= static_cast<float>(pixel.Rays);
        pixels.push_back(&pixel);
      }
    }
    RefineTile(integrator, pixels, (last.x - first.x) * (last.y - first.y), std::max(squares, 0.0));
    for (const SampledPixel* pixel : pixels)
    {
      const std::size_t index = region.Index(pixel->X, pixel->Y);
      StorePixel(pixel->Result, pixel->MediumError, index, region);
      region.RaysPerPixel[index] += static_cast<float>(pixel->Rays);
      pixel->GetNumberOfSamples() == 0 ? ++integrator.Pixels.Interior : ++integrator.Pixels.Uniform;
    }
  }
}

std::vector<MeshEdge> FindEdges(const Surface& surface, bool isDense, bool isUnsteady,
  const IntegrationSettings& integration, const Camera& camera)
{
  const double contrast = EdgeContrastFraction * integration.Tolerance;
  return surface.IsRound()          ? std::vector<MeshEdge>()
    : isDense && !surface.Instances ? FindEdgesOfDenseMesh(surface, contrast, camera)
                                    : FindMeshEdges(surface, contrast, isUnsteady);
}

/// Edges of one tile.
struct TileEdges
{
  const std::vector<ProjectedEdge>& All;
  const std::uint32_t* Indices; ///< of `Count` edges in `All`; null: the first `Count` edges
  std::size_t Count;
  bool IsDense = false; ///< the edges are too many and have been left out
};

/// Returns a flag for each tile: the samples of its pixels may be rasterized.
std::vector<char> SelectRasterizedTiles(
  const Scene& scene, const IntegrationSettings& integration, const EdgeBins& tileEdges)
{
  std::vector<char> selected(tileEdges.Begin.size() - 1, 0);
  if (integration.Rasterize && !integration.Shadows &&
    integration.Method == IntegrationSettings::Methods::Silhouettes &&
    !TileRasterizer::RequiresRays(scene))
  {
    const auto any = [&](const auto& test) {
      return std::any_of(scene.Surfaces.begin(), scene.Surfaces.end(), test);
    };
    const bool hasLines = any([](const Surface& surface) { return surface.IsLineOrPoint; }) &&
      any([](const Surface& surface) { return surface.IsTranslucent(); });
    const bool hasTextures =
      any([](const Surface& surface) { return surface.LitTexture != nullptr; });
    const std::size_t minimum = hasTextures ? 0
      : hasLines                            ? MinimumLayeredEdges
                                            : MinimumEdgesOfRasterizedTile;
    for (std::size_t tile = 0; tile < selected.size(); ++tile)
    {
      selected[tile] = tileEdges.Begin[tile + 1] - tileEdges.Begin[tile] >= minimum;
    }
  }
  return selected;
}

void RenderTile(glm::ivec2 origin, const TileEdges& edges, TileRasterizer* rasterizer,
  PixelIntegrator& integrator, ImageRegion& region)
{
  const glm::ivec2 low = glm::max(origin, region.Low);
  const glm::ivec2 high = glm::min(origin + TileSide, region.High);

  EdgeBins pixelEdges;
  BinEdges(edges.All, edges.Indices, edges.Count, glm::dvec2(origin), 1.0, glm::ivec2(TileSide),
    pixelEdges);
  const std::size_t pixels = static_cast<std::size_t>(TileSide) * TileSide;
  const bool crowded = pixelEdges.Edges.size() > CrowdedEdgesPerPixel * pixels;
  integrator.SetRasterizer(rasterizer, pixelEdges.Edges.size() > RasterizedEdgesPerPixel * pixels);

  // The integrator samples a pixel whose list of edges is longer than MaximumEdges.
  const std::vector<std::uint32_t> tooMany(edges.IsDense ? MaximumEdges + 1 : 0, 0u);
  integrator.BeginTile();
  bool searchAll = false;
  const PixelCounts initialCounts = integrator.Pixels;
  for (int y = low.y; y < high.y; ++y)
  {
    for (int x = low.x; x < high.x; ++x)
    {
      const int cell = (y - origin.y) * TileSide + (x - origin.x);
      const std::uint32_t* list =
        edges.IsDense ? tooMany.data() : pixelEdges.Edges.data() + pixelEdges.Begin[cell];
      const std::size_t size =
        edges.IsDense ? tooMany.size() : pixelEdges.Begin[cell + 1] - pixelEdges.Begin[cell];
      const std::size_t index = region.Index(x, y);
      const long long before = integrator.Rays.GetImageRays();
      const PixelResult result = integrator.Integrate(x, y, list, size, crowded);
      StorePixel(result, integrator.GetMediumError(), index, region);
      region.RaysPerPixel[index] += static_cast<float>(integrator.Rays.GetImageRays() - before);
    }
    // Triangles that intersect in one pixel also intersect in its neighbors. Render the tile again
    // and search all pixels with edges for intersections.
    if (y + 1 == high.y && !searchAll && integrator.HasFoundIntersection())
    {
      searchAll = true;
      integrator.SearchAllPixelsForIntersections();
      integrator.GetSampledPixels().clear();
      integrator.Pixels = initialCounts;
      y = low.y - 1;
    }
  }
  RefineTiles(low, high, integrator, region);
}

}

SceneEdges FindSceneEdges(
  const Scene& scene, const RenderSettings& settings, const ProgressCallback& progress)
{
  const IntegrationSettings& integration = settings.Integration;
  SceneEdges edges;
  if (integration.Method != IntegrationSettings::Methods::Silhouettes &&
    (integration.Method == IntegrationSettings::Methods::Uniform || !integration.FindSmallObjects))
  {
    return edges;
  }
  for (const Surface& surface : scene.Surfaces)
  {
    ThrowIfStopped(progress, 0.0);
    edges.Dense.push_back(HasSubpixelTriangles(surface, scene.ViewCamera));
    edges.Unsteady.push_back(HasUnsteadyNormals(surface));
    edges.EdgesBySurface.push_back(
      FindEdges(surface, edges.Dense.back(), edges.Unsteady.back(), integration, scene.ViewCamera));
  }
  return edges;
}

void UpdateSceneEdges(const Scene& scene, const RenderSettings& settings,
  const ProgressCallback& progress, SceneEdges& edges)
{
  for (std::size_t i = 0; i < edges.EdgesBySurface.size(); ++i)
  {
    ThrowIfStopped(progress, 0.0);
    const Surface& surface = scene.Surfaces[i];
    const char wasDense = edges.Dense[i];
    edges.Dense[i] = HasSubpixelTriangles(surface, scene.ViewCamera);
    if ((edges.Dense[i] || wasDense) && !surface.Instances)
    {
      edges.EdgesBySurface[i] = FindEdges(
        surface, edges.Dense[i], edges.Unsteady[i], settings.Integration, scene.ViewCamera);
    }
  }
}

namespace
{

/// Multiplies the colors of a region by the factors of its ambient occlusion.
void ApplyOcclusion(const OcclusionField& field, ImageRegion& region)
{
  for (int y = region.Low.y; y < region.High.y; ++y)
  {
    for (int x = region.Low.x; x < region.High.x; ++x)
    {
      const OcclusionField::Factor factor = field.At(x, y);
      const std::size_t index = region.Index(x, y);
      glm::vec4& color = region.Colors[index];
      color = glm::vec4(factor.Value * glm::vec3(color), color.a);
      region.Errors[index] = std::hypot(region.Errors[index], factor.Error);
      region.LightErrors[index] = std::hypot(region.LightErrors[index], factor.Error);
      if (!region.Occlusions.empty())
      {
        region.Occlusions[index] = field.GetMean(x, y);
      }
    }
  }
}

/// Renders a region without the ambient occlusion of `settings`.
bool RenderUnoccluded(const CameraRayTracer& tracer, const SceneEdges& sceneEdges,
  const RenderSettings& settings, const ProgressCallback& progress, ImageRegion& region)
{
  const Scene& scene = tracer.GetScene();
  const glm::ivec2 size = region.High - region.Low;
  const std::size_t pixels = static_cast<std::size_t>(size.x) * size.y;
  region.Colors.resize(pixels);
  region.Errors.resize(pixels);
  region.LightErrors.resize(settings.HasLightErrors() ? pixels : 0);
  region.RaysPerPixel.resize(pixels);
  std::mutex totals;

  // The grid includes one more corner on each side, within the image. The error estimate needs the
  // neighbors for second differences of colors.
  const bool corners = settings.Integration.Method != IntegrationSettings::Methods::Uniform;
  CornerGrid grid(glm::max(region.Low - 1, 0),
    glm::min(region.High + 1, glm::ivec2(scene.ViewCamera.Width, scene.ViewCamera.Height)), corners,
    tracer.GetShading().HasPenumbrae());
  if (corners &&
    !ParallelForWithProgress(grid.GetNumberOfStrips(), 0.0, 0.4, progress, [&](int strip) {
      RayCounts counts;
      grid.TraceStrip(tracer, strip, settings.UsePackets, counts);
      const std::lock_guard<std::mutex> lock(totals);
      region.Rays += counts;
    }))
  {
    return false;
  }

  grid.FindPenumbrae();
  if (corners && tracer.GetShading().HasPenumbrae() &&
    !ParallelForWithProgress(grid.GetNumberOfStrips(), 0.4, 0.4, progress, [&](int strip) {
      RayCounts counts;
      grid.ResolvePenumbrae(tracer, strip, settings.UsePackets, counts);
      const std::lock_guard<std::mutex> lock(totals);
      region.Rays += counts;
    }))
  {
    return false;
  }

  std::vector<ProjectedEdge> edges;
  for (std::size_t i = 0; i < sceneEdges.EdgesBySurface.size(); ++i)
  {
    const Surface& surface = scene.Surfaces[i];
    if (progress && progress(corners ? 0.4 : 0.0))
    {
      return false;
    }
    if (!surface.Instances)
    {
      ProjectEdges(surface, sceneEdges.EdgesBySurface[i], scene.ViewCamera, glm::dvec2(region.Low),
        glm::dvec2(region.High), edges);
    }
  }
  const Tiles tiles(region.Low, region.High);
  const InstanceEdges instances(
    scene, sceneEdges.EdgesBySurface, glm::dvec2(tiles.First * TileSide), TileSide, tiles.Count);
  instances.ProjectLarge(glm::dvec2(region.Low), glm::dvec2(region.High), edges);
  region.Edges = static_cast<long long>(edges.size());

  EdgeBins tileEdges;
  BinEdges(edges, nullptr, edges.size(), glm::dvec2(tiles.First * TileSide), TileSide, tiles.Count,
    tileEdges);
  const TileGrid tileGrid{ glm::dvec2(tiles.First * TileSide), TileSide, tiles.Count };
  const TriangleBins triangles(
    scene, tileGrid, SelectRasterizedTiles(scene, settings.Integration, tileEdges));
  const RoundOutlines outlines(scene, glm::dvec2(tiles.First * TileSide), TileSide,
    sceneEdges.EdgesBySurface.empty() ? glm::ivec2(0) : tiles.Count);
  return ParallelForWithProgress(
    tiles.Count.x * tiles.Count.y, corners ? 0.45 : 0.0, 1.0, progress, [&](int tile) {
      const glm::ivec2 origin =
        (tiles.First + glm::ivec2(tile % tiles.Count.x, tile / tiles.Count.x)) * TileSide;
      const std::uint32_t* const indices = tileEdges.Edges.data() + tileEdges.Begin[tile];
      const std::size_t count = tileEdges.Begin[tile + 1] - tileEdges.Begin[tile];
      const std::size_t shapes = outlines.GetCount(tile) + instances.GetCount(tile);
      std::vector<ProjectedEdge> withOutlines;
      if (shapes > 0 && shapes <= MaximumOutlinesInTile)
      {
        // Pages of memory are used only if they are written; growing would write twice as many.
        withOutlines.reserve(count + shapes * EdgesPerOutline);
        std::transform(indices, indices + count, std::back_inserter(withOutlines),
          [&](std::uint32_t i) { return edges[i]; });
        outlines.Project(tile, glm::dvec2(origin), glm::dvec2(origin + TileSide), withOutlines);
        instances.Project(tile, glm::dvec2(origin), glm::dvec2(origin + TileSide), withOutlines);
      }
      else if (shapes > 0)
      {
        // One edge outside of the tile, which stands for those that were left out.
        withOutlines.push_back({ glm::dvec2(origin) - 16.0, glm::dvec2(origin) - 15.0, 1.0, 1.0 });
      }
      const TileEdges inTile{ shapes > 0 ? withOutlines : edges, shapes > 0 ? nullptr : indices,
        shapes > 0 ? withOutlines.size() : count, shapes > MaximumOutlinesInTile };
      PixelIntegrator integrator(
        tracer, grid, inTile.All, sceneEdges.Dense, sceneEdges.Unsteady, settings.Integration);
      TileRasterizer rasterizer(tracer.GetRays(), tileGrid, triangles, tile);
      const bool mayRasterize = triangles.GetCount(tile) > 0 && shapes == 0;
      RenderTile(origin, inTile, mayRasterize ? &rasterizer : nullptr, integrator, region);
      const std::lock_guard<std::mutex> lock(totals);
      region.Edges +=
        inTile.IsDense || shapes == 0 ? 0 : static_cast<long long>(inTile.Count - count);
      region.Rays += integrator.Rays;
      region.Pixels += integrator.Pixels;
    });
}

}

bool RenderRegion(const CameraRayTracer& tracer, const SceneEdges& sceneEdges,
  const RenderSettings& settings, const ProgressCallback& progress, ImageRegion& region)
{
  if (!settings.Occlusion)
  {
    return RenderUnoccluded(tracer, sceneEdges, settings, progress, region);
  }
  const OcclusionField field(tracer, *settings.Occlusion, settings.OcclusionTolerance, region.Low,
    region.High, ScaleProgress(progress, 0.0, OcclusionProgress), region.Rays);
  if (!RenderUnoccluded(
        tracer, sceneEdges, settings, ScaleProgress(progress, OcclusionProgress, 1.0), region))
  {
    return false;
  }
  region.Occlusions.resize(settings.KeepsOcclusion ? region.Colors.size() : 0);
  ApplyOcclusion(field, region);
  return true;
}

}
