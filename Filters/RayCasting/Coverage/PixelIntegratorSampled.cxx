// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Adaptive sampling in PixelIntegrator, for single pixels whose exact coverage would cost more than
// samples of the same accuracy.
#include "PixelIntegrator.h"

#include "PixelErrors.h"
#include "Shading/OwenSobolSequence.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

// Number of groups whose means estimate the error.
constexpr int Groups = 16;

}

// Doubles the number of samples until the estimated error is below the tolerance or the maximum
// number is reached. Each group of samples is a contiguous part of the Owen-scrambled Sobol
// sequence and has low discrepancy. The variance of the means of the groups is a conservative
// estimate of the error.
PixelResult PixelIntegrator::IntegrateSampled()
{
  ++this->Pixels.Uniform;
  const OwenSobolSequence sequence(static_cast<std::uint32_t>(this->X) * 0x9e3779b1u ^
    static_cast<std::uint32_t>(this->Y) * 0x85ebca77u);
  const int maximumSamples =
    std::min(SampleBudgetFactor * ComputeMaximumSamples(this->Settings.Tolerance), MaximumSamples);
  glm::dvec4 sums[Groups] = {};
  int inGroup = MinimumSamples / Groups;
  int traced = 0;
  glm::dvec2 points[CameraRayTracer::PacketSize];
  Sample samples[CameraRayTracer::PacketSize];
  PixelResult result;
  for (int total = MinimumSamples;; total *= 2)
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
    this->Rays.Refinement += total == MinimumSamples ? total : total / 2;

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
    result.Error = this->CombineErrors(ConfidenceFactor * static_cast<float>(std::sqrt(largest)),
      HiddenError / static_cast<float>(total));
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
