// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares light shafts along single rays with closed forms and with dense uniform ray marching
// where shadows are known analytically.
#include "Media/LightShafts.h"
#include "Scene.h"
#include "Surface.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace penumbra;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Pi = glm::pi<double>();
constexpr float Extent = 1000.f;

/// Returns the half-plane x < 0 at height z.
Surface HalfPlane(float z)
{
  Surface surface;
  surface.Positions = { { -Extent, -Extent, z }, { 0.f, -Extent, z }, { 0.f, Extent, z },
    { -Extent, Extent, z } };
  surface.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return surface;
}

Light DirectionalLight(glm::vec3 direction)
{
  Light light;
  light.Direction = glm::normalize(direction);
  return light;
}

Light PositionalLight(glm::vec3 position)
{
  Light light;
  light.Kind = Light::Kinds::Positional;
  light.Position = position;
  return light;
}

Medium HomogeneousMedium(double scattering, double extinction)
{
  Medium medium;
  medium.Scattering = scattering;
  medium.Extinction = extinction;
  return medium;
}

/// Light shafts of one scene.
struct ShaftQuery
{
  ShaftQuery(Scene scene, const Medium& medium, double tolerance, int steps)
    : TracedScene(std::move(scene)),
      Rays(TracedScene, 1),
      SurfaceShading(Rays, false),
      Shafts(SurfaceShading, medium, { tolerance, steps })
  {
  }

  LightShafts::InScattering Along(glm::dvec3 origin, glm::dvec3 direction, double to)
  {
    Ray ray;
    ray.Origin = glm::vec3(origin);
    ray.Direction = glm::vec3(direction);
    return this->Shafts.Along(ray, 0.0, to, 1.f, this->ShadowRays);
  }

  Scene TracedScene;
  RayScene Rays;
  Shading SurfaceShading;
  LightShafts Shafts;
  long long ShadowRays = 0;
};

/// Integrates `density` over [from, to] by the midpoint rule.
double Integral(const std::function<double(double)>& density, double from, double to, int steps)
{
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    sum += density(from + (to - from) * (i + 0.5) / steps);
  }
  return sum * (to - from) / steps;
}

glm::dvec3 Fan(int i, int count)
{
  const double angle = -1.2 + 2.4 * i / (count - 1);
  return glm::normalize(glm::dvec3(std::cos(angle), 0.21, std::sin(angle)));
}

/// Returns the relative RMSE over a fan of rays below a half-plane at z = 1 that occludes the light
/// for x < 0. The medium ends at z = 2; the camera is at (-1.3, 0, -0.5).
double HalfPlaneError(int steps)
{
  Scene scene;
  scene.Surfaces = { HalfPlane(1.f) };
  scene.Lights = { DirectionalLight({ 0.f, 0.f, -1.f }) };
  Medium medium = HomogeneousMedium(0.3, 0.5);
  medium.High.z = 2.0;
  ShaftQuery query(std::move(scene), medium, 1.0 / 256.0, steps);
  const glm::dvec3 camera(-1.3, 0.0, -0.5);
  double squares = 0.0;
  double reference = 0.0;
  for (int i = 0; i < 101; ++i)
  {
    const glm::dvec3 v = Fan(i, 101);
    const double hit = v.z > 0.0 ? 1.5 / v.z : Infinity;
    const double far = std::min(8.0, hit);
    const double near = std::min(1.3 / v.x, far);
    // Closed form: sigma_s p E exp(-a) (exp(-b t0) - exp(-b t1)) / b.
    const double a = 0.5 * (2.0 - camera.z);
    const double b = 0.5 * (1.0 - v.z);
    const double exact =
      0.3 / (4.0 * Pi) * std::exp(-a) * (std::exp(-b * near) - std::exp(-b * far)) / b;
    const double error = query.Along(camera, v, far).Light.r - exact;
    squares += error * error;
    reference += exact * exact;
  }
  return std::sqrt(squares / reference);
}

}

TEST(LightShafts, MatchesClosedFormBelowHalfPlane)
{
  EXPECT_LT(HalfPlaneError(64), 5e-4);
  EXPECT_LT(HalfPlaneError(16), 2e-3);
}

