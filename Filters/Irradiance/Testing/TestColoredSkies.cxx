// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Irradiance under skies of one color: light of different channels does not mix, so that each channel
// equals that under a white sky.
#include "Gathering/HemisphereEstimate.h"
#include "Records/PixelCandidates.h"
#include "Scenes/Solids.h"
#include "Shading/EnvironmentMap.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/Illumination.h"
#include "SphereOnFloor.h"
#include "Surface.h"

#include "vtkCubeSource.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

using namespace penumbra_testing;
using namespace penumbra;

namespace
{

constexpr double Pi = glm::pi<double>();
constexpr int Size = 64;

/// White boxes on a floor.
struct Boxes
{
  Scene SceneData;
  std::unique_ptr<RayScene> Rays;
  std::vector<RecordCandidate> Sites;

  Boxes()
  {
    AddFloor(this->SceneData, 4.f);
    AddBox(this->SceneData, { -1.f, -.4f, 0.f }, { -.2f, .4f, .8f });
    AddBox(this->SceneData, { .1f, -.5f, 0.f }, { .7f, .2f, .4f });
    LookAt(this->SceneData, { 1.0, -4.0, 2.5 }, { 0.0, 0.0, .2 }, 40.0, Size, Size);
    this->Rays = std::make_unique<RayScene>(this->SceneData, 0);
    for (int level = 0; level < ImageLevels - 2; ++level)
    {
      const std::vector<RecordCandidate> sites = CandidatesInImage(*this->Rays, level);
      this->Sites.insert(this->Sites.end(), sites.begin(), sites.end());
    }
  }

  Illumination MakeLight(glm::vec3 sky) const
  {
    IlluminationSettings settings;
    settings.Environment = sky;
    settings.Bounces = 2;
    return Illumination(*this->Rays, settings);
  }

  std::vector<glm::dvec3> Query(
    vtkPenumbraIrradianceProvider* provider, glm::vec3 sky, double tolerance) const
  {
    provider->BeginIrradiance(this->MakeLight(sky), tolerance);
    std::vector<glm::dvec3> values;
    for (const RecordCandidate& site : this->Sites)
    {
      const glm::dvec3 world =
        glm::dvec3(site.Position) / this->SceneData.Scale + this->SceneData.Origin;
      const glm::dvec3 normal(site.Normal);
      const auto light = provider->Irradiance(&world.x, &normal.x, tolerance);
      values.emplace_back(light.Value[0], light.Value[1], light.Value[2]);
    }
    return values;
  }
};

void ExpectChannelsOfWhiteSky(vtkPenumbraIrradianceProvider* provider)
{
  const Boxes boxes;
  const std::vector<glm::dvec3> white = boxes.Query(provider, glm::vec3(1.f), .04);
  for (int channel = 0; channel < 3; ++channel)
  {
    glm::vec3 sky(0.f);
    sky[channel] = 1.f;
    const std::vector<glm::dvec3> colored = boxes.Query(provider, sky, .04);
    for (std::size_t i = 0; i < white.size(); ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_EQ(colored[i][c], c == channel ? white[i][c] : 0.0) << i;
      }
    }
  }
}

/// Returns a coarse sphere on a floor.
vtkSmartPointer<vtkPolyData> MakeSmallMesh()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(0.0, 0.0, 1.0);
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(12);
  sphere->SetPhiResolution(8);
  vtkNew<vtkAppendPolyData> all;
  all->AddInputConnection(MakeFloor(8)->GetOutputPort());
  all->AddInputConnection(sphere->GetOutputPort());
  all->Update();
  return all->GetOutput();
}

/// Returns slabs on a floor, which the sun lights from one side.
vtkSmartPointer<vtkPolyData> MakeSlabs()
{
  vtkNew<vtkAppendPolyData> all;
  all->AddInputConnection(MakeFloor(18)->GetOutputPort());
  for (int i = 0; i < 16; ++i)
  {
    const double x = 1.7 * (i % 4) - 3.2;
    const double y = 1.7 * (i / 4) - 3.2;
    vtkNew<vtkCubeSource> slab;
    slab->SetBounds(x, x + .5, y, y + .1, .1, 1.1);
    slab->Update();
    all->AddInputData(slab->GetOutput());
  }
  all->Update();
  return all->GetOutput();
}

