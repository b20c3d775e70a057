// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BruteForce.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace penumbra
{
namespace
{

constexpr int TileSize = 8;   // pixels; a tile with 64 x 64 samples per pixel fits into the cache
constexpr int Refinement = 4; // factor on the samples per side in pixels with silhouettes
constexpr std::uint32_t Nothing = 0xffffffffu;

/// A projected triangle: x and y in pixels, depth as an affine function of them; smaller is nearer.
struct Projected
{
  glm::dvec2 Corners[3];
  glm::dvec3 Depth; // (constant, per x, per y)
};

/// The samples of a square block of pixels.
struct Samples
{
  Samples(int pixels, int perSide)
    : Pixels(pixels),
      PerSide(perSide),
      Row(pixels * perSide),
      Depths(static_cast<std::size_t>(Row) * Row),
      Ids(Depths.size())
  {
    for (int row = 0; row < this->Row; ++row)
    {
      this->Shifts.push_back(std::fmod(0.5 + 0.61803398874989485 * row, 1.0));
    }
  }

  void Clear()
  {
    std::fill(this->Depths.begin(), this->Depths.end(), std::numeric_limits<double>::infinity());
    std::fill(this->Ids.begin(), this->Ids.end(), Nothing);
  }

  glm::ivec2 Origin{ 0 }; ///< lower left pixel
  int Pixels;
  int PerSide;
  int Row;
  std::vector<double> Depths;
  std::vector<std::uint32_t> Ids;
  /// Offset of the samples of a row within their cells. Rows are shifted by the golden ratio so
  /// that a vertical edge is sampled at many positions.
  std::vector<double> Shifts;
};

class Drawing
{
public:
  Drawing(const BruteForceScene& scene, int width, int height)
    : Scene(scene),
      TilesX((width + TileSize - 1) / TileSize),
      TilesY((height + TileSize - 1) / TileSize),
      Tiles(static_cast<std::size_t>(this->TilesX) * this->TilesY)
  {
    this->Image.Width = width;
    this->Image.Height = height;
    this->Image.Colors.resize(static_cast<std::size_t>(width) * height);
    this->Image.Kinds.resize(this->Image.Colors.size(), PixelKind::Inside);
    this->Project();
    this->Bin();
  }

  void DrawTile(std::size_t tile, Samples& coarse, Samples& fine);

  BruteForceImage Image;
  std::size_t GetNumberOfTiles() const { return this->Tiles.size(); }

private:
  void Project();
  void Bin();
  void Fill(std::uint32_t id, Samples& samples) const;
  void Resolve(const Samples& samples);
  glm::dvec3 ShadeSmooth(std::uint32_t id, glm::dvec2 at) const;
  glm::dvec3 LitBy(glm::dvec3 normal) const;
  PixelKind Kind(std::vector<std::uint32_t>& ids) const;

  const BruteForceScene& Scene;
  int TilesX;
  int TilesY;
  std::vector<glm::dvec4> Clip;
  std::vector<Projected> Flat;
  std::vector<glm::dvec3> FlatColors;
  std::vector<std::vector<std::uint32_t>> Tiles;
};

void Drawing::Project()
{
  const glm::dvec2 half(0.5 * this->Image.Width, 0.5 * this->Image.Height);
  this->Clip.reserve(this->Scene.Positions.size());
  for (const glm::dvec3& position : this->Scene.Positions)
  {
    this->Clip.push_back(this->Scene.Projection * glm::dvec4(position, 1.0));
  }
  this->Flat.reserve(this->Scene.Triangles.size());
  for (const glm::uvec3& triangle : this->Scene.Triangles)
  {
    Projected flat;
    double depths[3];
    for (int k = 0; k < 3; ++k)
    {
      const glm::dvec4& clip = this->Clip[triangle[k]];
      flat.Corners[k] = (glm::dvec2(clip) / clip.w + 1.0) * half;
      depths[k] = clip.z / clip.w;
    }
    const glm::dvec2 u = flat.Corners[1] - flat.Corners[0];
    const glm::dvec2 v = flat.Corners[2] - flat.Corners[0];
    const double area = u.x * v.y - u.y * v.x;
    const double du = depths[1] - depths[0];
    const double dv = depths[2] - depths[0];
    const double perX = area != 0.0 ? (du * v.y - dv * u.y) / area : 0.0;
    const double perY = area != 0.0 ? (dv * u.x - du * v.x) / area : 0.0;
    flat.Depth = { depths[0] - perX * flat.Corners[0].x - perY * flat.Corners[0].y, perX, perY };
    this->Flat.push_back(flat);

    const glm::dvec3& a = this->Scene.Positions[triangle[0]];
    const glm::dvec3& b = this->Scene.Positions[triangle[1]];
    const glm::dvec3& c = this->Scene.Positions[triangle[2]];
    glm::dvec3 normal = glm::cross(b - a, c - a);
    const glm::dvec3 toEye = this->Scene.Parallel ? -this->Scene.LightTravel : this->Scene.Eye - a;
    normal *= (glm::dot(normal, toEye) < 0.0 ? -1.0 : 1.0) / std::max(glm::length(normal), 1e-300);
    this->FlatColors.push_back(this->LitBy(normal));
  }
}

void Drawing::Bin()
{
  for (std::uint32_t id = 0; id < this->Flat.size(); ++id)
  {
    const auto& c = this->Flat[id].Corners;
    const glm::dvec2 low = glm::min(glm::min(c[0], c[1]), c[2]) / double(TileSize);
    const glm::dvec2 high = glm::max(glm::max(c[0], c[1]), c[2]) / double(TileSize);
    const int endX = std::min(static_cast<int>(std::floor(high.x)), this->TilesX - 1);
    const int endY = std::min(static_cast<int>(std::floor(high.y)), this->TilesY - 1);
    for (int y = std::max(static_cast<int>(std::floor(low.y)), 0); y <= endY; ++y)
    {
      for (int x = std::max(static_cast<int>(std::floor(low.x)), 0); x <= endX; ++x)
      {
        this->Tiles[static_cast<std::size_t>(y) * this->TilesX + x].push_back(id);
      }
    }
  }
}

void Drawing::DrawTile(std::size_t tile, Samples& coarse, Samples& fine)
{
  const auto draw = [&](Samples& samples) {
    samples.Clear();
    for (std::uint32_t id : this->Tiles[tile])
    {
      this->Fill(id, samples);
    }
    this->Resolve(samples);
  };
  coarse.Origin = { int(tile % this->TilesX) * TileSize, int(tile / this->TilesX) * TileSize };
  draw(coarse);
  for (int k = 0; k < TileSize * TileSize; ++k)
  {
    fine.Origin = coarse.Origin + glm::ivec2(k % TileSize, k / TileSize);
    if (fine.Origin.x < this->Image.Width && fine.Origin.y < this->Image.Height &&
      this->Image.Kinds[static_cast<std::size_t>(fine.Origin.y) * this->Image.Width +
        fine.Origin.x] == PixelKind::Silhouette)
    {
      draw(fine);
    }
  }
}

void Drawing::Fill(std::uint32_t id, Samples& samples) const
{
  const Projected& flat = this->Flat[id];
  const double step = 1.0 / samples.PerSide;
  const glm::dvec2 origin(samples.Origin);
  const auto& c = flat.Corners;
  const double low = std::min({ c[0].y, c[1].y, c[2].y }) - origin.y;
  const double high = std::max({ c[0].y, c[1].y, c[2].y }) - origin.y;
  const int first = std::max(static_cast<int>(std::ceil(low / step - 0.5)), 0);
  const int last = std::min(static_cast<int>(std::ceil(high / step - 0.5)), samples.Row);
  for (int row = first; row < last; ++row)
  {
    const double y = origin.y + (row + 0.5) * step;
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (int k = 0; k < 3; ++k)
    {
      const glm::dvec2 p = c[k];
      const glm::dvec2 q = c[(k + 1) % 3];
      if ((p.y <= y) != (q.y <= y))
      {
        // Interpolate from the lower end, so that both triangles of an edge compute the same value.
        const glm::dvec2 a = p.y < q.y ? p : q;
        const glm::dvec2 b = p.y < q.y ? q : p;
        const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
        left = std::min(left, x);
        right = std::max(right, x);
      }
    }
    if (!(left < right))
    {
      continue;
    }
    const double shift = samples.Shifts[row];
    const int begin = static_cast<int>(
      std::clamp(std::ceil((left - origin.x) / step - shift), 0.0, double(samples.Row)));
    const int end = static_cast<int>(
      std::clamp(std::ceil((right - origin.x) / step - shift), 0.0, double(samples.Row)));
    const double atRow = flat.Depth[0] + flat.Depth[2] * y;
    const std::size_t at = static_cast<std::size_t>(row) * samples.Row;
    for (int i = begin; i < end; ++i)
    {
      const double depth = atRow + flat.Depth[1] * (origin.x + (i + shift) * step);
      if (depth < samples.Depths[at + i])
      {
        samples.Depths[at + i] = depth;
        samples.Ids[at + i] = id;
      }
    }
  }
}

void Drawing::Resolve(const Samples& samples)
{
  const int n = samples.PerSide;
  const bool flat = this->Scene.Normals.empty() || !this->Scene.Lighting;
  const glm::ivec2 end = glm::min(
    glm::ivec2(samples.Pixels), glm::ivec2(this->Image.Width, this->Image.Height) - samples.Origin);
  std::vector<std::uint32_t> ids;
  for (int j = 0; j < end.y; ++j)
  {
    for (int i = 0; i < end.x; ++i)
    {
      ids.clear();
      glm::dvec3 sum(0.0);
      for (int row = 0; row < n; ++row)
      {
        const int sampleRow = j * n + row;
        const double y = samples.Origin.y + (sampleRow + 0.5) / n;
        const double left = samples.Origin.x;
        const std::size_t at = static_cast<std::size_t>(sampleRow) * samples.Row + i * n;
        for (int k = 0, next; k < n; k = next)
        {
          const std::uint32_t id = samples.Ids[at + k];
          for (next = k + 1; next < n && samples.Ids[at + next] == id;)
          {
            ++next;
          }
          if (ids.empty() || id != ids.back())
          {
            ids.push_back(id);
          }
          if (id == Nothing || flat)
          {
            sum +=
              double(next - k) * (id == Nothing ? this->Scene.Background : this->FlatColors[id]);
            continue;
          }
          for (int s = k; s < next; ++s)
          {
            sum += this->ShadeSmooth(id, { left + (i * n + s + samples.Shifts[sampleRow]) / n, y });
          }
        }
      }
      const std::size_t pixel =
        static_cast<std::size_t>(samples.Origin.y + j) * this->Image.Width + samples.Origin.x + i;
      this->Image.Colors[pixel] = sum / (static_cast<double>(n) * n);
      std::sort(ids.begin(), ids.end());
      ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
      this->Image.Kinds[pixel] = this->Kind(ids);
    }
  }
}

glm::dvec3 Drawing::LitBy(glm::dvec3 normal) const
{
  return this->Scene.Lighting
    ? this->Scene.Color * std::max(0.0, -glm::dot(normal, this->Scene.LightTravel))
    : this->Scene.Color;
}

glm::dvec3 Drawing::ShadeSmooth(std::uint32_t id, glm::dvec2 at) const
{
  const glm::uvec3& triangle = this->Scene.Triangles[id];
  const auto& c = this->Flat[id].Corners;
  const auto twice = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
  glm::dvec3 normal(0.0);
  for (int k = 0; k < 3; ++k)
  {
    const double share = twice(c[(k + 1) % 3] - at, c[(k + 2) % 3] - at);
    normal += this->Scene.Normals[triangle[k]] * (share / this->Clip[triangle[k]].w);
  }
  // The barycentric coordinates are negative on back faces. The normal is flipped there, as in VTK.
  return this->LitBy(glm::normalize(normal));
}

// Merges triangles that share a corner by relabeling. A pixel rarely contains more than a few
// triangles.
PixelKind Drawing::Kind(std::vector<std::uint32_t>& ids) const
{
  if (ids.size() < 2)
  {
    return PixelKind::Inside;
  }
  if (ids.back() == Nothing)
  {
    return PixelKind::Silhouette;
  }
  std::vector<std::size_t> part(ids.size());
  std::iota(part.begin(), part.end(), std::size_t(0));
  const auto touch = [&](std::uint32_t a, std::uint32_t b) {
    const glm::uvec3& s = this->Scene.Triangles[a];
    const glm::uvec3& t = this->Scene.Triangles[b];
    for (int k = 0; k < 3; ++k)
    {
      if (s[k] == t[0] || s[k] == t[1] || s[k] == t[2])
      {
        return true;
      }
    }
    return false;
  };
  for (std::size_t i = 1; i < ids.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (part[i] != part[j] && touch(ids[i], ids[j]))
      {
        std::replace(part.begin(), part.begin() + i + 1, std::size_t(part[i]), part[j]);
      }
    }
  }
  const bool whole = std::all_of(part.begin(), part.end(), [&](auto p) { return p == part[0]; });
  return whole ? PixelKind::Crease : PixelKind::Silhouette;
}

}

BruteForceImage DrawByBruteForce(const BruteForceScene& scene, int width, int height, int samples)
{
  Drawing drawing(scene, width, height);
  vtkSMPTools::For(
    0, static_cast<vtkIdType>(drawing.GetNumberOfTiles()), 16, [&](vtkIdType begin, vtkIdType end) {
      Samples coarse(TileSize, samples);
      Samples fine(1, Refinement * samples);
      for (vtkIdType tile = begin; tile < end; ++tile)
      {
        drawing.DrawTile(static_cast<std::size_t>(tile), coarse, fine);
      }
    });
  return std::move(drawing.Image);
}

}
