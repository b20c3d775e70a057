// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The part of PixelIntegrator that samples pixels uniformly.
#include "PixelIntegrator.h"

#include "PixelErrors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

// Sampling of a crowded pixel stops when its error is this share of the tolerance.
constexpr double DenseShare = 0.1;
// Regular samples of straight borders err like this power of their number, not -1/2.
constexpr float RegularPower = -0.75f;
// Where edges cross a pixel something may hide between n samples: this over n.
constexpr float HiddenError = 0.25f;

}

PixelResult PixelIntegrator::Uniform(int side)
{
  PixelResult result;
  glm::dvec4 sum(0.0);
  glm::dvec4 squares(0.0);
  const int total = side * side;
  glm::dvec2 points[Sampler::PacketSize];
  Sample samples[Sampler::PacketSize];
  for (int first = 0; first < total; first += Sampler::PacketSize)
  {
    const int count = std::min(total - first, static_cast<int>(Sampler::PacketSize));
    for (int i = 0; i < Sampler::PacketSize; ++i)
    {
      const int k = std::min(first + i, total - 1);
      const int row = k / side;
      points[i] = glm::dvec2(this->X + (k % side + 0.5) / side, this->Y + (row + 0.5) / side);
    }
    this->Source.AtPacket(
      points, (1u << count) - 1u, samples, this->Rays, OcclusionSlack(1.0 / total));
    for (int i = 0; i < count; ++i)
    {
      const glm::dvec4 color(samples[i].Color);
      sum += color;
      squares += color * color;
    }
  }
  this->Rays.Primary += total;
  const glm::dvec4 mean = sum / static_cast<double>(total);
  result.Color = glm::vec4(mean);
  const glm::vec4 variance(glm::max(squares / static_cast<double>(total) - mean * mean, 0.0));
  const float largest = std::max(std::max(variance.r, variance.g), variance.b);
  result.Error =
    this->Believe(std::sqrt(largest) * std::pow(static_cast<float>(total), RegularPower), 0.f);
  return result;
}

// 8 x 8 samples in four packets, each spread over the pixel; stops as soon as their mean is known.
PixelResult PixelIntegrator::UniformAdaptive()
{
  constexpr int Side = 8;
  constexpr int Packets = Side * Side / Sampler::PacketSize;
  PixelResult result;
  glm::vec4 sum(0.f);
  glm::vec4 squares(0.f);
  const double slack = OcclusionSlack(1.0 / (Side * Side));
  bool hits =
    false; // where all miss something small is meant to be here, or it would not be asked for
  glm::dvec2 points[Sampler::PacketSize];
  Sample samples[Sampler::PacketSize];
  for (int packet = 0; packet < Packets; ++packet)
  {
    int i = 0;
    for (int k = 0; k < Side * Side; ++k)
    {
      const int row = k / Side;
      if ((k % Side + 2 * row) % Packets == packet)
      {
        points[i++] = glm::dvec2(this->X + (k % Side + 0.5) / Side, this->Y + (row + 0.5) / Side);
      }
    }
    this->Source.AtPacket(points, 0xffffu, samples, this->Rays, slack);
    this->Rays.Refinement += Sampler::PacketSize;
    for (const Sample& sample : samples)
    {
      hits = hits || sample.First.IsHit();
      sum += sample.Color;
      squares += sample.Color * sample.Color;
    }
    const float n = static_cast<float>((packet + 1) * Sampler::PacketSize);
    result.Color = sum / n;
    const glm::vec4 variance = glm::max(squares / n - result.Color * result.Color, 0.f);
    const float largest = std::max(std::max(variance.r, variance.g), variance.b);
    result.Error = this->Believe(std::sqrt(largest) * std::pow(n, RegularPower),
      this->Segments.empty() ? ErrorFloor : HiddenError / n);
    if (this->Segments.empty() && hits && result.Error < DenseShare * this->Settings.Tolerance)
    {
      break;
    }
  }
  return result;
}

}
