// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartShapes.h"

#include "vtkPen.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace penumbra
{
namespace
{

/// Segments of a full ellipse.
constexpr int EllipseSegments = 72;

/// Values of the shapes of vtkContext2D::DrawMarkers(), whose enumeration VTK moved to a private header.
enum class Markers
{
  CROSS = 1,
  PLUS,
  SQUARE,
  CIRCLE,
  DIAMOND
};

/// Returns the stipples of a line type of vtkPen, those of vtkOpenGLContextDevice2D: a bit per pixel.
std::uint16_t FindStipples(int type)
{
  switch (type)
  {
    case vtkPen::NO_PEN:
      return 0x0000;
    case vtkPen::DASH_LINE:
      return 0x00FF;
    case vtkPen::DOT_LINE:
      return 0x0101;
    case vtkPen::DASH_DOT_LINE:
      return 0x0C0F;
    case vtkPen::DASH_DOT_DOT_LINE:
      return 0x1C47;
    default:
      return 0xFFFF;
  }
}

/// Returns the part of a polygon on one side of an axis-aligned line.
std::vector<OverlayVertex> ClipHalf(
  const std::vector<OverlayVertex>& corners, int axis, double limit, double sign)
{
  std::vector<OverlayVertex> result;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const OverlayVertex& a = corners[i];
    const OverlayVertex& b = corners[(i + 1) % corners.size()];
    const double da = sign * (a.Position[axis] - limit);
    const double db = sign * (b.Position[axis] - limit);
    if (da >= 0.0)
    {
      result.push_back(a);
    }
    if ((da >= 0.0) != (db >= 0.0))
    {
      const double t = da / (da - db);
      result.push_back(
        { glm::mix(a.Position, b.Position, t), glm::mix(a.Color, b.Color, static_cast<float>(t)),
          glm::mix(a.Coordinates, b.Coordinates, t) });
    }
  }
  return result;
}

/// Longer lines have no dashes, in stipples: most of them is outside the image.
constexpr double MaximumStipples = 1e5;

/// Returns a line as a rectangle that exceeds its ends by `more`.
std::vector<OverlayVertex> MakeSegment(
  glm::dvec2 from, glm::dvec2 to, double more, double width, glm::vec4 color)
{
  const glm::dvec2 along = (to - from) / glm::length(to - from);
  const glm::dvec2 across = 0.5 * width * glm::dvec2(-along.y, along.x);
  from -= more * along;
  to += more * along;
  return { { from - across, color }, { to - across, color }, { to + across, color },
    { from + across, color } };
}

}

std::vector<OverlayVertex> Clip(std::vector<OverlayVertex> corners, glm::dvec2 low, glm::dvec2 high)
{
  for (int axis = 0; axis < 2; ++axis)
  {
    corners = ClipHalf(corners, axis, low[axis], 1.0);
    corners = ClipHalf(corners, axis, high[axis], -1.0);
  }
  return corners;
}

void StretchTexture(std::vector<OverlayVertex>& corners)
{
  glm::dvec2 low(corners.empty() ? glm::dvec2(0.0) : corners.front().Position);
  glm::dvec2 high(low);
  for (const OverlayVertex& corner : corners)
  {
    low = glm::min(low, corner.Position);
    high = glm::max(high, corner.Position);
  }
  for (OverlayVertex& corner : corners)
  {
    corner.Color = glm::vec4(1.f);
    corner.Coordinates = (corner.Position - low) / glm::max(high - low, glm::dvec2(1e-9));
  }
}

std::vector<glm::dvec2> MakeEllipticArc(
  glm::dvec2 center, glm::dvec2 radii, double startAngle, double stopAngle)
{
  const int count =
    std::max(1, static_cast<int>(EllipseSegments * std::abs(stopAngle - startAngle) / 360.0));
  std::vector<glm::dvec2> points;
  for (int i = 0; i <= count; ++i)
  {
    const double angle = glm::radians(startAngle + i * (stopAngle - startAngle) / count);
    points.push_back(center + radii * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

std::vector<std::vector<OverlayVertex>> MakeMarker(
  int shape, glm::dvec2 center, double half, double thickness, glm::vec4 color)
{
  const auto at = [&](double x, double y) {
    return OverlayVertex{ center + half * glm::dvec2(x, y), color };
  };
  const auto line = [&](const OverlayVertex& from, const OverlayVertex& to) {
    return MakeSegment(from.Position, to.Position, 0.0, thickness, color);
  };
  switch (static_cast<Markers>(shape))
  {
    case Markers::CROSS:
      return { line(at(-1.0, -1.0), at(1.0, 1.0)), line(at(-1.0, 1.0), at(1.0, -1.0)) };
    case Markers::PLUS:
      return { line(at(-1.0, 0.0), at(1.0, 0.0)), line(at(0.0, -1.0), at(0.0, 1.0)) };
    case Markers::SQUARE:
      return { { at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0) } };
    case Markers::CIRCLE:
    {
      std::vector<OverlayVertex> corners;
      for (const glm::dvec2& point : MakeEllipticArc(center, glm::dvec2(half), 0.0, 360.0))
      {
        corners.push_back({ point, color });
      }
      return { corners };
    }
    case Markers::DIAMOND:
      return { { at(-1.0, 0.0), at(0.0, -1.0), at(1.0, 0.0), at(0.0, 1.0) } };
  }
  return {};
}

std::vector<std::vector<OverlayVertex>> MakeDashes(glm::dvec2 from, glm::dvec2 to, double width,
  int type, double unit, glm::vec4 color, double& length)
{
  const std::uint16_t stipples = FindStipples(type);
  const double total = glm::length(to - from);
  if (stipples == 0 || !(total > 0.0))
  {
    return {};
  }
  if (stipples == 0xFFFF || !(length + total < MaximumStipples * unit))
  {
    return { MakeSegment(from, to, 0.5 * width, width, color) };
  }
  const glm::dvec2 along = (to - from) / total;
  const auto bit = [&](double x) {
    return (stipples >> (static_cast<int>((length + x) / unit) % 16)) & 1;
  };
  std::vector<std::vector<OverlayVertex>> dashes;
  for (double at = 0.0; at < total;)
  {
    const int isDrawn = bit(at);
    double end = at;
    while (end < total && bit(end) == isDrawn)
    {
      end += unit;
    }
    end = std::min(end, total);
    if (isDrawn)
    {
      dashes.push_back(MakeSegment(from + at * along, from + end * along, 0.0, width, color));
    }
    at = end;
  }
  length += total;
  return dashes;
}

}
