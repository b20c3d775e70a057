// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageDivision.h"

#include <algorithm>
#include <numeric>

namespace penumbra
{
namespace
{

/// Work of an empty tile, in primitives: its pixels are traced as well.
constexpr double WorkOfPixels = 256.0;
/// Factor by which the work of a rank may exceed the mean.
constexpr double Imbalance = 1.1;

}

ImageDivision::ImageDivision(
  glm::ivec2 size, const std::vector<std::vector<std::uint32_t>>& counts, int partsPerRank)
  : Size(size),
    Tiles(CountTiles(size)),
    Owners(static_cast<std::size_t>(Tiles.x) * Tiles.y, 0)
{
  std::vector<double> work(this->Owners.size(), WorkOfPixels);
  for (const std::vector<std::uint32_t>& ofRank : counts)
  {
    for (std::size_t tile = 0; tile < work.size(); ++tile)
    {
      work[tile] += ofRank[tile];
    }
  }
  const int ranks = static_cast<int>(counts.size());
  this->Split(glm::ivec2(0), this->Tiles, ranks == 1 ? 1 : partsPerRank * ranks, work);
  this->Assign(counts, work);
  for (const Part& part : this->Parts)
  {
    for (int y = part.Low.y; y < part.High.y; ++y)
    {
      std::fill_n(this->Owners.begin() + y * this->Tiles.x + part.Low.x, part.High.x - part.Low.x,
        part.Owner);
    }
  }
}

template <typename Value>
double ImageDivision::Sum(const Part& part, const std::vector<Value>& values) const
{
  double sum = 0.0;
  for (int y = part.Low.y; y < part.High.y; ++y)
  {
    const auto row = values.begin() + y * this->Tiles.x;
    sum = std::accumulate(row + part.Low.x, row + part.High.x, sum);
  }
  return sum;
}

// Halves the number of parts, and the work in proportion, across the longer side.
void ImageDivision::Split(
  glm::ivec2 low, glm::ivec2 high, int parts, const std::vector<double>& work)
{
  const glm::ivec2 extent = high - low;
  const int axis = extent.x >= extent.y ? 0 : 1;
  if (parts == 1 || extent[axis] == 1)
  {
    this->Parts.push_back({ low, high });
    return;
  }
  const double goal = this->Sum(Part{ low, high }, work) * (parts / 2) / parts;
  int cut = low[axis] + 1;
  glm::ivec2 end = high;
  double sum = 0.0;
  for (int at = low[axis]; at + 1 < high[axis]; ++at)
  {
    glm::ivec2 begin = low;
    begin[axis] = at;
    end[axis] = at + 1;
    const double slice = this->Sum(Part{ begin, end }, work);
    if (at > low[axis] && sum + 0.5 * slice > goal)
    {
      break;
    }
    sum += slice;
    cut = at + 1;
  }
  glm::ivec2 middle = high;
  middle[axis] = cut;
  this->Split(low, middle, parts / 2, work);
  middle = low;
  middle[axis] = cut;
  this->Split(middle, high, parts - parts / 2, work);
}

// The parts that one rank has most of come first.
void ImageDivision::Assign(
  const std::vector<std::vector<std::uint32_t>>& counts, const std::vector<double>& work)
{
  struct Choice
  {
    double Count;
    std::size_t Part;
    int Rank;
  };
  std::vector<Choice> choices;
  std::vector<double> partWork;
  for (std::size_t i = 0; i < this->Parts.size(); ++i)
  {
    partWork.push_back(this->Sum(this->Parts[i], work));
    for (int rank = 0; rank < static_cast<int>(counts.size()); ++rank)
    {
      choices.push_back({ this->Sum(this->Parts[i], counts[rank]), i, rank });
    }
  }
  std::stable_sort(choices.begin(), choices.end(),
    [](const Choice& a, const Choice& b) { return a.Count > b.Count; });
  const double limit =
    Imbalance * std::accumulate(work.begin(), work.end(), 0.0) / static_cast<double>(counts.size());
  std::vector<double> load(counts.size(), 0.0);
  std::vector<char> isAssigned(this->Parts.size(), 0);
  const auto assign = [&](std::size_t part, int rank) {
    this->Parts[part].Owner = rank;
    load[rank] += partWork[part];
    isAssigned[part] = 1;
  };
  for (const Choice& choice : choices)
  {
    if (!isAssigned[choice.Part] && choice.Count > 0.0 &&
      load[choice.Rank] + partWork[choice.Part] <= limit)
    {
      assign(choice.Part, choice.Rank);
    }
  }
  for (std::size_t part = 0; part < this->Parts.size(); ++part)
  {
    if (!isAssigned[part])
    {
      assign(part, static_cast<int>(std::min_element(load.begin(), load.end()) - load.begin()));
    }
  }
}

std::vector<RegionBounds> ImageDivision::GetRegions(int rank) const
{
  std::vector<RegionBounds> regions;
  for (const Part& part : this->Parts)
  {
    if (part.Owner == rank)
    {
      regions.push_back({ part.Low * TileSide, glm::min(part.High * TileSide, this->Size) });
    }
  }
  return regions;
}

}
