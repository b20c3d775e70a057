// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Baking.h"

#include "Execution/ParallelFor.h"
#include "Gathering/IrradianceConstants.h"
#include "LocalRegression.h"
#include "Obstacles.h"
#include "Shading/HemisphereSampling.h"

#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace penumbra
{
namespace
{

/// Chooses record candidates: for each grid cell and octant of normals, the point nearest to the
/// center of the cell.
class CandidateGrid
{
public:
  explicit CandidateGrid(const std::vector<RecordCandidate>& sites)
    : Sites(sites)
  {
  }

  std::vector<std::size_t> Choose(const std::vector<std::size_t>& from, float width) const
  {
    struct Candidate
    {
      std::uint64_t Square;
      float Distance;
      std::size_t Index;
      bool operator<(const Candidate& other) const
      {
        return std::tie(this->Square, this->Distance, this->Index) <
          std::tie(other.Square, other.Distance, other.Index);
      }
    };
    std::vector<Candidate> candidates;
    for (const std::size_t index : from)
    {
      // Positions are within 1 of the origin.
      const glm::vec3 at = (this->Sites[index].Position + 1.f) / width;
      const glm::vec3 low = glm::floor(at);
      candidates.push_back(
        { ComputeKey(low, this->Sites[index].Normal), glm::distance(at, low + .5f), index });
    }
    std::sort(candidates.begin(), candidates.end());
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      if (i == 0 || candidates[i].Square != candidates[i - 1].Square)
      {
        chosen.push_back(candidates[i].Index);
      }
    }
    return chosen;
  }

private:
  static std::uint64_t ComputeKey(glm::vec3 low, glm::vec3 normal)
  {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      key = key << 20 | static_cast<std::uint64_t>(glm::clamp(low[axis], 0.f, 1048575.f));
      key = key << 1 | static_cast<std::uint64_t>(normal[axis] < 0.f);
    }
    return key;
  }

  const std::vector<RecordCandidate>& Sites;
};

/// Runs work(i) for `count` points at constant progress; throws Stopped if a stop is requested.
template <typename Work>
void ForEach(std::size_t count, double fraction, const ProgressCallback& progress, const Work& work)
{
  if (!ParallelForWithProgress(static_cast<int>(count), fraction, fraction, progress, work, 0))
  {
    throw Stopped();
  }
}

/// Returns the points of `from` that no record covers.
std::vector<std::size_t> FindUncovered(const std::vector<RecordCandidate>& sites,
  const RecordPlacement& placement, const std::vector<std::size_t>& from,
  const ProgressCallback& progress)
{
  std::vector<char> covered(from.size());
  ForEach(
    from.size(), 1.0, progress, [&](int i) { covered[i] = placement.IsCovered(sites[from[i]]); });
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    if (!covered[i])
    {
      left.push_back(from[i]);
    }
  }
  return left;
}

/// Returns the points of `which` in patches of at least MinimumPatchPoints, and the others.
std::pair<std::vector<std::size_t>, std::vector<std::size_t>> SplitByPatch(
  const std::vector<RecordCandidate>& sites, const std::vector<std::size_t>& which)
{
  std::unordered_map<std::uint32_t, std::size_t> counts;
  for (const RecordCandidate& site : sites)
  {
    ++counts[site.Patch];
  }
  std::pair<std::vector<std::size_t>, std::vector<std::size_t>> parts;
  for (const std::size_t index : which)
  {
    const bool isLarge = counts[sites[index].Patch] >= MinimumPatchPoints;
    (isLarge ? parts.first : parts.second).push_back(index);
  }
  return parts;
}

/// Returns the candidates `chosen` with the distances of their obstacles, without those that are too
/// near to one.
std::vector<RecordCandidate> FindObstacles(const std::vector<RecordCandidate>& sites,
  const std::vector<std::size_t>& chosen, const Obstacles& obstacles,
  const RecordPlacement& placement, const ProgressCallback& progress)
{
  std::vector<RecordCandidate> found(chosen.size());
  ForEach(chosen.size(), 0.0, progress, [&](int i) {
    RecordCandidate& site = found[i];
    site = sites[chosen[i]];
    site.ObstacleDistance =
      obstacles.FindDistance(site, site.MaximumRadius / ObstacleRadiusFraction);
  });
  found.erase(std::remove_if(found.begin(), found.end(),
                [&](const RecordCandidate& site) {
                  return SeenObstacleFraction * site.ObstacleDistance <
                    placement.GetMinimumRadius(site);
                }),
    found.end());
  return found;
}

