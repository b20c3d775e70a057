// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TracedOcclusion.h"

#include "Execution/ParallelFor.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/RayTracingConstants.h"
#include "Shading/TranslucentOcclusion.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace penumbra
{

namespace
{

/// Period of the ray directions in x and y, in pixels: the width of the bilateral filter, so that
/// every 5 x 5 window contains each of the 25 directions once.
constexpr int Period = 5;

constexpr int PacketSize = 16;

/// Side of the parts of a block. A part has 16 pixels with the same directions in their tangent frames,
/// which form a coherent packet; if one pixel of four is traced, those of a block do.
constexpr int PartSize = 4 * Period;
constexpr int BlockSize = 2 * PartSize;
constexpr int PixelsWithSameShift = (BlockSize / Period) * (BlockSize / Period);

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
    const TracedSamples& samples, const PixelRays& counts, std::vector<float>& sums, int stride)
    : Points(points),
      Width(width),
      Height(static_cast<int>(points.size() / std::max(width, 1))),
      Rays(rays),
      Samples(samples),
      Counts(counts),
      Sums(sums),
      Stride(stride),
      Translucent(HasTranslucentOccluders(rays.GetSurfaces()))
  {
  }

  int CountBlocks() const { return this->CountColumns() * CountParts(this->Height); }

  /// Traces all rays of a block and returns their number.
  long long TraceBlock(int block) const
  {
    const int left = block % this->CountColumns() * BlockSize;
    const int bottom = block / this->CountColumns() * BlockSize;
    Packet packet;
    long long count = 0;
    for (int j = 0; j < Period; ++j)
    {
      for (int i = 0; i < Period; ++i)
      {
        count += this->TracePixelsWithSameShift(left, bottom, i, j, packet);
      }
    }
    return count + this->TracePacket(packet);
  }

private:
  /// Rays that are traced together. If few pixels of a block are traced, they have different directions.
  struct Packet
  {
    std::size_t Pixels[PacketSize];
    glm::vec3 Directions[PacketSize];
    int Size = 0;
  };

  static int CountParts(int size) { return (size + BlockSize - 1) / BlockSize; }
  int CountColumns() const { return CountParts(this->Width); }

  /// Finds the traced pixels of a block whose offset from its corner is (i, j) modulo Period, part by
  /// part. Returns their number.
  int FindPixelsWithSameShift(int left, int bottom, int i, int j, std::size_t* pixels) const
  {
    int size = 0;
    for (int part = 0; part < 4; ++part)
    {
      const int right = std::min(left + (part % 2 + 1) * PartSize, this->Width);
      const int top = std::min(bottom + (part / 2 + 1) * PartSize, this->Height);
      for (int y = bottom + part / 2 * PartSize + j; y < top; y += Period)
      {
        for (int x = left + part % 2 * PartSize + i; x < right; x += Period)
        {
          const std::size_t pixel = static_cast<std::size_t>(y) * this->Width + x;
          if (this->Counts[pixel] > 0 && this->Points[pixel].Normal != glm::vec3(0.f))
          {
            pixels[size++] = pixel;
          }
        }
      }
    }
    return size;
  }

  long long TracePixelsWithSameShift(int left, int bottom, int i, int j, Packet& packet) const
  {
    std::size_t pixels[PixelsWithSameShift];
    int size = this->FindPixelsWithSameShift(left, bottom, i, j, pixels);
    const glm::dvec2 shift = ComputePixelShift((left + i) % Period, (bottom + j) % Period);
    long long rays = 0;
    for (int sample = 0; size > 0; ++sample)
    {
      const glm::dvec2 shifted = ComputeSequencePoint(this->Samples.First + sample) + shift;
      const glm::vec3 direction = DiskToHemisphere(SampleUniformDiskConcentric(
        static_cast<float>(Fraction(shifted.x)), static_cast<float>(Fraction(shifted.y))));
      for (int k = 0; k < size; ++k)
      {
        packet.Pixels[packet.Size] = pixels[k];
        packet.Directions[packet.Size++] = direction;
        rays += packet.Size == PacketSize ? this->TracePacket(packet) : 0;
      }
      size =
        static_cast<int>(std::remove_if(pixels, pixels + size,
                           [&](std::size_t pixel) { return this->Counts[pixel] == sample + 1; }) -
          pixels);
    }
    return rays;
  }

  /// Traces the rays of a packet and empties it. Returns their number, with those that continue behind
  /// translucent surfaces.
  long long TracePacket(Packet& packet) const
  {
    const int size = std::exchange(packet.Size, 0);
    const std::size_t* const pixels = packet.Pixels;
    long long layers = 0;
    Ray rays[PacketSize];
    for (int k = 0; k < PacketSize; ++k)
    {
      rays[k].Far = -1.f;
      if (k < size)
      {
        const SurfacePoint& point = this->Points[pixels[k]];
        rays[k].Origin = point.Position;
        rays[k].Direction = FrameFromNormal(point.Normal) * packet.Directions[k];
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
        this->Sums[this->Stride * pixels[k]] += TraceTranslucentOcclusion(
          this->Rays, rays[k], hits[k], falloff, MinimumTransmittance, layers);
      }
      return size + layers;
    }
    bool isHit[PacketSize];
    this->Rays.Occluded16(rays, isHit);
    for (int k = 0; k < size; ++k)
    {
      this->Sums[this->Stride * pixels[k]] += isHit[k] ? 1.f : 0.f;
    }
    return size;
  }

  const std::vector<SurfacePoint>& Points;
  int Width;
  int Height;
  const RayScene& Rays;
  const TracedSamples& Samples;
  const PixelRays& Counts;
  std::vector<float>& Sums;
  std::size_t Stride;
  bool Translucent;
};

}

long long TraceOcclusion(const std::vector<SurfacePoint>& points, int width, const RayScene& rays,
  const TracedSamples& samples, const PixelRays& counts, std::vector<float>& sums, int stride)
{
  const Tracer tracer(points, width, rays, samples, counts, sums, stride);
  std::atomic<long long> count{ 0 };
  ParallelFor(0, tracer.CountBlocks(), 0, [&](int block) { count += tracer.TraceBlock(block); });
  return count;
}

}
