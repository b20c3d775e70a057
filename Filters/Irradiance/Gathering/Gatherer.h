// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Who looks around from a point: rays, or a rasterised cube map. A gatherer answers a grid of
// directions; what follows from the answers (irradiance, gradients, radii) is found in one place,
// Derivatives.
#ifndef penumbra_Gatherer_h
#define penumbra_Gatherer_h

#include "Shading/DistanceFalloff.h"
#include "vtkPenumbraFiltersIrradianceModule.h" // for export macro, which other modules need

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace penumbra
{

struct HemisphereGrid;

/// What is seen in one direction.
struct HemisphereSample
{
  float Distance = std::numeric_limits<float>::infinity(); ///< infinity: nothing within reach
  glm::vec3 Normal{ 0.f }; ///< of what was met, unit, either side; 0 where unknown
  glm::vec3 Radiance{
    0.f
  }; ///< that comes from there; under occlusion 1 (or less, with a fall-off) where blocked, else 0
  float OccluderEdge =
    0.f; ///< where a flat surface that goes on towards its horizon ends; 0: not known
  float Variance = 1.f; ///< of Radiance, over that of a single ray in its cell
};

/// Where a lamp may be seen that is smaller than a cell.
struct EmitterSample
{
  glm::vec3 Direction; ///< unit, scene coordinates
  float Distance;
  float Strength;   ///< radiance, greatest channel
  float Share;      ///< of the mean over the hemisphere, if nothing lies between, over the cosine
  int EmitterIndex; ///< beams of one lamp follow each other
};

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT Gatherer
{
public:
  virtual ~Gatherer();

  /// Appends what of lamps may be seen from `point`, whatever lies between.
  virtual void SampleEmitters(glm::vec3 /*point*/, std::vector<EmitterSample>& /*beams*/) const {}

  /// What `directions` (unit, scene coordinates) see from `point`, a point just above a surface with
  /// `normal`. Fills `sights`, one for each direction, and returns how many rays that took. Called
  /// from many threads at once; the answer depends on nothing but the arguments.
  virtual long long Gather(glm::vec3 point, glm::vec3 normal,
    const std::vector<glm::vec3>& directions, std::vector<HemisphereSample>& sights) const = 0;

  /// What the cells of `grid` show about `frame` (from local to scene coordinates, its third axis the
  /// normal). Fills `directions` (local) and `sights`, one for each cell. Unless overridden asks for
  /// one direction a cell, which `seed` jitters. Otherwise like Gather().
  virtual long long SampleHemisphere(glm::vec3 point, const glm::mat3& frame,
    const HemisphereGrid& grid, std::uint32_t seed, std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& sights) const;

  /// Look() costs the same whatever the grid, and shows cells as a whole: a coarse look before, or a
  /// closer one behind, gains nothing.
  virtual bool SamplesGridAtOnce() const { return false; }

  /// How far it looks, in scene units, infinite without a limit; and how much of the radiance of what
  /// is met there counts, which is in the sights' radiance already.
  virtual DistanceFalloff GetFalloff() const = 0;
  float GetReach() const { return this->GetFalloff().Radius; }
};

}
#endif
