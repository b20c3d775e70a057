// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The part of PixelIntegrator for single pixels in which so much lies that covering them exactly would
// cost more than sampling them to the tolerance.
#include "PixelIntegrator.h"

#include "PixelErrors.h"
#include "Shading/OwenSobolSequence.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

constexpr int Groups = 16;
constexpr int FirstSamples = 64;
// Borders as close as those of slivers need more samples than single straight ones, by this at most.
constexpr int SampleBudgetFactor = 4;
constexpr int MaximumSamples = 4096;
// Errors above the standard error: few are.
constexpr float Confidence = 1.5f;
// Something may hide between n samples: this over n.
constexpr float HiddenError = 0.25f;

}

// Samples of a sequence, twice as many each time until their groups agree to the tolerance or there are
// as many as it is worth. Each group is a run of the sequence and so evenly spread by itself: the scatter
// of their means tells the error of the whole, and rather more.
PixelResult PixelIntegrator::IntegrateSampled()
{
  ++this->Pixels.Uniform;
  const OwenSobolSequence sequence(static_cast<std::uint32_t>(this->X) * 0x9e3779b1u ^
    static_cast<std::uint32_t>(this->Y) * 0x85ebca77u);
  const int maximumSamples =
    std::min(SampleBudgetFactor * ComputeMaximumSamples(this->Settings.Tolerance), MaximumSamples);
  glm::dvec4 sums[Groups] = {};
  int inGroup = FirstSamples / Groups;
  int traced = 0;
  glm::dvec2 points[CameraRayTracer::PacketSize];
  Sample samples[CameraRayTracer::PacketSize];
  PixelResult result;
  for (int total = FirstSamples;; total *= 2)
  {
    const double toleranceScale = ComputeToleranceScale(1.0 / total);
    while (traced < total)
    {
      for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
      {
        points[i] = glm::dvec2(this->X, this->Y) +
          glm::dvec2(sequence.At(static_cast<std::uint32_t>(traced + i)));
      }
      this->Tracer.TracePacket(points, 0xffffu, samples, this->Rays, toleranceScale);
      for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
      {
        sums[(traced + i) / inGroup] += glm::dvec4(samples[i].Color);
      }
      traced += CameraRayTracer::PacketSize;
    }
    this->Rays.Refinement += total == FirstSamples ? total : total / 2;

    glm::dvec4 sum(0.0);
    glm::dvec4 squares(0.0);
    for (const glm::dvec4& group : sums)
    {
      const glm::dvec4 mean = group / static_cast<double>(inGroup);
      sum += mean;
      squares += mean * mean;
    }
    const glm::dvec4 mean = sum / static_cast<double>(Groups);
    const glm::dvec4 variance =
      glm::max(squares / static_cast<double>(Groups) - mean * mean, 0.0) / (Groups - 1.0);
    const double largest = std::max(std::max(variance.r, variance.g), variance.b);
    result.Color = glm::vec4(mean);
    result.Error = this->CombineErrors(
      Confidence * static_cast<float>(std::sqrt(largest)), HiddenError / static_cast<float>(total));
    if (result.Error <= this->Settings.Tolerance || total >= maximumSamples)
    {
      return result;
    }
    for (int i = 0; i < Groups; ++i)
    {
      sums[i] = 2 * i < Groups ? sums[2 * i] + sums[2 * i + 1] : glm::dvec4(0.0);
    }
    inGroup *= 2;
  }
}

}