std::vector<glm::dvec3> Bake(
  vtkPolyData* mesh, vtkPenumbraIrradianceFilter* filter, int method, double tolerance)
{
  filter->SetInputData(mesh);
  filter->SetQuantity(vtkPenumbraIrradianceFilter::IRRADIANCE);
  filter->SetMethod(method);
  filter->SetTolerance(tolerance);
  filter->SetBounces(2);
  filter->Update();
  vtkDataArray* array = GetPolyData(filter)->GetPointData()->GetArray("Irradiance");
  std::vector<glm::dvec3> values;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    values.emplace_back(
      array->GetComponent(i, 0), array->GetComponent(i, 1), array->GetComponent(i, 2));
  }
  return values;
}

std::vector<glm::dvec3> Bake(vtkPolyData* mesh, glm::dvec3 sky, int method, double tolerance = .1)
{
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetEnvironmentColor(sky.x, sky.y, sky.z);
  return Bake(mesh, filter, method, tolerance);
}

std::vector<glm::dvec3> Bake(
  vtkPolyData* mesh, vtkPenumbraEnvironment* sky, int method, double tolerance)
{
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetEnvironment(sky);
  return Bake(mesh, filter, method, tolerance);
}

}

TEST(ColoredSky, GivesTheCacheTheChannelsOfAWhiteSky)
{
  vtkNew<vtkPenumbraIrradianceCache> cache;
  ExpectChannelsOfWhiteSky(cache);
}

TEST(ColoredSky, GivesBruteForceTheChannelsOfAWhiteSky)
{
  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  ExpectChannelsOfWhiteSky(provider);
}

TEST(ColoredSky, GivesBakingTheChannelsOfAWhiteSky)
{
  const auto mesh = MakeSmallMesh();
  for (const int method :
    { vtkPenumbraIrradianceFilter::AUTOMATIC, vtkPenumbraIrradianceFilter::BRUTE_FORCE })
  {
    const std::vector<glm::dvec3> white = Bake(mesh, glm::dvec3(1.0), method);
    const std::vector<glm::dvec3> blue = Bake(mesh, { 0.0, 0.0, 1.0 }, method);
    for (std::size_t i = 0; i < white.size(); ++i)
    {
      EXPECT_EQ(blue[i], glm::dvec3(0.0, 0.0, white[i].z)) << i;
    }
  }
}

TEST(BrightSky, ScalesTheCacheWithItsTolerance)
{
  const Boxes boxes;
  vtkNew<vtkPenumbraIrradianceCache> cache;
  const auto count = [&](const char* name) {
    vtkNew<vtkFieldData> statistics;
    cache->Report(statistics);
    return statistics->GetArray(name)->GetComponent(0, 0);
  };
  const std::vector<glm::dvec3> white = boxes.Query(cache, glm::vec3(1.f), .06);
  const double rays = count("Rays/Gather");
  const double records = count("Cache/Records");
  for (const float factor : { 8.f, 1.f / 128.f }) // powers of two: rounding does not change
  {
    const std::vector<glm::dvec3> scaled = boxes.Query(cache, glm::vec3(factor), .06 * factor);
    EXPECT_EQ(count("Rays/Gather"), rays);
    EXPECT_EQ(count("Cache/Records"), records);
    for (std::size_t i = 0; i < white.size(); ++i)
    {
      EXPECT_NEAR(scaled[i].x, factor * white[i].x, 1e-6 * factor) << i;
    }
  }
}

TEST(BrightSky, KeepsTheTolerance)
{
  // The tolerance of the cache is that of the image: it does not increase with the radiance.
  const Boxes boxes;
  vtkNew<vtkPenumbraIrradianceCache> cache;
  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  provider->SetMinimumRays(2048);
  const std::vector<glm::dvec3> values = boxes.Query(cache, glm::vec3(8.f), .2);
  const std::vector<glm::dvec3> exact = boxes.Query(provider, glm::vec3(8.f), .2);
  double squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    squares += std::pow(values[i].x - exact[i].x, 2.0) / static_cast<double>(values.size());
  }
  EXPECT_LE(std::sqrt(squares), .2);
}

TEST(BrightSky, ScalesBakedIrradiance)
{
  const auto mesh = MakeSmallMesh();
  for (const int method :
    { vtkPenumbraIrradianceFilter::AUTOMATIC, vtkPenumbraIrradianceFilter::BRUTE_FORCE })
  {
    const std::vector<glm::dvec3> white = Bake(mesh, glm::dvec3(1.0), method);
    for (const double factor : { 8.0, 1.0 / 128.0 })
    {
      const std::vector<glm::dvec3> scaled = Bake(mesh, glm::dvec3(factor), method);
      for (std::size_t i = 0; i < white.size(); ++i)
      {
        EXPECT_NEAR(scaled[i].x, factor * white[i].x, 1e-6 * factor) << i;
      }
    }
  }
}

