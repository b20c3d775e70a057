// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Diffuse light in a scene: what each surface sends where, how often it is passed on, and what comes
// from where nothing is. Means over the hemisphere are irradiance over pi: 1 under a sky of radiance 1.
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
  glm::vec3 Environment{ 0.f };                  ///< radiance from where nothing is
  std::shared_ptr<const EnvironmentMap> Picture; ///< instead of it; none: one colour
  float Albedo = .5f;                            ///< share that a white surface throws back, 0 to 1
  int Bounces = 1;      ///< reflections on the way to the eye, the last one included
  bool Shadows = false; ///< lights cast shadows

  bool operator==(const IlluminationSettings& other) const
  {
    return this->Environment == other.Environment && this->Picture == other.Picture &&
      this->Albedo == other.Albedo && this->Bounces == other.Bounces &&
      this->Shadows == other.Shadows;
  }
};

/// A triangle that shines by itself.
struct Emitter
{
  std::array<glm::vec3, 3> Corners;
  float Strength; ///< greatest channel of its radiance
};

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT Illumination
{
public:
  /// `rays` must outlive this object.
  Illumination(const RayScene& rays, const IlluminationSettings& settings);

  /// The mean that arrives at a point under the hemisphere about a normal (unit).
  using IrradianceFunction = std::function<glm::vec3(glm::vec3 point, glm::vec3 normal)>;

  /// Radiance that comes back along `ray` (its direction unit), whose first hit is `hit`: emitted,
  /// reflected of the lights, and of what is `arriving` where that is given; through translucent
  /// surfaces. Adds the rays that it traced to `rays`.
  glm::vec3 IncidentRadiance(
    Ray ray, Hit hit, const IrradianceFunction& arriving, long long& rays) const;

  /// What the suns of the environment's picture send to a point: their part of the mean over the
  /// hemisphere, which Along() leaves out, and its standard error.
  struct Sunlight
  {
    glm::vec3 Mean{ 0.f };
    float Error = 0.f;
  };
  /// To about the error `tolerance`.
  Sunlight EstimateSunlight(
    glm::vec3 point, glm::vec3 normal, double tolerance, long long& rays) const;

  /// One guess of it.
  glm::vec3 SampleSuns(
    glm::vec3 point, glm::vec3 normal, std::uint32_t& random, long long& rays) const;

  /// One path's guess of the mean that arrives after at most `bounces` - 1 reflections, suns included.
  glm::vec3 TracePath(
    glm::vec3 point, glm::vec3 normal, int bounces, std::uint32_t& random, long long& rays) const;

  /// A ray that leaves `point` on a surface.
  static Ray SpawnRay(glm::vec3 point, glm::vec3 normal, glm::vec3 direction);

  /// What shines, where it is so few triangles that they may be small; else none.
  const std::vector<Emitter>& GetEmitters() const { return this->Emitters; }

  const RayScene& GetRays() const { return this->Rays; }
  const IlluminationSettings& GetSettings() const { return this->Settings; }

private:
  bool HasSuns() const { return this->Settings.Picture && this->Settings.Picture->HasSuns(); }
  glm::vec3 SunContribution(glm::vec3 point, glm::vec3 normal, glm::vec2 at, long long& rays) const;

  const RayScene& Rays;
  Shading Shades;
  IlluminationSettings Settings;
  std::vector<Emitter> Emitters;
};

}
#endif
