// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the irradiance of environment maps with closed forms.
#include "vtkPenumbraEnvironment.h"

#include "Scenes/Solids.h"
#include "Shading/EnvironmentMap.h"
#include "Shading/Illumination.h"
#include "Surface.h"
#include "vtkPenumbraBruteForceIrradiance.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

using namespace penumbra;

namespace
{

constexpr double Pi = glm::pi<double>();

/// Radiance by longitude and latitude, in radians.
using SkyFunction = std::function<glm::dvec3(double longitude, double latitude)>;

vtkSmartPointer<vtkImageData> MakeImage(int width, int height, const SkyFunction& sky)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfComponents(3);
  for (int row = 0; row < height; ++row)
  {
    for (int i = 0; i < width; ++i)
    {
      const glm::dvec3 color =
        sky(2.0 * Pi * ((i + .5) / width - .5), Pi * ((row + .5) / height - .5));
      values->InsertNextTuple3(color.x, color.y, color.z);
    }
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

glm::dvec3 SineOfElevation(double, double latitude)
{
  return glm::dvec3(std::max(std::sin(latitude), 0.0));
}

/// Brute-force irradiance at a point of a scene.
struct IrradianceResult
{
  glm::dvec3 Value;
  double Error;
  long long Rays;
};

IrradianceResult ComputeIrradiance(vtkPenumbraEnvironment* environment, glm::dvec3 normal,
  const Scene& scene, double tolerance = .002, glm::dvec3 point = glm::dvec3(0.0))
{
  const RayScene rays(scene, 1);
  IlluminationSettings settings;
  settings.Map = environment->GetMap();
  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  provider->BeginIrradiance(Illumination(rays, settings), tolerance);
  const auto light = provider->Irradiance(&point.x, &normal.x, tolerance);
  return { { light.Value[0], light.Value[1], light.Value[2] }, light.Error, light.Rays };
}

/// Environment map with a sun of one texel in a dim sky.
constexpr int Width = 512;
constexpr int Rows = 256;
constexpr int SunRow = 200;
constexpr double SunRadiance = 1e5;
constexpr double SunLatitude = Pi * ((SunRow + .5) / Rows - .5);

glm::dvec3 SunlitSky(double longitude, double latitude)
{
  const bool sun =
    std::abs(longitude - Pi / Width) < 1e-6 && std::abs(latitude - SunLatitude) < 1e-6;
  return sun ? glm::dvec3(SunRadiance, .5 * SunRadiance, 0.0) : glm::dvec3(.25);
}

/// A sun of about 6 texels across.
glm::dvec3 SkyWithRoundSun(double longitude, double latitude)
{
  const double distance = std::hypot(longitude, latitude - SunLatitude);
  return distance < 3.2 * Pi / Rows ? glm::dvec3(SunRadiance, .5 * SunRadiance, 0.0)
                                    : glm::dvec3(.25);
}

/// Returns the approximate irradiance from the sun on a plane that faces it.
double ComputeSunIrradiance()
{
  const double low = Pi * (double(SunRow) / Rows - .5);
  const double high = Pi * (double(SunRow + 1) / Rows - .5);
  return (SunRadiance - .25) * 2.0 * Pi / Width * (std::sin(high) - std::sin(low));
}

}

TEST(vtkPenumbraEnvironment, ReturnsPiTimesUniformRadiance)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  const glm::dvec3 color(.5, 1.0, 2.0);
  environment->SetImage(MakeImage(8, 4, [&](double, double) { return color; }));
  for (const glm::dvec3& normal :
    { glm::dvec3(0, 0, 1), glm::dvec3(.6, -.8, 0), glm::dvec3(0, -1, 0) })
  {
    const IrradianceResult result = ComputeIrradiance(environment, normal, Scene());
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(result.Value[c], Pi * color[c], 1e-5);
    }
    EXPECT_LT(result.Error, 1e-6);
  }
}