TEST(LightShafts, MatchesEquationOneWithoutShadows)
{
  for (const Medium::Phases phase :
    { Medium::Phases::Isotropic, Medium::Phases::Rayleigh, Medium::Phases::HenyeyGreenstein })
  {
    Medium medium = HomogeneousMedium(0.2, 0.7);
    medium.Phase = phase;
    medium.Asymmetry = 0.4;
    Scene scene;
    scene.Lights = { DirectionalLight({ 1.f, -2.f, 0.5f }) };
    const glm::dvec3 toward = -glm::dvec3(scene.Lights[0].Direction);
    ShaftQuery query(std::move(scene), medium, 1.0 / 256.0, 0);
    for (const double s : { 0.01, 1.0, 30.0, Infinity })
    {
      const glm::dvec3 v = glm::normalize(glm::dvec3(0.3, 0.4, -0.8));
      const double phaseValue = medium.PhaseFunction(glm::dot(v, toward));
      const double exact = 0.2 * phaseValue * (1.0 - std::exp(-0.7 * s)) / 0.7;
      const LightShafts::InScattering result = query.Along({ 0.1, 0.2, 0.3 }, v, s);
      EXPECT_NEAR(result.Light.g, exact, 1e-6 * exact);
      EXPECT_NEAR(result.Transmittance.r, std::exp(-0.7 * s), 1e-6);
    }
  }
}

TEST(LightShafts, NormalizesPhaseFunctions)
{
  for (const Medium::Phases phase :
    { Medium::Phases::Isotropic, Medium::Phases::Rayleigh, Medium::Phases::HenyeyGreenstein })
  {
    Medium medium;
    medium.Phase = phase;
    medium.Asymmetry = 0.7;
    const auto ring = [&](double c) { return 2.0 * Pi * medium.PhaseFunction(c); };
    EXPECT_NEAR(Integral(ring, -1.0, 1.0, 20000), 1.0, 1e-5);
  }
}

TEST(LightShafts, MatchesNumericalIntegralForAttenuatedPositionalLights)
{
  for (const bool spot : { false, true })
  {
    Light light = PositionalLight({ 0.4f, 1.1f, 2.f });
    light.Attenuation = { 0.1f, 0.2f, 0.5f };
    if (spot)
    {
      light.Kind = Light::Kinds::Spot;
      light.Direction = glm::normalize(glm::vec3(0.1f, -1.f, 0.2f));
      light.ConeCosine = 0.8f;
      light.Exponent = 3.f;
    }
    Scene scene;
    scene.Lights = { light };
    const Medium medium = HomogeneousMedium(0.3, 0.4);
    ShaftQuery query(std::move(scene), medium, 1.0 / 4096.0, 0);
    const glm::dvec3 v = glm::normalize(glm::dvec3(0.1, 0.1, 1.0));
    const auto density = [&](double t) {
      const glm::dvec3 path = glm::dvec3(light.Position) - t * v;
      const double d = glm::length(path);
      const double cosine = glm::dot(-path / d, glm::dvec3(light.Direction));
      const double strength = !spot ? 1.0 : cosine < 0.8 ? 0.0 : cosine * cosine * cosine;
      return strength / (0.1 + 0.2 * d + 0.5 * d * d) * std::exp(-0.4 * (t + d));
    };
    const double exact = 0.3 / (4.0 * Pi) * Integral(density, 0.0, 40.0, 400000);
    EXPECT_NEAR(query.Along({ 0, 0, 0 }, v, Infinity).Light.b, exact, 2e-3 * exact) << spot;
  }
}

TEST(LightShafts, AttenuatesLightInsideBoundedMedium)
{
  Medium medium = HomogeneousMedium(0.5, 0.6);
  medium.Low = { -1.0, -2.0, -1.5 };
  medium.High = { 2.0, 1.0, 3.0 };
  Scene scene;
  scene.Lights = { DirectionalLight({ -1.f, -0.7f, -1.3f }) };
  const glm::dvec3 toward = -glm::dvec3(scene.Lights[0].Direction);
  ShaftQuery query(std::move(scene), medium, 1.0 / 256.0, 0);
  const glm::dvec3 camera(-4.0, -1.0, -2.0);
  const glm::dvec3 v = glm::normalize(glm::dvec3(1.0, 0.3, 0.55));
  double near = 0.0;
  double far = Infinity;
  ASSERT_TRUE(medium.Clip(camera, v, near, far));
  const auto density = [&](double t) {
    const glm::dvec3 p = camera + t * v;
    const double exit =
      std::min({ (2.0 - p.x) / toward.x, (1.0 - p.y) / toward.y, (3.0 - p.z) / toward.z });
    return std::exp(-0.6 * (t - near + exit));
  };
  const double exact = 0.5 / (4.0 * Pi) * Integral(density, near, far, 100000);
  EXPECT_NEAR(query.Along(camera, v, Infinity).Light.r, exact, 1e-5 * exact);
}

