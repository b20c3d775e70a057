// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the parts of PixelIntegrator share: differences of colours, and how far errors are believed.
#ifndef penumbra_PixelErrors_h
#define penumbra_PixelErrors_h

#include "Sampling/CameraRayTracer.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

// A corner nearer to an edge than this, in pixels, may lie on either side of it for the ray.
inline constexpr double EdgePrecision = 1e-3;
// Errors that no pixel with a surface in it is believed to be below: rounding; and with edges in it,
// the precision to which a ray and an edge agree on a place.
inline constexpr float ErrorFloor = 2e-5f;
inline constexpr float EdgeErrorFloor = 1.5e-4f;
// The share of what the last comparison of samples saw that is believed to be left as an error, and
// by how much second differences are doubted: between the vertices of a mesh colours bend in kinks.
// Measured on a smooth scan, so that 95 % of tiles err by less than is believed.
inline constexpr float ResidualErrorFraction = 0.35f;
inline constexpr float CurvatureSafetyFactor = 3.f;

// How much more than each of a pixel's four corners a sample may err that stands for a share `area` of
// it, so that the independent errors of all samples add up to the same.
inline double ComputeToleranceScale(double area)
{
  return 0.5 / std::sqrt(area);
}

// How many well-spread samples bring the error of a pixel that straight borders cross, of any contrast,
// down to `tolerance`; a power of two, from 64 to 4,096. It is what such a pixel may cost.
inline int ComputeMaximumSamples(double tolerance)
{
  const double enough = std::pow(0.5 / std::max(tolerance, 1e-6), 4.0 / 3.0);
  int samples = 64;
  while (samples < enough && samples < 4096)
  {
    samples *= 2;
  }
  return samples;
}

inline float ComputeMaximumDifference(const glm::vec4& a, const glm::vec4& b)
{
  const glm::vec4 d = glm::abs(a - b);
  return std::max(std::max(d.r, d.g), std::max(d.b, d.a));
}

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

inline glm::dvec2 GetCornerOffset(int corner)
{
  return { corner & 1, corner >> 1 };
}

}
#endif
