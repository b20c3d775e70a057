// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Irradiance of pictures of the environment against closed forms.
#include "vtkPenumbraEnvironment.h"

#include "Scenes/Solids.h"
#include "Shading/EnvironmentMap.h"
#include "Shading/Illumination.h"
#include "vtkPenumbraBruteForceIrradiance.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

using namespace penumbra;

namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Radiance by longitude and latitude, in radians.
using Sky = std::function<glm::dvec3(double longitude, double latitude)>;

vtkSmartPointer<vtkImageData> Paint(int width, int height, const Sky& sky)
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

glm::dvec3 Height(double, double latitude)
{
  return glm::dvec3(std::max(std::sin(latitude), 0.0));
}

/// Irradiance at the origin of a scene, by brute force.
struct Answer
{
  glm::dvec3 Value;
  double Error;
  long long Rays;
};

Answer Ask(vtkPenumbraEnvironment* environment, glm::dvec3 normal, const Scene& scene,
  double tolerance = .002, glm::dvec3 point = glm::dvec3(0.0))
{
  const RayScene rays(scene, 1);
  IlluminationSettings settings;
  settings.Picture = environment->GetMap();
  vtkNew<vtkPenumbraBruteForceIrradiance> source;
  source->BeginIrradiance(Illumination(rays, settings), tolerance);
  const auto light = source->Irradiance(&point.x, &normal.x, tolerance);
  return { { light.Value[0], light.Value[1], light.Value[2] }, light.Error, light.Rays };
}

/// A sun of one texel in a dim sky.
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

/// Irradiance of the sun's texel square to it, nearly.
double SunStrength()
{
  const double low = Pi * (double(SunRow) / Rows - .5);
  const double high = Pi * (double(SunRow + 1) / Rows - .5);
  return (SunRadiance - .25) * 2.0 * Pi / Width * (std::sin(high) - std::sin(low));
}

}

TEST(vtkPenumbraEnvironment, OfOneColourIsThatColour)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  const glm::dvec3 color(.5, 1.0, 2.0);
  environment->SetImage(Paint(8, 4, [&](double, double) { return color; }));
  for (const glm::dvec3& normal :
    { glm::dvec3(0, 0, 1), glm::dvec3(.6, -.8, 0), glm::dvec3(0, -1, 0) })
  {
    const Answer found = Ask(environment, normal, Scene());
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(found.Value[c], Pi * color[c], 1e-5);
    }
    EXPECT_LT(found.Error, 1e-6);
  }
}

TEST(vtkPenumbraEnvironment, ThatBrightensUpwardsHasTheIntegralsOfTheCosine)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(Paint(256, 256, Height));
  EXPECT_FALSE(environment->GetMap()->HasSuns());
  environment->SetUp(0.0, 0.0, 3.0);
  EXPECT_NEAR(Ask(environment, { 0, 0, 1 }, Scene()).Value.x, 2.0 * Pi / 3.0, .003);
  EXPECT_NEAR(Ask(environment, { 1, 0, 0 }, Scene()).Value.x, 2.0 / 3.0, .003);
  EXPECT_NEAR(Ask(environment, { 0, 0, -1 }, Scene()).Value.x, 0.0, 1e-6);
  environment->SetUp(.6, 0.0, .8);
  EXPECT_NEAR(Ask(environment, { .6, 0, .8 }, Scene()).Value.x, 2.0 * Pi / 3.0, .003);
  EXPECT_NEAR(Ask(environment, { -.8, 0, .6 }, Scene()).Value.x, 2.0 / 3.0, .003);
}

TEST(vtkPenumbraEnvironment, LiesAroundAsInVTK)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(Paint(64, 32, [](double longitude, double latitude) {
    return glm::dvec3(longitude, latitude, 0.0) + 4.0; // from 4 - pi up
  }));
  environment->SetUp(0.0, 0.0, 1.0);
  environment->SetRight(0.0, 2.0, 1.0);
  const auto seen = [&](glm::vec3 direction) {
    return glm::dvec3(environment->GetMap()->ClampedRadiance(direction)) - 4.0;
  };
  EXPECT_NEAR(seen({ 0, 1, 0 }).x, 0.0, .06);
  EXPECT_NEAR(seen({ 1, 0, 0 }).x, Pi / 2, .06); // Right x Up
  EXPECT_NEAR(seen({ -1, 0, 0 }).x, -Pi / 2, .06);
  EXPECT_NEAR(seen({ .001f, 0, 1 }).y, Pi / 2, .06);
  EXPECT_NEAR(seen({ .001f, 0, -1 }).y, -Pi / 2, .06);
}

