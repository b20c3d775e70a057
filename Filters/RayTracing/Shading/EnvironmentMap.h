// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Environment map in latitude-longitude projection with constant texels. It is the sum of two
// parts: radiance clamped to a threshold, which rays in all directions sample with little noise,
// and the suns, the excess of bright texels over the threshold, which are sampled by importance.
#ifndef penumbra_EnvironmentMap_h
#define penumbra_EnvironmentMap_h

#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace penumbra
{

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT EnvironmentMap
{
public:
  /// `radiances`: one value per texel, bottom row first. As in VTK, each row starts at -`right`,
  /// has `right` in the middle and `right` x `up` at three quarters. `up` and `right` must be
  /// orthonormal.
  EnvironmentMap(
    int width, int height, std::vector<glm::vec3> radiances, glm::dvec3 up, glm::dvec3 right);

  /// Returns the radiance from `direction` (unit) without the suns.
  glm::vec3 ClampedRadiance(glm::vec3 direction) const;

  /// Returns the mean radiance over the sphere, with the suns, of the largest channel of each texel.
  double GetMeanRadiance() const { return this->MeanRadiance; }

  /// Returns the largest radiance of ClampedRadiance() in any channel.
  double GetLargestRadiance() const { return this->LargestRadiance; }

  bool HasSuns() const { return !this->Suns.empty(); }

  /// Sample of the suns: a direction, distributed in proportion to their excess radiance.
  struct Sun
  {
    glm::vec3 Direction;
    glm::vec3 Weight; ///< radiance / pdf; its mean is the irradiance on a plane that faces the suns
  };
  /// Maps a point of the unit square to a sample of the suns.
  Sun SampleSun(glm::vec2 sample) const;

private:
  /// Returns the direction of a horizontal image coordinate in [0, 1] and a sine of latitude in
  /// [-1, 1].
  glm::vec3 ComputeDirection(double u, double sine) const;
  /// Returns the sine of the latitude of the lower edge of a row.
  double ComputeSineOfLatitude(int row) const;

  int Width;
  int Height;
  std::vector<glm::vec3> ClampedRadiances;
  glm::dvec3 Up;
  glm::dvec3 Right;
  glm::dvec3 Forward; ///< Right x Up

  /// A texel brighter than the threshold.
  struct SunTexel
  {
    int Texel;
    glm::vec3 Color;   ///< normalized to a largest channel of 1
    double Cumulative; ///< CDF: sum over earlier suns of excess (largest channel) times solid angle
  };
  std::vector<SunTexel> Suns;
  double Total = 0.0;
  double MeanRadiance = 0.0;
  double LargestRadiance = 0.0;
};

}
#endif
