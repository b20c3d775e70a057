// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sampling in PixelIntegrator without rays where surfaces are translucent: the triangles at each
// sample of a pixel are found front to back, each is shaded once or a few times per pixel, and
// their colors are composited per sample as along a ray.
#include "PixelIntegrator.h"

#include "Sampling/EdgeBlending.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace penumbra
{

namespace
{

/// Fraction of the pixel from which a triangle, whose color may vary, is shaded several times.
constexpr double LargeArea = 0.125;

/// Part of the squared spread of points that is added in all directions, so that points near a line
/// have no gradient across it.
constexpr float SpreadRegularization = 0.01f;

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

}

// Returns true if the pixel that was selected last is sampled by layers.
bool PixelIntegrator::SelectLayers() const
{
  return this->Rasterizer && this->Rasterizer->HasLayers() && !this->Tracer.HasShafts() &&
    !this->Tracer.UsesIrradianceProvider();
}

void PixelIntegrator::RasterizeLayers(SampledPixel& pixel, std::size_t total)
{
  const std::size_t before = pixel.Samples.size();
  const std::uint32_t seed = static_cast<std::uint32_t>(pixel.X) * 0x9e3779b1u ^
    static_cast<std::uint32_t>(pixel.Y) * 0x85ebca77u;
  this->Points.Compute(seed, static_cast<int>(before), static_cast<int>(total - before));
  this->Rasterizer->FindLayers(this->Points, this->Layers);
  this->FindLayerSamples();
  pixel.Samples.resize(total);
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < this->Layers.End.size(); ++i)
  {
    pixel.Samples[before + this->Points.Indices[i]] = this->CompositeLayers(pixel, i, first);
    first = this->Layers.End[i];
  }
  this->Rays.Rasterized += static_cast<long long>(total - before);
}

// Lists the triangles of the layers, and selects the samples at which they are shaded. Replaces the
// indices of triangles in the layers by those in LayeredTriangles.
void PixelIntegrator::FindLayerSamples()
{
  std::vector<LayeredTriangle>& triangles = this->LayeredTriangles;
  std::vector<std::uint32_t>& groups = this->Groups; // per triangle of the tile
  groups.resize(this->Rasterizer->GetNumberOfTriangles() + 1, TileRasterizer::None);
  triangles.clear();
  std::size_t at = 0;
  for (std::size_t sample = 0; sample < this->Layers.End.size(); ++sample)
  {
    for (; at < this->Layers.End[sample]; ++at)
    {
      std::uint32_t& index = this->Layers.Layers[at].Triangle;
      std::uint32_t& group = groups[index];
      if (group == TileRasterizer::None)
      {
        group = static_cast<std::uint32_t>(triangles.size());
        triangles.push_back({ index, 0, glm::vec2(0.f), {}, 0, -1 });
      }
      index = group;
      ++triangles[group].Count;
      triangles[group].Mean += glm::vec2(this->Points.X[sample], this->Points.Y[sample]);
    }
  }
  const auto largeCount =
    static_cast<std::uint32_t>(LargeArea * static_cast<double>(this->Layers.End.size()));
  std::vector<float> nearest(triangles.size(), std::numeric_limits<float>::infinity());
  std::vector<std::uint32_t> visited(triangles.size(), 0);
  for (LayeredTriangle& triangle : triangles)
  {
    groups[triangle.Index] = TileRasterizer::None;
    triangle.Mean /= static_cast<float>(triangle.Count);
    const std::uint32_t surface = this->Rasterizer->GetTriangle(triangle.Index).Surface;
    triangle.NumberShaded = triangle.Count < std::max(largeCount, 4u) ||
        this->Tracer.GetShading().IsConstantPerTriangle(surface)
      ? 1
      : LayeredTriangle::MaximumShaded;
  }
  at = 0;
  for (std::uint32_t sample = 0; sample < this->Layers.End.size(); ++sample)
  {
    for (; at < this->Layers.End[sample]; ++at)
    {
      const std::uint32_t group = this->Layers.Layers[at].Triangle;
      LayeredTriangle& triangle = triangles[group];
      if (triangle.NumberShaded > 1)
      {
        // The samples are sorted by cells, so these are spread over the triangle.
        const std::uint32_t part = visited[group]++ * LayeredTriangle::MaximumShaded;
        triangle.Shaded[part / triangle.Count] = sample;
        continue;
      }
      const glm::vec2 d = glm::vec2(this->Points.X[sample], this->Points.Y[sample]) - triangle.Mean;
      if (glm::dot(d, d) < nearest[group])
      {
        nearest[group] = glm::dot(d, d);
        triangle.Shaded[0] = sample;
      }
    }
  }
}

