// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Picture.h"

#include "Batches.h"
#include "Density.h"

#include <algorithm>
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
  const EdgeLists& tileEdges, const std::vector<char>& dense, PixelIntegrator& integrator,
  Picture& picture)
{
  const glm::ivec2 origin =
    (tiles.First + glm::ivec2(tile % tiles.Count.x, tile / tiles.Count.x)) * TileSide;
  const glm::ivec2 low = glm::max(origin, picture.Low);
  const glm::ivec2 high = glm::min(origin + TileSide, picture.High);

  EdgeLists pixelEdges;
  const std::uint32_t begin = tileEdges.Begin[tile];
  const std::uint32_t count = tileEdges.Begin[tile + 1] - begin;
  BinEdges(edges, tileEdges.Edges.data() + begin, count, glm::dvec2(origin), 1.0,
    glm::ivec2(TileSide), pixelEdges);
  const bool crowded = pixelEdges.Edges.size() > CrowdedEdges * TileSide * TileSide;

  integrator.BeginTile();
  for (int y = low.y; y < high.y; ++y)
  {
    for (int x = low.x; x < high.x; ++x)
    {
      const int cell = (y - origin.y) * TileSide + (x - origin.x);
      const std::uint32_t* list = pixelEdges.Edges.data() + pixelEdges.Begin[cell];
      const std::size_t size = pixelEdges.Begin[cell + 1] - pixelEdges.Begin[cell];
      const std::size_t index = picture.Index(x, y);
      const Density density = !dense.empty() && dense[index] ? Density::Dense
        : crowded                                            ? Density::Crowded
                                                             : Density::Sparse;
      const long long before = integrator.Rays.InPicture();
      const PixelResult result = integrator.Integrate(x, y, list, size, density);
      const float alpha = result.Color.a;
      picture.Colors[index] =
        alpha > 0.f ? glm::vec4(glm::vec3(result.Color) / alpha, alpha) : glm::vec4(0.f);
      picture.Errors[index] = result.Error;
      picture.RayShares[index] = static_cast<float>(integrator.Rays.InPicture() - before);
    }
  }
}

}

bool RenderPicture(const Sampler& sampler, const PictureSettings& settings,
  const ProgressCallback& progress, Picture& picture)
{
  const Scene& scene = sampler.GetScene();
  const glm::ivec2 size = picture.High - picture.Low;
  const std::size_t pixels = static_cast<std::size_t>(size.x) * size.y;
  picture.Colors.resize(pixels);
  picture.Errors.resize(pixels);
  picture.RayShares.resize(pixels);
  std::mutex totals;

  // One corner more on each side, where the picture has it: the neighbours say how colours bend.
  const bool corners = settings.Integration.Method != IntegrationSettings::Methods::Uniform;
  CornerGrid grid(glm::max(picture.Low - 1, 0),
    glm::min(picture.High + 1, glm::ivec2(scene.Eye.Width, scene.Eye.Height)), corners);
  if (corners && !InBatches(grid.GetNumberOfRows(), 0.0, 0.4, progress, [&](int row) {
        RayCounts counts;
        grid.TraceRow(sampler, row, settings.Packets, counts);
        const std::lock_guard<std::mutex> lock(totals);
        picture.Rays += counts;
      }))
  {
    return false;
  }

  std::vector<ProjectedEdge> edges;
  std::vector<char> dense;
  const bool borders = settings.Integration.Method == IntegrationSettings::Methods::Silhouettes ||
    (corners && settings.Integration.SmallObjects);
  for (const Surface& surface : scene.Surfaces)
  {
    if (!borders)
    {
      break;
    }
    if (IsDense(surface, scene.Eye))
    {
      MarkPixels(surface, scene.Eye, picture.Low, picture.High, dense);
    }
    else
    {
      ProjectEdges(surface, FindMeshEdges(surface, ContrastShare * settings.Integration.Tolerance),
        scene.Eye, glm::dvec2(picture.Low), glm::dvec2(picture.High), edges);
    }
  }
  picture.Edges = static_cast<long long>(edges.size());

  const Tiles tiles(picture.Low, picture.High);
  EdgeLists tileEdges;
  BinEdges(edges, nullptr, edges.size(), glm::dvec2(tiles.First * TileSide), TileSide, tiles.Count,
    tileEdges);
  return InBatches(
    tiles.Count.x * tiles.Count.y, corners ? 0.45 : 0.0, 1.0, progress, [&](int tile) {
      PixelIntegrator integrator(sampler, grid, edges, settings.Integration);
      RenderTile(tile, tiles, edges, tileEdges, dense, integrator, picture);
      const std::lock_guard<std::mutex> lock(totals);
      picture.Rays += integrator.Rays;
      picture.Pixels += integrator.Pixels;
    });
}

}
