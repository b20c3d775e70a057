// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "JoinedOcclusion.h"

#include "Execution/ParallelFor.h"
#include "Light/SiteJoining.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/OwenSobolSequence.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace penumbra
{

namespace
{

constexpr int PacketSize = OcclusionRays::PacketSize;
constexpr int CellsOfBlock = DirectionBlockSide * DirectionBlockSide;
constexpr int FirstRaysOfHalf = FirstSiteRays / Halves;
static_assert(CellsOfBlock * FirstRaysOfHalf <= MaximumSiteRays,
  "the points of the first round precede those of later ones");

/// Number of parts of the unit square, on each side, by which the rays of a block are sorted: rays of a
/// packet then have similar directions.
constexpr int DirectionBins = 4;

/// Rays grow with this power of the squared error of a tile, because that of stratified rays decreases faster than that
/// of independent ones. Measured with `./penumbra benchmark ambient-occlusion --only settling`: with 0.75, S400
/// needs two more rounds; with 1, Sticks needs more rays.
constexpr float GrowthPower = 0.875f;

/// After LightRounds rounds, tiles get rays for this fraction of the accepted squared error, so that few
/// rounds of few tiles remain.
constexpr float LateErrorFraction = 0.5f;

/// A ray of a block of pixels.
struct BlockRay
{
  std::uint32_t Site;
  int Half;
  glm::vec2 At; ///< its direction, in the unit square
};

/// Returns the offset of a cell of a block, in Morton order.
glm::ivec2 OffsetOfCell(int cell)
{
  glm::ivec2 offset(0);
  for (int bit = 0; 1 << bit < DirectionBlockSide; ++bit)
  {
    offset.x |= (cell >> (2 * bit) & 1) << bit;
    offset.y |= (cell >> (2 * bit + 1) & 1) << bit;
  }
  return offset;
}

int BinOf(glm::vec2 at)
{
  const glm::ivec2 bin = glm::ivec2(static_cast<float>(DirectionBins) * at);
  return DirectionBins * bin.y + bin.x;
}

/// Sorts rays by their bins and keeps their order in each.
void SortByDirection(std::vector<BlockRay>& rays)
{
  std::uint32_t begin[DirectionBins * DirectionBins + 1] = {};
  for (const BlockRay& ray : rays)
  {
    ++begin[BinOf(ray.At) + 1];
  }
  std::partial_sum(std::begin(begin), std::end(begin), std::begin(begin));
  std::vector<BlockRay> sorted(rays.size());
  for (const BlockRay& ray : rays)
  {
    sorted[begin[BinOf(ray.At)]++] = ray;
  }
  rays.swap(sorted);
}

}

JoinedOcclusion::JoinedOcclusion(const std::vector<SurfacePoint>& points, int width,
  const RayScene& rays, float radius, double tolerance)
  : Rays(rays, DistanceFalloff(radius), tolerance),
    Tolerance(tolerance),
    Size(width, static_cast<int>(points.size()) / std::max(width, 1))
{
  this->Grid.High = (this->Size + LightTileSide - 1) / LightTileSide * LightTileSide;
  const glm::ivec2 tiles = this->Grid.High / LightTileSide;
  this->Tiles.resize(static_cast<std::size_t>(tiles.x) * tiles.y);
  this->Grid.Tiles.resize(this->Tiles.size());
  for (int y = 0; y < this->Size.y; ++y)
  {
    for (int x = 0; x < this->Size.x; ++x)
    {
      const SurfacePoint& point = points[static_cast<std::size_t>(y) * width + x];
      if (point.Normal != glm::vec3(0.f))
      {
        this->Grid.Tiles[this->Grid.GetTile(x, y)].resize(LightTileSide * LightTileSide);
        LightPixel& pixel = this->Grid.GetPixel(x, y);
        pixel.Begin = static_cast<std::uint32_t>(this->Grid.Sites.size());
        pixel.Sites = 1;
        pixel.Traced = 0;
        LightSite<1>& site = this->Grid.Sites.emplace_back();
        site.Position = point.Position;
        site.Normal = point.Normal;
        site.Footprint = point.PixelSize;
        site.Samples = 1.f;
      }
    }
  }
  std::iota(this->Tiles.begin(), this->Tiles.end(), 0);
  this->Done.assign(this->Tiles.size(), 0);
  this->Complete = this->Grid.Sites.empty();
}

bool JoinedOcclusion::Continue(WorkLimit* limit)
{
  bool changed = false;
  while (!this->Complete && this->TraceRound(limit))
  {
    this->Join();
    ++this->Round;
    changed = true;
    this->Complete = !this->StartRound();
  }
  return changed;
}

/// Traces the rays of a round. Returns false if the limit ended this, or if none of it is left for
/// joining; the next call continues.
bool JoinedOcclusion::TraceRound(WorkLimit* limit)
{
  const int count = static_cast<int>(this->Tiles.size());
  const auto next = static_cast<int>(
    std::find(this->Done.begin(), this->Done.end(), 0) - this->Done.begin()); // always traced
  std::atomic<long long> rays{ 0 };
  ParallelFor<int>(next, count, 1, [&](int i) {
    if (this->Done[i] == 0 && (i == next || !IsReached(limit)))
    {
      rays += this->TraceTile(this->Tiles[i]);
      this->Done[i] = 1;
    }
  });
  this->NumberOfRays += rays;
  const bool isDone = std::find(this->Done.begin(), this->Done.end(), 0) == this->Done.end();
  return isDone && (next == count || !IsReached(limit));
}

glm::ivec2 JoinedOcclusion::FirstOfTile(int tile) const
{
  const int columns = this->Grid.High.x / LightTileSide;
  return LightTileSide * glm::ivec2(tile % columns, tile / columns);
}

long long JoinedOcclusion::TraceTile(int tile)
{
  constexpr int Ratio = LightTileSide / DirectionBlockSide;
  long long rays = 0;
  for (int i = 0; i < Ratio * Ratio && !this->Grid.Tiles[tile].empty(); ++i)
  {
    rays += this->TraceBlock(
      this->FirstOfTile(tile) + DirectionBlockSide * glm::ivec2(i % Ratio, i / Ratio));
  }
  return rays;
}

// The directions of the first round are one net of all pixels of the block, which decides smooth surfaces. Those of
// all later rounds of a pixel are one range of the sequence, so that they are stratified together. Without shuffled
// indices, every second pixel of a row has directions in the same parts of the hemisphere. An occluder in such a part
// looks like a pattern of the surface, which is not joined.
long long JoinedOcclusion::TraceBlock(glm::ivec2 first)
{
  const glm::ivec2 block = first / DirectionBlockSide;
  const std::uint32_t seed =
    MixBits(static_cast<std::uint32_t>(block.x) + MixBits(static_cast<std::uint32_t>(block.y))) *
    static_cast<std::uint32_t>(Halves);
  const OwenSobolSequence sequences[Halves] = { OwenSobolSequence(MixBits(seed)),
    OwenSobolSequence(MixBits(seed + 1)) };
  std::vector<BlockRay> rays;
  for (int cell = 0; cell < CellsOfBlock; ++cell)
  {
    const glm::ivec2 p = first + OffsetOfCell(cell);
    LightPixel& pixel = this->Grid.GetPixel(p.x, p.y);
    const bool isFirst = pixel.Traced == 0;
    const int begin =
      isFirst ? cell * FirstRaysOfHalf : (cell + 1) * MaximumSiteRays + pixel.Traced;
    const int added =
      pixel.Sites > 0 ? (isFirst ? FirstRaysOfHalf : pixel.Target - pixel.Traced) : 0;
    for (int i = 0; i < Halves * added; ++i)
    {
      const int half = i % Halves;
      const auto index = static_cast<std::uint32_t>(begin + i / Halves);
      const std::uint32_t shuffled =
        OwenSobolSequence::ShuffleIndex(index, seed + static_cast<std::uint32_t>(half));
      rays.push_back({ pixel.Begin, half, sequences[half].At(shuffled) });
    }
    pixel.Traced = static_cast<std::uint16_t>(pixel.Traced + added);
  }
  SortByDirection(rays);
  auto count = static_cast<long long>(rays.size());
  for (std::size_t begin = 0; begin < rays.size(); begin += PacketSize)
  {
    const int size = static_cast<int>(std::min<std::size_t>(rays.size() - begin, PacketSize));
    Ray packet[PacketSize];
    float values[PacketSize];
    for (int k = 0; k < PacketSize; ++k)
    {
      packet[k].Far = -1.f;
      if (k < size)
      {
        const BlockRay& ray = rays[begin + k];
        const LightSite<1>& site = this->Grid.Sites[ray.Site];
        packet[k].Origin = site.Position;
        packet[k].Direction = FrameFromNormal(site.Normal) *
          DiskToHemisphere(SampleUniformDiskConcentric(ray.At.x, ray.At.y));
        packet[k].Far = this->Rays.GetRadius();
      }
    }
    this->Rays.Trace(packet, values, count);
    for (int k = 0; k < size; ++k)
    {
      const BlockRay& ray = rays[begin + k];
      this->Grid.Sites[ray.Site].Sums[ray.Half][0] += values[k];
      ++this->Grid.Sites[ray.Site].Rays[ray.Half];
    }
  }
  return count;
}

PixelError JoinedOcclusion::ErrorAt(int x, int y) const
{
  const LightPixel& pixel = this->Grid.ReadPixel(x, y);
  if (pixel.Sites == 0)
  {
    return { -1.f, 0.f };
  }
  const SitePatch<1>& patch = this->Grid.Patches[this->Grid.Sites[pixel.Begin].Patch];
  const float square = patch.SquaredError[0];
  return { square, patch.SharedPixels * square * square };
}

void JoinedOcclusion::Join()
{
  JoinSites(this->Grid);
  this->LargestError = 0.0;
  double sum = 0.0;
  const glm::ivec2 tiles = this->Grid.High / LightTileSide;
  for (int tile = 0; tile < tiles.x * tiles.y; ++tile)
  {
    const glm::ivec2 first = this->FirstOfTile(tile);
    const ErrorSum errors =
      SumErrors(first, first + LightTileSide, [this](int x, int y) { return this->ErrorAt(x, y); });
    sum += errors.Squares;
    this->LargestError = std::max(this->LargestError,
      std::sqrt(static_cast<double>(errors.Squares) / std::max(errors.Count, 1)));
  }
  this->MeanError = std::sqrt(sum / static_cast<double>(this->Grid.Sites.size()));
}

/// Chooses the tiles of the next round and their numbers of rays. Returns false if there are none.
bool JoinedOcclusion::StartRound()
{
  const auto limit = static_cast<float>(this->Tolerance * this->Tolerance);
  const auto errorAt = [this](int x, int y) { return this->ErrorAt(x, y); };
  this->Tiles.clear();
  const glm::ivec2 tiles = this->Grid.High / LightTileSide;
  for (int tile = 0; tile < tiles.x * tiles.y; ++tile)
  {
    const glm::ivec2 first = this->FirstOfTile(tile);
    const glm::ivec2 end = first + LightTileSide;
    const ErrorSum errors = SumErrors(first, end, errorAt);
    const float excess =
      errors.GetBound() / (static_cast<float>(std::max(errors.Count, 1)) * limit);
    const float aim = this->Round < LightRounds ? limit * std::pow(excess, 1.f - GrowthPower)
                                                : LateErrorFraction * limit;
    if (excess > 1.f && IncreaseTile(this->Grid, first, end, aim, errorAt))
    {
      this->Tiles.push_back(tile);
    }
  }
  this->Done.assign(this->Tiles.size(), 0);
  return !this->Tiles.empty();
}

void JoinedOcclusion::CopyTo(std::vector<float>& means) const
{
  means.assign(static_cast<std::size_t>(this->Size.x) * this->Size.y, 0.f);
  ParallelFor<int>(0, this->Size.y, 0, [&](int y) {
    for (int x = 0; x < this->Size.x; ++x)
    {
      const LightPixel& pixel = this->Grid.ReadPixel(x, y);
      if (pixel.Sites > 0)
      {
        means[static_cast<std::size_t>(y) * this->Size.x + x] =
          std::clamp(EvaluateSite(this->Grid, this->Grid.Sites[pixel.Begin])[0], 0.f, 1.f);
      }
    }
  });
}

}
