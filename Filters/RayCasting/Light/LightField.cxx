// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LightField.h"

#include "LightConstants.h"
#include "RayGrowth.h"
#include "Sampling/CameraRayTracer.h"
#include "ScatteredTiles.h"
#include "SiteJoining.h"
#include "SiteSampler.h"
#include "Vectors.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <utility>

namespace penumbra
{
namespace
{

/// Returns the grid of the sites that the pixels [low, high) depend on: every round extends them.
template <int N>
SiteGrid<N> MakeGrid(const Camera& camera, glm::ivec2 low, glm::ivec2 high)
{
  const int margin = (LightRounds + 1) * GetJoiningReach() + LightRounds * LightTileSide;
  SiteGrid<N> grid;
  grid.Cover(low - margin, high + margin, { camera.Width, camera.Height });
  return grid;
}

/// Samples the tiles of a field, and decides how many samples their pixels get.
template <int N>
class TileSamples
{
public:
  /// Reads only the errors of `field`, which may be incomplete.
  TileSamples(const LightField& field, SiteGrid<N>& grid, const CameraRayTracer& tracer,
    const LightRays<N>& rays)
    : Field(field),
      Grid(grid),
      Tracer(tracer),
      Rays(rays),
      Tiles(grid.GetSize() / LightTileSide),
      Count(this->Tiles.x * this->Tiles.y)
  {
  }

  /// Finds the sites of the tiles. Returns false if the limit ended this; the next call continues.
  bool FindSites(
    WorkLimit* limit, double from, double to, const ProgressCallback& progress, RayCounts& counts)
  {
    if (this->FoundSites.empty())
    {
      this->FoundSites.resize(this->Count);
      this->Done.assign(this->Count, 0);
      this->Scattered.assign(this->Count, 0);
      this->Grid.Tiles.resize(this->Count);
      constexpr int Ratio = LightTileSide / DirectionBlockSide;
      constexpr int Guides = LightTerms<N>::HasRadiance ? Ratio * Ratio : 0;
      this->Grid.Guides.resize(static_cast<std::size_t>(this->Count) * Guides);
    }
    const bool finished = this->ForTiles(
      limit, from, to, progress, counts, this->Count, [&](int tile, SiteSampler<N>& sampler) {
        std::vector<LightSite<N>>& sites = this->FoundSites[tile];
        this->Scattered[tile] =
          IsScattered(this->Tracer, this->GetFirst(tile), sampler.Counts) ? 1 : 0;
        if (this->Scattered[tile])
        {
          return;
        }
        this->Grid.Tiles[tile].resize(LightTileSide * LightTileSide);
        this->VisitBlocks(tile, [&](glm::ivec2 first) {
          sampler.FindSites(first);
          if constexpr (LightTerms<N>::HasRadiance)
          {
            this->Grid.Guides[this->Grid.GetBlock(first)] = sampler.MakeGuide();
          }
          for (int cell = 0; cell < SiteSampler<N>::Cells; ++cell)
          {
            LightPixel& pixel = this->GetPixel(first, cell);
            pixel = sampler.GetPixel(cell);
            pixel.Begin = static_cast<std::uint32_t>(sites.size());
            const std::vector<LightSite<N>>& found = sampler.GetSites(cell);
            sites.insert(sites.end(), found.begin(), found.end());
          }
        });
        sites.shrink_to_fit();
        if (sites.empty())
        {
          std::vector<LightPixel>().swap(this->Grid.Tiles[tile]);
        }
      });
    if (finished)
    {
      this->JoinTiles();
    }
    return finished;
  }

  /// Returns true if the tile of a pixel is scattered, so that it has no sites.
  bool IsScatteredAt(glm::ivec2 pixel) const
  {
    const glm::ivec2 tile = (pixel - this->Grid.Low) / LightTileSide;
    return this->Scattered[static_cast<std::size_t>(tile.y) * this->Tiles.x + tile.x] != 0;
  }

