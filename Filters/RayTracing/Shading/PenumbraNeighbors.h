// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Prediction of the boundary that divides a light from the boundaries at neighboring points, which
// are in a block of 4 x 4 pixel corners.
#ifndef penumbra_PenumbraNeighbors_h
#define penumbra_PenumbraNeighbors_h

#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

/// Circular arc that divides the unit disk of a light.
struct PenumbraArc
{
  float Axis = 0.f;     ///< angle of the direction from the middle of the chord to the visible side
  float Distance = 0.f; ///< of the chord from the center, along the axis; beyond -1 or 1: no chord
  float Curvature = 0.f; ///< 1 / radius, positive if the arc bulges toward the hidden side
};

/// Results at the points of one block, in the order in which they are estimated.
class VTKPENUMBRAFILTERSRAYTRACING_EXPORT PenumbraNeighbors
{
public:
  /// Sets the position of the next estimate.
  void MoveTo(glm::vec2 position) { this->Position = position; }

  /// Adds the result at the position.
  void Add(const PenumbraArc& arc);

  /// Adds a point from which all of the light has the visibility `value`.
  void AddUniform(float value)
  {
    this->Uniform[0] = this->Uniform[0] || value == 0.f;
    this->Uniform[1] = this->Uniform[1] || value == 1.f;
    this->IsDoubtful = this->IsDoubtful || !this->Complex;
  }
  /// Returns true if `value` is 0 or 1 and has been added.
  bool HasUniform(float value) const
  {
    return (this->Uniform[0] && value == 0.f) || (this->Uniform[1] && value == 1.f);
  }

  /// Returns true if one boundary divides the light at a point.
  bool HasBoundary() const { return !this->Entries.empty(); }

  /// Reports that the light is divided by more than one boundary.
  void SetComplex() { this->Complex = true; }
  bool IsComplex() const { return this->Complex; }

  /// Returns true if the points of the block must be estimated once more: no boundary was found at some
  /// of them before more than one was found at another.
  bool NeedsNextPass() const { return this->Complex && this->IsDoubtful; }

  /// Discards the results, except that the light is divided by more than one boundary.
  void BeginNextPass();

  /// Predicts the arc at the position by a linear fit. Returns false if there is no result yet.
  bool Predict(PenumbraArc& arc) const;

private:
  struct Entry
  {
    glm::vec2 Position;
    PenumbraArc Arc;
  };
  std::vector<Entry> Entries;
  glm::vec2 Position{ 0.f };
  bool Complex = false;
  bool IsDoubtful = false; ///< a uniform result is wrong if another is complex
  bool Uniform[2] = { false, false };
};

}
#endif
