// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// With L the radiance, the mean is F = 1/pi * integral of L cos. Where L jumps by dL across a
// boundary, F changes as the boundary moves. Let e be the unit normal of the boundary, in the
// tangent plane of the sphere of directions, toward the side with less radiance; dl its element; r
// the distance of the nearer side, whose edge it is; and w its direction. If the point moves by d,
// the projected edge moves by -d.e/r, so that
//
//   gradient  g = -1/pi * sum over boundaries of dL cos(w) e dl / r,
//
// of which the part in the tangent plane is kept. e dl = w x dw is linear in the path: a staircase
// along the sides of cells gives the same sum as the smooth boundary. Differentiating again with
// the edge fixed in space, the symmetric part that remains for closed edges is
//
//   Hessian   H = -4/pi * sum of dL cos(w) / r^2 * sym(w e^T) dl.
//
// The silhouette of a round object slides along the object as the point moves. H omits this term,
// because it is used for radii only. If the boundary is not an edge but the maximum distance R on a
// surface with normal m, it moves along m' = m - (m.w) w by -(m.d) / (R |m'|), a separate term.
//
// With a falloff D, the radiance of a hit at distance t in direction w is D(t), which changes by
// -D'(t) w.d as the point moves. Its mean over the hemisphere is added to g. To H it adds the mean
// of D'' w w^T + D'/t (1 - w w^T) and both mixed derivatives: the sums above of the jumps of -D' w.
#include "HemisphereEstimate.h"

#include "IrradianceConstants.h"
#include "Vectors.h"
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

/// Sums derivatives over the boundaries between cells.
class Boundaries
{
public:
  Boundaries(const HemisphereGrid& grid, const glm::mat3& frame,
    const std::vector<glm::vec3>& directions, const std::vector<HemisphereSample>& samples,
    const DistanceFalloff& falloff)
    : Grid(grid),
      ToLocal(glm::transpose(frame)),
      Directions(directions),
      Samples(samples),
      Falloff(falloff)
  {
  }

  /// Adds the side from corner `from` to corner `to` between cells `one` and `other`.
  void Add(int one, int other, glm::vec3 from, glm::vec3 to)
  {
    const bool oneIsNear = this->Samples[one].Distance <= this->Samples[other].Distance;
    const int near = oneIsNear ? one : other;
    const int far = oneIsNear ? other : one;
    const glm::vec3 step = this->Samples[near].Radiance - this->Samples[far].Radiance;
    if (step == glm::vec3(0.f))
    {
      return;
    }
    this->Variance += step * step *
      (.5f * VariancePerSide * (this->Samples[one].Variance + this->Samples[other].Variance));
    const glm::vec3 w = glm::normalize(from + to);
    glm::vec3 edgeNormal = glm::cross(w, to - from); // e dl
    const glm::vec3 offset = this->Directions[far] - this->Directions[near];
    if (glm::dot(edgeNormal, offset) < 0.f)
    {
      edgeNormal = -edgeNormal;
    }
    const float cosine = std::max(w.z, 0.f);
    glm::vec2 change;
    const float length = glm::length(edgeNormal);
    const float edgeDistance = this->EstimateEdgeDistance(
      near, far, std::abs(glm::dot(offset, edgeNormal)) / (2.f * length));
    const glm::vec3 m = this->ToLocal * this->Samples[near].Normal;
    const glm::vec3 slope = m - glm::dot(m, w) * w;
    const bool endsAtMaximumDistance = this->EndsAtMaximumDistance(near, far, m);
    if (endsAtMaximumDistance)
    {
      change = glm::vec2(m) *
        (-cosine * glm::dot(slope, edgeNormal) / glm::pi<float>() /
          (this->Falloff.Radius * std::max(glm::dot(slope, slope), MinimumSlope)));
    }
    else
    {
      change = glm::vec2(edgeNormal) * (-cosine / (glm::pi<float>() * edgeDistance));
    }
    for (int c = 0; c < 3; ++c)
    {
      this->Gradient[c] += step[c] * change;
    }
    const float largestStep = MaximumComponent(glm::abs(step));
    this->GradientSum += largestStep * cosine * length / edgeDistance;
    this->GradientSumOverDistance += largestStep * cosine * length / (edgeDistance * edgeDistance);
    const glm::vec3 shape = Symmetric(glm::vec2(w), glm::vec2(edgeNormal));
    // At the maximum distance the falloff is 0 everywhere, so that only one mixed derivative
    // remains.
    const glm::vec3 mixed = (endsAtMaximumDistance ? 1.f : 2.f) *
      Symmetric(this->ComputeFalloffGradient(near) - this->ComputeFalloffGradient(far), change);
    for (int c = 0; c < 3; ++c)
    {
      const float curvature =
        -4.f * cosine * step[c] / (glm::pi<float>() * edgeDistance * edgeDistance);
      this->HessianSums[c] += curvature * shape;
      this->HessianSums[c] += mixed;
    }
  }