/// Places records from coarse to fine. Returns false if stopped.
bool PlaceRecords(const BakeInput& mesh, const Obstacles& obstacles, double minimumCovered,
  RecordPlacement& placement, const ProgressCallback& progress)
{
  const std::vector<RecordCandidate>& sites = mesh.Sites;
  std::vector<std::size_t> left(sites.size());
  std::iota(left.begin(), left.end(), std::size_t(0));
  left = SplitByPatch(sites, left).first;
  const CandidateGrid squares(sites);
  float width = CoarsestCellWidth * mesh.Spacing;
  for (int level = 0; level < BakingLevels && !left.empty(); ++level, width *= .5f)
  {
    const std::size_t invalid = placement.GetNumberOfInvalidRecords();
    const auto step = [&](double fraction) {
      return progress && progress(RecordProgress * (level + fraction) / BakingLevels);
    };
    const std::vector<RecordCandidate> chosen =
      FindObstacles(sites, squares.Choose(left, width), obstacles, placement, step);
    if (!placement.AddLevel(chosen, step))
    {
      return false;
    }
    const std::size_t before = left.size();
    left = FindUncovered(sites, placement, left, step);
    const auto made = static_cast<double>(std::max<std::size_t>(chosen.size(), 1));
    const double serving =
      1.0 - static_cast<double>(placement.GetNumberOfInvalidRecords() - invalid) / made;
    if (!chosen.empty() &&
      static_cast<double>(before - left.size()) * serving < minimumCovered * made)
    {
      break;
    }
  }
  return true;
}

/// Sets the values of points that can be interpolated or that have a record. Returns the other
/// points.
std::vector<std::size_t> Interpolate(const std::vector<RecordCandidate>& sites,
  const RecordOctree& tree, float minimumWeight, double fraction, const ProgressCallback& progress,
  BakedValues& result)
{
  std::vector<char> unresolved(sites.size());
  ForEach(sites.size(), fraction, progress, [&](int i) {
    // Records of less weight do not cover the point: it is at the very end of their radius.
    const InterpolationResult found = tree.LookUp(sites[i]);
    const bool isCovered = found.MaximumWeight > minimumWeight;
    const Record* here = isCovered ? nullptr : tree.FindAt(sites[i]);
    if (isCovered)
    {
      result.Values[i] = { found.Mean, found.Error };
    }
    else if (here)
    {
      result.Values[i] = { here->Gathered.Mean, here->Gathered.Error };
    }
    unresolved[i] = !isCovered && !here;
  });
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    if (unresolved[i])
    {
      left.push_back(i);
    }
  }
  return left;
}

/// Computes values at points without records.
struct PointEvaluator
{
  const std::vector<RecordCandidate>& Sites;
  const PointEstimators& Estimators;
  BakedValues& Result;

  bool EvaluateByBruteForce(
    const std::vector<std::size_t>& which, double begin, const ProgressCallback& progress)
  {
    for (const std::size_t index : which)
    {
      this->Result.Methods[index] = BakingMethod::BruteForce;
    }
    return this->Evaluate(this->Estimators.BruteForce, which, begin, 1.0, progress);
  }

  /// Computes low-sample estimates and denoises them. Points with too large an error are returned
  /// in `uncertain`. If denoising fails for most points of a trial subset, all points are returned.
  bool EvaluateWithDenoising(const std::vector<std::size_t>& which, float spacing, double begin,
    double end, const ProgressCallback& progress, std::vector<std::size_t>& uncertain)
  {
    std::vector<std::size_t> trial;
    std::vector<std::size_t> rest;
    for (const std::size_t index : which)
    {
      (IsInTrial(this->Sites[index], spacing) ? trial : rest).push_back(index);
    }
    const double midProgress = begin + (end - begin) / TrialInterval;
    std::vector<NoisyEstimate> estimates(this->Sites.size());
    if (!this->Evaluate(this->Estimators.LowSample, trial, begin, midProgress, progress))
    {
      return false;
    }
    const std::size_t denoised =
      this->Denoise(trial, spacing, midProgress, progress, estimates, nullptr);
    if (static_cast<double>(denoised) < MinimumDenoisedFraction * static_cast<double>(trial.size()))
    {
      uncertain = which;
      return true;
    }
    if (!this->Evaluate(this->Estimators.LowSample, rest, midProgress, end, progress))
    {
      return false;
    }
    this->Denoise(which, spacing, end, progress, estimates, &uncertain);
    return true;
  }

private:
  static bool IsInTrial(const RecordCandidate& site, float spacing)
  {
    const glm::vec3 square = glm::floor(site.Position / (TrialCellWidth * spacing));
    return HashPoint(square, glm::vec3(0.f)) % TrialInterval == 0;
  }

  bool Evaluate(const PointEstimator& estimator, const std::vector<std::size_t>& which,
    double begin, double end, const ProgressCallback& progress)
  {
    std::atomic<long long> rays(0);
    const bool done =
      ParallelForWithProgress(static_cast<int>(which.size()), begin, end, progress, [&](int i) {
        long long count = 0;
        this->Result.Values[which[i]] = estimator(this->Sites[which[i]], count);
        rays += count;
      });
    this->Result.BruteForceRays += rays;
    return done;
  }

