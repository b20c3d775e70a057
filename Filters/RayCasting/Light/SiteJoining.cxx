// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SiteJoining.h"

#include "ChangedBlocks.h"
#include "Execution/ParallelFor.h"
#include "LightBias.h"
#include "LightConstants.h"
#include "LightLevel.h"
#include "TilePatches.h"
#include "Vectors.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace penumbra
{
/// Patches, models and estimates of all levels.
template <int N>
class SiteJoining<N>::Levels
{
  using Value = typename LightTerms<N>::Value;
  using Patch = LightPatch<N>;
  using Model = LightModel<N>;
  using Level = LightLevel<N>;
  using Changes = LevelChanges<N>;

public:
  explicit Levels(SiteGrid<N>& grid)
    : Grid(grid)
  {
    const int tiles = this->GetNumberOfTiles();
    for (int i = 0; i < LightLevels; ++i)
    {
      Level& level = this->All[i];
      level.Side = 2 << i;
      level.Blocks = grid.GetSize() / level.Side;
      level.Ranges.resize(level.GetNumberOfBlocks());
      level.Tiles.resize(tiles);
    }
    this->Sums.resize(this->GetBiasLevel().GetNumberOfBlocks());
    this->RowSums.resize(this->Sums.size());
  }

  int GetNumberOfTiles() const
  {
    const glm::ivec2 tiles = this->Grid.GetSize() / LightTileSide;
    return tiles.x * tiles.y;
  }

  std::vector<int> Update(const std::vector<int>& tiles)
  {
    ChangedBlocks changed(this->Grid.GetSize() / LightTileSide, tiles);
    this->MakePatches(tiles);
    for (Level& level : this->All)
    {
      ForAll(changed.Models[&level - this->All], [&](int block) { this->FitModels(level, block); });
    }
    ForAll(changed.Evaluated, [&](const ChangedBlocks::Estimates& estimates) {
      this->Evaluate(estimates.Block, estimates.Levels);
      this->SumChanges(estimates.Block);
    });
    this->PoolBias(changed.Biased);
    ForAll(changed.Combined, [&](int block) {
      this->VisitCells(block, [&](std::uint32_t p, glm::ivec2 cell) { this->Combine(p, cell); });
    });
    return std::move(changed.Tiles);
  }

private:
  /// Estimates at the mean of a patch of the first level, at each level; 0: of
  /// the sites alone.
  struct PatchEstimates
  {
    Value Values[LightLevels][Halves];
    Value Variances[LightLevels +
      1]; ///< if the rays are independent; the first one: of the sites alone
    float SiteWeight = 0.f;
    Value SiteChanges{
      0.f
    }; ///< weighted sum of the products of the changes from the sites to the first level
  };

  template <typename Items, typename Work>
  static void ForAll(const Items& items, const Work& work)
  {
    ParallelFor(0, static_cast<int>(items.size()), 32, [&](int i) { work(items[i]); });
  }

  const Level& GetBiasLevel() const { return this->All[BiasLevel - 1]; }

  /// Calls visit(index, corner) for the blocks of the first level in a block of BiasLevel, row by row. `corner`: first
  /// cell of the block.
  template <typename Visit>
  void VisitBlocks(int block, const Visit& visit) const
  {
    const Level& level = this->All[0];
    const int ratio = this->GetBiasLevel().Side / level.Side;
    const int columns = this->GetBiasLevel().Blocks.x;
    for (int i = 0; i < ratio * ratio; ++i)
    {
      const glm::ivec2 at =
        ratio * glm::ivec2(block % columns, block / columns) + glm::ivec2(i % ratio, i / ratio);
      visit(at.y * level.Blocks.x + at.x, level.Side * at);
    }
  }

  /// Calls visit(patch, corner) for the patches of these blocks.
  template <typename Visit>
  void VisitCells(int block, const Visit& visit) const
  {
    this->VisitBlocks(block, [&](int first, glm::ivec2 corner) {
      this->All[0].VisitPatches(first, [&](std::uint32_t p) { visit(p, corner); });
    });
  }

  void MakePatches(const std::vector<int>& tiles)
  {
    std::vector<TilePatches<N>> made(tiles.size());
    ParallelFor(
      0, static_cast<int>(tiles.size()), 1, [&](int i) { made[i].Make(this->Grid, tiles[i]); });
    for (int l = 0; l < LightLevels; ++l)
    {
      this->All[l].MakeRoom(tiles, [&](std::size_t i) { return made[i].Levels[l].Patches.size(); });
    }
    GrowTo(this->Estimates, this->All[0].Patches.size());
    GrowTo(this->Grid.Patches, this->All[0].Patches.size());
    GrowTo(this->Own, this->GetBiasLevel().Patches.size());
    GrowTo(this->Bias, this->Own.size());
    ParallelFor(0, static_cast<int>(tiles.size()), 1, [&](int i) {
      this->StorePatches(tiles[i], made[i]);
      made[i] = TilePatches<N>();
    });
  }

  void StorePatches(int tile, const TilePatches<N>& made)
  {
    if (made.Levels[0].Begin.empty())
    {
      return;
    }
    for (int l = 0; l < LightLevels; ++l)
    {
      Level& level = this->All[l];
      const typename TilePatches<N>::Level& source = made.Levels[l];
      const std::uint32_t begin = level.Tiles[tile].Begin;
      std::copy(source.Patches.begin(), source.Patches.end(), level.Patches.begin() + begin);
      for (std::size_t i = 0; i < source.Parents.size(); ++i)
      {
        level.Parents[begin + i] = this->All[l + 1].Tiles[tile].Begin + source.Parents[i];
      }
      const int ratio = LightTileSide / level.Side;
      const int columns = level.Blocks.x / ratio;
      const glm::ivec2 first = ratio * glm::ivec2(tile % columns, tile / columns);
      for (int i = 0; i < ratio * ratio; ++i)
      {
        level.Ranges[(first.y + i / ratio) * level.Blocks.x + first.x + i % ratio] = {
          begin + source.Begin[i], begin + source.Begin[i + 1]
        };
      }
    }
    for (const LightPixel& pixel : this->Grid.Tiles[tile])
    {
      for (std::uint32_t k = pixel.Begin; k < pixel.Begin + pixel.Sites; ++k)
      {
        this->Grid.Sites[k].Patch += this->All[0].Tiles[tile].Begin;
      }
    }
  }

  void FitModels(Level& level, int block)
  {
    const glm::ivec2 at(block % level.Blocks.x, block / level.Blocks.x);
    level.VisitPatches(block, [&](std::uint32_t p) {
      const Patch& patch = level.Patches[p];
      Patch sum = patch;
      for (int i = 0; i < WindowBlocks; ++i)
      {
        const glm::ivec2 step(i % 3 - 1, i / 3 - 1);
        std::uint32_t& match = level.Windows[p].Patches[i];
        match = i == 4 ? p : FindMatch(level, at + step, patch);
        if (i != 4 && match != NoPatch)
        {
          sum.Add(level.Patches[match], (step.x == 0 ? 1.f : 0.5f) * (step.y == 0 ? 1.f : 0.5f));
        }
      }
      level.Models[p].Fit(sum, level.Side, this->Grid.SquaredRange);
    });
  }

  static std::uint32_t FindMatch(const Level& level, glm::ivec2 block, const Patch& patch)
  {
    std::uint32_t best = NoPatch;
    float largest = 0.f;
    if (block.x >= 0 && block.y >= 0 && block.x < level.Blocks.x && block.y < level.Blocks.y)
    {
      level.VisitPatches(block.y * level.Blocks.x + block.x, [&](std::uint32_t i) {
        const Patch& other = level.Patches[i];
        if (patch.Matches(other) && other.Weight > largest)
        {
          largest = other.Weight;
          best = i;
        }
      });
    }
    return best;
  }

  /// Evaluates the models of `levels` (bits) in a block of BiasLevel.
  void Evaluate(int block, unsigned int levels)
  {
    this->VisitCells(block, [&](std::uint32_t p, glm::ivec2 cell) {
      std::uint32_t parent = p;
      for (int l = 0; l < LightLevels; ++l)
      {
        if ((levels >> l & 1u) != 0)
        {
          this->Evaluate(l, p, parent, cell);
        }
        parent = l + 1 < LightLevels ? this->All[l].Parents[parent] : parent;
      }
    });
    if ((levels & 1u) != 0)
    {
      this->VisitBlocks(
        block, [&](int first, glm::ivec2 corner) { this->CompareSites(first, corner); });
    }
  }

  /// Evaluates the models of a level at the mean of patch `p` of the first level. `parent`: its patch of this level.
  void Evaluate(int l, std::uint32_t p, std::uint32_t parent, glm::ivec2 cell)
  {
    const Level& level = this->All[l];
    const Patch& patch = this->All[0].Patches[p];
    PatchEstimates& estimates = this->Estimates[p];
    const ModelBlend blend(level, parent, cell);
    Value* const values = estimates.Values[l];
    std::fill(values, values + Halves, Value(0.f));
    Value variance(0.f);
    for (int k = 0; k < blend.Count; ++k)
    {
      const Model& model = level.Models[blend.Patches[k]];
      model.Evaluate(patch.Mean, blend.Weights[k], values);
      variance += blend.Weights[k] * model.Variance;
    }
    estimates.Variances[l + 1] = variance;
    if (l == BiasLevel - 1)
    {
      const Patch& pool = level.Patches[parent];
      estimates.Variances[0] =
        AloneVarianceGain * pool.GetVariance(this->Grid.SquaredRange) * patch.Parts / patch.Weight;
    }
  }

  /// Compares the sites of a block of the first level with its models. A site has an effect on its pixel, and
  /// a number of rays, in proportion to the part that it covers.
  void CompareSites(int block, glm::ivec2 corner)
  {
    const Level& level = this->All[0];
    level.VisitPatches(block, [&](std::uint32_t p) {
      this->Estimates[p].SiteWeight = 0.f;
      this->Estimates[p].SiteChanges = Value(0.f);
    });
    for (int i = 0; i < level.Side * level.Side; ++i)
    {
      const glm::ivec2 at = this->Grid.Low + corner + glm::ivec2(i % level.Side, i / level.Side);
      const LightPixel& pixel = this->Grid.ReadPixel(at.x, at.y);
      for (std::uint32_t k = pixel.Begin; k < pixel.Begin + pixel.Sites; ++k)
      {
        const LightSite<N>& site = this->Grid.Sites[k];
        const ModelBlend blend(level, site.Patch, corner);
        Value values[Halves] = {};
        for (int n = 0; n < blend.Count; ++n)
        {
          level.Models[blend.Patches[n]].Evaluate(
            { site.Position, site.Normal }, blend.Weights[n], values);
        }
        const float weight = Square(pixel.GetPart(site));
        PatchEstimates& estimates = this->Estimates[site.Patch];
        estimates.SiteWeight += weight;
        estimates.SiteChanges += weight *
          (site.Sums[0] / static_cast<float>(site.Rays[0]) - values[0]) *
          (site.Sums[1] / static_cast<float>(site.Rays[1]) - values[1]);
      }
    }
  }

  std::uint32_t FindBiasPatch(std::uint32_t p) const
  {
    for (int l = 0; l + 1 < BiasLevel; ++l)
    {
      p = this->All[l].Parents[p];
    }
    return p;
  }

  /// Sums the changes in a block of BiasLevel, of each patch and of all.
  void SumChanges(int block)
  {
    const Level& level = this->GetBiasLevel();
    level.VisitPatches(block, [&](std::uint32_t p) { this->Own[p] = Changes(); });
    this->VisitCells(block,
      [&](std::uint32_t p, glm::ivec2) { this->AddChanges(p, this->Own[this->FindBiasPatch(p)]); });
    this->Sums[block] = Changes();
    level.VisitPatches(block, [&](std::uint32_t p) { this->Sums[block].Add(this->Own[p], 1.f); });
  }

  void AddChanges(std::uint32_t p, Changes& changes) const
  {
    const PatchEstimates& estimates = this->Estimates[p];
    const float parts = this->All[0].Patches[p].Parts;
    changes.Weights[0] += estimates.SiteWeight;
    changes.Sums[0] += estimates.SiteChanges;
    changes.Variances[0] += estimates.SiteWeight * estimates.Variances[0];
    for (int l = 1; l < LightLevels; ++l)
    {
      changes.Weights[l] += parts;
      changes.Sums[l] += parts * (estimates.Values[l][0] - estimates.Values[l - 1][0]) *
        (estimates.Values[l][1] - estimates.Values[l - 1][1]);
      changes.Totals[l] += parts * (estimates.Values[l][0] - estimates.Values[0][0]) *
        (estimates.Values[l][1] - estimates.Values[0][1]);
    }
    for (int l = 0; l < LightLevels; ++l)
    {
      const Value difference = estimates.Values[l][0] - estimates.Values[l][1];
      changes.Differences[l] += 0.25f * parts * difference * difference;
      changes.Variances[l + 1] += parts * estimates.Variances[l + 1];
    }
  }

  void PoolBias(const std::vector<int>& blocks)
  {
    const Level& level = this->GetBiasLevel();
    ForAll(blocks, [&](int block) { this->RowSums[block] = this->SumLine(this->Sums, block, 0); });
    ForAll(blocks, [&](int block) {
      if (level.Ranges[block].Begin == level.Ranges[block].End)
      {
        return;
      }
      const PatchBias<N> region(this->SumLine(this->RowSums, block, 1), nullptr);
      level.VisitPatches(block, [&](std::uint32_t p) {
        Changes sum;
        for (int i = 0; i < WindowBlocks; ++i)
        {
          const std::uint32_t other = level.Windows[p].Patches[i];
          if (other != NoPatch)
          {
            sum.Add(this->Own[other], (i % 3 == 1 ? 1.f : 0.5f) * (i / 3 == 1 ? 1.f : 0.5f));
          }
        }
        this->Bias[p] = PatchBias<N>(sum, &region);
        this->Bias[p].Accumulate(sum);
      });
    });
  }

  /// Returns the sum of the values of the blocks of BiasLevel around a block, along an axis.
  Changes SumLine(const std::vector<Changes>& values, int block, int axis) const
  {
    const glm::ivec2 size = this->GetBiasLevel().Blocks;
    const int stride = axis == 0 ? 1 : size.x;
    const int at = axis == 0 ? block % size.x : block / size.x;
    const int first = std::max(at - BiasRegion, 0);
    const int last = std::min(at + BiasRegion, size[axis] - 1);
    Changes sum;
    for (int i = first; i <= last; ++i)
    {
      sum.Add(values[block + (i - at) * stride], 1.f);
    }
    return sum;
  }

  void Combine(std::uint32_t p, glm::ivec2 cell)
  {
    const PatchEstimates& estimates = this->Estimates[p];
    const ModelBlend pool(this->GetBiasLevel(), this->FindBiasPatch(p), cell);
    const Patch& patch = this->All[0].Patches[p];
    const float part = patch.Parts / patch.Sites;
    const float factor = 1.f + PartialSiteBias * (1.f - part);
    Value errors[LightLevels + 1];
    float combined[LightLevels + 1];
    float weights[LightLevels + 1];
    float smallest = std::numeric_limits<float>::max();
    for (int l = 0; l <= LightLevels; ++l)
    {
      errors[l] = l == 0 ? estimates.Variances[l] / part : Value(0.f);
      for (int k = 0; l > 0 && k < pool.Count; ++k)
      {
        const PatchBias<N>& bias = this->Bias[pool.Patches[k]];
        errors[l] += pool.Weights[k] *
          (bias.Gains[l - 1] * estimates.Variances[l] + factor * bias.Squares[l - 1]);
      }
      errors[l] = glm::max(errors[l], Value(SmallestSquaredError));
      combined[l] = LightTerms<N>::Combine(errors[l]);
      smallest = std::min(smallest, combined[l]);
    }
    float sum = 0.f;
    for (int l = 0; l <= LightLevels; ++l)
    {
      weights[l] = Square(Square(smallest / combined[l]));
      sum += weights[l];
    }
    SitePatch<N>& result = this->Grid.Patches[p];
    result = SitePatch<N>();
    result.Mean = patch.Mean;
    result.AloneWeight = weights[0] / sum;
    result.SquaredError = result.AloneWeight * errors[0];
    float shared = result.AloneWeight * Square(combined[0]);
    std::uint32_t parent = p;
    for (int l = 1; l <= LightLevels; ++l)
    {
      const Level& level = this->All[l - 1];
      const ModelBlend blend(level, parent, cell);
      const float weight = 0.5f * weights[l] / sum;
      result.SquaredError += 2.f * weight * errors[l];
      shared += 2.f * weight * Square(combined[l]) *
        std::min(SharedBlocks * Square<float>(level.Side), float(LightTileSide * LightTileSide));
      result.Value += weight * (estimates.Values[l - 1][0] + estimates.Values[l - 1][1]);
      for (int k = 0; k < blend.Count; ++k)
      {
        const Model& model = level.Models[blend.Patches[k]];
        for (int i = 0; i < LightFeatures::Count; ++i)
        {
          result.Slopes[i] += weight * blend.Weights[k] * (model.Slopes[0][i] + model.Slopes[1][i]);
        }
      }
      parent = l < LightLevels ? level.Parents[parent] : parent;
    }
    result.SharedPixels = shared / Square(LightTerms<N>::Combine(result.SquaredError));
  }

  SiteGrid<N>& Grid;
  Level All[LightLevels];
  std::vector<PatchEstimates> Estimates; ///< of patches of the first level
  std::vector<Changes> Own;              ///< of patches of BiasLevel
  std::vector<Changes> Sums;             ///< of blocks of BiasLevel
  std::vector<Changes> RowSums;
  std::vector<PatchBias<N>> Bias; ///< of patches of BiasLevel
};

template <int N>
SiteJoining<N>::SiteJoining(SiteGrid<N>& grid)
  : State(std::make_unique<Levels>(grid))
{
}

template <int N>
SiteJoining<N>::~SiteJoining() = default;

template <int N>
void SiteJoining<N>::Start()
{
  std::vector<int> tiles(this->State->GetNumberOfTiles());
  std::iota(tiles.begin(), tiles.end(), 0);
  this->State->Update(tiles);
}

template <int N>
std::vector<int> SiteJoining<N>::Update(const std::vector<int>& tiles)
{
  return this->State->Update(tiles);
}

int GetJoiningReach()
{
  // Models of adjacent blocks, each fitted in a window of three blocks; and the bias, which averages
  // changes of such models in the regions of adjacent blocks.
  return (3 << LightLevels) + ((2 + BiasRegion) << BiasLevel);
}

template <int N>
void JoinSites(SiteGrid<N>& grid)
{
  SiteJoining<N>(grid).Start();
}

template class SiteJoining<1>;
template class SiteJoining<3>;
template class SiteJoining<4>;
template void JoinSites(SiteGrid<1>&);
template void JoinSites(SiteGrid<3>&);
template void JoinSites(SiteGrid<4>&);

} // namespace penumbra
