// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How much of one light's light a medium scatters towards the eye along a ray, were nothing in the
// light's way: eq. 1 of [Shafts], cumulative, and its inverse. Under a directional light this is a
// closed form; under another it is a table whose pieces are exponentials.
#ifndef penumbra_InScatteringDistribution_h
#define penumbra_InScatteringDistribution_h

#include "Medium.h"
#include "Scene.h"

#include <limits>
#include <vector>

namespace penumbra
{

/// From a point to a light.
struct LightDirection
{
  glm::dvec3 Direction{ 0.0 }; ///< unit
  double Distance = std::numeric_limits<double>::infinity();
  bool InCone = true; ///< of a spot
};
VTKPENUMBRAFILTERSRAYTRACING_EXPORT LightDirection DirectionToLight(
  const Light& light, glm::dvec3 point);

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT InScatteringDistribution
{
public:
  /// Along origin + t direction (unit), t in [from, to], which must lie in the medium; `to` may be
  /// infinite. The light is seen from `from`, its colour is left out, and so is the cone of a spot.
  InScatteringDistribution(const Medium& medium, const Light& light, glm::dvec3 origin,
    glm::dvec3 direction, double from, double to);

  /// What a lit ray scatters in all.
  double Integral() const { return this->Sum; }

  /// What it scatters up to t, as a share of Total().
  double CDF(double t) const;

  /// The t up to which it scatters this share of Total().
  double InvertCDF(double share) const;

private:
  /// From Begin on the scattered light falls as exp(-Slope t).
  struct Segment
  {
    double Begin;
    double Length;
    double Slope;
    double Before; ///< scattered before the piece
    double Weight; ///< scattered in it
  };

  double Density(double t) const;
  void AddExactPieces();
  void AddTabulatedPieces();
  void AddPiece(double begin, double end, double slope, double weight);

  const Medium& Fog;
  const Light& Source;
  const glm::dvec3 Origin;
  const glm::dvec3 Direction;
  const double From;
  const double To;
  double Sum = 0.0;
  std::vector<Segment> Pieces;
};

}
#endif
