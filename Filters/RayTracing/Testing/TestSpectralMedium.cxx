// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Media with color, height fall-off and density images along single rays: closed forms, and an
// independent march of each wavelength.
#include "BruteForce/SpectralMarch.h"
#include "Media/LightShafts.h"
#include "Scene.h"
#include "Surface.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Tolerance = 1.0 / 256.0;
constexpr double Factors[3] = { 0.42797, 1.0, 2.44141 };

/// Mie and Rayleigh scattering that falls off with the height y.
SpectralMedium Haze(double scaleHeight)
{
  SpectralMedium medium;
  for (int i = 0; i < 3; ++i)
  {
    Medium& channel = medium.Channels[i];
    channel.Scattering = 0.1;
    channel.Rayleigh = 0.2 * Factors[i];
    channel.Extinction = 0.12 + 0.2 * Factors[i];
    channel.Phase = Medium::Phases::HenyeyGreenstein;
    channel.Asymmetry = 0.6;
    channel.Density.ScaleHeight = scaleHeight;
  }
  return medium;
}

MarchedMedium Describe(const Medium& channel, glm::dvec3 toLight)
{
  MarchedMedium marched;
  marched.Scattering = channel.Scattering;
  marched.Asymmetry = channel.Asymmetry;
  marched.Rayleigh = channel.Rayleigh;
  marched.Extinction = channel.Extinction;
  const double scaleHeight = channel.Density.ScaleHeight;
  marched.Density = [scaleHeight](glm::dvec3 p) { return std::exp(-p.y / scaleHeight); };
  marched.Light = toLight;
  marched.LightPath = 20.0 * scaleHeight / toLight.y;
  return marched;
}

/// A wall x < 0 in the plane y = 2 that shadows what is below it.
Surface Roof()
{
  Surface surface;
  surface.Positions = { { -90.f, 2.f, -90.f }, { 0.f, 2.f, -90.f }, { 0.f, 2.f, 90.f },
    { -90.f, 2.f, 90.f } };
  surface.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return surface;
}

/// A smooth blob of density in the unit cube, sampled on a grid.
std::shared_ptr<DensityImage> Blob(int points)
{
  auto image = std::make_shared<DensityImage>();
  image->Size = glm::ivec3(points);
  image->Spacing = glm::dvec3(1.0 / (points - 1));
  for (int i = 0; i < points * points * points; ++i)
  {
    const glm::dvec3 p =
      glm::dvec3(i % points, i / points % points, i / points / points) * image->Spacing - 0.5;
    image->Values.push_back(static_cast<float>(std::exp(-8.0 * glm::dot(p, p))));
  }
  return image;
}

struct Query
{
  Query(Scene scene, const SpectralMedium& medium)
    : TracedScene(std::move(scene)),
      Rays(TracedScene, 1),
      SurfaceShading(Rays, false),
      Shafts(SurfaceShading, medium, { Tolerance, 0 })
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

Light Sun(glm::vec3 toward, glm::vec3 color)
{
  Light light;
  light.Direction = -glm::normalize(toward);
  light.DiffuseColor = color;
  return light;
}

bool AlwaysLit(glm::dvec3)
{
  return true;
}

}

TEST(MediumDensity, HasClosedFormColumnsOfTheFalloff)
{
  MediumDensity density;
  density.Up = glm::normalize(glm::dvec3(1.0, 2.0, 0.5));
  density.BaseHeight = 0.3;
  density.ScaleHeight = 0.7;
  for (const glm::dvec3 v : { glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.6, -0.8, 0.0),
         glm::normalize(glm::dvec3(2.0, -1.0, 0.0)), glm::normalize(glm::dvec3(1.0, -1.0, 1.0)) })
  {
    const glm::dvec3 start(0.1, 0.4, -0.2);
    double sum = 0.0;
    for (int i = 0; i < 20000; ++i)
    {
      sum += density.At(start + (i + 0.5) / 20000.0 * 1.5 * v) * 1.5 / 20000.0;
    }
    EXPECT_NEAR(density.Column(start, v, 1.5), sum, 1e-7 * sum);
    EXPECT_NEAR(density.LengthOfColumn(start, v, sum), 1.5, 1e-6);
  }
  // Straight up the column is that of the density at the start over one scale height.
  EXPECT_NEAR(density.Column({ 0, 0, 0 }, density.Up, Infinity), 0.7 * std::exp(0.3 / 0.7), 1e-12);
  EXPECT_EQ(density.Column({ 0, 0, 0 }, -density.Up, Infinity), Infinity);
}

