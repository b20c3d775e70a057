// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Interface for sampling the hemisphere above a point, by tracing rays or by rasterizing a cube
// map. A gatherer returns one sample per direction of a grid. HemisphereEstimate.h computes
// irradiance, gradients and second derivatives from these samples.
#ifndef penumbra_Gatherer_h
#define penumbra_Gatherer_h

#include "Shading/DistanceFalloff.h"
#include "Shading/HemisphereSampling.h"
#include "vtkPenumbraFiltersIrradianceModule.h" // for export macro, which other modules need

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace penumbra
{

struct HemisphereGrid;

/// Result of sampling one direction of the hemisphere.
struct HemisphereSample
{
  float Distance = std::numeric_limits<float>::infinity(); ///< infinite if nothing was hit
  glm::vec3 Normal{ 0.f }; ///< unit normal of the hit, facing either side; 0 if unknown

  /// Incident radiance. For occlusion, the falloff (1 without falloff) of a hit and 0 for a miss.
  glm::vec3 Radiance{ 0.f };

  /// Distance at which a flat surface that continues toward its horizon ends; 0 if unknown.
  float OccluderEdge = 0.f;

  float Variance = 1.f; ///< of Radiance, relative to a single ray in the cell
};

/// Point on an emitter that may be smaller than a cell.
struct EmitterSample
{
  glm::vec3 Direction; ///< unit vector toward the emitter, scene coordinates
  float Distance;
  float Strength; ///< radiance, maximum over the channels

  /// Contribution to the mean over the hemisphere if the emitter is visible, divided by the cosine.
  float Contribution;

  int EmitterIndex; ///< samples of one emitter are consecutive
};

/// Orientation of a hemisphere.
struct TangentFrame
{
  TangentFrame(const glm::mat3& axes) // NOLINT(google-explicit-constructor): flat surfaces
    : Axes(axes),
      GeometricNormal(axes[2])
  {
  }
  TangentFrame(const glm::mat3& axes, glm::vec3 geometricNormal)
    : Axes(axes),
      GeometricNormal(geometricNormal)
  {
  }
  glm::mat3 Axes; ///< local to scene coordinates; the third axis is the shading normal
  glm::vec3 GeometricNormal;

  SurfaceNormals GetNormals() const { return { this->Axes[2], this->GeometricNormal }; }
};

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT Gatherer
{
public:
  virtual ~Gatherer();

  /// Appends samples of the emitters to `emitterSamples`, without testing their visibility from
  /// `point`.
  virtual void SampleEmitters(
    glm::vec3 /*point*/, std::vector<EmitterSample>& /*emitterSamples*/) const
  {
  }

  /// Samples `directions` (unit vectors, scene coordinates) from `point` on a surface. Directions
  /// below the surface are reflected. Fills `samples` with one sample per direction and returns
  /// the number of rays traced. Thread-safe; the result depends only on the arguments.
  virtual long long Gather(glm::vec3 point, const SurfaceNormals& normals,
    const std::vector<glm::vec3>& directions, std::vector<HemisphereSample>& samples) const = 0;

  /// Samples the cells of `grid`, oriented by `frame`. Fills `directions` (local coordinates) and
  /// `samples`, one per cell. The
  /// default implementation calls Gather() with one direction per cell, jittered by `seed`.
  virtual long long SampleHemisphere(glm::vec3 point, const TangentFrame& frame,
    const HemisphereGrid& grid, std::uint32_t seed, std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& samples) const;

  /// Returns true if SampleHemisphere() costs the same for every grid size and averages over whole
  /// cells. A preceding coarse grid or supersampling of cells then has no benefit.
  virtual bool SamplesGridAtOnce() const { return false; }

  /// Returns the maximum distance in scene units, which may be infinite, and the distance falloff,
  /// which the radiance of the samples already includes.
  virtual DistanceFalloff GetFalloff() const = 0;
  float GetRadius() const { return this->GetFalloff().Radius; }
};

}
#endif
