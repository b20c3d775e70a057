// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Functions used by all parts of PixelIntegrator: color differences, and numbers of samples.
#ifndef penumbra_PixelErrors_h
#define penumbra_PixelErrors_h

#include "CoverageConstants.h"
#include "Sampling/CameraRayTracer.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

/// Returns the factor on the tolerance of a sample that represents the fraction `area` of a pixel,
/// so that the independent errors of all samples add up to the same as those of four corners.
inline double ComputeToleranceScale(double area)
{
  return 0.5 / std::sqrt(area);
}

/// Returns the number of low-discrepancy samples that reduce the error of a pixel with straight
/// edges of any contrast to `tolerance`.
inline double ComputeRequiredSamples(double tolerance)
{
  return std::pow(0.5 / std::max(tolerance, 1e-6), 4.0 / 3.0);
}

/// Returns ComputeRequiredSamples() as a power of two in [64, MaximumSamples]. It bounds the cost of exact
/// coverage.
inline int ComputeMaximumSamples(double tolerance)
{
  const double required = ComputeRequiredSamples(tolerance);
  int samples = 64;
  while (samples < required && samples < MaximumSamples)
  {
    samples *= 2;
  }
  return samples;
}

/// Returns the number of the first samples of a rasterized pixel, a power of two.
inline int ComputeFirstRasterizedSamples(double tolerance)
{
  return std::clamp(ComputeMaximumSamples(tolerance) / 4, 64, MaximumFirstRasterizedSamples);
}

/// Returns the maximum number of samples of a tile, per pixel, if exact coverage takes less time in most pixels.
inline double ComputeSampleBudget(double tolerance)
{
  return std::max(SampleBudgetFraction * ComputeMaximumSamples(tolerance), MinimumSampleBudget);
}

/// Returns the maximum over the components of |a - b|.
inline float ComputeMaximumDifference(const glm::vec4& a, const glm::vec4& b)
{
  const glm::vec4 d = glm::abs(a - b);
  return std::max(std::max(d.r, d.g), std::max(d.b, d.a));
}

/// Returns the maximum color difference between four corners.
inline float ComputeContrast(const Sample* corners)
{
  const glm::vec4 low = glm::min(
    glm::min(corners[0].Color, corners[1].Color), glm::min(corners[2].Color, corners[3].Color));
  const glm::vec4 high = glm::max(
    glm::max(corners[0].Color, corners[1].Color), glm::max(corners[2].Color, corners[3].Color));
  return ComputeMaximumDifference(low, high);
}

inline glm::vec4 ComputeMean(const Sample* corners)
{
  return 0.25f * ((corners[0].Color + corners[1].Color) + (corners[2].Color + corners[3].Color));
}

/// Returns the position of a corner (0 to 3) in the pixel.
inline glm::dvec2 GetCornerOffset(int corner)
{
  return { corner & 1, corner >> 1 };
}

}
#endif
