// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolygonRows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace penumbra
{
namespace
{

// Distance in pixels up to which corners are the same, and sides of a row on the same line.
constexpr double CornerPrecision = 1e-3;

/// A quadrilateral from its edge `Start` to its edge `End`, whose corners are on the same side in
/// the same order.
struct Step
{
  glm::dvec2 Start[2];
  glm::dvec2 End[2];
};

bool IsSame(glm::dvec2 a, glm::dvec2 b)
{
  return glm::length(a - b) <= CornerPrecision;
}

bool IsQuadrilateral(const OverlayShape& shape)
{
  return shape.Text.empty() && shape.Corners.size() == 4 && shape.Color.a == 1.f;
}

/// Returns the step of a quadrilateral that starts with the edge from corner `edge`, with its sides
/// exchanged if `exchange` is true.
Step MakeStep(const OverlayShape& shape, std::size_t edge, bool exchange)
{
  const auto corner = [&](std::size_t i) { return shape.Corners[(edge + i) % 4]; };
  return exchange ? Step{ { corner(1), corner(0) }, { corner(2), corner(3) } }
                  : Step{ { corner(0), corner(1) }, { corner(3), corner(2) } };
}

/// Returns true if `to` is on the line through `a` and `b`, beyond `b`.
bool Continues(glm::dvec2 a, glm::dvec2 b, glm::dvec2 to)
{
  const glm::dvec2 along = b - a;
  const glm::dvec2 next = to - b;
  const double length = glm::length(along) * glm::length(next);
  const double distance = std::abs(along.x * next.y - along.y * next.x);
  return length > 0.0 && glm::dot(along, next) > 0.0 &&
    distance <= CornerPrecision * std::max(glm::length(along), glm::length(next));
}

/// Finds the step of a quadrilateral that continues `last`.
bool FindNext(const Step& last, const OverlayShape& shape, Step& next)
{
  for (std::size_t edge = 0; edge < 4; ++edge)
  {
    for (const bool exchange : { false, true })
    {
      next = MakeStep(shape, edge, exchange);
      if (IsSame(last.End[0], next.Start[0]) && IsSame(last.End[1], next.Start[1]))
      {
        return Continues(last.Start[0], last.End[0], next.End[0]) &&
          Continues(last.Start[1], last.End[1], next.End[1]);
      }
    }
  }
  return false;
}

/// Returns the steps of the row that starts with the first of `count` shapes; empty if there is none.
std::vector<Step> FindRow(const OverlayShape* shapes, std::size_t count)
{
  std::vector<Step> steps;
  for (std::size_t edge = 0; edge < 4 && count > 1 && steps.size() < 2; ++edge)
  {
    if (!IsQuadrilateral(shapes[0]))
    {
      break;
    }
    steps = { MakeStep(shapes[0], edge, false) };
    Step next;
    while (steps.size() < count && IsQuadrilateral(shapes[steps.size()]) &&
      FindNext(steps.back(), shapes[steps.size()], next))
    {
      steps.push_back(next);
    }
  }
  return steps.size() < 2 ? std::vector<Step>() : steps;
}

/// Rounds the corners of a rectangle along the axes to boundaries of pixels.
void RoundRectangle(std::vector<glm::dvec2>& corners)
{
  for (std::size_t i = 0; i < 4; ++i)
  {
    const glm::dvec2 edge = corners[(i + 1) % 4] - corners[i];
    if (std::min(std::abs(edge.x), std::abs(edge.y)) > CornerPrecision)
    {
      return;
    }
  }
  // A pixel is inside if its center is, or if the center is on the lower or left edge.
  for (glm::dvec2& corner : corners)
  {
    corner = glm::ceil(corner - 0.5);
  }
}

}

void ExtendRows(std::vector<OverlayShape>& shapes)
{
  std::vector<OverlayShape> extended;
  for (std::size_t i = 0; i < shapes.size();)
  {
    const std::vector<Step> steps = FindRow(&shapes[i], shapes.size() - i);
    const std::size_t first = extended.size();
    for (std::size_t k = 0; k < steps.size(); ++k)
    {
      OverlayShape shape = shapes[i + k];
      shape.Corners = { steps[k].Start[0], steps.back().End[0], steps.back().End[1],
        steps[k].Start[1] };
      RoundRectangle(shape.Corners);
      if (extended.size() > first && extended.back().Corners == shape.Corners)
      {
        extended.pop_back();
      }
      if (!IsSame(shape.Corners[0], shape.Corners[1]))
      {
        extended.push_back(shape);
      }
    }
    if (steps.empty())
    {
      extended.push_back(shapes[i]);
    }
    i += std::max<std::size_t>(1, steps.size());
  }
  shapes = std::move(extended);
}

}
