// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TracedOcclusion.h"

#include "Execution/ParallelFor.h"
#include "Scene.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/RayTracingConstants.h"
#include "Shading/TranslucentOcclusion.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace penumbra
{

namespace
{

/// Period of the ray directions in x and y, in pixels: the width of the bilateral filter, so that
/// every 5 x 5 window contains each of the 25 directions once.
constexpr int Period = 5;

/// Side of the blocks of pixels. A block has 16 pixels with the same directions in their tangent
/// frames, which form a coherent packet.
constexpr int BlockSize = 4 * Period;
constexpr int PacketSize = 16;

double Fraction(double x)
{
  return x - std::floor(x);
}

/// Point of the unit square for a sample index, the same for all pixels: the additive R2 sequence
/// of the plastic number [Roberts 2018]. Any run of consecutive points has low discrepancy.
glm::dvec2 ComputeSequencePoint(int sample)
{
  return { Fraction(.5 + sample * 0.75487766624669276),
    Fraction(.5 + sample * 0.56984029099805327) };
}

/// Shift of the sequence for pixel (i, j) modulo Period: one of 25 Hammersley points in base 5,
/// chosen so that adjacent pixels have distant shifts.
glm::dvec2 ComputePixelShift(int i, int j)
{
  const int low = (i + 2 * j) % Period;
  const int high = (2 * i + j) % Period;
  return { (Period * high + low) / 25.0, (Period * low + high) / 25.0 };
}

class Tracer
{
public:
  Tracer(const std::vector<SurfacePoint>& points, int width, const RayScene& rays,
    const TracedSamples& samples, std::vector<float>& means)
    : Points(points),
      Width(width),
      Rays(rays),
      Samples(samples),
      Means(means),
      Translucent(HasTranslucentOccluders(rays.GetScene()))
  {
  }

  /// Traces all rays of a block and returns their number.
  long long Trace(const Rectangle& block) const
  {
    long long count = 0;
    for (int j = 0; j < Period; ++j)
    {
      for (int i = 0; i < Period; ++i)
      {
        count += this->TracePixelsWithSameShift(block, i, j);
      }
    }
    return count;
  }

private:
  std::size_t Index(int i, int j) const { return static_cast<std::size_t>(j) * this->Width + i; }

  /// Traces the pixels of a block whose offset from its corner is (i, j) modulo Period.
  long long TracePixelsWithSameShift(const Rectangle& block, int i, int j) const
  {
    std::size_t pixels[PacketSize];
    int size = 0;
    for (int y = j; y < block.Height; y += Period)
    {
      for (int x = i; x < block.Width; x += Period)
      {
        const std::size_t pixel = this->Index(block.X + x, block.Y + y);
        if (this->Points[pixel].Normal != glm::vec3(0.f))
        {
          pixels[size++] = pixel;
        }
      }
    }
    if (size == 0)
    {
      return 0;
    }
    float blocked[PacketSize] = {};
    long long layers = 0;
    for (int sample = 0; sample < this->Samples.Count; ++sample)
    {
      const InterleavedPixels& lattice = this->Samples.Lattice;
      const glm::dvec2 shifted = ComputeSequencePoint(this->Samples.First + sample) +
        ComputePixelShift((lattice.Column + (block.X + i) * lattice.Step) % Period,
          (lattice.Row + (block.Y + j) * lattice.Step) % Period);
      const glm::vec3 direction = DiskToHemisphere(SampleUniformDiskConcentric(
        static_cast<float>(Fraction(shifted.x)), static_cast<float>(Fraction(shifted.y))));
      this->TracePacket(pixels, size, direction, blocked, layers);
    }
    for (int k = 0; k < size; ++k)
    {
      this->Means[pixels[k]] = blocked[k] / static_cast<float>(this->Samples.Count);
    }
    return static_cast<long long>(size) * this->Samples.Count + layers;
  }

  /// Adds the occlusion of one ray of each pixel to `blocked`, and the number of rays that continue
  /// behind translucent surfaces to `layers`.
  void TracePacket(const std::size_t* pixels, int size, glm::vec3 direction, float* blocked,
    long long& layers) const
  {
    Ray rays[PacketSize];
    for (int k = 0; k < PacketSize; ++k)
    {
      rays[k].Far = -1.f;
      if (k < size)
      {
        const SurfacePoint& point = this->Points[pixels[k]];
        rays[k].Origin = point.Position;
        rays[k].Direction = FrameFromNormal(point.Normal) * direction;
        rays[k].Far = this->Samples.Radius;
      }
    }
    if (this->Translucent)
    {
      Hit hits[PacketSize];
      this->Rays.Intersect16(rays, hits);
      const DistanceFalloff falloff(this->Samples.Radius);
      for (int k = 0; k < size; ++k)
      {
        blocked[k] += TraceTranslucentOcclusion(
          this->Rays, rays[k], hits[k], falloff, MinimumTransmittance, layers);
      }
      return;
    }
    bool isHit[PacketSize];
    this->Rays.Occluded16(rays, isHit);
    for (int k = 0; k < size; ++k)
    {
      blocked[k] += isHit[k] ? 1.f : 0.f;
    }
  }

  const std::vector<SurfacePoint>& Points;
  int Width;
  const RayScene& Rays;
  const TracedSamples& Samples;
  std::vector<float>& Means;
  bool Translucent;
};

/// Clips the rectangles to the image and splits them into blocks.
std::vector<Rectangle> SplitIntoBlocks(const std::vector<Rectangle>& parts, int width, int height)
{
  std::vector<Rectangle> blocks;
  for (const Rectangle& part : parts)
  {
    const int right = std::min(part.X + part.Width, width);
    const int top = std::min(part.Y + part.Height, height);
    for (int y = part.Y; y < top; y += BlockSize)
    {
      for (int x = part.X; x < right; x += BlockSize)
      {
        blocks.push_back({ x, y, std::min(BlockSize, right - x), std::min(BlockSize, top - y) });
      }
    }
  }
  return blocks;
}

}

long long TraceOcclusion(const std::vector<SurfacePoint>& points, int width, const RayScene& rays,
  const TracedSamples& samples, const std::vector<Rectangle>& parts, std::vector<float>& means)
{
  const int height = static_cast<int>(points.size() / std::max(width, 1));
  const std::vector<Rectangle> blocks = SplitIntoBlocks(parts, width, height);
  const Tracer tracer(points, width, rays, samples, means);
  std::atomic<long long> count{ 0 };
  ParallelFor<std::size_t>(
    0, blocks.size(), 0, [&](std::size_t block) { count += tracer.Trace(blocks[block]); });
  return count;
}

}
