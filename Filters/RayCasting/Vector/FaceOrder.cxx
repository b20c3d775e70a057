// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FaceOrder.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

namespace penumbra
{
namespace
{

// Side of the cells that find polygons close to each other, in pixels.
constexpr double CellSize = 16.0;
// Overlaps with a smaller area, in square pixels, do not matter.
constexpr double MinimumOverlap = 1e-3;
// Most pairs of polygons that are compared, per polygon.
constexpr std::size_t MaximumPairs = 2000;
// Rounds in which intersecting polygons are split.
constexpr int MaximumRounds = 32;

struct Box
{
  glm::ivec2 Low;
  glm::ivec2 High; ///< included
};

Box FindCells(const FacePolygon& polygon, glm::dvec2 origin)
{
  glm::dvec2 low(std::numeric_limits<double>::max());
  glm::dvec2 high(std::numeric_limits<double>::lowest());
  for (const glm::dvec2 corner : polygon.Corners)
  {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  return { glm::ivec2(glm::floor((low - origin) / CellSize)),
    glm::ivec2(glm::floor((high - origin) / CellSize)) };
}

/// Two polygons whose cells overlap.
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Finds pairs of polygons that share a cell. Returns false if there are too many.
bool FindPairs(const std::vector<FacePolygon>& polygons, std::vector<Pair>& pairs)
{
  glm::dvec2 low(std::numeric_limits<double>::max());
  glm::dvec2 high(std::numeric_limits<double>::lowest());
  for (const FacePolygon& polygon : polygons)
  {
    for (const glm::dvec2 corner : polygon.Corners)
    {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }
  if (polygons.empty())
  {
    return true;
  }
  const glm::ivec2 cells = glm::ivec2(glm::floor((high - low) / CellSize)) + 1;
  std::vector<std::vector<std::uint32_t>> bins(static_cast<std::size_t>(cells.x) * cells.y);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < polygons.size(); ++i)
  {
    boxes.push_back(FindCells(polygons[i], low));
    for (int y = boxes[i].Low.y; y <= boxes[i].High.y; ++y)
    {
      for (int x = boxes[i].Low.x; x <= boxes[i].High.x; ++x)
      {
        bins[static_cast<std::size_t>(y) * cells.x + x].push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
  pairs.clear();
  for (int y = 0; y < cells.y; ++y)
  {
    for (int x = 0; x < cells.x; ++x)
    {
      const std::vector<std::uint32_t>& bin = bins[static_cast<std::size_t>(y) * cells.x + x];
      for (std::size_t i = 0; i < bin.size(); ++i)
      {
        for (std::size_t j = i + 1; j < bin.size(); ++j)
        {
          // Counts each pair once, in the first cell that both touch.
          const glm::ivec2 first = glm::max(boxes[bin[i]].Low, boxes[bin[j]].Low);
          if (first == glm::ivec2(x, y) && polygons[bin[i]].Face != polygons[bin[j]].Face)
          {
            pairs.emplace_back(bin[i], bin[j]);
          }
        }
      }
      if (pairs.size() > MaximumPairs * polygons.size())
      {
        return false;
      }
    }
  }
  return true;
}

std::vector<glm::dvec2> Intersect(const FacePolygon& a, const FacePolygon& b)
{
  std::vector<glm::dvec2> overlap = a.Corners;
  for (std::size_t i = 0; i < b.Corners.size() && overlap.size() > 2; ++i)
  {
    const glm::dvec2 from = b.Corners[i];
    const glm::dvec2 step = b.Corners[(i + 1) % b.Corners.size()] - from;
    overlap = ClipPolygon(overlap, { from.x * step.y - from.y * step.x, -step.y, step.x });
  }
  return overlap;
}

enum class Relations
{
  Apart,
  FirstBehind,
  SecondBehind,
  Intersecting
};

Relations Compare(const FacePolygon& a, const FacePolygon& b)
{
  const std::vector<glm::dvec2> overlap = Intersect(a, b);
  if (overlap.size() < 3 || ComputeArea(overlap) < MinimumOverlap)
  {
    return Relations::Apart;
  }
  const glm::dvec3 difference = a.Nearness - b.Nearness;
  const double aNearer = ComputeArea(ClipPolygon(overlap, difference));
  const double bNearer = ComputeArea(ClipPolygon(overlap, -difference));
  if (std::min(aNearer, bNearer) >= MinimumOverlap &&
    aNearer + bNearer < 1.5 * ComputeArea(overlap))
  {
    return Relations::Intersecting;
  }
  return aNearer < bNearer ? Relations::FirstBehind : Relations::SecondBehind;
}

/// Splits polygon `index` where `plane` changes its sign.
void Split(std::size_t index, glm::dvec3 plane, std::vector<FacePolygon>& polygons)
{
  FacePolygon other = polygons[index];
  other.Corners = ClipPolygon(other.Corners, -plane);
  std::vector<glm::dvec2> rest = ClipPolygon(polygons[index].Corners, plane);
  if (rest.size() > 2 && other.Corners.size() > 2)
  {
    polygons[index].Corners = std::move(rest);
    polygons[index].Planes.push_back(plane);
    other.Planes.push_back(-plane);
    polygons.push_back(std::move(other));
  }
}

/// Draws the farthest polygon that nothing remaining is behind. Returns false at a cycle.
bool SortByRelations(
  const std::vector<std::vector<std::uint32_t>>& nearer, std::vector<FacePolygon>& polygons)
{
  std::vector<std::uint32_t> behind(polygons.size(), 0);
  for (const std::vector<std::uint32_t>& list : nearer)
  {
    for (const std::uint32_t j : list)
    {
      ++behind[j];
    }
  }
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> ready;
  const auto add = [&](std::uint32_t i) {
    glm::dvec2 center(0.0);
    for (const glm::dvec2 corner : polygons[i].Corners)
    {
      center += corner / static_cast<double>(polygons[i].Corners.size());
    }
    ready.emplace(polygons[i].NearnessAt(center), i);
  };
  for (std::uint32_t i = 0; i < polygons.size(); ++i)
  {
    if (behind[i] == 0)
    {
      add(i);
    }
  }
  std::vector<FacePolygon> sorted;
  sorted.reserve(polygons.size());
  while (!ready.empty())
  {
    const std::uint32_t i = ready.top().second;
    ready.pop();
    for (const std::uint32_t j : nearer[i])
    {
      if (--behind[j] == 0)
      {
        add(j);
      }
    }
    sorted.push_back(std::move(polygons[i]));
  }
  if (sorted.size() < polygons.size())
  {
    return false;
  }
  polygons = std::move(sorted);
  return true;
}

}

double ComputeArea(const std::vector<glm::dvec2>& corners)
{
  double twice = 0.0;
  for (std::size_t i = 2; i < corners.size(); ++i)
  {
    const glm::dvec2 a = corners[i - 1] - corners[0];
    const glm::dvec2 b = corners[i] - corners[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

std::vector<glm::dvec2> ClipPolygon(const std::vector<glm::dvec2>& corners, glm::dvec3 plane)
{
  std::vector<glm::dvec2> clipped;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const glm::dvec2 p = corners[i];
    const glm::dvec2 q = corners[(i + 1) % corners.size()];
    const double atP = glm::dot(plane, glm::dvec3(1.0, p.x, p.y));
    const double atQ = glm::dot(plane, glm::dvec3(1.0, q.x, q.y));
    if (atP >= 0.0)
    {
      clipped.push_back(p);
    }
    if ((atP < 0.0 && atQ > 0.0) || (atP > 0.0 && atQ < 0.0))
    {
      clipped.push_back(glm::mix(p, q, atP / (atP - atQ)));
    }
  }
  return clipped;
}

bool SortFaces(std::size_t maximum, std::vector<FacePolygon>& polygons)
{
  std::vector<Pair> pairs;
  for (int round = 0; round < MaximumRounds; ++round)
  {
    if (polygons.size() > maximum || !FindPairs(polygons, pairs))
    {
      return false;
    }
    std::vector<std::vector<std::uint32_t>> nearer(polygons.size());
    std::vector<std::pair<std::uint32_t, glm::dvec3>> splits;
    for (const auto& [i, j] : pairs)
    {
      const Relations relation = Compare(polygons[i], polygons[j]);
      if (relation == Relations::Intersecting)
      {
        const bool splitFirst =
          ComputeArea(polygons[i].Corners) <= ComputeArea(polygons[j].Corners);
        splits.emplace_back(splitFirst ? i : j, polygons[i].Nearness - polygons[j].Nearness);
      }
      else if (relation != Relations::Apart)
      {
        const bool firstBehind = relation == Relations::FirstBehind;
        nearer[firstBehind ? i : j].push_back(firstBehind ? j : i);
      }
    }
    if (splits.empty())
    {
      return SortByRelations(nearer, polygons);
    }
    // One split of a polygon per round: the next round compares its parts.
    std::vector<char> isSplit(polygons.size(), 0);
    for (const auto& [i, plane] : splits)
    {
      if (!isSplit[i])
      {
        isSplit[i] = 1;
        Split(i, plane, polygons);
      }
    }
  }
  return false;
}

}
