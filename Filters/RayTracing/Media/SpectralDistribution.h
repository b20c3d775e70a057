// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Distribution along a ray of the in-scattered light of all color channels together, so that one
// march serves all of them: the mean of the distributions of the channels, weighted by their light.
// In a gray medium it is that of one channel.
#ifndef penumbra_SpectralDistribution_h
#define penumbra_SpectralDistribution_h

#include "InScatteringDistribution.h"

#include <optional>

namespace penumbra
{

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT SpectralDistribution
{
public:
  /// As InScatteringDistribution, which describes the arguments.
  SpectralDistribution(const SpectralMedium& medium, const Light& light, glm::dvec3 origin,
    glm::dvec3 direction, double from, double to);

  /// Returns the in-scattered light, including the color of the light, if this fraction of each
  /// channel is lit.
  glm::vec3 ComputeLight(glm::dvec3 lit) const;

  ///@{
  /// Returns factors whose product bounds the light of each channel of the whole ray: the color of
  /// the light, and in-scattering. It also bounds the light of each channel per unit of the CDF.
  double GetBrightness() const { return this->Brightness; }
  double GetScatteredSum() const { return this->Sum; }
  ///@}

  bool IsGray() const { return this->Gray; }

  /// Point of the ray, with the in-scattered light up to it as a fraction of that of the ray.
  struct Point
  {
    double Parameter;            ///< t
    double CDF;                  ///< of all channels
    glm::dvec3 Fractions{ 0.0 }; ///< of each channel, if the medium is not gray
  };

  Point PointAt(double t) const;

  /// Returns the end of the ray, behind which light is neglected.
  Point End() const;

  /// Returns the point between `low` and `high` with this CDF: exact in a gray medium, otherwise
  /// within `accuracy`.
  Point Find(const Point& low, const Point& high, double cdf, double accuracy) const;

  /// Returns the point halfway between two points; if the medium is not gray, approximately.
  Point Middle(const Point& low, const Point& high) const;

  /// Returns the in-scattered light between two points, as a fraction of that of the ray in each
  /// channel.
  glm::dvec3 Between(const Point& low, const Point& high) const;

private:
  bool Gray;
  glm::vec3 Color;
  std::optional<InScatteringDistribution> Channels[3]; ///< empty: no light
  glm::dvec3 Integrals{ 0.0 };                         ///< spectral: including the color
  double Brightness = 1.0;
  double Sum = 0.0;
};

}
#endif
