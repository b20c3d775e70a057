// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One smooth boundary between the visible and the hidden part of a light.
#ifndef penumbra_PenumbraBoundary_h
#define penumbra_PenumbraBoundary_h

#include "HemisphereSampling.h"
#include "PenumbraNeighbors.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace penumbra
{

/// Returns the visibility of a point of the unit disk, in [0, 1].
using DiskVisibility = std::function<float(glm::vec2)>;

/// Area of a cap of the unit disk with half the central angle `half`, as a fraction of the disk.
float CapArea(float half);

inline glm::vec2 OnCircle(float angle)
{
  return { std::cos(angle), std::sin(angle) };
}

inline bool IsBinary(float value)
{
  return value == 0.f || value == 1.f;
}

/// Angle by which the points on the circumference and those inside are rotated, so that errors of
/// neighbors are independent.
float ComputeCircleOffset(std::uint32_t seed);

/// Points inside the disk. Together with 8 points on the circumference, few wires and few small
/// occluders are between them.
class InteriorPointSet
{
public:
  explicit InteriorPointSet(std::uint32_t seed)
    : Axis(OnCircle(ComputeCircleOffset(seed))),
      First(MixBits(seed))
  {
  }
  glm::vec2 At(std::uint32_t index) const;

private:
  glm::vec2 Axis;
  std::uint32_t First; ///< point with index 0
};

/// A circular arc between two points on the circumference. All positions are brackets that
/// visibility tests make narrower. The circumference is visible from `Begin` counterclockwise to
/// `End`; each bracket has a hidden and a visible end.
class PenumbraBoundary
{
public:
  /// A coarser boundary does not pass its checks, and samples take more rays (measured).
  static constexpr float LargestTolerance = 0.03f;

  PenumbraBoundary(const DiskVisibility& visibility, std::uint32_t seed, float tolerance)
    : Visibility(visibility),
      Seed(seed),
      Tolerance(std::min(tolerance, LargestTolerance))
  {
  }

  /// Sets the brackets of the ends, in radians.
  void SetEnds(glm::vec2 begin, glm::vec2 end);

  /// Tests if the ends are where `arc` predicts them, or near by. Returns false if they are not.
  bool FindEnds(const PenumbraArc& arc);

  /// Narrows the brackets until the estimated error is at most the tolerance. Returns false if the
  /// boundary is not one smooth curve, which `checkPoints` points of the disk check, or if the
  /// visibility is neither 0 nor 1. Without the support of neighbors that have one boundary, too, a
  /// small cap is tested more closely.
  bool Refine(int checkPoints, bool isSupported);

  float GetArea() const;
  float GetError() const;
  PenumbraArc GetArc() const;

private:
  float HalfAngle() const;
  float HalfLength() const { return std::abs(std::sin(this->HalfAngle())); }
  /// Angle of the direction from the middle of the chord to the visible side.
  float AxisAngle() const
  {
    return 0.25f * (this->Begin.x + this->Begin.y + this->End.x + this->End.y);
  }
  bool IsWide() const;
  float SagittaWidth() const { return this->Middle.y - this->Middle.x; }
  float Sagitta() const { return 0.5f * (this->Middle.x + this->Middle.y); }
  float EstimateEndError() const;
  /// Returns the bracket of each end that meets the tolerance.
  float ComputeEndWidth(float halfLength) const;
  float EstimateSagittaError() const;
  glm::vec2 At(float along, float across) const;
  float SignedDistance(glm::vec2 point) const;
  bool FindEnd(float angle, float width, float random, float before, glm::vec2& bracket) const;
  bool NarrowEnds();
  bool IsClosed() const;
  bool BracketSagitta(float low, float high);
  bool FindSagitta();
  bool Check(int points) const;

  const DiskVisibility& Visibility;
  std::uint32_t Seed;
  float Tolerance;
  glm::vec2 Begin{ 0.f };
  glm::vec2 End{ 0.f };
  glm::vec2 Middle{ 0.f }; ///< bracket of the sagitta: hidden side of x, visible side of y
  float PredictedCurvature = 0.f;
  bool IsSupported = false; ///< neighbors have one boundary, too
};

}
#endif