TEST(vtkPenumbraEnvironment, MatchesClosedFormForSineOfElevation)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(MakeImage(256, 256, SineOfElevation));
  EXPECT_FALSE(environment->GetMap()->HasSuns());
  environment->SetUp(0.0, 0.0, 3.0);
  EXPECT_NEAR(ComputeIrradiance(environment, { 0, 0, 1 }, Scene()).Value.x, 2.0 * Pi / 3.0, .003);
  EXPECT_NEAR(ComputeIrradiance(environment, { 1, 0, 0 }, Scene()).Value.x, 2.0 / 3.0, .003);
  EXPECT_NEAR(ComputeIrradiance(environment, { 0, 0, -1 }, Scene()).Value.x, 0.0, 1e-6);
  environment->SetUp(.6, 0.0, .8);
  EXPECT_NEAR(ComputeIrradiance(environment, { .6, 0, .8 }, Scene()).Value.x, 2.0 * Pi / 3.0, .003);
  EXPECT_NEAR(ComputeIrradiance(environment, { -.8, 0, .6 }, Scene()).Value.x, 2.0 / 3.0, .003);
}

TEST(vtkPenumbraEnvironment, IsOrientedAsInVTK)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(MakeImage(64, 32, [](double longitude, double latitude) {
    return glm::dvec3(longitude, latitude, 0.0) + 4.0; // at least 4 - pi
  }));
  environment->SetUp(0.0, 0.0, 1.0);
  environment->SetRight(0.0, 2.0, 1.0);
  const auto radiance = [&](glm::vec3 direction) {
    return glm::dvec3(environment->GetMap()->ClampedRadiance(direction)) - 4.0;
  };
  EXPECT_NEAR(radiance({ 0, 1, 0 }).x, 0.0, .06);
  EXPECT_NEAR(radiance({ 1, 0, 0 }).x, Pi / 2, .06); // Right x Up
  EXPECT_NEAR(radiance({ -1, 0, 0 }).x, -Pi / 2, .06);
  EXPECT_NEAR(radiance({ .001f, 0, 1 }).y, Pi / 2, .06);
  EXPECT_NEAR(radiance({ .001f, 0, -1 }).y, -Pi / 2, .06);
}

TEST(vtkPenumbraEnvironment, IncludesSmallSun)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(MakeImage(Width, Rows, SunlitSky));
  environment->SetUp(0.0, 0.0, 1.0);
  ASSERT_TRUE(environment->GetMap()->HasSuns());
  const double sun = ComputeSunIrradiance() * std::sin(SunLatitude);
  const IrradianceResult result = ComputeIrradiance(environment, { 0, 0, 1 }, Scene(), .01);
  EXPECT_NEAR(result.Value.x, sun + .25 * Pi, .002 * sun);
  EXPECT_NEAR(result.Value.z, .25 * Pi, .002);
  EXPECT_LT(result.Rays, 5000);
  // The sun is close to longitude 0.
  EXPECT_NEAR(ComputeIrradiance(environment, { 1, 0, 0 }, Scene(), .01).Value.x,
    ComputeSunIrradiance() * std::cos(SunLatitude) + .25 * Pi, .002 * sun);
}

TEST(EnvironmentMap, LeavesLittleOfABrightSunToRaysInAllDirections)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(MakeImage(64, 32, [](double longitude, double latitude) {
    return glm::dvec3(std::abs(longitude) < .06 && std::abs(latitude - .8) < .05 ? 1e5 : .5);
  }));
  const std::shared_ptr<const EnvironmentMap> map = environment->GetMap();
  EXPECT_GT(map->GetMeanRadiance(), 20.0);
  EXPECT_NEAR(map->GetLargestRadiance(), 8.0 * .5, .2);
}

