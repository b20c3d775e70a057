// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Environment map in latitude-longitude projection with constant texels. It is the sum of two
// parts: radiance clamped to a threshold, which rays in all directions sample with little noise,
// and the suns, the excess of bright texels over the threshold. These are sampled in proportion to
// their radiance and solid angle, with the piecewise constant 2-D distribution of Pharr, Jakob and
// Humphreys, Physically Based Rendering, 4th ed., section A.5. As the parts are disjoint, their
// estimates add without weights; Karlik et al., MIS Compensation, 2019, subtract from the sampled
// distribution what other samples already find.
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

  /// Returns the irradiance of the suns on a plane that faces them, of the largest channel.
  double GetSunIrradiance() const { return this->SunIrradiance; }

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
  /// Returns the fraction of the sphere that a texel of a row covers.
  double ComputeTexelWeight(int row) const;
  /// Returns the mean over the sphere of the smaller of `limit` and the largest channel.
  double ComputeClampedMean(double limit) const;
  /// Returns the radiance above which texels are suns: SunThreshold times the mean radiance without
  /// what exceeds it.
  double FindSunThreshold() const;

  int Width;
  int Height;
  std::vector<glm::vec3> ClampedRadiances;
  std::vector<double> SinesOfLatitude; ///< of the lower edges of the rows, and of the top
  glm::dvec3 Up;
  glm::dvec3 Right;
  glm::dvec3 Forward; ///< Right x Up

  /// A texel brighter than the threshold. Cumulative sums are of the excess (largest channel) times
  /// solid angle.
  struct SunTexel
  {
    int Column;
    glm::vec3 Color;   ///< normalized to a largest channel of 1
    double Cumulative; ///< of earlier texels in the same row
  };
  /// A row with such texels.
  struct SunRow
  {
    int Row;
    std::size_t First; ///< index into Suns
    double Cumulative; ///< of earlier rows
  };
  std::vector<SunTexel> Suns;
  std::vector<SunRow> SunRows;
  double SunIrradiance = 0.0;
  double MeanRadiance = 0.0;
  double LargestRadiance = 0.0;
};

}
#endif
