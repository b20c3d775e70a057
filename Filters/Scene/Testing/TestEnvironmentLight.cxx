// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light of environments whose reflections have closed forms.
#include "Environment/EnvironmentLight.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

using namespace penumbra;

namespace
{

constexpr double Pi = 3.14159265358979;

const glm::vec3 Directions[] = { { 1.f, 0.f, 0.f }, { 0.f, -1.f, 0.f }, { 0.f, 0.f, 1.f },
  { .6f, .48f, -.64f }, { -.36f, .8f, .48f } };

/// Returns an image of all directions with the given radiance.
RadianceImage MakeImage(const std::function<glm::vec3(glm::vec3)>& radiance, int height = 96)
{
  RadianceImage image{ 2 * height, height, {} };
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < 2 * height; ++i)
    {
      const double longitude = 2.0 * Pi * ((i + .5) / (2 * height) - .5);
      const double latitude = Pi * ((j + .5) / height - .5);
      image.Texels.push_back(radiance(glm::dvec3(std::cos(latitude) * std::cos(longitude),
        std::sin(latitude), std::cos(latitude) * std::sin(longitude))));
    }
  }
  return image;
}

}

TEST(EnvironmentLight, OfUniformRadianceIsUniform)
{
  for (const std::size_t faces : { 1, 6 })
  {
    const RadianceImage image{ 4, 4, std::vector<glm::vec3>(16, glm::vec3(.2f, .5f, 3.f)) };
    EnvironmentLight light(std::vector<RadianceImage>(faces, image), glm::dmat3(1.0), 1.f, 0);
    light.Prepare();
    for (const glm::vec3 direction : Directions)
    {
      for (const float roughness : { 0.f, .1f, .5f, 1.f })
      {
        const glm::vec3 reflected = light.ComputeReflection(direction, roughness);
        EXPECT_LT(glm::distance(reflected, { .2f, .5f, 3.f }), 1e-4f);
      }
      EXPECT_LT(glm::distance(light.ComputeIrradiance(direction), { .2f, .5f, 3.f }), 2e-3f);
    }
  }
}

TEST(EnvironmentLight, OfLinearRadianceMatchesClosedForm)
{
  // The irradiance of n . a over pi is 2/3 n . a. The mean of a lobe about the direction d is m d . a
  // with the same m for all d.
  const glm::vec3 a(.3f, -.4f, .2f);
  // Columns of the rotation are where the axes of the image point in the scene.
  const glm::dmat3 toScene(glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
  EnvironmentLight light(
    { MakeImage([&](glm::vec3 d) { return glm::vec3(1.f + glm::dot(d, a)); }) },
    glm::transpose(toScene), 1.f, 0);
  light.Prepare();
  const auto inScene = glm::vec3(toScene * glm::dvec3(a));
  for (const glm::vec3 direction : Directions)
  {
    const float along = glm::dot(direction, inScene);
    EXPECT_NEAR(light.ComputeIrradiance(direction).x, 1.f + 2.f / 3.f * along, 2e-3f);
    EXPECT_NEAR(light.ComputeReflection(direction, 0.f).x, 1.f + along, 2e-3f);
    for (const float roughness : { .25f, .5f, 1.f })
    {
      const float length = light.ComputeReflection(inScene / glm::length(a), roughness).x - 1.f;
      EXPECT_NEAR(light.ComputeReflection(direction, roughness).x,
        1.f + length * along / glm::length(a), 2e-3f);
      EXPECT_LT(length, glm::length(a));
    }
  }
}

TEST(EnvironmentLight, TakesPowersForTheDiffusePartOnly)
{
  const RadianceImage image{ 2, 2, std::vector<glm::vec3>(4, glm::vec3(.5f)) };
  EnvironmentLight light({ image }, glm::dmat3(1.0), 2.f, 0);
  light.Prepare();
  EXPECT_NEAR(light.ComputeIrradiance(Directions[3]).x, .25f, 1e-3f);
  EXPECT_NEAR(light.ComputeReflection(Directions[3], .7f).x, .5f, 1e-4f);
}

TEST(EnvironmentLight, IsReflectedEntirelyBySmoothWhiteMetals)
{
  EnvironmentLight light({ RadianceImage{ 1, 1, { glm::vec3(1.f) } } }, glm::dmat3(1.0), 1.f, 0);
  light.Prepare();
  for (const float cosine : { .2f, .6f, 1.f })
  {
    const glm::vec2 smooth = light.ComputeReflectance(cosine, 0.f);
    EXPECT_NEAR(smooth.x + smooth.y, 1.f, .01f) << cosine;
    EXPECT_NEAR(smooth.y, std::pow(1.f - cosine, 5.f), .01f) << cosine; // Schlick's term
    const glm::vec2 rough = light.ComputeReflectance(cosine, 1.f);
    EXPECT_LT(rough.x + rough.y, .9f) << cosine;
  }
}

TEST(EnvironmentLight, AcceptsDirectionsThatAreNotANumber)
{
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (const std::size_t faces : { 1, 6 })
  {
    const RadianceImage image{ 4, 4, std::vector<glm::vec3>(16, glm::vec3(1.f)) };
    EnvironmentLight light(std::vector<RadianceImage>(faces, image), glm::dmat3(1.0), 1.f, 0);
    light.Prepare();
    EXPECT_EQ(light.ComputeReflection(glm::vec3(none), .5f), glm::vec3(1.f));
    EXPECT_EQ(light.ComputeReflection(glm::vec3(none), none), glm::vec3(1.f));
    EXPECT_EQ(light.ComputeReflectance(none, none), light.ComputeReflectance(0.f, 0.f));
  }
}