TEST(LightShafts, SumsLights)
{
  const auto integrate = [](const std::vector<Light>& lights) {
    Scene scene;
    scene.Surfaces = { HalfPlane(1.f) };
    scene.Lights = lights;
    ShaftQuery query(std::move(scene), HomogeneousMedium(0.4, 0.4), 1e-4, 0);
    return query.Along({ -1.0, 0.0, 0.0 }, glm::normalize(glm::dvec3(1.0, 0.1, 0.2)), 9.0).Light;
  };
  Light red = DirectionalLight({ 0.2f, 0.1f, -1.f });
  red.DiffuseColor = { 2.f, 0.5f, 0.f };
  Light light = PositionalLight({ 1.f, 0.f, 2.f });
  light.DiffuseColor = { 0.f, 0.3f, 1.f };
  const glm::vec3 both = integrate({ red, light });
  const glm::vec3 sum = integrate({ red }) + integrate({ light });
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(both[c], sum[c], 1e-6);
  }
}

TEST(LightShafts, MeetsToleranceAndBoundsItsError)
{
  // Narrow strips that occlude half of the light.
  const auto integrate = [](double tolerance, int steps, long long& rays) {
    Scene scene;
    for (int i = -20; i < 20; ++i)
    {
      Surface strip;
      const float x = 0.4f * static_cast<float>(i);
      strip.Positions = { { x, -Extent, 1.f }, { x + .2f, -Extent, 1.f }, { x + .2f, Extent, 1.f },
        { x, Extent, 1.f } };
      strip.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
      scene.Surfaces.push_back(strip);
    }
    scene.Lights = { DirectionalLight({ 0.f, 0.f, -1.f }) };
    scene.Lights[0].DiffuseColor = glm::vec3(8.f);
    ShaftQuery query(std::move(scene), HomogeneousMedium(0.3, 0.3), tolerance, steps);
    std::vector<LightShafts::InScattering> all;
    for (int i = 0; i < 60; ++i)
    {
      const double slant = 0.4 * i / 60.0 - 0.3;
      all.push_back(
        query.Along({ -1.0, 0.0, 0.0 }, glm::normalize(glm::dvec3(1.0, 0.1, slant)), 4.0));
    }
    rays = query.ShadowRays;
    return all;
  };
  long long rays = 0;
  const std::vector<LightShafts::InScattering> reference = integrate(1e-5, 4096, rays);
  long long before = 0;
  for (const double tolerance : { 1.0 / 64.0, 1.0 / 256.0, 1.0 / 1024.0 })
  {
    const std::vector<LightShafts::InScattering> results = integrate(tolerance, 0, rays);
    double error = 0.0;
    double estimated = 0.0;
    for (std::size_t i = 0; i < results.size(); ++i)
    {
      error += std::pow(results[i].Light.r - reference[i].Light.r, 2) / results.size();
      estimated += results[i].Error * results[i].Error / results.size();
    }
    EXPECT_LT(std::sqrt(error), tolerance);
    EXPECT_LT(error, estimated);
    EXPECT_GT(rays, before);
    before = rays;
  }
}

TEST(LightShafts, TerminatesForExtremeLightAndTolerance)
{
  Scene scene;
  Surface half;
  half.Positions = { { 0.f, -Extent, 1.f }, { Extent, -Extent, 1.f }, { 0.f, Extent, 1.f } };
  half.Triangles = { { 0, 1, 2 } };
  scene.Surfaces.push_back(half);
  scene.Lights = { DirectionalLight({ 0.f, 0.f, -1.f }) };
  scene.Lights[0].DiffuseColor = glm::vec3(1e25f);
  ShaftQuery query(std::move(scene), HomogeneousMedium(0.3, 0.3), 1e-6, 16);
  query.Along({ -1.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, 4.0);
  EXPECT_LT(query.ShadowRays, 200); // the mantissa of a double allows 52 bisections
}

TEST(LightShafts, IsEmptyWithoutShadowCastingLights)
{
  Scene scene;
  scene.Lights = { DirectionalLight({ 0.f, 0.f, -1.f }) };
  scene.Lights[0].CastsShadow = false;
  ShaftQuery query(std::move(scene), HomogeneousMedium(1.0, 1.0), 0.01, 0);
  EXPECT_TRUE(query.Shafts.IsEmpty());
}
