// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UniformSampling.h"

#include "Pixels/CoverageConstants.h"
#include "Pixels/PixelErrors.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

float GetMaximumComponent(const glm::vec3& squares)
{
  return std::max(std::max(squares.r, squares.g), squares.b);
}

/// Mean square of the differences between neighbors.
class Differences
{
public:
  void Add(const glm::vec4& a, const glm::vec4& b)
  {
    const glm::vec3 d = glm::vec3(a) - glm::vec3(b);
    this->Sum += d * d;
    ++this->Count;
  }

  float ComputeMean() const
  {
    return GetMaximumComponent(this->Sum) / static_cast<float>(this->Count);
  }

private:
  glm::vec3 Sum{ 0.f };
  int Count = 0;
};

/// Estimates the error of the mean of side x side samples. The variance of a sample is half the
/// mean square of the differences between neighbors, both for noise and for edges. If an edge is
/// parallel to rows or columns, the errors of its samples are equal. The differences between the
/// means of neighboring rows or columns bound this error.
float EstimateGridError(const std::vector<glm::vec4>& colors, int side)
{
  if (side < 2)
  {
    return SingleSampleError;
  }
  const float n = static_cast<float>(side);
  Differences sampleDifferences;
  float lineError = 0.f;
  for (int axis = 0; axis < 2; ++axis)
  {
    const int along = axis == 0 ? 1 : side;
    const int across = axis == 0 ? side : 1;
    Differences lineDifferences;
    glm::vec4 before(0.f);
    for (int line = 0; line < side; ++line)
    {
      glm::vec4 mean(0.f);
      for (int i = 0; i < side; ++i)
      {
        const glm::vec4& color = colors[line * across + i * along];
        mean += color / n;
        if (i > 0)
        {
          sampleDifferences.Add(color, colors[line * across + (i - 1) * along]);
        }
      }
      if (line > 0)
      {
        lineDifferences.Add(mean, before);
      }
      before = mean;
    }
    lineError = std::max(lineError, 0.125f * lineDifferences.ComputeMean() / n);
  }
  return std::sqrt(std::max(0.5f * sampleDifferences.ComputeMean() / (n * n), lineError));
}

}

PixelResult SampleUniformly(PixelContext& pixel)
{
  const int side = pixel.Settings.UniformSamples;
  PixelResult result;
  glm::dvec4 sum(0.0);
  const int total = side * side;
  std::vector<glm::vec4> colors(total);
  glm::dvec2 points[CameraRayTracer::PacketSize];
  Sample samples[CameraRayTracer::PacketSize];
  for (int first = 0; first < total; first += CameraRayTracer::PacketSize)
  {
    const int count = std::min(total - first, static_cast<int>(CameraRayTracer::PacketSize));
    for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
    {
      const int k = std::min(first + i, total - 1);
      const int row = k / side;
      points[i] = glm::dvec2(
        pixel.Position.x + (k % side + 0.5) / side, pixel.Position.y + (row + 0.5) / side);
    }
    pixel.Tracer.TracePacket(
      points, (1u << count) - 1u, samples, pixel.Rays, ComputeToleranceScale(1.0 / total));
    for (int i = 0; i < count; ++i)
    {
      colors[first + i] = samples[i].Color;
      sum += glm::dvec4(samples[i].Color);
    }
  }
  pixel.Rays.Primary += total;
  result.Color = glm::vec4(sum / static_cast<double>(total));
  pixel.SetErrors(EstimateGridError(colors, side), 0.f, result);
  return result;
}

}