  /// Increases the targets of pixels in those of the `changed` tiles whose estimated error exceeds `tolerance`, and
  /// clears these flags. Returns true if there are such tiles. Does nothing until AddSamples() has traced them all.
  bool Increase(double tolerance, std::vector<char>& changed)
  {
    if (!this->Increased.empty())
    {
      return true;
    }
    const auto limit = static_cast<float>(Square<float>(tolerance));
    ParallelFor(0, this->Count, 4, [&](int tile) {
      changed[tile] = changed[tile] != 0 && this->IncreaseTile(this->GetFirst(tile), limit) ? 1 : 0;
    });
    for (int tile = 0; tile < this->Count; ++tile)
    {
      if (std::exchange(changed[tile], 0) != 0)
      {
        this->Increased.push_back(tile);
      }
    }
    this->Done.assign(this->Increased.size(), 0);
    return !this->Increased.empty();
  }

  /// Traces the samples that Increase() has added. Returns false if the limit ended this; the next call
  /// continues. Adds the tiles that have new samples to `sampled`.
  bool AddSamples(WorkLimit* limit, double from, double to, const ProgressCallback& progress,
    RayCounts& counts, std::vector<int>& sampled)
  {
    const int count = static_cast<int>(this->Increased.size());
    const bool finished =
      this->ForTiles(limit, from, to, progress, counts, count, [&](int i, SiteSampler<N>& sampler) {
        const int tile = this->Increased[i];
        this->VisitBlocks(tile, [&](glm::ivec2 first) {
          sampler.AddSamples(first, this->Grid);
          for (int cell = 0; cell < SiteSampler<N>::Cells; ++cell)
          {
            LightPixel& pixel = this->GetPixel(first, cell);
            pixel = sampler.GetPixel(cell);
            std::copy(sampler.GetSites(cell).begin(), sampler.GetSites(cell).end(),
              this->Grid.Sites.begin() + pixel.Begin);
          }
        });
      });
    for (int i = 0; i < count; ++i)
    {
      if (this->Done[i] == 1)
      {
        sampled.push_back(this->Increased[i]);
        this->Done[i] = 2;
      }
    }
    if (finished)
    {
      this->Increased.clear();
    }
    return finished;
  }

private:
  /// Moves the sites of all tiles to the grid.
  void JoinTiles()
  {
    std::size_t count = 0;
    for (const std::vector<LightSite<N>>& sites : this->FoundSites)
    {
      count += sites.size();
    }
    this->Grid.Sites.reserve(count);
    for (std::size_t tile = 0; tile < this->FoundSites.size(); ++tile)
    {
      std::vector<LightSite<N>>& sites = this->FoundSites[tile];
      if (sites.empty())
      {
        continue;
      }
      this->VisitBlocks(static_cast<int>(tile), [&](glm::ivec2 first) {
        for (int cell = 0; cell < SiteSampler<N>::Cells; ++cell)
        {
          this->GetPixel(first, cell).Begin += static_cast<std::uint32_t>(this->Grid.Sites.size());
        }
      });
      this->Grid.Sites.insert(this->Grid.Sites.end(), sites.begin(), sites.end());
      std::vector<LightSite<N>>().swap(sites);
    }
  }

  bool IncreaseTile(glm::ivec2 first, float limit)
  {
    const Camera& camera = this->Tracer.GetCamera();
    const glm::ivec2 end = glm::min(first + LightTileSide, glm::ivec2(camera.Width, camera.Height));
    return penumbra::IncreaseTile(this->Grid, first, end, limit, [&](int x, int y) {
      const LightField::Change change = this->Field.At(x, y);
      return PixelError{ Square(change.Error), change.Scatter };
    });
  }

  glm::ivec2 GetFirst(int tile) const
  {
    return this->Grid.Low + LightTileSide * glm::ivec2(tile % this->Tiles.x, tile / this->Tiles.x);
  }