  /// Adds the derivatives of the falloff within `cell`, which covers the fraction `fraction` of the
  /// hemisphere.
  void AddFalloff(int cell, float fraction)
  {
    const float distance = std::max(this->Samples[cell].Distance, MinimumEdgeDistance);
    if (this->Falloff.IsConstant() || std::isinf(distance))
    {
      return;
    }
    const glm::vec2 falloffGradient = fraction * this->ComputeFalloffGradient(cell);
    for (glm::vec2& gradient : this->Gradient)
    {
      gradient += falloffGradient;
    }
    const glm::vec2 w(this->Directions[cell]);
    const float slope = this->Falloff.Derivative(distance) / distance;
    const float curvature = this->Falloff.SecondDerivative(distance) - slope;
    const glm::vec3 sum = fraction * (curvature * Symmetric(w, w) + glm::vec3(slope, slope, 0.f));
    for (glm::vec3& hessian : this->HessianSums)
    {
      hessian += sum;
    }
  }

  /// Returns the maximum absolute eigenvalue of the Hessians of the channels.
  float ComputeHessianNorm() const
  {
    float largest = 0.f;
    for (const glm::vec3& hessian : this->HessianSums)
    {
      const float difference = hessian.x - hessian.y;
      const float norm = .5f *
        (std::abs(hessian.x + hessian.y) +
          std::sqrt(difference * difference + 4.f * hessian.z * hessian.z));
      largest = std::max(largest, norm);
    }
    return largest;
  }

  float OccluderEdgeDistance() const
  {
    return this->GradientSumOverDistance > 0.f ? this->GradientSum / this->GradientSumOverDistance
                                               : std::numeric_limits<float>::infinity();
  }

  glm::vec3 Variance{ 0.f };
  std::array<glm::vec2, 3> Gradient{};

private:
  /// Returns xx, yy, xy of the symmetric part of a b^T.
  static glm::vec3 Symmetric(glm::vec2 a, glm::vec2 b)
  {
    return { a.x * b.x, a.y * b.y, .5f * (a.x * b.y + a.y * b.x) };
  }

  /// Returns the derivative of the falloff in `cell` with respect to the position of the point.
  glm::vec2 ComputeFalloffGradient(int cell) const
  {
    const float distance = std::max(this->Samples[cell].Distance, MinimumEdgeDistance);
    return this->Falloff.IsConstant() || std::isinf(distance)
      ? glm::vec2(0.f)
      : -this->Falloff.Derivative(distance) * glm::vec2(this->Directions[cell]);
  }

  /// Estimates the distance of the edge of the surface hit in cell `near`. A planar surface is
  /// extended halfway to cell `far`; a curved one is assumed to end tangentially at the angle
  /// `gap`. The result is at most the distance of the hit in `far`.
  float EstimateEdgeDistance(int near, int far, float gap) const
  {
    const float distance = this->Samples[near].Distance;
    const glm::vec3 m = this->ToLocal * this->Samples[near].Normal;
    const float nearCosine = glm::dot(m, this->Directions[near]);
    float stretch = 1.f;
    if (IsFlat(this->Grid, this->Samples, near))
    {
      const float between = nearCosine + glm::dot(m, this->Directions[far]);
      stretch = between * nearCosine > 0.f ? 2.f * nearCosine / between : MaximumEdgeFactor;
    }
    else if (m != glm::vec3(0.f))
    {
      const float sine = std::min(std::abs(nearCosine), 1.f);
      stretch = 1.f + gap * sine / std::max(1.f - std::sqrt(1.f - sine * sine), 1e-6f);
    }
    const float edgeDistance =
      std::max(distance * std::min(stretch, MaximumEdgeFactor), this->Samples[near].OccluderEdge);
    return std::max(std::min(edgeDistance, this->Samples[far].Distance), MinimumEdgeDistance);
  }