TEST(EnvironmentMap, SamplesSunsByRadianceAndSolidAngle)
{
  // Bright texels in three rows, of different brightness and color, above a dim sky.
  const auto sky = [](double longitude, double latitude) {
    const int column = static_cast<int>(std::floor((longitude / (2.0 * Pi) + .5) * 32.0));
    const int row = static_cast<int>(std::floor((latitude / Pi + .5) * 16.0));
    const bool isBright = row >= 11 && row <= 13 && (column * 7 + row * 3) % 5 == 0;
    return isBright ? glm::dvec3(40.0 + column, 90.0 - row, 20.0 * (row - 10)) : glm::dvec3(.1);
  };
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(MakeImage(32, 16, sky));
  environment->SetUp(0.0, 0.0, 1.0);
  const std::shared_ptr<const EnvironmentMap> map = environment->GetMap();
  ASSERT_TRUE(map->HasSuns());
  // Irradiance of both parts on planes against a sum over directions.
  for (const glm::vec3 normal :
    { glm::vec3(0.f, 0.f, 1.f), glm::vec3(.6f, 0.f, .8f), glm::vec3(0.f, -1.f, 0.f) })
  {
    glm::dvec3 exact(0.0);
    glm::dvec3 clamped(0.0);
    constexpr int Steps = 512;
    for (int j = 0; j < Steps; ++j)
    {
      const double latitude = std::asin(2.0 * (j + .5) / Steps - 1.0);
      for (int i = 0; i < 2 * Steps; ++i)
      {
        const double longitude = Pi * (i + .5) / Steps - Pi;
        const glm::dvec3 direction(std::cos(latitude) * std::cos(longitude),
          -std::cos(latitude) * std::sin(longitude), std::sin(latitude));
        const double weight =
          std::max(glm::dot(direction, glm::dvec3(normal)), 0.0) * 2.0 * Pi / (Steps * Steps);
        clamped += weight * glm::dvec3(map->ClampedRadiance(direction));
        exact += weight * sky(longitude, latitude);
      }
    }
    glm::dvec3 sampled(0.0);
    constexpr int Side = 128;
    for (int k = 0; k < Side * Side; ++k)
    {
      const EnvironmentMap::Sun sun =
        map->SampleSun((glm::vec2(k % Side, k / Side) + .5f) / static_cast<float>(Side));
      EXPECT_GT(
        sky(std::atan2(-sun.Direction.y, sun.Direction.x), std::asin(sun.Direction.z)).x, 1.0);
      sampled += glm::dvec3(sun.Weight) * double(std::max(glm::dot(sun.Direction, normal), 0.f)) /
        double(Side * Side);
    }
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(clamped[c] + sampled[c], exact[c], .01 * exact[c]);
    }
  }
}

TEST(EnvironmentMap, SamplesAllLightOfABlackSkyWithASun)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(MakeImage(64, 32, [](double longitude, double latitude) {
    return glm::dvec3(std::abs(longitude) < .06 && std::abs(latitude - .8) < .05 ? 100.0 : 0.0);
  }));
  const std::shared_ptr<const EnvironmentMap> map = environment->GetMap();
  ASSERT_TRUE(map->HasSuns());
  EXPECT_LT(map->GetLargestRadiance(), 1.0);
  environment->SetUp(0.0, 0.0, 1.0);
  const double total = 4.0 * Pi * map->GetMeanRadiance();
  EXPECT_NEAR(ComputeIrradiance(environment, { 0, 0, 1 }, Scene(), .001).Value.x,
    std::sin(.8) * total, .05 * total);
}

TEST(vtkPenumbraEnvironment, CastsShadowsFromSun)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(MakeImage(Width, Rows, SunlitSky));
  environment->SetUp(0.0, 0.0, 1.0);
  Scene scene;
  AddDisc(scene, .5f, 1.f);
  scene.Surfaces.back().Front.Diffuse = 0.f;
  // x coordinate of a point in the shadow of the disk.
  const double shadowed = -std::cos(SunLatitude) / std::sin(SunLatitude);
  const double hidden = .25 / (.25 + 1.0); // occlusion below the center of the disk
  EXPECT_NEAR(
    ComputeIrradiance(environment, { 0, 0, 1 }, scene).Value.z, .25 * Pi * (1.0 - hidden), .004);
  EXPECT_LT(
    ComputeIrradiance(environment, { 0, 0, 1 }, scene, .01, { shadowed, 0, 0 }).Value.x, .25 * Pi);
  EXPECT_GT(ComputeIrradiance(environment, { 0, 0, 1 }, scene, .01).Value.x,
    .99 * ComputeSunIrradiance() * std::sin(SunLatitude));
}

/// Paths of two reflections from a point that faces a large white floor, under a sky of radiance 1 with a red sun.
struct FloorPaths
{
  glm::dvec3 Mean{ 0.0 };
  double Rays = 0.0; ///< per path
  double Sun = 0.0;  ///< mean radiance that the floor gets from the sun, if it is above the horizon

  static constexpr int Paths = 40000;
  /// Standard error of a mean of paths of which one in eight returns 4, the others 0.
  static constexpr double SkyError = .5 * 2.6457513 / 200.0;