  LightPixel& GetPixel(glm::ivec2 first, int cell)
  {
    const glm::ivec2 p = first + SiteSampler<N>::GetOffset(cell);
    return this->Grid.GetPixel(p.x, p.y);
  }

  /// Calls visit(first) for the first pixels of the blocks of a tile.
  template <typename Visit>
  void VisitBlocks(int tile, const Visit& visit) const
  {
    constexpr int Ratio = LightTileSide / SiteSampler<N>::Side;
    for (int i = 0; i < Ratio * Ratio; ++i)
    {
      visit(this->GetFirst(tile) + SiteSampler<N>::Side * glm::ivec2(i % Ratio, i / Ratio));
    }
  }

  /// Calls work(i, sampler) for i in [0, count) that are not done. Returns true if all are.
  template <typename Work>
  bool ForTiles(WorkLimit* limit, double from, double to, const ProgressCallback& progress,
    RayCounts& counts, int count, const Work& work)
  {
    std::mutex totals;
    std::atomic<bool> finished{ true };
    const auto visit = [&](int i) {
      if (this->Done[i] != 0)
      {
        return;
      }
      if (IsReached(limit))
      {
        finished = false;
        return;
      }
      SiteSampler<N> sampler(this->Tracer, this->Rays);
      work(i, sampler);
      this->Done[i] = 1;
      const std::lock_guard<std::mutex> lock(totals);
      counts += sampler.Counts;
      counts.Auxiliary += sampler.CameraRays;
      (LightTerms<N>::HasRadiance ? counts.Indirect : counts.Occlusion) += sampler.TracedRays;
    };
    if (!ParallelForWithProgress(count, from, to, progress, visit))
    {
      throw Stopped();
    }
    return finished;
  }

  const LightField& Field;
  SiteGrid<N>& Grid;
  const CameraRayTracer& Tracer;
  const LightRays<N>& Rays;
  glm::ivec2 Tiles;
  int Count;
  std::vector<int> Increased; ///< tiles that get more samples in this round
  /// States of the tiles of this round: 1: has all samples; 2: AddSamples() has reported it.
  std::vector<char> Done;
  std::vector<char> Scattered;                       ///< flags of all tiles
  std::vector<std::vector<LightSite<N>>> FoundSites; ///< per tile, until all are known
};

/// Light with N values, see LightSite.h.
template <int N>
class JoinedLight final : public LightField
{
public:
  JoinedLight(
    const CameraRayTracer& tracer, const LightEffects& effects, glm::ivec2 low, glm::ivec2 high);

  bool FindSites(WorkLimit* limit, double from, double to, const ProgressCallback& progress,
    RayCounts& counts) override;
  bool AddRounds(WorkLimit* limit, double from, double to, const ProgressCallback& progress,
    RayCounts& counts) override;
  bool HasSites() const override { return this->Round > 0; }
  Change At(int x, int y) const override;
  bool LightsSamples(glm::ivec2 pixel) const override { return this->Tiles.IsScatteredAt(pixel); }
  double GetTolerance() const override { return this->Tolerance; }
  void TraceSamples(std::uint32_t seed, std::uint32_t first, const glm::dvec2* points,
    Packet& packet, RayCounts& counts) const override
  {
    this->Samples.Trace(seed, first, points, packet, counts);
  }
  float GetMeanOcclusion(int x, int y) const override;

private:
  using Terms = LightTerms<N>;
  using Value = typename Terms::Value;

  Value Evaluate(const LightSite<N>& site) const;
  float ComputeSquaredError(const LightSite<N>& site, float samples) const;

