// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Diffuse illumination of a scene: emission, direct light, interreflection between surfaces, and
// the environment. Means over the hemisphere are irradiance / pi: 1 under a sky of radiance 1.
#ifndef penumbra_Illumination_h
#define penumbra_Illumination_h

#include "EnvironmentMap.h"
#include "HemisphereSampling.h"
#include "Lights/EmitterTree.h"
#include "Shading.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace penumbra
{
struct IlluminationSettings
{
  glm::vec3 Environment{ 0.f };              ///< radiance of rays that hit nothing
  std::shared_ptr<const EnvironmentMap> Map; ///< replaces Environment if not null
  float Albedo = .5f;   ///< fraction of light that a white surface reflects, in [0, 1]
  int Bounces = 1;      ///< reflections of a path, including the one toward the camera
  bool Shadows = false; ///< if on, lights cast shadows

  bool operator==(const IlluminationSettings& other) const
  {
    return this->Environment == other.Environment && this->Map == other.Map &&
      this->Albedo == other.Albedo && this->Bounces == other.Bounces &&
      this->Shadows == other.Shadows;
  }
};

/// A point of a surface, and the point of the unit square that selects the sample of the suns and emitters there.
struct LightReceiver
{
  glm::vec3 Position{ 0.f };
  SurfaceNormals Normals{ glm::vec3(0.f) };
  glm::vec2 Sample{ 0.f };
  Hit Where; ///< of the surface, where known
};

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT Illumination
{
public:
  /// `rays` must outlive this object.
  Illumination(const RayScene& rays, const IlluminationSettings& settings);

  /// Returns the mean incident radiance at a point, over the hemisphere about its shading normal.
  using IrradianceFunction = std::function<glm::vec3(glm::vec3, const SurfaceNormals&)>;

  /// Returns the radiance that arrives along `ray` (unit direction), whose first hit is `hit`: emission, reflected
  /// direct light and, if `irradiance` is not empty, reflected indirect light. Translucent surfaces are composited; the
  /// reflected indirect light of several layers is that of one of them, chosen with the probability of its weight.
  /// `normal` (unit) is the axis of the cosine-distributed rays. The emission of sampled emitters is multiplied by the
  /// weight of these rays, see EstimateSampledLight(). Adds the number of rays traced to `rays`.
  glm::vec3 IncidentRadiance(Ray ray, Hit hit, glm::vec3 normal,
    const IrradianceFunction& irradiance, long long& rays) const;

  /// Contribution to the mean over the hemisphere that IncidentRadiance() excludes, and its standard error.
  struct SampledLight
  {
    glm::vec3 Mean{ 0.f };
    float Error = 0.f; ///< of the channel with the largest error
  };
  /// Estimates the light of the suns of the environment map and of emitters by rays toward them. Stops when the
  /// estimated error is at most `tolerance`. Emitters are sampled if they are small and bright, see EmitterThreshold.
  /// Their light is split between these rays and those of IncidentRadiance() by multiple importance sampling with the
  /// power heuristic (Veach, Robust Monte Carlo Methods, 1997, section 9.2), as if both were equally many.
  SampledLight EstimateSampledLight(
    glm::vec3 point, const SurfaceNormals& normals, double tolerance, long long& rays) const;

  /// Computes estimates of it at `count` <= 16 points, from one sample of the suns and of the emitters each; unbiased,
  /// but rays from a known hit may start at its curved surface, see LiftRayStart().
  void SampleLights(const LightReceiver* receivers, std::uint32_t count, glm::vec3* estimates,
    long long& rays) const;
  /// The same at one point with a random sample.
  glm::vec3 SampleLights(
    glm::vec3 point, const SurfaceNormals& normals, std::uint32_t& random, long long& rays) const;

  /// Returns an unbiased estimate, from one path, of the mean incident radiance with at most `bounces` - 1 reflections,
  /// including suns and sampled emitters. Under suns, its last ray is traced at random.
  glm::vec3 TracePath(glm::vec3 point, const SurfaceNormals& normals, int bounces,
    std::uint32_t& random, long long& rays) const;

  /// Lets last rays from where no sun is seen be traced at random, too, as `tolerance` of means of `paths` permits.
  void AcceptNoise(double tolerance, double paths);

  /// TracePath() without the suns and sampled emitters that `point` sees. The first ray is `ray`, distributed by the
  /// cosine to `normal`, and ends at `hit`.
  glm::vec3 FollowPath(const Ray& ray, const Hit& hit, glm::vec3 normal, int bounces,
    std::uint32_t& random, long long& rays) const;

  /// Returns a ray from `point` on a surface, offset along the geometric normal. Directions below it are reflected.
  static Ray SpawnRay(glm::vec3 point, const SurfaceNormals& normals, glm::vec3 direction);

  /// Returns the emissive triangles that are not sampled. Returns none if there are more than MaximumEmitters, because
  /// only few triangles are likely to be missed by random rays, or if a sphere or tube is among them.
  const std::vector<Emitter>& GetEmitters() const { return this->Emitters; }

  /// Radiances of the light sources of a scene, of the largest channel; 1 if all are 0.
  struct SourceRadiance
  {
    /// Mean, to which tolerances can be relative: the larger of the environment, averaged over the sphere, and the
    /// emission, averaged over all surfaces (see EmissiveSurfaces::MeanRadiance).
    double Mean = 1.0;

    /// Largest that random rays meet: of the environment without its suns, of emitters that are not sampled, and of
    /// surfaces under the lights and suns. The noise of gathered light is proportional to it.
    double Largest = 1.0;
  };
  const SourceRadiance& GetSourceRadiance() const { return this->Sources; }
  const RayScene& GetRays() const { return this->Rays; }
  const IlluminationSettings& GetSettings() const { return this->Settings; }

private:
  bool HasSuns() const { return this->Settings.Map && this->Settings.Map->HasSuns(); }
  bool HasSampledEmitters() const
  {
    return this->SampledEmitters && !this->SampledEmitters->IsEmpty();
  }

  /// Rays toward samples of the suns, and of the emitters, see SampledLight.cxx.
  class SunRays;
  class EmitterRays;
  template <typename Source>
  void AddSamples(const LightReceiver* receivers, std::uint32_t count, glm::vec3* estimates,
    long long& rays) const;
  template <typename Source>
  void AddEstimate(const LightReceiver& at, std::uint32_t seed, double tolerance,
    SampledLight& result, long long& rays) const;
  void FindEmitters();
  void FindSourceRadiance(double emitted);

  const RayScene& Rays;
  Shading SurfaceShading;
  IlluminationSettings Settings;
  std::vector<Emitter> Emitters;
  std::shared_ptr<const EmitterTree> SampledEmitters; ///< null if there are none
  std::vector<char> PlainEmitters; ///< of each surface, see IsPlainEmitter() in Illumination.cxx
  SourceRadiance Sources;
  float UnlitProbability = 1.f; ///< of last rays, where no sun is seen
  float LastRadiance = 0.f;     ///< which the last rays of paths may meet, under suns
};

}
#endif
