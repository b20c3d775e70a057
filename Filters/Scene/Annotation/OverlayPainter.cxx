// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OverlayPainter.h"

#include "Vectors.h"

#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace penumbra
{
namespace
{

/// Returns true if a point is in a polygon. Polygons that share an edge have no point in common.
bool IsInPolygon(const std::vector<glm::dvec2>& corners, glm::dvec2 point)
{
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
  {
    const glm::dvec2 a = corners[i];
    const glm::dvec2 b = corners[j];
    inside = (a.y > point.y) != (b.y > point.y) &&
        point.x < a.x + (point.y - a.y) * (b.x - a.x) / (b.y - a.y)
      ? !inside
      : inside;
  }
  return inside;
}

/// Calls `fill` with the lower left corner of each pixel whose center is in a polygon.
template <typename Function>
void ForEachPixel(const std::vector<glm::dvec2>& corners, const Overlay& overlay, Function&& fill)
{
  glm::dvec2 low(1e9);
  glm::dvec2 high(-1e9);
  for (const glm::dvec2& corner : corners)
  {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  low = glm::max(glm::floor(low), 0.0);
  high = glm::min(high, glm::dvec2(overlay.GetWidth(), overlay.GetHeight()));
  for (double y = low.y; y < high.y; ++y)
  {
    for (double x = low.x; x < high.x; ++x)
    {
      if (IsInPolygon(corners, { x + 0.5, y + 0.5 }))
      {
        fill(glm::dvec2(x, y));
      }
    }
  }
}

/// Returns the color at texture coordinates in [0, 1]; others are clamped.
glm::vec4 Sample(const Texture& texture, glm::dvec2 coordinates)
{
  const auto texel = [&](double x, double y) {
    const int i = std::clamp(static_cast<int>(std::floor(x)), 0, texture.Width - 1);
    const int j = std::clamp(static_cast<int>(std::floor(y)), 0, texture.Height - 1);
    return glm::vec4(texture.Texels[static_cast<std::size_t>(j) * texture.Width + i]) / 255.f;
  };
  glm::dvec2 p = glm::clamp(coordinates, 0.0, 1.0) * glm::dvec2(texture.Width, texture.Height);
  if (!texture.Interpolate)
  {
    return texel(p.x, p.y);
  }
  p -= 0.5;
  const glm::vec2 t = glm::fract(p);
  return glm::mix(glm::mix(texel(p.x, p.y), texel(p.x + 1.0, p.y), t.x),
    glm::mix(texel(p.x, p.y + 1.0), texel(p.x + 1.0, p.y + 1.0), t.x), t.y);
}

}

Texture ConvertTexels(vtkUnsignedCharArray* colors, int width, int height)
{
  Texture texture;
  const auto count = static_cast<std::size_t>(width) * height;
  const int components = colors->GetNumberOfComponents();
  if (static_cast<std::size_t>(colors->GetNumberOfTuples()) < count)
  {
    return texture;
  }
  texture.Width = width;
  texture.Height = height;
  texture.Texels.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const unsigned char* c = colors->GetPointer(static_cast<vtkIdType>(i) * components);
    const bool isGray = components < 3;
    texture.Texels[i] = { c[0], isGray ? c[0] : c[1], isGray ? c[0] : c[2],
      components % 2 == 0 ? c[components - 1] : static_cast<unsigned char>(255) };
  }
  return texture;
}

void FillPolygon(const std::vector<glm::dvec2>& corners, glm::vec4 color, Overlay& overlay)
{
  OverlayShape shape;
  shape.Corners = corners;
  shape.Color = color;
  overlay.AddShape(std::move(shape));
  ForEachPixel(
    corners, overlay, [&](glm::dvec2 pixel) { overlay.FillRectangle(pixel, pixel + 1.0, color); });
}

void FillLine(glm::dvec2 from, glm::dvec2 to, double width, glm::vec4 color, Overlay& overlay)
{
  const double length = glm::length(to - from);
  if (length > 0.0)
  {
    const glm::dvec2 along = 0.5 * width * (to - from) / length;
    const glm::dvec2 across(-along.y, along.x);
    FillPolygon(
      { from - along - across, to + along - across, to + along + across, from - along + across },
      color, overlay);
  }
}

void FillShadedPolygon(const std::vector<OverlayVertex>& corners, const Texture* texels,
  Overlay& overlay, bool isDescribed)
{
  overlay.SetDescribed(isDescribed);
  for (std::size_t i = 2; i < corners.size(); ++i)
  {
    const OverlayVertex& a = corners[0];
    const OverlayVertex& b = corners[i - 1];
    const OverlayVertex& c = corners[i];
    const double area = Cross(b.Position - a.Position, c.Position - a.Position);
    if (area == 0.0)
    {
      continue;
    }
    ForEachPixel({ a.Position, b.Position, c.Position }, overlay, [&](glm::dvec2 pixel) {
      const glm::dvec2 p = pixel + 0.5 - a.Position;
      const double u = Cross(p, c.Position - a.Position) / area;
      const double v = Cross(b.Position - a.Position, p) / area;
      const double w = 1.0 - u - v;
      glm::vec4 color = static_cast<float>(w) * a.Color + static_cast<float>(u) * b.Color +
        static_cast<float>(v) * c.Color;
      if (texels)
      {
        color *= Sample(*texels, w * a.Coordinates + u * b.Coordinates + v * c.Coordinates);
      }
      overlay.FillRectangle(pixel, pixel + 1.0, color);
    });
  }
  overlay.SetDescribed(true);
}

}
