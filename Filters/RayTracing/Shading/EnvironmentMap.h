// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A picture of everything around, infinitely far: latitudes and longitudes, each texel one colour. It is
// cut in two, so that rays in all directions find the one and only few of them are needed for the other:
// the glow, bounded, and the suns, which is what of bright texels is above that bound.
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
  /// `radiances`: bottom row first, each row from behind `right` all the way round by `right` x `up`,
  /// `right` and its opposite, as VTK has it. `up` and `right`: orthonormal.
  EnvironmentMap(
    int width, int height, std::vector<glm::vec3> radiances, glm::dvec3 up, glm::dvec3 right);

  /// Radiance that comes from `direction` (unit), suns left out.
  glm::vec3 ClampedRadiance(glm::vec3 direction) const;

  bool HasSuns() const { return !this->Suns.empty(); }

  /// A direction, as likely as the suns are strong there.
  struct Sun
  {
    glm::vec3 Direction;
    glm::vec3
      Weight; ///< radiance over the likelihood of a direction: irradiance square to it, each
  };
  /// From a point of the unit square.
  Sun SampleSun(glm::vec2 at) const;

private:
  /// The direction of a place in the picture, both coordinates from 0 to 1; the second is that of the
  /// sine of the latitude.
  glm::vec3 DirectionOf(double across, double sine) const;
  double SineOfRow(int row) const;

  int Width;
  int Height;
  std::vector<glm::vec3> ClampedRadiances;
  glm::dvec3 Up;
  glm::dvec3 Right;
  glm::dvec3 Ahead;

  /// A texel that is above the bound.
  struct SunTexel
  {
    int Texel;
    glm::vec3 Color;   ///< its greatest channel 1
    double Cumulative; ///< greatest channels times solid angles of all suns before it
  };
  std::vector<SunTexel> Suns;
  double Total = 0.0;
};

}
#endif
