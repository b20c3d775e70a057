// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TexelIntegral.h"

#include "LayerSampler.h"
#include "Pixels/CoverageConstants.h"
#include "Surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace penumbra
{

namespace
{

/// Number of texels in a pixel above which samples take less time.
constexpr int MaximumTexels = 1024;
/// Texel coordinates above this value have lost too much precision.
constexpr double LargestTexel = 1e6;

/// A convex polygon in coordinates of the pixel. Each side that cuts it adds a point.
struct Polygon
{
  std::array<glm::dvec2, 24> Points;
  std::size_t Count = 0;
};

/// A value that is linear in the pixel, as a function of (1, x, y).
using Linear = glm::dvec3;

double Evaluate(const Linear& f, glm::dvec2 p)
{
  return f.x + f.y * p.x + f.z * p.y;
}

/// Divides a polygon into the parts where a value is negative and where it is positive.
void Split(const Polygon& polygon, const Linear& f, Polygon& negative, Polygon& positive)
{
  negative.Count = positive.Count = 0;
  const auto add = [](Polygon& part, glm::dvec2 p) {
    if (part.Count < part.Points.size())
    {
      part.Points[part.Count++] = p;
    }
  };
  for (std::size_t i = 0; i < polygon.Count; ++i)
  {
    const glm::dvec2 p = polygon.Points[i];
    const glm::dvec2 q = polygon.Points[i + 1 < polygon.Count ? i + 1 : 0];
    const double a = Evaluate(f, p);
    const double b = Evaluate(f, q);
    add(a < 0.0 ? negative : positive, p);
    if ((a < 0.0) != (b < 0.0))
    {
      const glm::dvec2 crossing = p + a / (a - b) * (q - p);
      add(negative, crossing);
      add(positive, crossing);
    }
  }
}

/// Returns the area of a polygon and its center.
double ComputeArea(const Polygon& polygon, glm::dvec2& center)
{
  double area = 0.0;
  glm::dvec2 sum(0.0);
  for (std::size_t i = 2; i < polygon.Count; ++i)
  {
    const glm::dvec2 u = polygon.Points[i - 1] - polygon.Points[0];
    const glm::dvec2 v = polygon.Points[i] - polygon.Points[0];
    const double part = 0.5 * (u.x * v.y - u.y * v.x);
    area += part;
    sum += part / 3.0 * (u + v);
  }
  center = area > 0.0 ? polygon.Points[0] + sum / area : glm::dvec2(0.5);
  return area;
}

/// Divides a polygon at the integers of the value `numerator` / `denominator` and calls
/// visit(integer, part). Returns false if there are too many or visit() returned false.
template <typename Visit>
bool VisitParts(
  Polygon rest, const Linear& numerator, const Linear& denominator, const Visit& visit)
{
  double low = LargestTexel;
  double high = -LargestTexel;
  for (std::size_t i = 0; i < rest.Count; ++i)
  {
    const double value =
      Evaluate(numerator, rest.Points[i]) / Evaluate(denominator, rest.Points[i]);
    if (!(std::abs(value) < LargestTexel))
    {
      return false;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const auto first = static_cast<int>(std::floor(low));
  const auto last = static_cast<int>(std::floor(high));
  if (last - first >= MaximumTexels)
  {
    return false;
  }
  Polygon part;
  for (int i = first; i < last; ++i)
  {
    Polygon next;
    Split(rest, numerator - (i + 1.0) * denominator, part, next);
    if (part.Count > 2 && !visit(i, part))
    {
      return false;
    }
    rest = next;
  }
  return rest.Count <= 2 || visit(last, rest);
}

}

std::optional<PixelResult> IntegrateTexels(PixelContext& context, const TileRasterizer& rasterizer)
{
  if (!rasterizer.IsTextured())
  {
    return std::nullopt;
  }
  SampledPixel pixel;
  pixel.X = context.Position.x;
  pixel.Y = context.Position.y;
  PixelLayerColor color;
  color.Id = rasterizer.GetLayer(0);
  color.Of = &context.GetSurfaces()[color.Id.Surface];
  ShadePartOfLayer(context, rasterizer, 0, pixel, color);
  const PixelTexture& found = pixel.Textures[color.Texture];
  const Texture& texture = *found.Image;
  if (texture.Interpolate)
  {
    return std::nullopt;
  }
  const glm::dvec2 size(texture.Width, texture.Height);
  const auto getLinear = [&](int component) {
    return Linear(found.Coordinates.Value[component], found.Coordinates.SlopeX[component],
      found.Coordinates.SlopeY[component]);
  };
  const Linear column = size.x * getLinear(0);
  const Linear row = size.y * getLinear(1);
  const Linear weight = getLinear(2);
  const Polygon square{ { { { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } } }, 4 };
  int texels = 0;
  double covered = 0.0;
  glm::dvec4 sum(0.0);
  const bool isComplete = std::all_of(square.Points.begin(), square.Points.begin() + 4,
                            [&](glm::dvec2 p) { return Evaluate(weight, p) > 0.0; }) &&
    VisitParts(square, row, weight, [&](int j, const Polygon& strip) {
      return VisitParts(strip, column, weight, [&](int i, const Polygon& part) {
        glm::dvec2 center;
        const double area = ComputeArea(part, center);
        const glm::vec4 texel = SampleTexture(texture, glm::vec2((glm::dvec2(i, j) + 0.5) / size));
        covered += area;
        sum += area * glm::dvec4(color.At(glm::vec2(center)) * texel);
        return ++texels <= MaximumTexels;
      });
    });
  if (!isComplete || std::abs(covered - 1.0) > MinimumFaceArea)
  {
    return std::nullopt;
  }
  ++context.Pixels.Interior;
  PixelResult result;
  result.Color = glm::vec4(glm::vec3(sum), 1.f);
  context.SetErrors(0.f, ErrorFloor, result);
  return result;
}

}