TEST(vtkPenumbraEnvironment, LosesNothingOfASmallSun)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(Paint(Width, Rows, SunlitSky));
  environment->SetUp(0.0, 0.0, 1.0);
  ASSERT_TRUE(environment->GetMap()->HasSuns());
  const double sun = SunStrength() * std::sin(SunLatitude);
  const Answer found = Ask(environment, { 0, 0, 1 }, Scene(), .01);
  EXPECT_NEAR(found.Value.x, sun + .25 * Pi, .002 * sun);
  EXPECT_NEAR(found.Value.z, .25 * Pi, .002);
  EXPECT_LT(found.Rays, 5000);
  // Towards longitude 0, nearly.
  EXPECT_NEAR(Ask(environment, { 1, 0, 0 }, Scene(), .01).Value.x,
    SunStrength() * std::cos(SunLatitude) + .25 * Pi, .002 * sun);
}

TEST(vtkPenumbraEnvironment, IsHiddenWithItsSun)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(Paint(Width, Rows, SunlitSky));
  environment->SetUp(0.0, 0.0, 1.0);
  Scene scene;
  AddDisc(scene, .5f, 1.f);
  scene.Surfaces.back().Front.Diffuse = 0.f;
  // The disc lies between the sun and a point that is so far behind it.
  const double beside = -std::cos(SunLatitude) / std::sin(SunLatitude);
  const double hidden = .25 / (.25 + 1.0); // seen from below its middle
  EXPECT_NEAR(Ask(environment, { 0, 0, 1 }, scene).Value.z, .25 * Pi * (1.0 - hidden), .004);
  EXPECT_LT(Ask(environment, { 0, 0, 1 }, scene, .01, { beside, 0, 0 }).Value.x, .25 * Pi);
  EXPECT_GT(
    Ask(environment, { 0, 0, 1 }, scene, .01).Value.x, .99 * SunStrength() * std::sin(SunLatitude));
}

TEST(vtkPenumbraEnvironment, TakesWholeNumbersAsStandardRGB)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 1, 1);
  vtkNew<vtkUnsignedCharArray> grey;
  grey->InsertNextValue(188);
  grey->InsertNextValue(188);
  image->GetPointData()->SetScalars(grey);
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(image);
  environment->SetIntensity(2.0);
  const glm::vec3 seen = environment->GetMap()->ClampedRadiance({ 0.f, 1.f, 0.f });
  EXPECT_NEAR(seen.x, 2.0 * .5029, .0002); // ((188 / 255 + .055) / 1.055)^2.4
  EXPECT_EQ(seen.z, seen.x);
}

TEST(vtkPenumbraEnvironment, IsMadeAnewWhenSomethingChanged)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(Paint(4, 2, Height));
  const auto first = environment->GetMap();
  EXPECT_EQ(environment->GetMap(), first);
  environment->SetUp(1.0, 0.0, 0.0);
  EXPECT_NE(environment->GetMap(), first);
}

TEST(vtkPenumbraEnvironment, RefusesWhatIsNoPictureOfLight)
{
  vtkNew<vtkPenumbraEnvironment> environment;
  EXPECT_THROW(environment->GetMap(), std::runtime_error);
  for (const double wrong : { -1.0, std::nan(""), HUGE_VAL })
  {
    environment->SetImage(Paint(4, 2, [&](double, double) { return glm::dvec3(wrong); }));
    EXPECT_THROW(environment->GetMap(), std::runtime_error) << wrong;
  }
  environment->SetImage(Paint(4, 2, Height));
  environment->SetUp(0.0, 0.0, 0.0);
  EXPECT_THROW(environment->GetMap(), std::runtime_error);
  environment->SetUp(1.0, 0.0, 0.0); // Right is the same: any other will do
  EXPECT_NO_THROW(environment->GetMap());
}