  /// Returns the number of values that can be denoised: those with the smallest errors, as many as
  /// keep the RMS error within LowSampleError. If `uncertain` is not null, sets these values and
  /// appends the other points to `uncertain`.
  std::size_t Denoise(const std::vector<std::size_t>& which, float spacing, double fraction,
    const ProgressCallback& progress, std::vector<NoisyEstimate>& estimates,
    std::vector<std::size_t>* uncertain)
  {
    for (const std::size_t index : which)
    {
      const BakedValue& value = this->Result.Values[index];
      estimates[index] = { value.Mean.x, value.Error };
    }
    const LocalRegression neighbors(this->Sites, which, spacing, this->Estimators.RegressionRadius);
    std::vector<NoisyEstimate> fitted(which.size());
    ForEach(which.size(), fraction, progress, [&](int i) {
      const NoisyEstimate& estimate = estimates[which[i]];
      fitted[i] = neighbors.Fit(which[i], estimates);
      // Keep estimates of exactly 0 or 1, so that unoccluded points stay at 0.
      const bool agree = estimate.Mean == 0.f || estimate.Mean == 1.f;
      const float allowed = agree ? AgreeingErrorFactor * this->Estimators.LowSampleError
                                  : OutlierFactor * estimate.Error;
      if (std::abs(fitted[i].Mean - estimate.Mean) > allowed)
      {
        fitted[i].Error = std::numeric_limits<float>::infinity();
      }
      else if (agree && std::isfinite(fitted[i].Error))
      {
        fitted[i] = estimate;
      }
    });
    const float limit = std::min(ComputeErrorLimit(fitted, this->Estimators.LowSampleError),
      MaximumDenoisedError * this->Estimators.LowSampleError);
    std::size_t certain = 0;
    for (std::size_t i = 0; i < which.size(); ++i)
    {
      const bool isCertain = fitted[i].Error <= limit;
      certain += isCertain ? 1 : 0;
      if (isCertain && uncertain)
      {
        this->Result.Values[which[i]] = { glm::vec3(fitted[i].Mean), fitted[i].Error };
        this->Result.Methods[which[i]] = BakingMethod::Denoised;
      }
      else if (uncertain)
      {
        uncertain->push_back(which[i]);
      }
    }
    return certain;
  }

  /// Returns the maximum error for which the RMS of all errors up to it is at most `allowed`.
  static float ComputeErrorLimit(const std::vector<NoisyEstimate>& values, float allowed)
  {
    std::vector<float> errors;
    for (const NoisyEstimate& value : values)
    {
      if (std::isfinite(value.Error))
      {
        errors.push_back(value.Error);
      }
    }
    std::sort(errors.begin(), errors.end());
    double sum = 0.0;
    double count = 0.0;
    float limit = 0.f;
    for (const float error : errors)
    {
      sum += static_cast<double>(error) * error;
      count += 1.0;
      if (sum > count * allowed * allowed)
      {
        break;
      }
      limit = error;
    }
    return limit;
  }
};

}

bool Bake(const BakeInput& mesh, const RayScene& rays, bool records, RecordPlacement& placement,
  const RecordOctree& tree, const PointEstimators& estimators, const ProgressCallback& progress,
  BakedValues& result)
{
  const std::vector<RecordCandidate>& sites = mesh.Sites;
  result.Values.resize(sites.size());
  result.Methods.assign(sites.size(), BakingMethod::Interpolated);
  const bool denoises = records && estimators.LowSample;
  if (records &&
    !PlaceRecords(mesh, Obstacles(mesh, rays),
      denoises ? MinimumCoveredPointsDenoised : MinimumCoveredPoints, placement, progress))
  {
    return false;
  }
  const double begin = records ? RecordProgress : 0.0;
  const std::vector<std::size_t> left =
    Interpolate(sites, tree, placement.GetCoverageWeight(), begin, progress, result);
  PointEvaluator evaluator{ sites, estimators, result };
  if (!denoises)
  {
    return evaluator.EvaluateByBruteForce(left, begin, progress);
  }
  const auto midProgress = begin + .5 * (1.0 - begin);
  const auto [large, small] = SplitByPatch(sites, left);
  std::vector<std::size_t> uncertain;
  if (!evaluator.EvaluateWithDenoising(
        large, mesh.Spacing, begin, midProgress, progress, uncertain))
  {
    return false;
  }
  uncertain.insert(uncertain.end(), small.begin(), small.end());
  return evaluator.EvaluateByBruteForce(uncertain, midProgress, progress);
}

}