TEST(MediumDensity, IntegratesImagesExactly)
{
  const auto image = Blob(6);
  MediumDensity density;
  density.Image = image;
  for (const glm::dvec3 v : { glm::dvec3(1.0, 0.0, 0.0), glm::normalize(glm::dvec3(3, 2, 1)),
         glm::normalize(glm::dvec3(-1, -2, 0.4)) })
  {
    const glm::dvec3 start = glm::dvec3(0.5, 0.45, 0.55) - v;
    const RayColumn columns(density, start, v, 2.0);
    for (const double length : { 0.9, 1.1, 2.0 })
    {
      double sum = 0.0;
      for (int i = 0; i < 40000; ++i)
      {
        sum += density.At(start + (i + 0.5) / 40000.0 * length * v) * length / 40000.0;
      }
      EXPECT_NEAR(density.Column(start, v, length), sum, 5e-6);
      EXPECT_NEAR(columns.At(length), sum, 5e-6);
    }
  }
  EXPECT_EQ(density.Column({ 0, 2, 0 }, { 1, 0, 0 }, Infinity), 0.0);
}

TEST(SpectralMedium, MatchesTheMarchOfEachChannelAboveGround)
{
  const SpectralMedium medium = Haze(1.5);
  const glm::vec3 color(3.f, 2.f, 4.f);
  for (const glm::vec3 toward : { glm::vec3(0.3f, 1.f, 0.2f), glm::vec3(1.f, 0.15f, 0.f) })
  {
    Scene scene;
    scene.Lights = { Sun(toward, color) };
    const glm::dvec3 toLight = -glm::dvec3(scene.Lights[0].Direction);
    Query query(std::move(scene), medium);
    for (const glm::dvec3 v : { glm::dvec3(1.0, 0.0, 0.0), glm::normalize(glm::dvec3(1, 0.7, 0.1)),
           glm::normalize(glm::dvec3(1.0, -0.2, 0.3)) })
    {
      const LightShafts::InScattering result = query.Along({ 0, 0.5, 0 }, v, 6.0);
      for (int i = 0; i < 3; ++i)
      {
        const MarchedMedium marched = Describe(medium.Channels[i], toLight);
        const double exact =
          color[i] * MarchInScattering(marched, { 0, 0.5, 0 }, v, 6.0, AlwaysLit, 1000);
        EXPECT_NEAR(result.Light[i], exact, 1e-3 * exact) << i;
        EXPECT_NEAR(
          result.Transmittance[i], MarchTransmittance(marched, { 0, 0.5, 0 }, v, 6.0, 1000), 1e-5);
      }
    }
  }
}

TEST(SpectralMedium, MatchesTheMarchOfEachChannelInShadow)
{
  const SpectralMedium medium = Haze(1.5);
  const glm::vec3 color(6.f, 6.f, 6.f);
  for (int i = 0; i < 12; ++i)
  {
    Scene scene;
    scene.Surfaces = { Roof() };
    scene.Lights = { Sun({ 0.4f, 1.f, 0.f }, color) };
    const glm::dvec3 toLight = -glm::dvec3(scene.Lights[0].Direction);
    Query query(std::move(scene), medium);
    const glm::dvec3 v = glm::normalize(glm::dvec3(1.0, -0.3 + 0.05 * i, 0.3));
    const glm::dvec3 eye(-3.0, 0.8, 0.0);
    const LightShafts::InScattering result = query.Along(eye, v, 8.0);
    const auto isLit = [&toLight](glm::dvec3 p) {
      return p.y >= 2.0 || p.x + (2.0 - p.y) / toLight.y * toLight.x > 0.0;
    };
    for (int c = 0; c < 3; ++c)
    {
      const double exact = color[c] *
        MarchInScattering(Describe(medium.Channels[c], toLight), eye, v, 8.0, isLit, 1000);
      EXPECT_NEAR(result.Light[c], exact, Tolerance) << i << " " << c;
    }
  }
}

TEST(SpectralMedium, MatchesTheMarchForPositionalLights)
{
  const SpectralMedium medium = Haze(0.8);
  Scene scene;
  Light light = Sun({ 0, 1, 0 }, glm::vec3(5.f));
  light.Kind = Light::Kinds::Positional;
  light.Position = { 2.f, 1.5f, 0.6f };
  scene.Lights = { light };
  Query query(std::move(scene), medium);
  const glm::dvec3 v = glm::normalize(glm::dvec3(1.0, 0.2, 0.1));
  const LightShafts::InScattering result = query.Along({ 0, 0, 0 }, v, 5.0);
  for (int c = 0; c < 3; ++c)
  {
    MarchedMedium marched = Describe(medium.Channels[c], { 0, 1, 0 });
    marched.IsPositional = true;
    marched.Light = light.Position;
    const double exact = 5.0 * MarchInScattering(marched, { 0, 0, 0 }, v, 5.0, AlwaysLit, 1000);
    EXPECT_NEAR(result.Light[c], exact, 1e-3 * exact);
  }
}

