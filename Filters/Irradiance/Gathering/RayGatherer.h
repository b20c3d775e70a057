// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Gatherers that trace rays with Embree.
#ifndef penumbra_RayGatherer_h
#define penumbra_RayGatherer_h

#include "Gatherer.h"
#include "Shading/Illumination.h"
#include "vtkPenumbraFiltersIrradianceModule.h" // for export macro, which tests need

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace penumbra
{

/// Returns the unit normal of the triangle that was hit, facing either side; 0 for a degenerate
/// triangle.
glm::vec3 NormalAt(const RayScene& rays, const Ray& ray, const Hit& hit);

/// Base class of gatherers that trace rays. Derived classes shade the hits. Other gatherers use
/// ShadeHits() for hits that they find without rays.
class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT RayGatherer : public Gatherer
{
public:
  /// `scene` must outlive this object.
  explicit RayGatherer(const RayScene& scene)
    : Rays(scene)
  {
  }

  long long Gather(glm::vec3 point, const SurfaceNormals& normals,
    const std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& samples) const override;

  /// Shades `hits`, the first hits of `rays` from `point` without lines and points. Fills
  /// `samples`, with radiance before the distance falloff, and returns the number of additional
  /// rays traced.
  virtual long long ShadeHits(glm::vec3 point, const SurfaceNormals& normals,
    const std::vector<Ray>& rays, const std::vector<Hit>& hits,
    std::vector<HemisphereSample>& samples) const = 0;

  const RayScene& GetRays() const { return this->Rays; }

private:
  const RayScene& Rays;
};

/// Gatherer of occlusion. Radiance is the distance falloff of a hit and 0 for a miss. Lines and
/// points do not occlude.
class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT OcclusionGatherer : public RayGatherer
{
public:
  /// `falloff` in scene units.
  OcclusionGatherer(const RayScene& scene, const DistanceFalloff& falloff);

  long long ShadeHits(glm::vec3 point, const SurfaceNormals& normals, const std::vector<Ray>& rays,
    const std::vector<Hit>& hits, std::vector<HemisphereSample>& samples) const override;
  DistanceFalloff GetFalloff() const override { return this->Falloff; }

private:
  DistanceFalloff Falloff;
  bool Translucent; ///< the scene has translucent occluders
};

/// Gatherer of light. Radiance of a hit is emitted light, reflected light of the lights, and
/// reflected indirect light if `arriving` is set. Radiance of a miss is the environment without its
/// suns. Suns and small emitters are sampled separately. Rays pass through lines and points.
class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT LightGatherer : public RayGatherer
{
public:
  /// Looks up the mean radiance over the hemisphere at a point, without suns and sampled emitters.
  /// Returns nothing if no value is cached for the point.
  using LightLookup =
    std::function<std::optional<glm::vec3>(glm::vec3 point, const SurfaceNormals& normals)>;

  /// `arriving` looks up the incident light at surfaces after at most `bounces` - 1 reflections. If
  /// it returns nothing, a single path is traced. If it is empty, surfaces reflect no indirect
  /// light. `light` and the objects that `arriving` refers to must outlive this object.
  LightGatherer(const Illumination& light, LightLookup arriving, int bounces);

  void SampleEmitters(glm::vec3 point, std::vector<EmitterSample>& emitterSamples) const override;
  long long ShadeHits(glm::vec3 point, const SurfaceNormals& normals, const std::vector<Ray>& rays,
    const std::vector<Hit>& hits, std::vector<HemisphereSample>& samples) const override;
  DistanceFalloff GetFalloff() const override { return {}; }

private:
  const Illumination& Light;
  LightLookup IncidentLight;
  int Bounces;
};

}
#endif
