// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SiteJoining.h"

#include "Execution/ParallelFor.h"
#include "LightBias.h"
#include "LightConstants.h"
#include "LightLevel.h"
#include "Vectors.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace penumbra
{
namespace
{

/// Number of consecutive blocks whose patches are made together.
constexpr int BlocksOfRun = 32;

template <int N>
class SiteJoining
{
  using Value = typename LightTerms<N>::Value;
  using Patch = LightPatch<N>;
  using Model = LightModel<N>;
  using Level = LightLevel<N>;
  using Changes = LevelChanges<N>;

public:
  explicit SiteJoining(SiteGrid<N>& grid)
    : Grid(grid)
  {
  }

  void Run()
  {
    for (int i = 0; i < LightLevels; ++i)
    {
      Level& level = this->Levels[i];
      level.Side = 2 << i;
      level.Blocks = this->Grid.GetSize() / level.Side;
      i == 0 ? this->MakeFirstPatches() : this->MakePatches(this->Levels[i - 1], level);
      this->MatchNeighbors(level);
    }
    const auto count = static_cast<std::uint32_t>(this->Levels[0].Patches.size());
    this->FindCells();
    this->Estimates.resize(count);
    ParallelFor<std::uint32_t>(0, count, 256, [&](std::uint32_t p) { this->Evaluate(p); });
    ParallelFor(
      0, this->Levels[0].GetNumberOfBlocks(), 64, [&](int block) { this->CompareSites(block); });
    this->PoolBias();
    this->Grid.Patches.assign(count, SitePatch<N>());
    ParallelFor<std::uint32_t>(0, count, 256, [&](std::uint32_t p) { this->Combine(p); });
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
  template <typename Visit>
  void VisitPatches(Level& level, const Visit& makePatches)
  {
    const int count = level.GetNumberOfBlocks();
    std::vector<std::vector<Patch>> runs((count + BlocksOfRun - 1) / BlocksOfRun);
    level.Begin.assign(static_cast<std::size_t>(count) + 1, 0);
    ParallelFor(0, static_cast<int>(runs.size()), 1, [&](int run) {
      std::vector<Patch> patches;
      const int first = run * BlocksOfRun;
      for (int block = first; block < std::min(first + BlocksOfRun, count); ++block)
      {
        patches.clear();
        makePatches(block, patches);
        level.Begin[block + 1] = static_cast<std::uint32_t>(patches.size());
        runs[run].insert(runs[run].end(), patches.begin(), patches.end());
      }
    });
    std::partial_sum(level.Begin.begin(), level.Begin.end(), level.Begin.begin());
    level.Patches.reserve(level.Begin.back());
    for (const std::vector<Patch>& patches : runs)
    {
      level.Patches.insert(level.Patches.end(), patches.begin(), patches.end());
    }
  }

  /// Adds `part` to the patch in `patches` that it matches, or as a new one.
  /// Returns its index.
  static std::uint32_t AddPart(std::vector<Patch>& patches, const Patch& part)
  {
    for (std::uint32_t i = 0; i < patches.size(); ++i)
    {
      if (patches[i].Matches(part))
      {
        patches[i].Add(part, 1.f);
        return i;
      }
    }
    patches.push_back(part);
    return static_cast<std::uint32_t>(patches.size() - 1);
  }

  const LightPixel& GetPixel(glm::ivec2 p) const { return this->Grid.ReadPixel(p.x, p.y); }

  /// Calls visit(site, pixel) for the sites of a block of a level.
  template <typename Visit>
  void VisitSites(const Level& level, int block, const Visit& visit)
  {
    const glm::ivec2 first =
      this->Grid.Low + level.Side * glm::ivec2(block % level.Blocks.x, block / level.Blocks.x);
    for (int i = 0; i < level.Side * level.Side; ++i)
    {
      const LightPixel& pixel = this->GetPixel(first + glm::ivec2(i % level.Side, i / level.Side));
      for (std::uint32_t k = pixel.Begin; k < pixel.Begin + pixel.Sites; ++k)
      {
        visit(this->Grid.Sites[k], pixel);
      }
    }
  }

  void MakeFirstPatches()
  {
    Level& level = this->Levels[0];
    this->VisitPatches(level, [&](int block, std::vector<Patch>& patches) {
      this->VisitSites(level, block, [&](LightSite<N>& site, const LightPixel& pixel) {
        Patch part;
        part.Add(site, pixel.GetPart(site));
        site.Patch = AddPart(patches, part);
      });
    });
    for (int block = 0; block < level.GetNumberOfBlocks(); ++block)
    {
      this->VisitSites(level, block,
        [&](LightSite<N>& site, const LightPixel&) { site.Patch += level.Begin[block]; });
    }
  }

  void FindCells()
  {
    const Level& level = this->Levels[0];
    this->Cells.resize(level.Patches.size());
    for (int block = 0; block < level.GetNumberOfBlocks(); ++block)
    {
      const glm::ivec2 first(block % level.Blocks.x, block / level.Blocks.x);
      std::fill(this->Cells.begin() + level.Begin[block],
        this->Cells.begin() + level.Begin[block + 1],
        glm::u8vec2(level.Side * first % LightTileSide));
    }
  }

  void MakePatches(Level& finer, Level& level)
  {
    finer.Parents.resize(finer.Patches.size());
    const auto visitChildren = [&](int block, const auto& visit) {
      const glm::ivec2 at(block % level.Blocks.x, block / level.Blocks.x);
      for (int i = 0; i < 4; ++i)
      {
        const int child = (2 * at.y + (i >> 1)) * finer.Blocks.x + 2 * at.x + (i & 1);
        for (std::uint32_t k = finer.Begin[child]; k < finer.Begin[child + 1]; ++k)
        {
          visit(k);
        }
      }
    };
    this->VisitPatches(level, [&](int block, std::vector<Patch>& patches) {
      visitChildren(
        block, [&](std::uint32_t k) { finer.Parents[k] = AddPart(patches, finer.Patches[k]); });
    });
    for (int block = 0; block < level.GetNumberOfBlocks(); ++block)
    {
      visitChildren(block, [&](std::uint32_t k) { finer.Parents[k] += level.Begin[block]; });
    }
  }

  void MatchNeighbors(Level& level)
  {
    level.Windows.resize(level.Patches.size());
    level.Models.resize(level.Patches.size());
    ParallelFor(0, level.GetNumberOfBlocks(), 16, [&](int block) {
      const glm::ivec2 at(block % level.Blocks.x, block / level.Blocks.x);
      for (std::uint32_t p = level.Begin[block]; p < level.Begin[block + 1]; ++p)
      {
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
      }
    });
  }

  static std::uint32_t FindMatch(const Level& level, glm::ivec2 block, const Patch& patch)
  {
    std::uint32_t best = NoPatch;
    float largest = 0.f;
    if (block.x >= 0 && block.y >= 0 && block.x < level.Blocks.x && block.y < level.Blocks.y)
    {
      const int index = block.y * level.Blocks.x + block.x;
      for (std::uint32_t i = level.Begin[index]; i < level.Begin[index + 1]; ++i)
      {
        const Patch& other = level.Patches[i];
        if (patch.Matches(other) && other.Weight > largest)
        {
          largest = other.Weight;
          best = i;
        }
      }
    }
    return best;
  }

  /// Evaluates the models of all levels at the means of the patches of the first level.
  void Evaluate(std::uint32_t p)
  {
    const Patch& patch = this->Levels[0].Patches[p];
    PatchEstimates& estimates = this->Estimates[p];
    std::uint32_t parent = p;
    for (int l = 0; l < LightLevels; ++l)
    {
      const Level& level = this->Levels[l];
      const ModelBlend blend(level, parent, this->Cells[p]);
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
        estimates.Variances[0] = AloneVarianceGain * pool.GetVariance(this->Grid.SquaredRange) *
          patch.Parts / patch.Weight;
      }
      parent = l + 1 < LightLevels ? level.Parents[parent] : parent;
    }
  }

  /// Compares the sites of a block of the first level with its models. A site has an effect on its pixel, and
  /// a number of rays, in proportion to the part that it covers.
  void CompareSites(int block)
  {
    const Level& level = this->Levels[0];
    const glm::ivec2 first =
      this->Grid.Low + level.Side * glm::ivec2(block % level.Blocks.x, block / level.Blocks.x);
    for (int i = 0; i < level.Side * level.Side; ++i)
    {
      const LightPixel& pixel = this->GetPixel(first + glm::ivec2(i % level.Side, i / level.Side));
      for (std::uint32_t k = pixel.Begin; k < pixel.Begin + pixel.Sites; ++k)
      {
        const LightSite<N>& site = this->Grid.Sites[k];
        const ModelBlend blend(level, site.Patch, this->Cells[site.Patch]);
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
      p = this->Levels[l].Parents[p];
    }
    return p;
  }

  void PoolBias()
  {
    const Level& level = this->Levels[BiasLevel - 1];
    std::vector<Changes> own(level.Patches.size());
    for (std::uint32_t p = 0; p < this->Estimates.size(); ++p)
    {
      Changes& changes = own[this->FindBiasPatch(p)];
      const PatchEstimates& estimates = this->Estimates[p];
      const float parts = this->Levels[0].Patches[p].Parts;
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
    const std::vector<Changes> regions = SumRegions(level, own);
    this->Bias.resize(own.size());
    ParallelFor(0, level.GetNumberOfBlocks(), 16, [&](int block) {
      if (level.Begin[block] == level.Begin[block + 1])
      {
        return;
      }
      const PatchBias<N> region(regions[block], nullptr);
      for (std::uint32_t p = level.Begin[block]; p < level.Begin[block + 1]; ++p)
      {
        Changes sum;
        for (int i = 0; i < WindowBlocks; ++i)
        {
          const std::uint32_t other = level.Windows[p].Patches[i];
          if (other != NoPatch)
          {
            sum.Add(own[other], (i % 3 == 1 ? 1.f : 0.5f) * (i / 3 == 1 ? 1.f : 0.5f));
          }
        }
        this->Bias[p] = PatchBias<N>(sum, &region);
        this->Bias[p].Accumulate(sum);
      }
    });
  }

  /// Returns the sums over the blocks around each block, of all surfaces.
  static std::vector<Changes> SumRegions(const Level& level, const std::vector<Changes>& patches)
  {
    std::vector<Changes> sums(level.GetNumberOfBlocks());
    for (std::size_t block = 0; block < sums.size(); ++block)
    {
      for (std::uint32_t p = level.Begin[block]; p < level.Begin[block + 1]; ++p)
      {
        sums[block].Add(patches[p], 1.f);
      }
    }
    for (int axis = 0; axis < 2; ++axis)
    {
      const std::vector<Changes> single = sums;
      const int stride = axis == 0 ? 1 : level.Blocks.x;
      ParallelFor(0, level.GetNumberOfBlocks(), 64, [&](int block) {
        const int at = axis == 0 ? block % level.Blocks.x : block / level.Blocks.x;
        const int first = std::max(at - BiasRegion, 0);
        const int last = std::min(at + BiasRegion, level.Blocks[axis] - 1);
        sums[block] = Changes();
        for (int i = first; i <= last; ++i)
        {
          sums[block].Add(single[block + (i - at) * stride], 1.f);
        }
      });
    }
    return sums;
  }

  void Combine(std::uint32_t p)
  {
    const PatchEstimates& estimates = this->Estimates[p];
    const ModelBlend pool(this->Levels[BiasLevel - 1], this->FindBiasPatch(p), this->Cells[p]);
    const Patch& patch = this->Levels[0].Patches[p];
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
    result.Mean = patch.Mean;
    result.AloneWeight = weights[0] / sum;
    result.SquaredError = result.AloneWeight * errors[0];
    float shared = result.AloneWeight * Square(combined[0]);
    std::uint32_t parent = p;
    for (int l = 1; l <= LightLevels; ++l)
    {
      const Level& level = this->Levels[l - 1];
      const ModelBlend blend(level, parent, this->Cells[p]);
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
  std::vector<glm::u8vec2> Cells; ///< per patch of the first level: first cell
                                  ///< of its block, in its tile
  std::vector<PatchEstimates> Estimates;
  std::vector<PatchBias<N>> Bias;
  Level Levels[LightLevels];
};

} // namespace

int GetJoiningReach()
{
  // Models of adjacent blocks, each fitted in a window of three blocks; and the bias, which averages
  // changes of such models in the regions of adjacent blocks.
  return (3 << LightLevels) + ((2 + BiasRegion) << BiasLevel);
}

template <int N>
void JoinSites(SiteGrid<N>& grid)
{
  SiteJoining<N>(grid).Run();
}

template void JoinSites(SiteGrid<1>&);
template void JoinSites(SiteGrid<3>&);
template void JoinSites(SiteGrid<4>&);

} // namespace penumbra
