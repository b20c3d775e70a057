// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LayerSampler.h"

#include "Edges/UnsteadyNormals.h"
#include "Sampling/EdgeBlending.h"
#include "Surface.h"
#include "Tiles/ScreenTriangle.h"

#include <array>
#include <cstddef>

namespace penumbra
{

namespace
{

/// Fraction of the pixel from which a triangle, whose color may vary, is shaded several times.
constexpr float LargeArea = 0.125f;
constexpr int ShadedPointsOfLargeArea = 4;
/// Distance from its center of the points at which a part of a pixel is shaded, relative to that of
/// its corners.
constexpr float CornerDistance = 0.6f;

/// Part of the squared spread of points that is added in all directions, so that points near a line
/// have no gradient across it.
constexpr float SpreadRegularization = 0.01f;

/// Returns the texture coordinates of a triangle relative to the lower left corner of a pixel.
PixelTexture FindTexture(
  const Surface& surface, std::uint32_t triangle, const Camera& camera, glm::dvec2 pixel)
{
  PixelTexture texture;
  texture.Image = surface.LitTexture.get();
  const glm::uvec3 corners = surface.GetCorners(triangle);
  const ScreenTriangle projected(surface.GetPoints(triangle), camera);
  glm::dvec3 values[3];
  for (int i = 0; i < 3; ++i)
  {
    const double weight = camera.Parallel ? 1.0 : projected.Keys[i];
    values[i] = weight * glm::dvec3(surface.TextureCoordinates[corners[i]], 1.0);
  }
  texture.Coordinates = projected.MakePlane(values[0], values[1], values[2], pixel);
  return texture;
}

/// Returns a value that is positive where the normal of a triangle points away from the camera, relative to the lower
/// left corner of a pixel.
LinearValue<double> FindAway(
  const Surface& surface, std::uint32_t triangle, const Camera& camera, glm::dvec2 pixel)
{
  const ScreenTriangle projected(surface.GetPoints(triangle), camera);
  const std::array<glm::vec3, 3> normals = surface.GetNormals(triangle, surface.Normals);
  double values[3];
  for (int i = 0; i < 3; ++i)
  {
    const double weight = camera.Parallel ? 1.0 : projected.Keys[i];
    values[i] = weight * glm::dot(glm::dvec3(normals[i]), glm::dvec3(camera.Forward));
  }
  return projected.MakePlane(values[0], values[1], values[2], pixel);
}

/// Fits the gradient of the color to colors at points.
void FitGradient(
  const glm::vec2* points, const glm::vec4* colors, int count, PixelLayerColor& color)
{
  glm::mat2 spread(0.f);
  glm::vec4 sums[2] = { glm::vec4(0.f), glm::vec4(0.f) };
  for (int i = 0; i < count; ++i)
  {
    const glm::vec2 d = points[i] - color.Center;
    spread += glm::outerProduct(d, d);
    sums[0] += d.x * (colors[i] - color.Color);
    sums[1] += d.y * (colors[i] - color.Color);
  }
  const float trace = spread[0][0] + spread[1][1];
  if (trace > 0.f)
  {
    const glm::mat2 inverse = glm::inverse(spread + glm::mat2(SpreadRegularization * trace));
    color.Gradient[0] = inverse[0][0] * sums[0] + inverse[1][0] * sums[1];
    color.Gradient[1] = inverse[0][1] * sums[0] + inverse[1][1] * sums[1];
  }
}

/// Shades a triangle at the center of a polygon, or, if that is large, near some of its corners.
void ShadePolygon(PixelContext& context, const LayerPolygon& polygon, const SampledPixel& pixel,
  PixelLayerColor& color)
{
  glm::vec2 center(0.f);
  float area = 0.f;
  for (int i = 2; i < polygon.Count; ++i)
  {
    const glm::vec2 u = polygon.Points[i - 1] - polygon.Points[0];
    const glm::vec2 v = polygon.Points[i] - polygon.Points[0];
    const float part = 0.5f * (u.x * v.y - u.y * v.x);
    area += part;
    center += part * (polygon.Points[0] + (u + v) / 3.f);
  }
  center = area > 0.f ? center / area : polygon.Count == 0 ? glm::vec2(0.5f) : polygon.Points[0];
  const bool isConstant = area < LargeArea;
  const int count = isConstant ? 1 : ShadedPointsOfLargeArea;
  glm::vec2 points[ShadedPointsOfLargeArea] = { center };
  glm::vec4 colors[ShadedPointsOfLargeArea];
  const float part = 1.f / static_cast<float>(count);
  for (int i = 0; i < count; ++i)
  {
    if (!isConstant)
    {
      const glm::vec2 corner = polygon.Points[i * polygon.Count / ShadedPointsOfLargeArea];
      points[i] = center + CornerDistance * (corner - center);
    }
    const LayerColor shaded = context.Tracer.ShadeLayer(
      glm::dvec2(pixel.X, pixel.Y) + glm::dvec2(points[i]), color.Id, context.Rays);
    colors[i] = shaded.Color;
    color.Center += part * points[i];
    color.Color += part * shaded.Color;
    color.Slope += part * shaded.Slope;
  }
  color.IsConstant = isConstant;
  if (!isConstant)
  {
    FitGradient(points, colors, count, color);
  }
}

}

void ShadePartOfLayer(PixelContext& context, const TileRasterizer& rasterizer, std::uint32_t layer,
  SampledPixel& pixel, PixelLayerColor& color)
{
  const Camera& camera = context.Tracer.GetCamera();
  const glm::dvec2 origin(pixel.X, pixel.Y);
  if (color.Of->LitTexture)
  {
    color.Texture = static_cast<std::uint32_t>(pixel.Textures.size());
    pixel.Textures.push_back(FindTexture(*color.Of, color.Id.Primitive, camera, origin));
  }
  LayerPolygon polygon = rasterizer.ClipLayer(layer);
  if (IsPartlyNegated(*color.Of, color.Id.Primitive, camera))
  {
    NegatedLayer negated{ FindAway(*color.Of, color.Id.Primitive, camera, origin), color };
    LayerPolygon away;
    LayerPolygon rest;
    const auto evaluate = [&](glm::vec2 p) { return -Evaluate(negated.Away, p); };
    Split(polygon, evaluate, away, rest);
    if (away.Count > 0 && rest.Count > 0)
    {
      ShadePolygon(context, away, pixel, negated.Color);
      polygon = rest;
      color.Negated = static_cast<std::uint32_t>(pixel.NegatedLayers.size());
      pixel.NegatedLayers.push_back(negated);
    }
  }
  ShadePolygon(context, polygon, pixel, color);
}

LayerSampler::LayerSampler(PixelContext& pixel, TileRasterizer& rasterizer)
  : Pixel(pixel),
    Rasterizer(rasterizer)
{
}

void LayerSampler::AddSamples(SampledPixel& pixel, std::size_t total)
{
  const std::size_t before = pixel.Samples.size();
  this->Points.Compute(pixel.GetSeed(), static_cast<int>(before), static_cast<int>(total - before));
  this->LoadBackground(pixel);
  this->ConstantLayers.resize(this->Rasterizer.GetNumberOfTriangles());
  pixel.Samples.resize(total);
  pixel.LayerColors.resize(this->Rasterizer.GetNumberOfLayers());
  this->Rasterizer.VisitLayers(
    this->Points, [&](std::uint32_t i, const LayerCandidate* begin, const LayerCandidate* end) {
      const glm::vec2 point(this->Points.X[i], this->Points.Y[i]);
      pixel.Samples[before + this->Points.Indices[i]] =
        this->CompositeLayers(pixel, point, begin, end);
    });
  this->Pixel.Rays.Rasterized += static_cast<long long>(total - before);
}

// A background without an image is almost linear inside a pixel.
void LayerSampler::LoadBackground(const SampledPixel& pixel)
{
  const glm::dvec2 corner(pixel.X, pixel.Y);
  PixelLayerColor& background = this->Background;
  background.Color = this->Pixel.Tracer.GetBackground(corner);
  background.Gradient[0] =
    this->Pixel.Tracer.GetBackground(corner + glm::dvec2(1.0, 0.0)) - background.Color;
  background.Gradient[1] =
    this->Pixel.Tracer.GetBackground(corner + glm::dvec2(0.0, 1.0)) - background.Color;
  background.IsConstant =
    background.Gradient[0] == glm::vec4(0.f) && background.Gradient[1] == glm::vec4(0.f);
}

// Shades a triangle: once per tile, if its color is constant.
void LayerSampler::ShadeLayer(SampledPixel& pixel, std::uint32_t layer, PixelLayerColor& color)
{
  const PrimitiveId id = this->Rasterizer.GetLayer(layer);
  if (!this->Pixel.Tracer.GetShading().IsConstantPerTriangle(id.Surface))
  {
    color.Id = id;
    color.Of = &this->Pixel.GetSurfaces()[id.Surface];
    ShadePartOfLayer(this->Pixel, this->Rasterizer, layer, pixel, color);
    return;
  }
  PixelLayerColor& constant = this->ConstantLayers[this->Rasterizer.GetLayerTriangle(layer)];
  if (!constant.Of)
  {
    constant.Id = id;
    constant.Of = &this->Pixel.GetSurfaces()[id.Surface];
    const std::array<glm::vec3, 3> points = constant.Of->GetPoints(id.Primitive);
    const ScreenTriangle projected(points, this->Pixel.Tracer.GetCamera());
    const LayerColor shaded = this->Pixel.Tracer.ShadeLayer(
      (projected.Points[0] + projected.Points[1] + projected.Points[2]) / 3.0, id,
      this->Pixel.Rays);
    constant.Color = shaded.Color;
    constant.Slope = shaded.Slope;
  }
  color = constant;
}

// As CameraRayTracer::CompositeLayers().
glm::vec4 LayerSampler::CompositeLayers(
  SampledPixel& pixel, glm::vec2 point, const LayerCandidate* begin, const LayerCandidate* end)
{
  const auto origin = static_cast<float>(this->Pixel.Tracer.GetCamera().DepthOfRayOrigins());
  LayerOrder order;
  EdgeBlending edges(this->Pixel.Tracer.GetCamera());
  glm::vec4 color(0.f);
  for (const LayerCandidate* layer = begin; layer < end; ++layer)
  {
    if (this->Pixel.Tracer.HasLayerOrder() &&
      !this->Pixel.Tracer.IsDrawn(this->Rasterizer.GetLayer(layer->Layer), order))
    {
      continue;
    }
    PixelLayerColor& found = pixel.LayerColors[layer->Layer];
    if (!found.Of)
    {
      this->ShadeLayer(pixel, layer->Layer, found);
    }
    const PixelLayerColor& part = pixel.GetLayerColor(found, point);
    glm::vec4 c = part.At(point);
    if (found.Texture != PixelLayerColor::NoTexture)
    {
      const PixelTexture& texture = pixel.Textures[found.Texture];
      c *= SampleTexture(*texture.Image, texture.At(point));
    }
    float opacity = c.a;
    if (edges.IsBehindEdge() || found.Of->EdgeWidth > 0.f)
    {
      const float distance = this->Rasterizer.ComputeDepth(*layer) - origin;
      opacity = edges.FindOpacity(*found.Of, distance, part.Slope, c.a);
    }
    const float weight = (1.f - color.a) * opacity;
    color += glm::vec4(weight * glm::vec3(c), found.Of->IsAdditive ? 0.f : weight);
    if ((opacity >= 1.f && !found.Of->IsAdditive) || color.a > CameraRayTracer::OpaqueAlpha)
    {
      break;
    }
  }
  if (color.a < 1.f)
  {
    color += (1.f - color.a) *
      (this->Pixel.Tracer.HasBackgroundImage()
          ? this->Pixel.Tracer.GetBackground(glm::dvec2(pixel.X, pixel.Y) + glm::dvec2(point))
          : this->Background.At(point));
  }
  return color;
}

}