TEST(SpectralMedium, MatchesTheMarchThroughAnImage)
{
  for (const double scaleHeight : { 1e9, 0.4 })
  {
    SpectralMedium medium = Haze(scaleHeight);
    const auto image = Blob(9);
    for (Medium& channel : medium.Channels)
    {
      channel.Scattering *= 10.0;
      channel.Extinction *= 10.0;
      channel.Rayleigh *= 10.0;
      channel.Density.Image = image;
      channel.Low = image->Low;
      channel.High = image->High();
    }
    Scene scene;
    scene.Lights = { Sun({ 0.5f, 1.f, 0.3f }, glm::vec3(4.f)) };
    const glm::dvec3 toLight = -glm::dvec3(scene.Lights[0].Direction);
    Query query(std::move(scene), medium);
    const glm::dvec3 v = glm::normalize(glm::dvec3(1.0, 0.2, 0.35));
    const glm::dvec3 eye = glm::dvec3(0.5, 0.4, 0.5) - 2.0 * v;
    const LightShafts::InScattering result = query.Along(eye, v, 4.0);
    for (int c = 0; c < 3; ++c)
    {
      MarchedMedium marched = Describe(medium.Channels[c], toLight);
      marched.Density = [&](glm::dvec3 p) { return image->At(p) * std::exp(-p.y / scaleHeight); };
      marched.LightPath = 2.0;
      const double exact = 4.0 * MarchInScattering(marched, eye, v, 4.0, AlwaysLit, 1000);
      EXPECT_NEAR(result.Light[c], exact, 1e-3 * exact);
      EXPECT_NEAR(result.Transmittance[c], MarchTransmittance(marched, eye, v, 4.0, 1000), 3e-4);
    }
  }
}

TEST(SpectralMedium, ReducesToTheGrayMediumBitForBit)
{
  Medium gray;
  gray.Scattering = 0.3;
  gray.Extinction = 0.4;
  const auto integrate = [](const SpectralMedium& medium) {
    Scene scene;
    scene.Surfaces = { Roof() };
    scene.Lights = { Sun({ 0.4f, 1.f, 0.f }, { 2.f, 0.7f, 0.1f }) };
    Query query(std::move(scene), medium);
    return query.Along({ -3.0, 0.8, 0.0 }, glm::normalize(glm::dvec3(1.0, 0.1, 0.3)), 8.0);
  };
  const LightShafts::InScattering expected = integrate(gray);
  SpectralMedium almost(gray);
  almost.Channels[2].Extinction *= 1.0 + 1e-12;
  const LightShafts::InScattering spectral = integrate(almost);
  EXPECT_EQ(expected.Light, integrate(SpectralMedium(gray)).Light);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_EQ(expected.Transmittance[c], expected.Transmittance[0]);
    EXPECT_NEAR(spectral.Light[c], expected.Light[c], 0.1 * Tolerance);
  }
}

TEST(SpectralMedium, AttenuatesLightOnItsWayToSurfaces)
{
  const SpectralMedium medium = Haze(1.5);
  const Light sun = Sun({ 0.5f, 1.f, 0.f }, glm::vec3(1.f));
  Light bulb = sun;
  bulb.Kind = Light::Kinds::Positional;
  bulb.Position = { 0.f, 3.f, 4.f };
  const double slant = -1.0 / sun.Direction.y;
  for (int c = 0; c < 3; ++c)
  {
    const double column = 1.5 * std::exp(-0.25 / 1.5) * slant;
    EXPECT_NEAR(medium.TransmittanceToLight(sun, { 0.f, 0.25f, 0.f })[c],
      std::exp(-medium.Channels[c].Extinction * column), 1e-6);
    MarchedMedium marched = Describe(medium.Channels[c], { 0, 1, 0 });
    EXPECT_NEAR(medium.TransmittanceToLight(bulb, glm::vec3(0.f))[c],
      MarchTransmittance(marched, glm::dvec3(0.0), { 0.0, 0.6, 0.8 }, 5.0, 1000), 1e-5);
  }
}