TEST(BrightSky, MeetsToleranceOfBakedIrradianceUnderSun)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(64, 32, 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  for (int i = 0; i < 64 * 32; ++i)
  {
    const bool isSun = i == 24 * 64 + 44;
    image->SetScalarComponentFromDouble(i % 64, i / 64, 0, 0, isSun ? 1e5 : .3);
  }
  vtkNew<vtkPenumbraEnvironment> sky;
  sky->SetImage(image);
  sky->SetUp(0.0, 0.0, 1.0);
  const auto mesh = MakeSlabs();
  constexpr double Tolerance = .03;
  const auto values = Bake(mesh, sky, vtkPenumbraIrradianceFilter::AUTOMATIC, Tolerance);
  const auto exact = Bake(mesh, sky, vtkPenumbraIrradianceFilter::BRUTE_FORCE, .5 * Tolerance);
  double squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    squares += std::pow(values[i].x - exact[i].x, 2.0) / static_cast<double>(values.size());
  }
  EXPECT_LE(std::sqrt(squares), Tolerance * sky->GetMap()->GetMeanRadiance());
}

TEST(SourceRadiance, IsThatOfSkiesAndLights)
{
  const Boxes boxes;
  EXPECT_EQ(boxes.MakeLight(glm::vec3(0.f)).GetSourceRadiance().Mean, 1.0);
  EXPECT_EQ(boxes.MakeLight(glm::vec3(0.f)).GetSourceRadiance().Largest, 1.0);
  EXPECT_FLOAT_EQ(boxes.MakeLight({ .1f, .3f, .2f }).GetSourceRadiance().Mean, .3f);
  EXPECT_FLOAT_EQ(boxes.MakeLight({ .1f, .3f, .2f }).GetSourceRadiance().Largest, .3f);
  Scene lit = boxes.SceneData;
  lit.Lights.emplace_back();
  lit.Lights.back().DiffuseColor = { 2.f, 1.f, 1.f };
  const RayScene rays(lit, 0);
  EXPECT_EQ(Illumination(rays, IlluminationSettings()).GetSourceRadiance().Largest, 2.0);
  // A map of two rows, of which the upper one has radiance 2.
  IlluminationSettings settings;
  settings.Map = std::make_shared<EnvironmentMap>(1, 2,
    std::vector<glm::vec3>{ glm::vec3(0.f), { 0.f, 0.f, 2.f } }, glm::dvec3(0.0, 0.0, 1.0),
    glm::dvec3(1.0, 0.0, 0.0));
  const auto found = Illumination(*boxes.Rays, settings).GetSourceRadiance();
  EXPECT_NEAR(found.Mean, 1.0, 1e-6);
  EXPECT_NEAR(found.Largest, 2.0, 1e-6);
}

TEST(HemisphereEstimate, HasTheDerivativesOfTheWorstChannel)
{
  // A wall of one color on one side: the derivatives do not depend on the channel.
  const HemisphereGrid& grid = HemisphereGrid::Get(16);
  std::vector<glm::vec3> directions;
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    const glm::vec2 at(cell % grid.Side + .5f, cell / grid.Side + .5f);
    const glm::vec2 inDisk = at / static_cast<float>(grid.Side);
    directions.push_back(DiskToHemisphere(SampleUniformDiskConcentric(inDisk.x, inDisk.y)));
  }
  const auto estimate = [&](glm::vec3 color) {
    std::vector<HemisphereSample> samples(directions.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      if (directions[i].x < -.3f)
      {
        samples[i].Distance = -1.f / directions[i].x;
        samples[i].Normal = { 1.f, 0.f, 0.f };
        samples[i].Radiance = color;
      }
    }
    return EstimateHemisphere(grid, glm::mat3(1.f), directions, samples, DistanceFalloff());
  };
  const HemisphereEstimate white = estimate(glm::vec3(1.f));
  EXPECT_GT(white.HessianNorm, 0.f);
  EXPECT_GT(white.Error, 0.f);
  for (const glm::vec3 color :
    { glm::vec3(1.f, 0.f, 0.f), glm::vec3(.2f, 1.f, .4f), glm::vec3(0.f, 0.f, 1.f) })
  {
    const HemisphereEstimate colored = estimate(color);
    EXPECT_EQ(colored.HessianNorm, white.HessianNorm);
    EXPECT_EQ(colored.Error, white.Error);
    EXPECT_EQ(colored.OccluderEdgeDistance, white.OccluderEdgeDistance);
  }
}