  /// Returns true if `far` has no hit because the surface of `near` continues beyond the maximum
  /// distance.
  bool EndsAtMaximumDistance(int near, int far, glm::vec3 m) const
  {
    if (std::isinf(this->Falloff.Radius) || !std::isinf(this->Samples[far].Distance))
    {
      return false;
    }
    const float nearCosine = glm::dot(m, this->Directions[near]);
    const float farCosine = glm::dot(m, this->Directions[far]);
    return nearCosine * farCosine > 0.f && std::abs(nearCosine) > .1f &&
      this->Samples[near].Distance * nearCosine / farCosine >= this->Falloff.Radius;
  }

  const HemisphereGrid& Grid;
  glm::mat3 ToLocal;
  const std::vector<glm::vec3>& Directions;
  const std::vector<HemisphereSample>& Samples;
  DistanceFalloff Falloff;
  std::array<glm::vec3, 3> HessianSums{}; ///< xx, yy, xy of each channel
  float GradientSum = 0.f;                ///< sum of absolute gradients, of the channel that
                                          ///< changes most at each boundary
  float GradientSumOverDistance =
    0.f; ///< sum of absolute gradients, each over the distance of its edge
};

void AddBoundaries(const HemisphereGrid& grid, Boundaries& boundaries)
{
  const int side = grid.Side;
  for (int j = 0; j < side; ++j)
  {
    for (int i = 0; i < side; ++i)
    {
      const int cell = j * side + i;
      if (i + 1 < side)
      {
        boundaries.Add(cell, cell + 1, grid.Corner(i + 1, j), grid.Corner(i + 1, j + 1));
      }
      if (j + 1 < side)
      {
        boundaries.Add(cell, cell + side, grid.Corner(i, j + 1), grid.Corner(i + 1, j + 1));
      }
    }
  }
}

}

bool IsFlat(const HemisphereGrid& grid, const std::vector<HemisphereSample>& samples, int cell)
{
  const int i = cell % grid.Side;
  const int j = cell / grid.Side;
  const glm::vec3 normal = samples[cell].Normal;
  const auto agrees = [&](bool exists, int other) {
    return exists && std::abs(glm::dot(samples[other].Normal, normal)) > FlatCosine;
  };
  return agrees(i > 0, cell - 1) || agrees(i + 1 < grid.Side, cell + 1) ||
    agrees(j > 0, cell - grid.Side) || agrees(j + 1 < grid.Side, cell + grid.Side);
}

HemisphereEstimate EstimateHemisphere(const HemisphereGrid& grid, const glm::mat3& frame,
  const std::vector<glm::vec3>& directions, const std::vector<HemisphereSample>& samples,
  const DistanceFalloff& falloff)
{
  HemisphereEstimate result;
  result.Clearance.fill(std::numeric_limits<float>::infinity());
  const float fraction = 1.f / static_cast<float>(grid.Cells());
  std::array<glm::vec2, 3> rotation{};
  glm::dvec3 sum(0.0);
  double inverse = 0.0;
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    const HemisphereSample& sample = samples[cell];
    const glm::vec3 w = directions[cell];
    sum += sample.Radiance;
    for (int c = 0; c < 3; ++c)
    {
      rotation[c] += sample.Radiance[c] * grid.NormalDerivatives[cell];
    }
    if (std::isinf(sample.Distance))
    {
      continue;
    }
    inverse += 1.0 / std::max(sample.Distance, 1e-30f);
    if (w.z > GrazingCosine)
    {
      result.Nearest = std::min(result.Nearest, sample.Distance);
    }
    if (w.z < LowCosine && std::abs(glm::dot(sample.Normal, frame[2])) < SteepCosine)
    {
      float& clearance = result.Clearance[SectorOf(w.x, w.y)];
      clearance = std::min(clearance, sample.Distance * std::sqrt(1.f - w.z * w.z));
    }
  }
  result.Mean = glm::vec3(sum / static_cast<double>(grid.Cells()));
  if (inverse > 0.0)
  {
    result.HarmonicMean = static_cast<float>(grid.Cells() / inverse);
  }

  Boundaries boundaries(grid, frame, directions, samples, falloff);
  AddBoundaries(grid, boundaries);
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    boundaries.AddFalloff(cell, fraction);
  }
  result.Error = std::sqrt(MaximumComponent(boundaries.Variance)) * fraction;
  result.HessianNorm = boundaries.ComputeHessianNorm();
  result.OccluderEdgeDistance = boundaries.OccluderEdgeDistance();
  for (int c = 0; c < 3; ++c)
  {
    result.Translation[c] = frame * glm::vec3(boundaries.Gradient[c], 0.f);
    result.Rotation[c] = frame * glm::vec3(rotation[c], 0.f);
  }
  return result;
}

}
