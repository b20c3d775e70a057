// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Baking.h"

#include <atomic>
#include <cstdint>
#include <tuple>

namespace penumbra
{
namespace
{

/// Squares of a level are half as wide as those of the level before, from so many spacings on down
/// to about one.
constexpr float CoarsestSquare = 32.f;
constexpr int Levels = 6;

/// A record costs about as much as two answers of brute force (it needs the nearest hit, and more
/// rays for its derivatives). A level whose records do not serve so many sites each is the last.
constexpr double LeastServed = 2.5;

/// Shares of the progress.
constexpr double ProgressOfRecords = 0.5;

/// Which sites still need a record, one of each square of space and each octant of normals: the one
/// nearest to the middle.
class Squares
{
public:
  explicit Squares(const std::vector<Site>& sites)
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
        { Key(low, this->Sites[index].Normal), glm::distance(at, low + .5f), index });
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
  static std::uint64_t Key(glm::vec3 low, glm::vec3 normal)
  {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      key = key << 20 | static_cast<std::uint64_t>(glm::clamp(low[axis], 0.f, 1048575.f));
      key = key << 1 | static_cast<std::uint64_t>(normal[axis] < 0.f);
    }
    return key;
  }

  const std::vector<Site>& Sites;
};

/// Those of `from` that no record covers; counts those that one serves.
std::vector<std::size_t> Uncovered(
  const std::vector<Site>& sites, const RecordTree& tree, const std::vector<std::size_t>& from)
{
  std::vector<char> covered(from.size());
  vtkSMPTools::For(0, static_cast<vtkIdType>(from.size()), [&](vtkIdType begin, vtkIdType end) {
    for (vtkIdType i = begin; i < end; ++i)
    {
      covered[i] = Placement::IsCovered(tree, sites[from[i]]);
    }
  });
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

/// Records from coarse to fine; false when stopped.
bool PlaceRecords(const std::vector<Site>& sites, float spacing, Placement& places,
  const RecordTree& tree, const ProgressCallback& progress)
{
  std::vector<std::size_t> left(sites.size());
  for (std::size_t i = 0; i < left.size(); ++i)
  {
    left[i] = i;
  }
  const Squares squares(sites);
  float width = CoarsestSquare * spacing;
  for (int level = 0; level < Levels && !left.empty(); ++level, width *= .5f)
  {
    std::vector<Site> chosen;
    for (const std::size_t index : squares.Choose(left, width))
    {
      chosen.push_back(sites[index]);
    }
    const std::size_t idle = places.GetIdle();
    const auto step = [&](double share) {
      return progress && progress(ProgressOfRecords * (level + share) / Levels);
    };
    if (!places.AddLevel(chosen, step))
    {
      return false;
    }
    const std::size_t before = left.size();
    left = Uncovered(sites, tree, left);
    const auto made = static_cast<double>(chosen.size());
    const double serving = 1.0 - static_cast<double>(places.GetIdle() - idle) / made;
    if (static_cast<double>(before - left.size()) * serving < LeastServed * made)
    {
      break;
    }
  }
  return true;
}

}

bool Bake(const std::vector<Site>& sites, float spacing, bool records, Placement& places,
  const RecordTree& tree, const BruteForceAnswer& bruteForce, const ProgressCallback& progress,
  BakedValues& result)
{
  result.Values.resize(sites.size());
  if (records && !PlaceRecords(sites, spacing, places, tree, progress))
  {
    return false;
  }
  std::atomic<long long> rays(0);
  std::atomic<std::size_t> interpolated(0);
  std::atomic<std::size_t> asked(0);
  const bool done = InBatches(
    static_cast<int>(sites.size()), records ? ProgressOfRecords : 0.0, 1.0, progress, [&](int i) {
      const Interpolated found = tree.LookUp(sites[i]);
      if (found.Found())
      {
        result.Values[i] = { found.Mean, found.Error };
        ++interpolated;
        return;
      }
      const Record* here = tree.FindAt(sites[i]);
      if (here)
      {
        result.Values[i] = { here->Found.Mean, here->Found.Error };
        return;
      }
      long long own = 0;
      result.Values[i] = bruteForce(sites[i], own);
      rays += own;
      ++asked;
    });
  result.Interpolated = interpolated;
  result.BruteForce = asked;
  result.BruteForceRays = rays;
  return done;
}

}
