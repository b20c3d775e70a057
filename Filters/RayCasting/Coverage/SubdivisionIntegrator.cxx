// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SubdivisionIntegrator.h"

#include "Pixels/CoverageConstants.h"
#include "Pixels/PixelErrors.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

// Weight of the center sample of a square that is not subdivided further (Simpson's rule).
constexpr double CenterWeight = 2.0 / 3.0;

}

SubdivisionIntegrator::SubdivisionIntegrator(PixelContext& pixel, const PixelEdges& edges)
  : Pixel(pixel),
    Edges(edges)
{
}

const Sample& SubdivisionIntegrator::GetGridSample(glm::ivec2 fine)
{
  const std::uint64_t key = static_cast<std::uint64_t>(static_cast<std::uint32_t>(fine.y)) << 32 |
    static_cast<std::uint32_t>(fine.x);
  if (const auto found = this->Samples.find(key); found != this->Samples.end())
  {
    return found->second;
  }
  // The coarsest level at which this position is a corner. It is independent of the current pixel.
  int level = this->Pixel.Settings.MaximumLevel;
  for (glm::ivec2 p = fine; level > 1 && (p.x | p.y) % 2 == 0; p /= 2)
  {
    --level;
  }
  const double area = CenterWeight * std::ldexp(1.0, -2 * (level - 1));
  const double scale = std::ldexp(1.0, -this->Pixel.Settings.MaximumLevel);
  ++this->Pixel.Rays.Refinement;
  const Sample sample = this->Pixel.Tracer.TraceSample(glm::dvec2(fine) * scale, this->Pixel.Rays,
    ComputeToleranceScale(area), this->Pixel.Grid.GetPenumbrae(glm::dvec2(fine) * scale));
  return this->Samples.emplace(key, sample).first->second;
}

bool SubdivisionIntegrator::NeedsSubdivision(const Square& square) const
{
  for (int i = 1; i < 4; ++i)
  {
    if (square.Corners[i].FirstHit.Surface != square.Corners[0].FirstHit.Surface)
    {
      return true;
    }
  }
  // Case 4: an edge inside, although the corners agree.
  const double scale = std::ldexp(1.0, -this->Pixel.Settings.MaximumLevel);
  const glm::dvec2 low = glm::dvec2(square.Low) * scale - this->Pixel.GetOrigin();
  const double side = std::ldexp(1.0, -square.Level);
  for (const PixelSegment& segment : this->Edges.Segments)
  {
    PixelSegment inside{ (segment.A - low) / side, (segment.B - low) / side };
    if (ClipToPixel(inside))
    {
      return true;
    }
  }
  return false;
}

void SubdivisionIntegrator::Subdivide(
  const Square& square, bool byObject, glm::vec4& color, float& squaredError)
{
  const float area = std::ldexp(1.f, -2 * square.Level);
  const glm::vec4 mean = ComputeMean(square.Corners);
  if (square.Level >= this->Pixel.Settings.MaximumLevel ||
    (byObject && !this->NeedsSubdivision(square)))
  {
    color += area * mean;
    const float error = area * ContrastError * ComputeContrast(square.Corners);
    squaredError += error * error;
    return;
  }
  const int half = 1 << (this->Pixel.Settings.MaximumLevel - square.Level - 1);
  Sample nodes[9];
  for (const int i : { 0, 2, 6, 8 })
  {
    nodes[i] = square.Corners[(i % 3) / 2 + 2 * (i / 6)];
  }
  nodes[4] = this->GetGridSample(square.Low + half);
  if (!byObject && !this->NeedsSubdivision(square) &&
    nodes[4].FirstHit.Surface == nodes[0].FirstHit.Surface)
  {
    // For quadratic colors, the errors of the mean of the corners and of the center have the ratio
    // 2 : -1, so their weighted mean is exact.
    const float deviation = area * ComputeMaximumDifference(nodes[4].Color, mean);
    const float noise = area * 2.f * static_cast<float>(this->Pixel.Noise);
    const bool doubtful = square.Level == 0 && this->Pixel.IsNearShadowBoundary();
    if (!doubtful && deviation <= static_cast<float>(this->Pixel.Settings.Tolerance) + noise)
    {
      color += area / 3.f * (mean + 2.f * nodes[4].Color);
      squaredError += ResidualErrorFraction * ResidualErrorFraction * deviation * deviation;
      return;
    }
  }
  for (const int i : { 1, 3, 5, 7 })
  {
    nodes[i] = this->GetGridSample(square.Low + half * glm::ivec2(i % 3, i / 3));
  }
  for (int child = 0; child < 4; ++child)
  {
    const int cx = child & 1;
    const int cy = child >> 1;
    Square part;
    part.Low = square.Low + half * glm::ivec2(cx, cy);
    part.Level = square.Level + 1;
    for (int i = 0; i < 4; ++i)
    {
      part.Corners[i] = nodes[(cy + (i >> 1)) * 3 + cx + (i & 1)];
    }
    this->Subdivide(part, byObject, color, squaredError);
  }
}

PixelResult SubdivisionIntegrator::Integrate(bool byObject)
{
  Square whole;
  whole.Low = this->Pixel.Position << this->Pixel.Settings.MaximumLevel;
  whole.Level = 0;
  std::copy(this->Pixel.Corners, this->Pixel.Corners + 4, whole.Corners);
  if (byObject && !this->NeedsSubdivision(whole))
  {
    ++(this->Pixel.Corners[0].FirstHit.IsHit() ? this->Pixel.Pixels.Interior
                                               : this->Pixel.Pixels.Empty);
  }
  else
  {
    ++(byObject && this->Pixel.CornersAgree() ? this->Pixel.Pixels.SmallObject
                                              : this->Pixel.Pixels.Refined);
  }
  PixelResult result;
  float squares = 0.f;
  this->Subdivide(whole, byObject, result.Color, squares);
  this->Pixel.SetErrors(std::sqrt(squares), ErrorFloor, result);
  return result;
}

}
