// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Distribution along a ray of the light that a medium scatters from one unshadowed light toward
// the camera: the cumulative distribution of [Shafts eq. 1] and its inverse. For directional lights
// in a homogeneous medium or one that falls off with height it is a closed form, otherwise a table
// with exponential segments.
#ifndef penumbra_InScatteringDistribution_h
#define penumbra_InScatteringDistribution_h

#include "Medium.h"

#include <glm/glm.hpp>

#include <limits>
#include <vector>

namespace penumbra
{

struct Light;

/// Direction and distance from a point to a light.
struct LightDirection
{
  glm::dvec3 Direction{ 0.0 }; ///< unit
  double Distance = std::numeric_limits<double>::infinity();
  bool InCone = true; ///< if on, the point is in the cone of the spotlight
};
VTKPENUMBRAFILTERSRAYTRACING_EXPORT LightDirection DirectionToLight(
  const Light& light, glm::dvec3 point);

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT InScatteringDistribution
{
public:
  /// Computes the distribution along origin + t direction (unit) for t in [from, to], which must be
  /// inside the medium; `to` may be infinite. Light is attenuated from t back to `from`. The color
  /// of the light and the cone of a spotlight are not included.
  InScatteringDistribution(const Medium& medium, const Light& light, glm::dvec3 origin,
    glm::dvec3 direction, double from, double to);

  /// Returns the in-scattered light of the whole ray if it is unshadowed.
  double Integral() const { return this->Sum; }

  /// Returns the in-scattered light up to t, as a fraction of Integral().
  double CDF(double t) const;

  /// Returns the t at which CDF(t) = `fraction`.
  double InvertCDF(double fraction) const;

private:
  /// Segment of the ray in which the in-scattered light decreases as exp(-Slope (x - Begin)). The
  /// position x is t, or with a fall-off in closed form the column from `from` to t.
  struct Segment
  {
    double Begin;
    double Length;
    double Slope;
    double Extent; ///< integral of exp(-Slope (x - Begin))
    double Before; ///< in-scattered light before the segment
    double Weight; ///< in-scattered light of the segment
  };

  /// Position along the ray and the light scattered there per unit of length.
  struct Node
  {
    double Position;
    double Density;
  };

  double Density(double t) const;
  double ToPosition(double t) const;
  double FromPosition(double position) const;
  double ColumnFromCamera(double t) const;
  double FindEnd(double to) const;
  std::vector<double> FindTabulatedEnds() const;
  double Quadrature(double begin, double end) const;
  void AddExactSegments();
  void AddFalloffSegments();
  void AddTabulatedSegments();
  void AddAdaptiveSegments();
  void Refine(Node first, Node last, double weight, double tolerance, int levels);
  void AddSegment(double begin, double end, double slope, double weight);

  const Medium& ScatteringMedium;
  const Light& Source;
  const glm::dvec3 Origin;
  const glm::dvec3 Direction;
  const double From;
  const RayColumn Columns;
  const double To;
  bool IsInColumns = false; ///< positions are columns
  double Sum = 0.0;
  std::vector<Segment> Segments;
};

}
#endif
