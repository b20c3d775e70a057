// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight.h"

#include "Embree/RayScene.h"
#include "Scene.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/Shading.h"

#include "vtkMath.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

namespace penumbra
{
namespace
{

/// Smallest cosine by which the tolerance of a light is divided.
constexpr float MinimumCosine = 0.01f;

Light MakeLight(
  const std::array<double, 4>& position, const DirectLightSettings& settings, const Scene& scene)
{
  // The largest component is scaled to 1, so that squares are finite.
  const double largest =
    std::max({ std::abs(position[0]), std::abs(position[1]), std::abs(position[2]) });
  const double w = position[3];
  if (!std::isfinite(largest) || !(w >= 0.0 && std::isfinite(w)) || std::isnan(position[0]) ||
    std::isnan(position[1]) || std::isnan(position[2]) || (w == 0.0 && largest == 0.0))
  {
    throw std::runtime_error("The position of a light must be finite, with w positive, or 0 with a "
                             "nonzero direction.");
  }
  const glm::dvec3 xyz(position[0], position[1], position[2]);
  Light light;
  if (w == 0.0)
  {
    light.Kind = Light::Kinds::Directional;
    light.Direction = -glm::normalize(xyz / largest);
    light.AngularRadius = static_cast<float>(0.5 * vtkMath::RadiansFromDegrees(settings.Angle));
    return light;
  }
  const glm::dvec3 world = xyz / w;
  light.Kind = Light::Kinds::Positional;
  light.Position = scene.FromWorld(&world.x);
  light.Radius = static_cast<float>(settings.Radius * scene.Scale);
  if (!std::isfinite(glm::dot(light.Position, light.Position)) || !std::isfinite(light.Radius))
  {
    throw std::runtime_error("A light is too far from the mesh, or too large.");
  }
  return light;
}

/// Returns the visible fraction of a light from a site, with the cosine `cosine`.
VisibleFraction EstimateFraction(const Shading& shading, const Light& light,
  const RecordCandidate& site, float tolerance, long long& rays)
{
  if (light.HasSize())
  {
    return shading.ComputeVisibleFraction(
      light, site.Position, site.GetNormals().Geometric, tolerance, rays);
  }
  const glm::vec3 origin =
    site.Position + RayOriginOffset(site.Position) * site.GetNormals().Geometric;
  return { shading.TraceTransmittance(AreaLight(light, origin).MakeRay(glm::vec2(0.f)), rays),
    0.f };
}

}

std::vector<Light> MakeLights(const DirectLightSettings& settings, const Scene& scene)
{
  if (!(settings.Radius >= 0.0 && std::isfinite(settings.Radius)))
  {
    throw std::runtime_error("LightRadius must be finite and not negative.");
  }
  if (!(settings.Angle >= 0.0 && settings.Angle <= 180.0))
  {
    throw std::runtime_error("LightAngle must be between 0 and 180 degrees.");
  }
  if (settings.Positions.empty())
  {
    throw std::runtime_error("Direct light needs at least one light. Call AddLight().");
  }
  std::vector<Light> lights;
  for (const std::array<double, 4>& position : settings.Positions)
  {
    lights.push_back(MakeLight(position, settings, scene));
  }
  return lights;
}

bool BakeDirectLight(const RayScene& rays, const std::vector<RecordCandidate>& sites,
  double tolerance, const ProgressCallback& progress, BakedValues& result)
{
  const Shading shading(rays, true);
  const std::vector<Light>& lights = rays.GetScene().Lights;
  const float share = static_cast<float>(tolerance / std::sqrt(static_cast<double>(lights.size())));
  result.Values.assign(sites.size(), {});
  result.Methods.assign(sites.size(), BakingMethod::BruteForce);
  std::atomic<long long> total(0);
  const bool done =
    ParallelForWithProgress(static_cast<int>(sites.size()), 0.0, 1.0, progress, [&](int i) {
      const RecordCandidate& site = sites[i];
      double sum = 0.0;
      double square = 0.0;
      long long count = 0;
      for (const Light& light : lights)
      {
        const glm::vec3 toward = light.Kind == Light::Kinds::Directional
          ? -light.Direction
          : light.Position - site.Position;
        const float length = glm::length(toward);
        const float cosine = length > 0.f ? glm::dot(site.Normal, toward) / length : 0.f;
        if (!(cosine > 0.f))
        {
          continue;
        }
        const VisibleFraction fraction =
          EstimateFraction(shading, light, site, share / std::max(cosine, MinimumCosine), count);
        sum += cosine * fraction.Value;
        square += std::pow(cosine * fraction.Error, 2.0);
      }
      result.Values[i] = { glm::vec3(static_cast<float>(sum)),
        static_cast<float>(std::sqrt(square)) };
      total += count;
    });
  result.BruteForceRays += total;
  return done;
}

}
