// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageRegion.h"

#include "Coverage/SubpixelTriangles.h"
#include "Execution/ParallelFor.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace penumbra
{

namespace
{

constexpr int TileSide = 32;
// A tile with more edges a pixel than this is crowded.
constexpr std::size_t CrowdedEdges = 6;
// Creases and seams below this share of the tolerance are not borders.
constexpr double ContrastShare = 0.25;

struct Tiles
{
  glm::ivec2 First; ///< in units of tiles
  glm::ivec2 Count;

  Tiles(glm::ivec2 low, glm::ivec2 high)
    : First(low / TileSide),
      Count((high + TileSide - 1) / TileSide - low / TileSide)
  {
  }
};

void RenderTile(int tile, const Tiles& tiles, const std::vector<ProjectedEdge>& edges,
  const EdgeBins& tileEdges, const std::vector<char>& dense, PixelIntegrator& integrator,
  ImageRegion& part)
{
  const glm::ivec2 origin =
    (tiles.First + glm::ivec2(tile % tiles.Count.x, tile / tiles.Count.x)) * TileSide;
  const glm::ivec2 low = glm::max(origin, part.Low);
  const glm::ivec2 high = glm::min(origin + TileSide, part.High);

  EdgeBins pixelEdges;
  const std::uint32_t begin = tileEdges.Begin[tile];
  const std::uint32_t count = tileEdges.Begin[tile + 1] - begin;
  BinEdges(edges, tileEdges.Edges.data() + begin, count, glm::dvec2(origin), 1.0,
    glm::ivec2(TileSide), pixelEdges);
  const bool crowded = pixelEdges.Edges.size() > CrowdedEdges * TileSide * TileSide;

  integrator.BeginTile();
  bool wary = false;
  const PixelCounts counted = integrator.Pixels;
  for (int y = low.y; y < high.y; ++y)
  {
    for (int x = low.x; x < high.x; ++x)
    {
      const int cell = (y - origin.y) * TileSide + (x - origin.x);
      const std::uint32_t* list = pixelEdges.Edges.data() + pixelEdges.Begin[cell];
      const std::size_t size = pixelEdges.Begin[cell + 1] - pixelEdges.Begin[cell];
      const std::size_t index = part.Index(x, y);
      const EdgeDensity density = !dense.empty() && dense[index] ? EdgeDensity::Dense
        : crowded                                                ? EdgeDensity::Crowded
                                                                 : EdgeDensity::Sparse;
      const long long before = integrator.Rays.InPicture();
      const PixelResult result = integrator.Integrate(x, y, list, size, density);
      const float alpha = result.Color.a;
      part.Colors[index] =
        alpha > 0.f ? glm::vec4(glm::vec3(result.Color) / alpha, alpha) : glm::vec4(0.f);
      part.Errors[index] = std::hypot(result.Error, integrator.GetMediumError());
      part.RayShares[index] += static_cast<float>(integrator.Rays.InPicture() - before);
    }
    // Where triangles pass through each other in one pixel they do so around it, too.
    if (y + 1 == high.y && !wary && integrator.HasFoundPiercing())
    {
      wary = true;
      integrator.BeWary();
      integrator.Pixels = counted;
      y = low.y - 1;
    }
  }
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
    edges.OfSurfaces.push_back(edges.Dense.back()
        ? std::vector<MeshEdge>()
        : FindMeshEdges(surface, ContrastShare * integration.Tolerance));
  }
  return edges;
}

bool RenderRegion(const CameraRayTracer& sampler, const SceneEdges& meshes,
  const RenderSettings& settings, const ProgressCallback& progress, ImageRegion& part)
{
  const Scene& scene = sampler.GetScene();
  const glm::ivec2 size = part.High - part.Low;
  const std::size_t pixels = static_cast<std::size_t>(size.x) * size.y;
  part.Colors.resize(pixels);
  part.Errors.resize(pixels);
  part.RayShares.resize(pixels);
  std::mutex totals;

  // One corner more on each side, where the picture has it: the neighbours say how colours bend.
  const bool corners = settings.Integration.Method != IntegrationSettings::Methods::Uniform;
  CornerGrid grid(glm::max(part.Low - 1, 0),
    glm::min(part.High + 1, glm::ivec2(scene.ViewCamera.Width, scene.ViewCamera.Height)), corners);
  if (corners && !ParallelForBatches(grid.GetNumberOfRows(), 0.0, 0.4, progress, [&](int row) {
        RayCounts counts;
        grid.TraceRow(sampler, row, settings.Packets, counts);
        const std::lock_guard<std::mutex> lock(totals);
        part.Rays += counts;
      }))
  {
    return false;
  }

  std::vector<ProjectedEdge> edges;
  std::vector<char> dense;
  for (std::size_t i = 0; i < meshes.OfSurfaces.size(); ++i)
  {
    const Surface& surface = scene.Surfaces[i];
    if (progress && progress(corners ? 0.4 : 0.0))
    {
      return false;
    }
    if (meshes.Dense[i])
    {
      MarkCoveredPixels(surface, scene.ViewCamera, part.Low, part.High, dense);
    }
    else
    {
      ProjectEdges(surface, meshes.OfSurfaces[i], scene.ViewCamera, glm::dvec2(part.Low),
        glm::dvec2(part.High), edges);
    }
  }
  part.Edges = static_cast<long long>(edges.size());

  const Tiles tiles(part.Low, part.High);
  EdgeBins tileEdges;
  BinEdges(edges, nullptr, edges.size(), glm::dvec2(tiles.First * TileSide), TileSide, tiles.Count,
    tileEdges);
  return ParallelForBatches(
    tiles.Count.x * tiles.Count.y, corners ? 0.45 : 0.0, 1.0, progress, [&](int tile) {
      PixelIntegrator integrator(sampler, grid, edges, settings.Integration);
      RenderTile(tile, tiles, edges, tileEdges, dense, integrator, part);
      const std::lock_guard<std::mutex> lock(totals);
      part.Rays += integrator.Rays;
      part.Pixels += integrator.Pixels;
    });
}

}
