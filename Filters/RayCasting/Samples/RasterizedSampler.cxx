// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RasterizedSampler.h"

#include "Pixels/PixelErrors.h"

#include <algorithm>
#include <cstddef>

namespace penumbra
{

namespace
{

/// Fraction of the pixel from which a triangle, whose color may vary, is shaded several times.
constexpr double LargeArea = 0.125;
constexpr std::uint32_t ShadedPartsOfLargeArea = 4;

}

RasterizedSampler::RasterizedSampler(PixelContext& pixel, TileRasterizer& rasterizer)
  : Pixel(pixel),
    Rasterizer(rasterizer)
{
}

void RasterizedSampler::AddSamples(SampledPixel& pixel, std::size_t total)
{
  const std::size_t before = pixel.SampleColors.size();
  this->Points.Compute(pixel.GetSeed(), static_cast<int>(before), static_cast<int>(total - before));
  this->Rasterizer.Rasterize(this->Points, this->Visible);
  this->GroupSamples();
  pixel.SampleColors.resize(total);
  const std::size_t known = pixel.TriangleColors.size();
  for (const VisibleTriangle& triangle : this->Triangles)
  {
    const std::uint32_t color = this->AddToTriangleColor(pixel, known, triangle);
    for (std::uint32_t i = triangle.First; i < triangle.First + triangle.Count; ++i)
    {
      pixel.SampleColors[before + this->Points.Indices[this->Grouped[i]]] = color;
    }
  }
  this->Pixel.Rays.Rasterized += static_cast<long long>(total - before);
}

// Groups the samples by their triangles.
void RasterizedSampler::GroupSamples()
{
  std::vector<VisibleTriangle>& triangles = this->Triangles;
  std::vector<std::uint32_t>& groups = this->Groups; // per triangle of the tile, and the background
  const std::size_t background = this->Rasterizer.GetNumberOfTriangles();
  groups.resize(background + 1, TileRasterizer::None);
  const auto find = [&](std::uint32_t triangle) -> std::uint32_t& {
    return groups[triangle == TileRasterizer::None ? background : triangle];
  };
  triangles.clear();
  for (const std::uint32_t triangle : this->Visible)
  {
    std::uint32_t& group = find(triangle);
    if (group == TileRasterizer::None)
    {
      group = static_cast<std::uint32_t>(triangles.size());
      triangles.push_back({ triangle, 0, 0 });
    }
    ++triangles[group].Count;
  }
  std::uint32_t first = 0;
  for (VisibleTriangle& triangle : triangles)
  {
    triangle.First = first;
    first += triangle.Count;
    triangle.Count = 0;
  }
  this->Grouped.resize(this->Visible.size());
  for (std::uint32_t i = 0; i < this->Visible.size(); ++i)
  {
    VisibleTriangle& triangle = triangles[find(this->Visible[i])];
    this->Grouped[triangle.First + triangle.Count++] = i;
  }
  for (const VisibleTriangle& triangle : triangles)
  {
    find(triangle.Index) = TileRasterizer::None;
  }
}

// Adds samples of a triangle to its color in this pixel. Returns the index of the color. The first
// `knownColors` colors are of earlier samples.
std::uint32_t RasterizedSampler::AddToTriangleColor(
  SampledPixel& pixel, std::size_t knownColors, const VisibleTriangle& triangle)
{
  const bool isBackground = triangle.Index == TileRasterizer::None;
  const PrimitiveId id = isBackground ? PrimitiveId{ TileRasterizer::None, TileRasterizer::None }
                                      : this->Rasterizer.GetTriangle(triangle.Index);
  const bool isExpensive =
    this->Pixel.Tracer.HasShafts() || this->Pixel.Tracer.UsesIrradianceProvider();
  const bool isConstant = !isBackground && !isExpensive &&
    this->Pixel.Tracer.GetShading().IsConstantPerTriangle(id.Surface);
  const auto end = pixel.TriangleColors.begin() + static_cast<std::ptrdiff_t>(knownColors);
  auto color = std::find_if(pixel.TriangleColors.begin(), end,
    [=](const PixelTriangleColor& entry) { return entry.Id == id; });
  if (color == end)
  {
    pixel.TriangleColors.push_back({ id, glm::vec4(0.f), 0 });
    color = pixel.TriangleColors.end() - 1;
  }
  if (color->Count == 0 || !(isConstant || isExpensive))
  {
    const glm::vec4 found = this->ShadeTriangle(pixel, triangle, id, isConstant);
    const std::uint32_t count = color->Count + triangle.Count;
    color->Color +=
      static_cast<float>(triangle.Count) / static_cast<float>(count) * (found - color->Color);
  }
  color->Count += triangle.Count;
  return static_cast<std::uint32_t>(color - pixel.TriangleColors.begin());
}

// Returns the mean color of a triangle over its samples. Colors that are linear over the image are
// exact, because they are those at mean positions.
glm::vec4 RasterizedSampler::ShadeTriangle(
  const SampledPixel& pixel, const VisibleTriangle& triangle, PrimitiveId id, bool isConstant)
{
  const double area =
    static_cast<double>(triangle.Count) / static_cast<double>(this->Visible.size());
  const std::uint32_t parts = area < LargeArea || isConstant ? 1 : ShadedPartsOfLargeArea;
  glm::vec4 color(0.f);
  for (std::uint32_t part = 0; part < parts; ++part)
  {
    // The samples are sorted by cells, so the samples of a part are close to each other.
    const std::uint32_t first = triangle.First + part * triangle.Count / parts;
    const std::uint32_t last = triangle.First + (part + 1) * triangle.Count / parts;
    glm::dvec2 sum(0.0);
    for (std::uint32_t i = first; i < last; ++i)
    {
      const std::uint32_t sample = this->Grouped[i];
      sum += glm::dvec2(this->Points.X[sample], this->Points.Y[sample]);
    }
    const glm::dvec2 at = glm::dvec2(pixel.X, pixel.Y) + sum / static_cast<double>(last - first);
    const float weight = static_cast<float>(last - first) / static_cast<float>(triangle.Count);
    color += weight *
      this->Pixel.Tracer
        .ShadeSample(at, triangle.Index == TileRasterizer::None ? nullptr : &id, this->Pixel.Rays,
          ComputeToleranceScale(area / parts))
        .Color;
  }
  return color;
}

}
