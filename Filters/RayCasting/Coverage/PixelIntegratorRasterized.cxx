// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sampling in PixelIntegrator without rays: the triangles at the samples of a pixel full of edges are
// found by comparing all samples with all triangles of the pixel. Each visible triangle is then
// shaded once, or a few times if it covers much of the pixel.
#include "PixelIntegrator.h"

#include "PixelErrors.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace penumbra
{

namespace
{

/// Fraction of the pixel from which a triangle, whose color may vary, is shaded several times.
constexpr double LargeArea = 0.125;
constexpr std::size_t ShadedSamplesOfLargeArea = 4;

}

bool PixelIntegrator::MayRasterize(std::size_t edges) const
{
  if (!this->Rasterizer || edges < MinimumLayeredEdges)
  {
    return false;
  }
  const bool isOpaque = this->Rasterizer->SelectPixel({ this->X, this->Y });
  const bool isFull = edges >= MinimumRasterizedEdges && this->RasterizesAll;
  return isOpaque ? isFull : (isFull || this->Rasterizer->HasLines()) && this->SelectLayers();
}

// Computes the samples [before, total) of a pixel.
void PixelIntegrator::ComputePoints(
  const SampledPixel& pixel, std::size_t before, std::size_t total)
{
  const std::uint32_t seed = static_cast<std::uint32_t>(pixel.X) * 0x9e3779b1u ^
    static_cast<std::uint32_t>(pixel.Y) * 0x85ebca77u;
  this->Points.Compute(seed, static_cast<int>(before), static_cast<int>(total - before));
}

// Finds the triangles at the samples of the selected pixel and adds their colors.
void PixelIntegrator::RasterizeSamples(SampledPixel& pixel, std::size_t total)
{
  const std::size_t before = pixel.SampleColors.size();
  this->ComputePoints(pixel, before, total);
  this->Rasterizer->Rasterize(this->Points, this->Visible);
  this->GroupSamples();
  pixel.SampleColors.resize(total);
  const std::size_t known = pixel.TriangleColors.size();
  for (const VisibleTriangle& triangle : this->RasterizedTriangles)
  {
    const std::uint32_t color = this->FindTriangleColor(pixel, known, triangle);
    for (std::uint32_t i = triangle.First; i < triangle.First + triangle.Count; ++i)
    {
      pixel.SampleColors[before + this->Points.Indices[this->Grouped[i]]] = color;
    }
  }
  this->Rays.Rasterized += static_cast<long long>(total - before);
}

// Groups the samples by their triangles.
void PixelIntegrator::GroupSamples()
{
  std::vector<VisibleTriangle>& triangles = this->RasterizedTriangles;
  std::vector<std::uint32_t>& groups = this->Groups; // per triangle of the tile, and the background
  const std::size_t background = this->Rasterizer->GetNumberOfTriangles();
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

// Returns the index of the color of a triangle in this pixel, which is shaded when it is found first. The first
// `knownColors` colors are of earlier samples.
std::uint32_t PixelIntegrator::FindTriangleColor(
  SampledPixel& pixel, std::size_t knownColors, const VisibleTriangle& triangle)
{
  const bool isBackground = triangle.Index == TileRasterizer::None;
  const PrimitiveId id = isBackground ? PrimitiveId{ TileRasterizer::None, TileRasterizer::None }
                                      : this->Rasterizer->GetTriangle(triangle.Index);
  const auto end = pixel.TriangleColors.begin() + static_cast<std::ptrdiff_t>(knownColors);
  const auto known = std::find_if(pixel.TriangleColors.begin(), end,
    [=](const std::pair<PrimitiveId, glm::vec4>& entry) { return entry.first == id; });
  if (known != end)
  {
    return static_cast<std::uint32_t>(known - pixel.TriangleColors.begin());
  }
  const std::uint32_t* const samples = this->Grouped.data() + triangle.First;
  const double area =
    static_cast<double>(triangle.Count) / static_cast<double>(this->Visible.size());
  const bool isConstant = !isBackground && !this->Tracer.HasShafts() &&
    !this->Tracer.UsesIrradianceProvider() &&
    this->Tracer.GetShading().IsConstantPerTriangle(id.Surface);
  const auto shade = [&](std::uint32_t sample, double part) {
    return this->Tracer
      .ShadeSample(
        glm::dvec2(pixel.X, pixel.Y) + glm::dvec2(this->Points.X[sample], this->Points.Y[sample]),
        isBackground ? nullptr : &id, this->Rays, ComputeToleranceScale(part))
      .Color;
  };
  glm::vec4 color(0.f);
  if (area < LargeArea || isConstant)
  {
    color = shade(this->FindCentralSample(triangle), area);
  }
  else
  {
    // The samples are sorted by cells, so these are spread over the triangle.
    for (std::size_t i = 0; i < ShadedSamplesOfLargeArea; ++i)
    {
      const std::size_t at = (2 * i + 1) * triangle.Count / (2 * ShadedSamplesOfLargeArea);
      color += shade(samples[at], area / ShadedSamplesOfLargeArea);
    }
    color /= static_cast<float>(ShadedSamplesOfLargeArea);
  }
  pixel.TriangleColors.emplace_back(id, color);
  return static_cast<std::uint32_t>(pixel.TriangleColors.size() - 1);
}

// Returns the sample of a triangle that is nearest to the mean position of its samples.
std::uint32_t PixelIntegrator::FindCentralSample(const VisibleTriangle& triangle) const
{
  const auto get = [&](std::uint32_t i) {
    const std::uint32_t sample = this->Grouped[triangle.First + i];
    return glm::vec2(this->Points.X[sample], this->Points.Y[sample]);
  };
  glm::vec2 sum(0.f);
  for (std::uint32_t i = 0; i < triangle.Count; ++i)
  {
    sum += get(i);
  }
  const glm::vec2 mean = sum / static_cast<float>(triangle.Count);
  std::uint32_t central = 0;
  float nearest = std::numeric_limits<float>::infinity();
  for (std::uint32_t i = 0; i < triangle.Count; ++i)
  {
    const glm::vec2 d = get(i) - mean;
    if (glm::dot(d, d) < nearest)
    {
      nearest = glm::dot(d, d);
      central = i;
    }
  }
  return this->Grouped[triangle.First + central];
}

}