  /// `sunRow`: of 32 rows of the sky. `tolerance`: see Illumination::AcceptNoise().
  explicit FloorPaths(int sunRow, double tolerance = 0.0)
  {
    constexpr double SunRadiance = 2e4;
    vtkNew<vtkPenumbraEnvironment> environment;
    environment->SetImage(MakeImage(64, 32, [sunRow](double longitude, double latitude) {
      const bool isSun = static_cast<int>((latitude / Pi + .5) * 32.0) == sunRow &&
        static_cast<int>((longitude / (2.0 * Pi) + .5) * 64.0) == 0;
      return isSun ? glm::dvec3(SunRadiance, 1.0, 1.0) : glm::dvec3(1.0);
    }));
    environment->SetUp(0.0, 0.0, 1.0);
    IlluminationSettings settings;
    settings.Map = environment->GetMap();
    settings.Albedo = .5f;
    settings.Bounces = 2;
    Scene scene;
    AddRectangle(scene, { -1e3f, -1e3f, 0.f }, { 2e3f, 0.f, 0.f }, { 0.f, 2e3f, 0.f });
    const RayScene rays(scene, 1);
    Illumination light(rays, settings);
    light.AcceptNoise(tolerance, Paths);
    std::uint32_t random = 1;
    long long traced = 0;
    for (int i = 0; i < Paths; ++i)
    {
      this->Mean += glm::dvec3(light.TracePath(
                      { 0.f, 0.f, 1.f }, glm::vec3(0.f, 0.f, -1.f), 2, random, traced)) /
        double(Paths);
    }
    this->Rays = static_cast<double>(traced) / Paths;
    const double low = -std::cos(Pi * sunRow / 32.0);
    const double high = -std::cos(Pi * (sunRow + 1) / 32.0);
    this->Sun = (SunRadiance - 1.0) / 64.0 * (high * high - low * low);
  }
};

/// Few of the last rays of paths, from the floor to the sky, are traced.
TEST(vtkPenumbraEnvironment, LightsPathsByTheSkyBesideABrightSun)
{
  const FloorPaths paths(24);
  EXPECT_GT(paths.Sun, 16.0);
  EXPECT_NEAR(paths.Mean.x, .5 * (1.0 + paths.Sun), .01 * paths.Sun);
  EXPECT_NEAR(paths.Mean.y, .5, 4.0 * FloorPaths::SkyError);
  EXPECT_LT(paths.Rays, 2.2);
}

/// The sun is below the floor, which hides it from the point.
TEST(vtkPenumbraEnvironment, TracesLastRaysOfPathsAsTheToleranceRequires)
{
  const FloorPaths all(7);
  EXPECT_DOUBLE_EQ(all.Rays, 3.0);
  EXPECT_NEAR(all.Mean.x, .5, 1e-5);
  const FloorPaths coarse(7, 1.0);
  EXPECT_LT(coarse.Rays, 2.2);
  EXPECT_NEAR(coarse.Mean.x, .5, 4.0 * FloorPaths::SkyError);
  const double tolerance = 1e-3;
  const FloorPaths fine(7, tolerance);
  EXPECT_GT(fine.Rays, 2.9);
  EXPECT_NEAR(fine.Mean.x, .5, 4.0 * .5 * tolerance);
}

/// Lights points below edges. Returns how many are partly shadowed, and how many of them have a wrong value and
/// estimate. `width`: of the row of points below each edge. `wire`: width of the occluder; 0: a half-plane.
std::array<int, 2> CountShadowEdges(const SkyFunction& sky, float width, float wire = 0.f)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(MakeImage(Width, Rows, sky));
  environment->SetUp(0.0, 0.0, 1.0);
  const std::shared_ptr<const EnvironmentMap> map = environment->GetMap();
  IlluminationSettings settings;
  settings.Map = map;
  constexpr int Edges = 40;
  constexpr int Points = 50;
  constexpr int Side = 64;
  int wrong = 0;
  int penumbra = 0;
  for (int edge = 0; edge < Edges; ++edge)
  {
    // At height 1, behind a line through the origin or on both sides of it.
    const float angle = 2.f * static_cast<float>(Pi) * (edge + .3f) / Edges;
    const glm::vec3 across(std::cos(angle), std::sin(angle), 0.f);
    const glm::vec3 along(-across.y, across.x, 0.f);
    const glm::vec3 up(0.f, 0.f, 1.f);
    Scene scene;
    const float begin = wire > 0.f ? .5f * wire : 0.f;
    const float end = wire > 0.f ? -.5f * wire : -50.f;
    AddRectangle(scene, up + begin * across - 50.f * along, 100.f * along, (end - begin) * across);
    const RayScene rays(scene, 1);
    const Illumination light(rays, settings);
    const glm::vec3 sun = map->SampleSun({ .5f, .5f }).Direction;
    for (int i = 0; i < Points; ++i)
    {
      const glm::vec3 point = (width * (static_cast<float>(i) / Points - .5f)) * across -
        glm::vec3(sun.x, sun.y, 0.f) / sun.z;
      double exact = 0.0;
      double unshadowed = 0.0;
      for (int k = 0; k < Side * Side; ++k)
      {
        const EnvironmentMap::Sun sample =
          map->SampleSun((glm::vec2(k % Side, k / Side) + .5f) / static_cast<float>(Side));
        const double value = sample.Direction.z * sample.Weight.x / (Pi * Side * Side);
        const glm::vec3 hit = point + sample.Direction / sample.Direction.z;
        const float at = glm::dot(hit, across);
        exact += at > begin || at < end ? value : 0.0;
        unshadowed += value;
      }
      penumbra += exact > 0.0 && exact < unshadowed ? 1 : 0;
      long long count = 0;
      const double tolerance = .01 * unshadowed;
      const auto found =
        light.EstimateSampledLight(point, glm::vec3(0.f, 0.f, 1.f), tolerance, count);
      wrong +=
        std::abs(found.Mean.x - exact) > std::max(2.0 * tolerance, 4.0 * found.Error) ? 1 : 0;
    }
  }
  return { penumbra, wrong };
}

