// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Gathers by rays over Embree.
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

/// Unit normal of the triangle that was hit, either side; 0 of one without area.
glm::vec3 NormalAt(const Scene& scene, const Hit& hit);

/// Who looks by rays. What their hits mean is for derived classes to say, also of hits that were found
/// in another way.
class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT RayGatherer : public Gatherer
{
public:
  /// `scene` must outlive this object.
  explicit RayGatherer(const RayScene& scene)
    : Rays(scene)
  {
  }

  long long Gather(glm::vec3 point, glm::vec3 normal, const std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& sights) const override;

  /// What `rays` from `point` see, whose first hits are `hits`, lines and points left out, before the
  /// fall-off. Fills `sights` and returns how many more rays that took.
  virtual long long ShadeHits(glm::vec3 point, glm::vec3 normal, const std::vector<Ray>& rays,
    const std::vector<Hit>& hits, std::vector<HemisphereSample>& sights) const = 0;

  const RayScene& GetRays() const { return this->Rays; }

private:
  const RayScene& Rays;
};

/// Occlusion: radiance is the fall-off's share where something lies within reach, 0 elsewhere. Lines and
/// points do not block.
class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT OcclusionGatherer : public RayGatherer
{
public:
  /// `falloff` in scene units.
  OcclusionGatherer(const RayScene& scene, const DistanceFalloff& falloff);

  long long ShadeHits(glm::vec3 point, glm::vec3 normal, const std::vector<Ray>& rays,
    const std::vector<Hit>& hits, std::vector<HemisphereSample>& sights) const override;
  DistanceFalloff GetFalloff() const override { return this->Counting; }

private:
  DistanceFalloff Counting;
};

/// Light: what surfaces emit, reflect of the lights and, where `arriving` is given, of what
/// arrives at them; the environment elsewhere, its suns left out, which are asked for where light is
/// asked for. Looks through lines and points.
class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT LightGatherer : public RayGatherer
{
public:
  /// What is known of the light that arrives at a point of a surface: the mean over the hemisphere
  /// about a normal, suns left out; nothing where it is not known.
  using KnownLight = std::function<std::optional<glm::vec3>(glm::vec3 point, glm::vec3 normal)>;

  /// `arriving`: the light that arrives at surfaces after at most `bounces` - 1 reflections; where
  /// it is not known, a single path answers. Empty: none arrives. `light`, and what `arriving`
  /// refers to, must outlive this object.
  LightGatherer(const Illumination& light, KnownLight arriving, int bounces);

  void SampleEmitters(glm::vec3 point, std::vector<EmitterSample>& beams) const override;
  long long ShadeHits(glm::vec3 point, glm::vec3 normal, const std::vector<Ray>& rays,
    const std::vector<Hit>& hits, std::vector<HemisphereSample>& sights) const override;
  DistanceFalloff GetFalloff() const override { return {}; }

private:
  const Illumination& Light;
  KnownLight Known;
  int Bounces;
};

}
#endif