void PixelIntegrator::ShadeLayer(SampledPixel& pixel, LayeredTriangle& triangle)
{
  const PrimitiveId id = this->Rasterizer->GetTriangle(triangle.Index);
  const auto known = std::find_if(pixel.LayerColors.begin(), pixel.LayerColors.end(),
    [&](const PixelLayerColor& color) { return color.Id == id; });
  triangle.Color = static_cast<std::int32_t>(known - pixel.LayerColors.begin());
  if (known != pixel.LayerColors.end())
  {
    return;
  }
  PixelLayerColor color{ id };
  glm::vec2 points[LayeredTriangle::MaximumShaded];
  glm::vec4 colors[LayeredTriangle::MaximumShaded];
  const float part = 1.f / static_cast<float>(triangle.NumberShaded);
  for (int i = 0; i < triangle.NumberShaded; ++i)
  {
    const std::uint32_t sample = triangle.Shaded[i];
    points[i] = glm::vec2(this->Points.X[sample], this->Points.Y[sample]);
    const LayerColor shaded =
      this->Tracer.ShadeLayer(glm::dvec2(pixel.X, pixel.Y) + glm::dvec2(points[i]), id, this->Rays);
    colors[i] = shaded.Color;
    color.Center += part * points[i];
    color.Color += part * shaded.Color;
    color.Slope += part * shaded.Slope;
  }
  FitGradient(points, colors, triangle.NumberShaded, color);
  pixel.LayerColors.push_back(color);
}

// As CameraRayTracer::CompositeLayers().
glm::vec4 PixelIntegrator::CompositeLayers(
  SampledPixel& pixel, std::uint32_t sample, std::uint32_t first)
{
  const std::vector<Surface>& surfaces = this->Tracer.GetScene().Surfaces;
  const auto origin = static_cast<float>(this->Tracer.GetCamera().DepthOfRayOrigins());
  const glm::vec2 point(this->Points.X[sample], this->Points.Y[sample]);
  EdgeBlending edges(this->Tracer.GetCamera());
  glm::vec4 color(0.f);
  for (std::uint32_t i = first; i < this->Layers.End[sample]; ++i)
  {
    const SampleLayers::Layer& layer = this->Layers.Layers[i];
    LayeredTriangle& triangle = this->LayeredTriangles[layer.Triangle];
    if (triangle.Color < 0)
    {
      this->ShadeLayer(pixel, triangle);
    }
    const PixelLayerColor& layerColor = pixel.LayerColors[triangle.Color];
    const glm::vec4 c = layerColor.At(point);
    const Surface& surface = surfaces[layerColor.Id.Surface];
    const float opacity = edges.FindOpacity(surface, layer.Depth - origin, layerColor.Slope, c.a);
    const float weight = (1.f - color.a) * opacity;
    color += glm::vec4(weight * glm::vec3(c), surface.IsAdditive ? 0.f : weight);
    if ((opacity >= 1.f && !surface.IsAdditive) || color.a > CameraRayTracer::OpaqueAlpha)
    {
      break;
    }
  }
  if (color.a < 1.f)
  {
    color += (1.f - color.a) *
      this->Tracer.GetBackground(glm::dvec2(pixel.X, pixel.Y) + glm::dvec2(point));
  }
  return color;
}

}