TEST(vtkPenumbraEnvironment, FindsShadowEdgesThatHideLittleOfTheSun)
{
  const auto [penumbra, wrong] = CountShadowEdges(SunlitSky, .02f);
  EXPECT_GT(penumbra, 500);
  EXPECT_EQ(wrong, 0);
}

TEST(vtkPenumbraEnvironment, FindsShadowEdgesThatHideLittleOfARoundSun)
{
  const auto [penumbra, wrong] = CountShadowEdges(SkyWithRoundSun, .14f);
  EXPECT_GT(penumbra, 500);
  EXPECT_EQ(wrong, 0);
}

TEST(vtkPenumbraEnvironment, MissesSomeWiresNarrowerThanHalfOfTheSun)
{
  constexpr double Diameter = 6.4 * Pi / Rows;
  // Widths relative to the diameter of the sun, and fractions of points with a wrong value and estimate.
  const double rows[][2] = { { 0.5, 0.0 }, { 0.25, 0.04 }, { 0.125, 0.23 }, { 0.0625, 0.4 } };
  for (const auto& [width, bound] : rows)
  {
    const auto [penumbra, wrong] =
      CountShadowEdges(SkyWithRoundSun, .14f, static_cast<float>(width * Diameter));
    EXPECT_GT(penumbra, 1500) << width;
    EXPECT_LE(wrong, bound * penumbra) << width;
  }
}

TEST(vtkPenumbraEnvironment, TreatsIntegersAsSRGB)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 1, 1);
  vtkNew<vtkUnsignedCharArray> gray;
  gray->InsertNextValue(188);
  gray->InsertNextValue(188);
  image->GetPointData()->SetScalars(gray);
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(image);
  environment->SetIntensity(2.0);
  const glm::vec3 radiance = environment->GetMap()->ClampedRadiance({ 0.f, 1.f, 0.f });
  EXPECT_NEAR(radiance.x, 2.0 * .5029, .0002); // ((188 / 255 + .055) / 1.055)^2.4
  EXPECT_EQ(radiance.z, radiance.x);
}

TEST(vtkPenumbraEnvironment, RebuildsMapAfterModification)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(MakeImage(4, 2, SineOfElevation));
  const auto first = environment->GetMap();
  EXPECT_EQ(environment->GetMap(), first);
  environment->SetUp(1.0, 0.0, 0.0);
  EXPECT_NE(environment->GetMap(), first);
}

TEST(vtkPenumbraEnvironment, RejectsInvalidImagesAndDirections)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  EXPECT_THROW(environment->GetMap(), std::runtime_error);
  for (const double invalid : { -1.0, std::nan(""), HUGE_VAL })
  {
    environment->SetImage(MakeImage(4, 2, [&](double, double) { return glm::dvec3(invalid); }));
    EXPECT_THROW(environment->GetMap(), std::runtime_error) << invalid;
  }
  environment->SetImage(MakeImage(4, 2, SineOfElevation));
  environment->SetUp(0.0, 0.0, 0.0);
  EXPECT_THROW(environment->GetMap(), std::runtime_error);
  environment->SetUp(1.0, 0.0, 0.0); // parallel to Right, which is replaced
  EXPECT_NO_THROW(environment->GetMap());
}