  LightRays<N> Rays;
  SiteGrid<N> Grid;
  TileSamples<N> Tiles;
  double Tolerance;
  float UniformLight;
  LitSamples<N> Samples;
  std::unique_ptr<SiteJoining<N>> Joining; ///< until all rounds are over
  std::vector<char> Changed; ///< flags of tiles whose estimates have changed since their last check
  bool UsesColors;           ///< the color of a pixel tells which parts of it the sites cover
  bool HasShadows;
  int Round = 0; ///< next one; 0: the sites are not known
};

template <int N>
JoinedLight<N>::JoinedLight(
  const CameraRayTracer& tracer, const LightEffects& effects, glm::ivec2 low, glm::ivec2 high)
  : Rays(effects),
    Grid(MakeGrid<N>(tracer.GetCamera(), low, high)),
    Tiles(*this, this->Grid, tracer, this->Rays),
    Tolerance(effects.Tolerance),
    UniformLight(effects.GetUniformLight()),
    Samples(tracer, this->Rays, this->UniformLight),
    UsesColors(!tracer.HasShafts()),
    HasShadows(effects.HasShadows)
{
  this->Grid.SquaredRange = this->Rays.GetSquaredRange();
}

template <int N>
bool JoinedLight<N>::FindSites(
  WorkLimit* limit, double from, double to, const ProgressCallback& progress, RayCounts& counts)
{
  if (this->Round == 0)
  {
    if (!this->Tiles.FindSites(limit, from, to, progress, counts))
    {
      return false;
    }
    this->Joining = std::make_unique<SiteJoining<N>>(this->Grid);
    this->Joining->Start();
    this->Changed.assign(this->Grid.Tiles.size(), 1);
    this->Round = 1;
  }
  return true;
}

template <int N>
bool JoinedLight<N>::AddRounds(
  WorkLimit* limit, double from, double to, const ProgressCallback& progress, RayCounts& counts)
{
  const double step = (to - from) / LightRounds;
  while (this->Round <= LightRounds && this->Tiles.Increase(this->Tolerance, this->Changed))
  {
    std::vector<int> sampled;
    const double begin = from + (this->Round - 1) * step;
    const bool finished =
      this->Tiles.AddSamples(limit, begin, begin + step, progress, counts, sampled);
    for (const int tile : this->Joining->Update(sampled))
    {
      this->Changed[tile] = 1;
    }
    if (!finished)
    {
      return false;
    }
    ++this->Round;
  }
  this->Round = LightRounds + 1;
  this->Joining.reset();
  return true;
}

template <int N>
typename JoinedLight<N>::Value JoinedLight<N>::Evaluate(const LightSite<N>& site) const
{
  Value value = glm::max(EvaluateSite(this->Grid, site), Value(0.f));
  if constexpr (Terms::HasOcclusion)
  {
    value[0] = std::min(value[0], 1.f);
  }
  return value;
}

/// Returns the squared error that a site causes in the color of a pixel with `samples` samples.
template <int N>
float JoinedLight<N>::ComputeSquaredError(const LightSite<N>& site, float samples) const
{
  const Value& squares = this->Grid.Patches[site.Patch].SquaredError;
  glm::vec3 sum(0.f);
  for (int term = 0; term < Terms::Count; ++term)
  {
    const glm::vec3 color = (site.Colors[term][0] + site.Colors[term][1]) / samples;
    for (int c = 0; c < 3; ++c)
    {
      const bool isOcclusion = Terms::HasOcclusion && term == Terms::OcclusionTerm;
      sum[c] += Square<float>(color[c]) * squares[isOcclusion ? 0 : Terms::FirstRadiance + c];
    }
  }
  return MaximumComponent(sum);
}

// The color of the whole pixel is known, that of its samples too: the change is predicted by linear
// regression on the color, among the samples, as their mean differs from the pixel. Without variance,
// the change is in proportion to the color; with shadows, only that by occlusion, because indirect light
// is the same on both sides of the boundary of a shadow. What the regression leaves of the difference between
// both halves of the samples estimates the error. In a medium, the samples lack the light that it scatters:
// their mean change is that of the pixel.
template <int N>
LightField::Change JoinedLight<N>::At(int x, int y) const
{
  Change result;
  const LightPixel& pixel = this->Grid.ReadPixel(x, y);
  if (pixel.Sites == 0)
  {
    return result;
  }
  glm::vec3 changes[Halves] = { glm::vec3(0.f), glm::vec3(0.f) };
  glm::vec3 products(0.f);
  glm::vec3 proportional(0.f); // part of the changes that is in proportion to the color
  float squares = 0.f;
  const glm::vec2 counts(pixel.Samples[0], pixel.Samples[1]);
  const float samples = counts[0] + counts[1];
  for (std::uint32_t i = pixel.Begin; i < pixel.Begin + pixel.Sites; ++i)
  {
    const LightSite<N>& site = this->Grid.Sites[i];
    const Value light = this->Evaluate(site);
    const auto change = [&](glm::vec3 occluded, glm::vec3 reflectance) {
      return Terms::ComputeChange(light, this->UniformLight, occluded, reflectance);
    };
    for (int half = 0; half < Halves; ++half)
    {
      const glm::vec3 occluded = site.Colors[Terms::OcclusionTerm][half];
      const glm::vec3 reflectance = site.Colors[Terms::RadianceTerm][half];
      changes[half] += change(occluded, reflectance);
      proportional += change(occluded, this->HasShadows ? glm::vec3(0.f) : reflectance);
    }
    products += change(site.Products[Terms::OcclusionTerm], site.Products[Terms::RadianceTerm]);
    const float square = this->ComputeSquaredError(site, samples);
    squares += square;
    result.Scatter += this->Grid.Patches[site.Patch].SharedPixels * Square(square);
  }
  const glm::vec3 color = (pixel.Colors[0] + pixel.Colors[1]) / samples;
  const glm::vec3 change = (changes[0] + changes[1]) / samples;
  const glm::vec3 variance = glm::max(pixel.Squares / samples - color * color, glm::vec3(0.f));
  const glm::vec3 covariance = products / samples - color * change;
  const glm::vec3 ridge = PartRidge * (1.f + color * color);
  float parts = 0.f;
  for (int c = 0; c < 3; ++c)
  {
    const float ratio = color[c] > 0.f ? proportional[c] / (samples * color[c]) : 0.f;
    const float slope = this->UsesColors
      ? std::max((covariance[c] + ridge[c] * ratio) / (variance[c] + ridge[c]), -1.f)
      : 0.f;
    result.Factor[c] = 1.f + slope;
    result.Offset[c] = change[c] - slope * color[c];
    float difference = 0.f;
    if (pixel.Samples[0] > 0 && pixel.Samples[1] > 0)
    {
      difference = (changes[0][c] - slope * pixel.Colors[0][c]) / counts[0] -
        (changes[1][c] - slope * pixel.Colors[1][c]) / counts[1];
    }
    parts = std::max(parts, std::abs(difference));
  }
  const float square = PartVarianceGain * Square<float>(parts);
  result.Scatter += Square(square);
  result.Error = std::sqrt(squares + square);
  return result;
}

template <int N>
float JoinedLight<N>::GetMeanOcclusion(int x, int y) const
{
  const LightPixel& pixel = this->Grid.ReadPixel(x, y);
  float sum = 0.f;
  float samples = 0.f;
  for (std::uint32_t i = pixel.Begin; i < pixel.Begin + pixel.Sites; ++i)
  {
    const LightSite<N>& site = this->Grid.Sites[i];
    sum += site.Samples * this->Evaluate(site)[0];
    samples += site.Samples;
  }
  return samples > 0.f ? sum / samples : 0.f;
}

}

std::unique_ptr<LightField> LightField::Make(
  const CameraRayTracer& tracer, const LightEffects& effects, glm::ivec2 low, glm::ivec2 high)
{
  return effects.Select([&](auto values) -> std::unique_ptr<LightField> {
    return std::make_unique<JoinedLight<values()>>(tracer, effects, low, high);
  });
}

}
