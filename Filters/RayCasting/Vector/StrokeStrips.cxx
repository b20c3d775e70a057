// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StrokeStrips.h"

#include "FaceOrder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace penumbra
{
namespace
{

// Distance in pixels of points of a polygon that are left out from its sides.
constexpr double StraightPrecision = 0.01;
// Area in square pixels of polygons that are left out.
constexpr double SmallestArea = 1e-3;

/// Removes points between others on a straight line.
void RemoveStraight(std::vector<glm::dvec2>& points)
{
  std::vector<glm::dvec2> kept{ points.front() };
  std::size_t last = 0;
  const auto isStraight = [&](std::size_t end) {
    const glm::dvec2 step = points[end] - points[last];
    const double length = std::max(glm::length(step), 1e-9);
    for (std::size_t i = last + 1; i < end; ++i)
    {
      const glm::dvec2 offset = points[i] - points[last];
      const double along = glm::dot(offset, step) / length;
      if (std::abs(offset.x * step.y - offset.y * step.x) > StraightPrecision * length ||
        along < 0.0 || along > length)
      {
        return false;
      }
    }
    return true;
  };
  for (std::size_t i = 2; i < points.size(); ++i)
  {
    if (!isStraight(i))
    {
      last = i - 1;
      kept.push_back(points[last]);
    }
  }
  kept.push_back(points.back());
  points = std::move(kept);
}

}

StrokeStrips::StrokeStrips(glm::dvec2 from, glm::dvec2 to, glm::dvec2 across,
  std::function<glm::vec4(glm::dvec2)> sampleColor, std::vector<FigurePath>& paths)
  : From(from),
    To(to),
    Across(across),
    Length(glm::length(to - from)),
    SampleColor(std::move(sampleColor)),
    Paths(paths)
{
}

/// Adds the connected parts of columns that follow each other.
void StrokeStrips::Add(const std::vector<StrokeColumn>& columns)
{
  std::vector<Strip> strips;
  for (const StrokeColumn& column : columns)
  {
    std::vector<Strip> next;
    for (const auto& part : column.Parts)
    {
      next.emplace_back();
      const auto found = std::find_if(strips.begin(), strips.end(), [&](const Strip& strip) {
        return part.first < strip.back().Part.second && strip.back().Part.first < part.second;
      });
      if (found != strips.end())
      {
        next.back() = *found;
        strips.erase(found);
      }
      next.back().push_back({ column.T, part });
    }
    this->AddAll(strips);
    strips = std::move(next);
  }
  this->AddAll(strips);
}

void StrokeStrips::AddAll(const std::vector<Strip>& strips)
{
  for (const Strip& strip : strips)
  {
    this->AddStrip(strip);
  }
}

/// Adds polygons of one color each. Colors are sampled in pieces.
void StrokeStrips::AddStrip(const Strip& strip)
{
  std::size_t first = 0;
  glm::vec4 color(0.f);
  for (std::size_t begin = 0; begin + 1 < strip.size();)
  {
    std::size_t end = begin + 1;
    while (end + 1 < strip.size() &&
      (strip[end + 1].T - strip[begin].T) * this->Length <= StrokePieceLength)
    {
      ++end;
    }
    // A position between two sections.
    const Section& before = strip[(begin + end) / 2];
    const Section& after = strip[(begin + end) / 2 + 1];
    const double side = 0.5 * std::max(before.Part.first, after.Part.first) +
      0.5 * std::min(before.Part.second, after.Part.second);
    const glm::dvec2 position = this->At(0.5 * (before.T + after.T), side);
    const glm::vec4 next = this->SampleColor(position);
    if (begin > 0 && next != color)
    {
      this->AddPolygon(strip, first, begin, color);
      first = begin;
    }
    color = next;
    begin = end;
  }
  this->AddPolygon(strip, first, strip.size() - 1, color);
}

void StrokeStrips::AddPolygon(
  const Strip& strip, std::size_t first, std::size_t last, glm::vec4 color)
{
  Strip sections(strip.begin() + first, strip.begin() + last + 1);
  if (sections.front().T == sections.back().T)
  {
    return;
  }
  if (color.a == 1.f && last + 1 < strip.size())
  {
    const double end = strip[last].T + StrokePieceOverlap / this->Length;
    for (++last; last + 1 < strip.size() && strip[last].T < end; ++last)
    {
      sections.push_back(strip[last]);
    }
    const Section& from = sections.back();
    const Section& to = strip[last];
    const double f = to.T > end ? (end - from.T) / (to.T - from.T) : 1.0;
    sections.push_back({ glm::mix(from.T, to.T, f),
      { glm::mix(from.Part.first, to.Part.first, f),
        glm::mix(from.Part.second, to.Part.second, f) } });
  }
  FigurePath path;
  path.Color = color;
  for (const Section& section : sections)
  {
    path.Points.push_back(this->At(section.T, section.Part.first));
  }
  for (std::size_t i = sections.size(); i-- > 0;)
  {
    path.Points.push_back(this->At(sections[i].T, sections[i].Part.second));
  }
  RemoveStraight(path.Points);
  const double area = ComputeArea(path.Points);
  if (std::abs(area) < SmallestArea)
  {
    return;
  }
  if (area < 0.0)
  {
    std::reverse(path.Points.begin(), path.Points.end());
  }
  this->Paths.push_back(path);
}

}
