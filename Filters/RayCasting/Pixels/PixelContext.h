// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One pixel with the samples at its four corners, and the rays that are traced in it.
#ifndef penumbra_PixelContext_h
#define penumbra_PixelContext_h

#include "Edges/UnsteadyNormals.h"
#include "IntegrationSettings.h"
#include "Sampling/CornerGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace penumbra
{

/// State that all integrators of a pixel share. Each thread needs its own object.
class PixelContext
{
public:
  PixelContext(
    const CameraRayTracer& tracer, const CornerGrid& corners, const IntegrationSettings& settings);

  /// Moves to a pixel without its corners, which may not have been traced.
  void MoveTo(glm::ivec2 pixel) { this->Position = pixel; }

  /// Moves to a pixel and loads its corners.
  void Load(glm::ivec2 pixel);

  /// Traces a sample at `local` in the unit square, which represents the fraction `area` of the pixel.
  Sample Trace(glm::dvec2 local, double area = 1.0);

  /// Forgets what predicts penumbrae.
  void ForgetNeighbors() { this->Neighbors.clear(); }
  /// Returns the penumbrae in this pixel, which predict each other, or null if there are none.
  std::vector<PenumbraNeighbors>* GetNeighbors(std::uint32_t penumbrae);

  glm::dvec2 GetOrigin() const { return glm::dvec2(this->Position); }
  const std::vector<Surface>& GetSurfaces() const { return this->Tracer.GetRays().GetSurfaces(); }
  /// Returns the side length of a pixel at a distance from the origin of a ray, in scene units.
  double ComputePixelSize(double distance) const;

  /// Returns true if all corners are on one surface, or on the background.
  bool CornersAgree() const;

  /// Traces the corners that are not trusted again at a position slightly inside the pixel: the ray
  /// of a corner may hit either side of an edge along a side of the pixel.
  void RetraceCornersOnEdges();

  /// Traces a single corner that differs from the other three again slightly inside the pixel: a ray
  /// exactly through a vertex or an edge can miss both triangles. Returns true if it then agrees.
  bool RetraceIsolatedMiss();

  /// Returns the largest difference between the colors of `sample` and of the corners whose bits
  /// are set in `corners`; at least 1 if one of them is on another surface.
  float ComputeVariation(unsigned int corners, const Sample& sample) const;

  /// Returns true if the color is constant over the triangle that was hit, or over the background. A
  /// medium makes it vary.
  bool IsConstant(const Hit& hit) const
  {
    return !this->Tracer.HasShafts() && this->IsConstantBehindMedium(hit);
  }
  bool IsConstantBehindMedium(const Hit& hit) const;

  /// Returns true if the corners are on a surface that no further corner shows along one of the
  /// axes. Second differences are unknown then: the corners of a small sphere agree if it is in the
  /// middle of the pixel. Round shapes are told apart, but not parts of one mesh. Returns false if the corners are on
  /// one triangle of constant color.
  bool IsIsolated() const;

  /// Estimates the error of the mean of the corners from second differences.
  float EstimateCurvatureError() const;

  /// Returns true if a shadow boundary may cross the pixel: a corner of this pixel or of a neighbor
  /// shows one.
  bool IsNearShadowBoundary() const;

  /// Returns true if `test` is true for a corner of this pixel or of its neighbors.
  template <typename Test>
  bool AnyNeighborCorner(const Test& test) const
  {
    const glm::ivec2 low = glm::max(this->Position - 1, this->Grid.GetLow());
    const glm::ivec2 high = glm::min(this->Position + 2, this->Grid.GetHigh());
    for (int y = low.y; y <= high.y; ++y)
    {
      for (int x = low.x; x <= high.x; ++x)
      {
        if (test(this->Grid.At(x, y)))
        {
          return true;
        }
      }
    }
    return false;
  }

  /// Sets the errors of a pixel: an error of coverage and shading, and the noise of sampled colors.
  /// About four colors are averaged per pixel, which halves the noise.
  void SetErrors(float error, float floor, PixelResult& result) const
  {
    result.LightError = 0.5f * static_cast<float>(this->Noise);
    result.Error = std::max(std::hypot(error, result.LightError), floor);
  }

  const CameraRayTracer& Tracer;
  const CornerGrid& Grid;
  const IntegrationSettings Settings;
  mutable RayCounts Rays; ///< those that only choose a method included
  /// Hits through each corner, front to back: memory that the choice of a method reuses in each pixel.
  mutable std::array<std::vector<Hit>, 4> Layers;
  PixelCounts Pixels;

  glm::ivec2 Position{ 0 };
  Sample Corners[4];       ///< (0, 0), (1, 0), (0, 1), (1, 1)
  float MediumError = 0.f; ///< maximum estimated error of the medium over the corners
  double Noise;            ///< standard error of sampled colors: Settings.Noise and penumbrae
  /// Bits of the corners farther than EdgePrecision from all edges.
  unsigned int TrustedCorners = 0;
  Steadiness LeastSteady = Steadiness::Steady; ///< of the triangles that faces show

private:
  std::vector<PenumbraNeighbors> Neighbors; ///< one for each light
};

}
#endif
