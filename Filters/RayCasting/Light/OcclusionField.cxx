// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionField.h"

#include "LightConstants.h"
#include "Sampling/CameraRayTracer.h"
#include "Scene.h"
#include "SiteJoining.h"
#include "SiteSampler.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace penumbra
{
namespace
{

float Square(float x)
{
  return x * x;
}

float MaximumComponent(const glm::vec3& v)
{
  return std::max({ v.x, v.y, v.z });
}

glm::ivec2 RoundDown(glm::ivec2 p)
{
  return glm::ivec2(glm::floor(glm::dvec2(p) / double(LightTileSide))) * LightTileSide;
}

}

/// Samples the tiles of a field, and decides how many samples their pixels get.
class TileSamples
{
public:
  TileSamples(OcclusionField& field, const CameraRayTracer& tracer, const OcclusionRays& rays)
    : Field(field),
      Grid(field.Grid),
      Tracer(tracer),
      Rays(rays),
      Tiles(field.Grid.GetSize() / LightTileSide),
      Count(this->Tiles.x * this->Tiles.y)
  {
  }

  /// Finds the sites of all tiles.
  void FindSites(double to, const ProgressCallback& progress, RayCounts& counts)
  {
    std::vector<std::vector<LightSite>> sites(this->Count);
    this->Grid.Pixels.assign(
      static_cast<std::size_t>(this->Grid.GetSize().x) * this->Grid.GetSize().y, LightPixel());
    this->ForTiles(0.0, to, progress, counts, [&](int tile, SiteSampler& sampler) {
      this->VisitBlocks(tile, [&](glm::ivec2 first) {
        sampler.FindSites(first);
        for (int cell = 0; cell < SiteSampler::Cells; ++cell)
        {
          LightPixel& pixel = this->GetPixel(first, cell);
          pixel = sampler.GetPixel(cell);
          pixel.Begin = static_cast<std::uint32_t>(sites[tile].size());
          const std::vector<LightSite>& found = sampler.GetSites(cell);
          sites[tile].insert(sites[tile].end(), found.begin(), found.end());
        }
      });
    });
    for (std::size_t tile = 0; tile < sites.size(); ++tile)
    {
      this->VisitBlocks(static_cast<int>(tile), [&](glm::ivec2 first) {
        for (int cell = 0; cell < SiteSampler::Cells; ++cell)
        {
          this->GetPixel(first, cell).Begin += static_cast<std::uint32_t>(this->Grid.Sites.size());
        }
      });
      this->Grid.Sites.insert(this->Grid.Sites.end(), sites[tile].begin(), sites[tile].end());
      std::vector<LightSite>().swap(sites[tile]);
    }
  }

  /// Increases the targets of pixels in the tiles whose estimated error exceeds `tolerance`. Returns
  /// true if there are such tiles.
  bool Increase(double tolerance)
  {
    const auto limit = static_cast<float>(Square(LightErrorMargin * tolerance));
    this->Increased.clear();
    for (int tile = 0; tile < this->Count; ++tile)
    {
      if (this->IncreaseTile(this->GetFirst(static_cast<int>(tile)), limit))
      {
        this->Increased.push_back(static_cast<int>(tile));
      }
    }
    return !this->Increased.empty();
  }

  /// Traces the samples that Increase() has added.
  void AddSamples(double from, double to, const ProgressCallback& progress, RayCounts& counts)
  {
    this->ForTiles(
      from, to, progress, counts,
      [&](int i, SiteSampler& sampler) {
        const int tile = this->Increased[i];
        this->VisitBlocks(tile, [&](glm::ivec2 first) {
          sampler.AddSamples(first, this->Grid);
          for (int cell = 0; cell < SiteSampler::Cells; ++cell)
          {
            LightPixel& pixel = this->GetPixel(first, cell);
            pixel = sampler.GetPixel(cell);
            std::copy(sampler.GetSites(cell).begin(), sampler.GetSites(cell).end(),
              this->Grid.Sites.begin() + pixel.Begin);
          }
        });
      },
      static_cast<int>(this->Increased.size()));
  }

private:
  // Numbers of rays in proportion to the errors of blocks of pixels would lead to the smallest error of the
  // tile (Neyman allocation) if neighbors did not share their rays. They grow by the mean of this and of
  // the same factor in the whole tile.
  bool IncreaseTile(glm::ivec2 first, float limit)
  {
    const Camera& camera = this->Tracer.GetScene().ViewCamera;
    const glm::ivec2 end = glm::min(first + LightTileSide, glm::ivec2(camera.Width, camera.Height));
    float sum = 0.f;
    int count = 0;
    SumErrors(first, end, sum, count);
    const float accepted = static_cast<float>(count) * limit;
    if (sum <= accepted)
    {
      return false;
    }
    bool isIncreased = false;
    for (int i = 0; i < RayBlocks * RayBlocks; ++i)
    {
      const glm::ivec2 low = first + RayBlockSide * glm::ivec2(i % RayBlocks, i / RayBlocks);
      const glm::ivec2 high = glm::min(low + RayBlockSide, end);
      float own = 0.f;
      int pixels = 0;
      SumErrors(low, high, own, pixels);
      const float share = own * static_cast<float>(count) / (sum * static_cast<float>(pixels));
      isIncreased |= pixels > 0 &&
        this->IncreaseBlock(low, high, 0.5f * (1.f + std::sqrt(share)) * sum / accepted);
    }
    return isIncreased;
  }

  /// Adds the squared errors of the pixels [low, high), and their number.
  void SumErrors(glm::ivec2 low, glm::ivec2 high, float& sum, int& count) const
  {
    for (int y = low.y; y < high.y; ++y)
    {
      for (int x = low.x; x < high.x; ++x, ++count)
      {
        sum += Square(this->Field.At(x, y).Error);
      }
    }
  }

  bool IncreaseBlock(glm::ivec2 low, glm::ivec2 high, float factor)
  {
    if (!(factor > 1.f))
    {
      return false;
    }
    bool isIncreased = false;
    for (int y = low.y; y < high.y; ++y)
    {
      for (int x = low.x; x < high.x; ++x)
      {
        LightPixel& pixel = this->Grid.Pixels[this->Grid.GetCell(x, y)];
        if (pixel.Sites > 0 && pixel.Target < MaximumSiteRays / Halves)
        {
          pixel.Target = static_cast<std::uint16_t>(Grow(pixel.Target, factor));
          isIncreased = true;
        }
      }
    }
    return isIncreased;
  }

  /// Multiplies a number of rays, 2^k or 1.5 x 2^k, by `factor` or a little more, but at most by
  /// LargestRayGrowth.
  static int Grow(int rays, float factor)
  {
    const float wanted = static_cast<float>(rays) * std::min(factor, LargestRayGrowth);
    while (static_cast<float>(rays) < wanted && rays < MaximumSiteRays / Halves)
    {
      rays += (rays & (rays - 1)) == 0 ? rays / 2 : rays / 3;
    }
    return rays;
  }

  glm::ivec2 GetFirst(int tile) const
  {
    return this->Grid.Low + LightTileSide * glm::ivec2(tile % this->Tiles.x, tile / this->Tiles.x);
  }

  LightPixel& GetPixel(glm::ivec2 first, int cell)
  {
    const glm::ivec2 p = first + SiteSampler::GetOffset(cell);
    return this->Grid.Pixels[this->Grid.GetCell(p.x, p.y)];
  }

  /// Calls visit(first) for the first pixels of the blocks of a tile.
  template <typename Visit>
  void VisitBlocks(int tile, const Visit& visit) const
  {
    constexpr int Ratio = LightTileSide / SiteSampler::Side;
    for (int i = 0; i < Ratio * Ratio; ++i)
    {
      visit(this->GetFirst(tile) + SiteSampler::Side * glm::ivec2(i % Ratio, i / Ratio));
    }
  }

  template <typename Work>
  void ForTiles(double from, double to, const ProgressCallback& progress, RayCounts& counts,
    const Work& work, int count = -1)
  {
    std::mutex totals;
    const bool finished =
      ParallelForWithProgress(count < 0 ? this->Count : count, from, to, progress, [&](int i) {
        SiteSampler sampler(this->Tracer, this->Rays);
        work(i, sampler);
        const std::lock_guard<std::mutex> lock(totals);
        counts += sampler.Counts;
        counts.Auxiliary += sampler.CameraRays;
        counts.Occlusion += sampler.LightRays;
      });
    if (!finished)
    {
      throw Stopped();
    }
  }

  const OcclusionField& Field;
  SiteGrid& Grid;
  const CameraRayTracer& Tracer;
  const OcclusionRays& Rays;
  glm::ivec2 Tiles;
  int Count;
  std::vector<int> Increased;
};

OcclusionField::OcclusionField(const CameraRayTracer& tracer, const OcclusionRays& rays,
  double tolerance, glm::ivec2 low, glm::ivec2 high, const ProgressCallback& progress,
  RayCounts& counts)
{
  // Every round extends the sites that an estimate depends on.
  const Camera& camera = tracer.GetScene().ViewCamera;
  const int margin = (LightRounds + 1) * GetJoiningReach() + LightRounds * LightTileSide;
  this->Grid.Low = glm::max(RoundDown(low - margin), glm::ivec2(0));
  this->Grid.High = glm::min(RoundDown(high + margin) + LightTileSide,
    RoundDown({ camera.Width, camera.Height }) + LightTileSide);
  TileSamples tiles(*this, tracer, rays);
  const double step = 1.0 / (LightRounds + 1);
  tiles.FindSites(step, progress, counts);
  JoinSites(this->Grid);
  for (int round = 1; round <= LightRounds && tiles.Increase(tolerance); ++round)
  {
    tiles.AddSamples(round * step, (round + 1) * step, progress, counts);
    JoinSites(this->Grid);
  }
}

float OcclusionField::Evaluate(const LightSite& site) const
{
  const SitePatch& patch = this->Grid.Patches[site.Patch];
  const LightFeatures at(site.Position, site.Normal);
  const float rays = static_cast<float>(site.Rays[0]) + static_cast<float>(site.Rays[1]);
  float value = patch.Value + patch.AloneWeight * (site.Sums[0] + site.Sums[1]) / rays;
  for (int k = 0; k < LightFeatures::Count; ++k)
  {
    value += patch.Slopes[k] * (at.At[k] - patch.Mean.At[k]);
  }
  return std::clamp(value, 0.f, 1.f);
}

// The parts of the sites are estimated from the samples of the pixel. The difference between both
// halves of them estimates their error.
OcclusionField::Factor OcclusionField::At(int x, int y) const
{
  Factor factor;
  const LightPixel& pixel = this->Grid.Pixels[this->Grid.GetCell(x, y)];
  if (pixel.Sites == 0)
  {
    return factor;
  }
  glm::vec3 removed[Halves] = { glm::vec3(0.f), glm::vec3(0.f) };
  float squares = 0.f;
  const float samples = static_cast<float>(pixel.Samples[0]) + static_cast<float>(pixel.Samples[1]);
  for (std::uint32_t i = pixel.Begin; i < pixel.Begin + pixel.Sites; ++i)
  {
    const LightSite& site = this->Grid.Sites[i];
    const float occlusion = this->Evaluate(site);
    removed[0] += occlusion * site.Colors[0];
    removed[1] += occlusion * site.Colors[1];
    squares += Square(MaximumComponent(site.Colors[0] + site.Colors[1]) / samples) *
      this->Grid.Patches[site.Patch].SquaredError;
  }
  float parts = 0.f;
  for (int c = 0; c < 3; ++c)
  {
    const float sum = pixel.Colors[0][c] + pixel.Colors[1][c];
    if (sum > 0.f)
    {
      factor.Value[c] = std::clamp(1.f - (removed[0][c] + removed[1][c]) / sum, 0.f, 1.f);
      const float difference = removed[0][c] / std::max(pixel.Colors[0][c], 1e-6f * sum) -
        removed[1][c] / std::max(pixel.Colors[1][c], 1e-6f * sum);
      parts = std::max(parts, std::abs(difference) * sum / samples);
    }
  }
  factor.Error = std::sqrt(squares + PartVarianceGain * Square(parts));
  return factor;
}

float OcclusionField::GetMean(int x, int y) const
{
  const LightPixel& pixel = this->Grid.Pixels[this->Grid.GetCell(x, y)];
  float sum = 0.f;
  float samples = 0.f;
  for (std::uint32_t i = pixel.Begin; i < pixel.Begin + pixel.Sites; ++i)
  {
    const LightSite& site = this->Grid.Sites[i];
    sum += site.Samples * this->Evaluate(site);
    samples += site.Samples;
  }
  return samples > 0.f ? sum / samples : 0.f;
}

}
