// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TexelIntegral.h"

#include "LayerSampler.h"
#include "Pixels/CoverageConstants.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Number of texels in a pixel above which samples take less time.
constexpr int MaximumTexels = 1024;
/// Largest ratio of the depths of a part of an interpolated texture. At this ratio, the mean of a coordinate from 0 to
/// 1 over the part is off by 0.00016.
constexpr double LargestDepthRatio = 1.25;
/// Texel coordinates above this value have lost too much precision.
constexpr double LargestTexel = 1e6;

/// The part of a pixel on a texel.
using Polygon = ConvexPolygon<double, 24>;

/// A value that is linear in the pixel, as a function of (1, x, y).
using Linear = glm::dvec3;

double Evaluate(const Linear& f, glm::dvec2 p)
{
  return f.x + f.y * p.x + f.z * p.y;
}

/// Returns the area of a polygon and its center.
double ComputeArea(const Polygon& polygon, glm::dvec2& center)
{
  double area = 0.0;
  glm::dvec2 sum(0.0);
  for (int i = 2; i < polygon.Count; ++i)
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
  for (int i = 0; i < rest.Count; ++i)
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
    const Linear border = numerator - (i + 1.0) * denominator;
    const auto evaluate = [&](glm::dvec2 p) { return Evaluate(border, p); };
    Split(rest, evaluate, part, next);
    if (part.Count > 2 && !visit(i, part))
    {
      return false;
    }
    rest = next;
  }
  return rest.Count <= 2 || visit(last, rest);
}

/// The integral of a texture times the color of its triangle over parts of a pixel.
class TexelSum
{
public:
  TexelSum(const PixelTexture& texture, const PixelLayerColor& color)
    : Image(*texture.Image),
      Color(color)
  {
    const auto getLinear = [&](int component) {
      return Linear(texture.Coordinates.Value[component], texture.Coordinates.SlopeX[component],
        texture.Coordinates.SlopeY[component]);
    };
    this->Weight = getLinear(2);
    const double center = this->Image.Interpolate ? 0.5 : 0.0;
    this->Column = static_cast<double>(this->Image.Width) * getLinear(0) - center * this->Weight;
    this->Row = static_cast<double>(this->Image.Height) * getLinear(1) - center * this->Weight;
  }

  /// Integrates over the pixel. Returns false if this takes more time than samples, or is not as accurate.
  bool AddPixel()
  {
    const Polygon square{ { { { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } } }, 4 };
    int texels = 0;
    return std::all_of(square.Points.begin(), square.Points.begin() + 4,
             [&](glm::dvec2 p) { return Evaluate(this->Weight, p) > 0.0; }) &&
      VisitParts(square, this->Row, this->Weight,
        [&](int j, const Polygon& strip) {
          return VisitParts(strip, this->Column, this->Weight, [&](int i, const Polygon& part) {
            const bool isAdded = this->Image.Interpolate ? this->AddCell({ i, j }, part)
                                                         : this->AddTexel({ i, j }, part);
            return isAdded && ++texels <= MaximumTexels;
          });
        }) &&
      std::abs(this->Covered - 1.0) <= MinimumFaceArea;
  }

  glm::dvec4 Sum{ 0.0 };

private:
  bool AddTexel(glm::ivec2 texel, const Polygon& part)
  {
    glm::dvec2 center;
    const double area = ComputeArea(part, center);
    this->Covered += area;
    this->Sum +=
      area * glm::dvec4(this->Color.At(glm::vec2(center)) * GetTexel(this->Image, texel));
    return true;
  }

  /// Adds a part between the centers of four texels, of which `low` is the first. The product of both coordinates is
  /// quadratic where the depth is constant, so that the middles of the sides of a triangle have its exact mean.
  bool AddCell(glm::ivec2 low, const Polygon& part)
  {
    const auto begin = part.Points.begin();
    const auto compare = [&](glm::dvec2 p, glm::dvec2 q) {
      return Evaluate(this->Weight, p) < Evaluate(this->Weight, q);
    };
    const auto depths = std::minmax_element(begin, begin + part.Count, compare);
    if (Evaluate(this->Weight, *depths.second) >
      LargestDepthRatio * Evaluate(this->Weight, *depths.first))
    {
      return false;
    }
    const glm::dvec4 texels[] = { glm::dvec4(GetTexel(this->Image, low)),
      glm::dvec4(GetTexel(this->Image, low + glm::ivec2(1, 0))),
      glm::dvec4(GetTexel(this->Image, low + glm::ivec2(0, 1))),
      glm::dvec4(GetTexel(this->Image, low + 1)) };
    const auto shade = [&](glm::dvec2 p) {
      const double weight = Evaluate(this->Weight, p);
      const double s = Evaluate(this->Column, p) / weight - low.x;
      const double t = Evaluate(this->Row, p) / weight - low.y;
      return glm::dvec4(this->Color.At(glm::vec2(p))) *
        glm::mix(glm::mix(texels[0], texels[1], s), glm::mix(texels[2], texels[3], s), t);
    };
    glm::dvec4 diagonal = shade(0.5 * (part.Points[0] + part.Points[1]));
    for (int i = 2; i < part.Count; ++i)
    {
      const glm::dvec2 u = part.Points[i - 1] - part.Points[0];
      const glm::dvec2 v = part.Points[i] - part.Points[0];
      const double area = 0.5 * (u.x * v.y - u.y * v.x);
      const glm::dvec4 next = shade(part.Points[0] + 0.5 * v);
      this->Covered += area;
      this->Sum +=
        area / 3.0 * (diagonal + next + shade(0.5 * (part.Points[i - 1] + part.Points[i])));
      diagonal = next;
    }
    return true;
  }

  const Texture& Image;
  const PixelLayerColor& Color;
  Linear
    Column; ///< times Weight; integers are borders of texels, or the centers of interpolated ones
  Linear Row;
  Linear Weight;
  double Covered = 0.0;
};

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
  TexelSum texels(pixel.Textures[color.Texture], color);
  if (!texels.AddPixel())
  {
    return std::nullopt;
  }
  ++context.Pixels.Interior;
  PixelResult result;
  result.Color = glm::vec4(glm::vec3(texels.Sum), 1.f);
  context.SetErrors(0.f, ErrorFloor, result);
  return result;
}

}
