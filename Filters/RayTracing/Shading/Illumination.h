// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Diffuse illumination of a scene: emission, direct light, interreflection between surfaces, and
// the environment. Means over the hemisphere are irradiance / pi: 1 under a sky of radiance 1.
#ifndef penumbra_Illumination_h
#define penumbra_Illumination_h

#include "EnvironmentMap.h"
#include "Shading.h"

#include <array>
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

/// An emissive triangle.
struct Emitter
{
  std::array<glm::vec3, 3> Corners;
  float Strength; ///< largest channel of its radiance
};

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT Illumination
{
public:
  /// `rays` must outlive this object.
  Illumination(const RayScene& rays, const IlluminationSettings& settings);

  /// Returns the mean incident radiance at a point, over the hemisphere about a normal (unit).
  using IrradianceFunction = std::function<glm::vec3(glm::vec3 point, glm::vec3 normal)>;

  /// Returns the radiance that arrives along `ray` (unit direction), whose first hit is `hit`:
  /// emission, reflected direct light and, if `irradiance` is not empty, reflected indirect light.
  /// Translucent surfaces are composited. Adds the number of rays traced to `rays`.
  glm::vec3 IncidentRadiance(
    Ray ray, Hit hit, const IrradianceFunction& irradiance, long long& rays) const;

  /// Contribution of the suns of the environment map to the mean over the hemisphere, which
  /// IncidentRadiance() excludes, and its standard error.
  struct Sunlight
  {
    glm::vec3 Mean{ 0.f };
    float Error = 0.f;
  };
  /// Estimates the contribution of the suns; stops when the estimated error is at most `tolerance`.
  Sunlight EstimateSunlight(
    glm::vec3 point, glm::vec3 normal, double tolerance, long long& rays) const;

  /// Returns an unbiased estimate of the contribution of the suns from one sample.
  glm::vec3 SampleSuns(
    glm::vec3 point, glm::vec3 normal, std::uint32_t& random, long long& rays) const;

  /// Returns an unbiased estimate, from one path, of the mean incident radiance with at most
  /// `bounces` - 1 reflections, including the suns.
  glm::vec3 TracePath(
    glm::vec3 point, glm::vec3 normal, int bounces, std::uint32_t& random, long long& rays) const;

  /// Returns a ray that starts at `point` on a surface, offset along the normal.
  static Ray SpawnRay(glm::vec3 point, glm::vec3 normal, glm::vec3 direction);

  /// Returns the emissive triangles. Returns none if there are more than MaximumEmitters, because
  /// only few triangles are likely to be small light sources that random rays miss, or if a sphere
  /// or tube is emissive.
  const std::vector<Emitter>& GetEmitters() const { return this->Emitters; }

  const RayScene& GetRays() const { return this->Rays; }
  const IlluminationSettings& GetSettings() const { return this->Settings; }

private:
  bool HasSuns() const { return this->Settings.Map && this->Settings.Map->HasSuns(); }
  glm::vec3 SunContribution(
    glm::vec3 point, glm::vec3 normal, glm::vec2 sample, long long& rays) const;

  const RayScene& Rays;
  Shading SurfaceShading;
  IlluminationSettings Settings;
  std::vector<Emitter> Emitters;
};

}
#endif
