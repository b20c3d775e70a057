// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Indirect light of neighboring pixels that is estimated together: accuracy against a closed form and
// brute force, independence of the requested extent and of threads, and bright emitters.
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace
{

constexpr double LightTolerance = 0.01;
constexpr double Height = 1.5; // of the center of the sphere

/// A white floor under a unit sphere with a narrower view of the floor beside the sphere.
class JoinedIndirectLight : public testing::Test
{
protected:
  JoinedIndirectLight()
  {
    vtkNew<vtkPlaneSource> floor;
    floor->SetOrigin(-40.0, -40.0, 0.0);
    floor->SetPoint1(40.0, -40.0, 0.0);
    floor->SetPoint2(-40.0, 40.0, 0.0);
    this->Floor = this->Add(floor);
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(1.0);
    sphere->SetCenter(0.0, 0.0, Height);
    sphere->SetThetaResolution(100);
    sphere->SetPhiResolution(100);
    this->Sphere = this->Add(sphere);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(1.0);
    camera->SetFocalPoint(2.2, 0.0, 0.0);
    camera->SetPosition(2.2, 0.0, 10.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(48, 48);
    this->Caster->IndirectLightOn();
    this->Caster->SetEnvironmentColor(1.0, 1.0, 1.0);
    this->Caster->SetAlbedo(0.8);
    this->Caster->SetAmbientOcclusionRadius(1e6);
    this->Caster->SetAmbientOcclusionStrength(1.0);
    this->Caster->SetLightTolerance(LightTolerance);
    this->Light->SetLightTypeToSceneLight();
    this->Light->SetPosition(3.0, 1.0, 5.0);
    this->Light->SetIntensity(0.0);
    this->Renderer->AddLight(this->Light);
  }

  vtkProperty* Add(vtkPolyDataAlgorithm* source)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    return actor->GetProperty();
  }

  void Join(bool joins)
  {
    vtkNew<vtkPenumbraBruteForceIrradiance> provider;
    provider->SetJoinPixels(joins);
    this->Caster->SetIrradianceProvider(provider);
  }

  /// Uses records, at any cost or only where few are needed.
  void UseRecords(bool automatic)
  {
    vtkNew<vtkPenumbraIrradianceCache> provider;
    provider->SetJoinPixels(automatic);
    this->Caster->SetIrradianceProvider(provider);
  }

  double CountRecords()
  {
    return this->Caster->GetStatistics()->GetArray("Cache/Records")->GetTuple1(0);
  }

  std::vector<float> Render()
  {
    this->Caster->Update();
    vtkDataArray* colors = this->Caster->GetOutput()->GetPointData()->GetArray("Color");
    std::vector<float> values;
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        values.push_back(static_cast<float>(colors->GetComponent(i, c)));
      }
    }
    return values;
  }

  double GetRaysPerPixel()
  {
    const int* size = this->Caster->GetResolution();
    return this->Caster->GetStatistics()->GetArray("Rays/Indirect")->GetTuple1(0) /
      (size[0] * size[1]);
  }

  /// Looks at the sphere from the side, with a sun.
  void ShowSphereInSunlight()
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0.0, -8.0, 4.0);
    camera->SetFocalPoint(0.0, 0.0, 1.0);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetParallelScale(2.5);
    this->Sphere->SetDiffuseColor(0.9, 0.4, 0.2);
    this->Light->SetIntensity(1.0);
    this->Caster->ShadowsOn();
    this->Caster->SetEnvironmentColor(0.2, 0.3, 0.4);
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkLight> Light;
  vtkNew<vtkPenumbraRayCaster> Caster;
  vtkProperty* Floor = nullptr;
  vtkProperty* Sphere = nullptr;
};

double ComputeRmse(const std::vector<float>& colors, const std::vector<float>& expected)
{
  double squares = 0.0;
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    squares += std::pow(colors[i] - expected[i], 2.0);
  }
  return std::sqrt(squares / static_cast<double>(colors.size()));
}

/// Returns the part of the sky that the pixels of the floor see, for each channel.
std::vector<float> ComputeOpenSky(int side)
{
  std::vector<float> values;
  for (int p = 0; p < side * side; ++p)
  {
    const double x = 1.2 + 2.0 * (p % side + 0.5) / side;
    const double y = 2.0 * (p / side + 0.5) / side - 1.0;
    const double open = 1.0 - Height / std::pow(Height * Height + x * x + y * y, 1.5);
    values.insert(values.end(), 3, static_cast<float>(open));
  }
  return values;
}

}

TEST_F(JoinedIndirectLight, MatchesTheClosedFormUnderASphere)
{
  this->Sphere->SetDiffuseColor(0.0, 0.0, 0.0);
  std::vector<float> expected = ComputeOpenSky(48);
  for (float& value : expected)
  {
    value *= 0.8f;
  }
  EXPECT_LT(ComputeRmse(this->Render(), expected), 0.5 * LightTolerance);
  EXPECT_LT(this->GetRaysPerPixel(), 40.0);
  EXPECT_LT(this->Caster->GetEstimatedError(), LightTolerance);
}

// Occlusion darkens the color of the lights, here ambient light, and leaves indirect light as it is.
TEST_F(JoinedIndirectLight, MatchesTheClosedFormTogetherWithAmbientOcclusion)
{
  this->Sphere->SetDiffuseColor(0.0, 0.0, 0.0);
  this->Floor->SetAmbient(0.5);
  this->Floor->SetAmbientColor(1.0, 1.0, 1.0);
  this->Caster->AmbientOcclusionOn();
  std::vector<float> expected = ComputeOpenSky(48);
  for (float& value : expected)
  {
    value *= 0.8f + 0.5f;
  }
  EXPECT_LT(ComputeRmse(this->Render(), expected), 0.5 * LightTolerance);
}

TEST_F(JoinedIndirectLight, IsCloseToEstimatesOfSinglePoints)
{
  this->ShowSphereInSunlight();
  this->Caster->SetResolution(16, 16);
  for (const bool hasOcclusion : { false, true })
  {
    this->Caster->SetAmbientOcclusion(hasOcclusion);
    this->Caster->SetLightTolerance(LightTolerance);
    this->Join(true);
    const std::vector<float> joined = this->Render();
    const double rays = this->GetRaysPerPixel();
    this->Join(false);
    this->Caster->SetLightTolerance(0.5 * LightTolerance);
    const std::vector<float> alone = this->Render();
    EXPECT_LT(ComputeRmse(joined, alone), LightTolerance) << hasOcclusion;
    EXPECT_LT(rays, 0.2 * this->GetRaysPerPixel()) << hasOcclusion;
  }
}

// The extent is far from the borders of the image.
TEST_F(JoinedIndirectLight, DependsNeitherOnThreadsNorOnTheRequestedExtent)
{
  this->ShowSphereInSunlight();
  this->Caster->SetResolution(160, 40);
  this->Caster->SetNumberOfThreads(1);
  const std::vector<float> one = this->Render();
  this->Caster->SetNumberOfThreads(3);
  this->Caster->Modified();
  EXPECT_EQ(this->Render(), one);
  vtkNew<vtkPenumbraRayCaster> other;
  this->Caster->UpdateInformation();
  int extent[6] = { 71, 90, 13, 22, 0, 0 };
  this->Caster->Modified();
  this->Caster->UpdateExtent(extent);
  vtkImageData* part = this->Caster->GetOutput();
  vtkDataArray* colors = part->GetPointData()->GetArray("Color");
  for (int y = extent[2]; y <= extent[3]; ++y)
  {
    for (int x = extent[0]; x <= extent[1]; ++x)
    {
      int index[3] = { x, y, 0 };
      const vtkIdType point = part->ComputePointId(index);
      ASSERT_EQ(colors->GetComponent(point, 0), one[3 * (160 * y + x)]) << x << " " << y;
    }
  }
}

// Pixels at the outline of an emitter that is a hundred times brighter than the floor: which part of
// them the floor covers is known from their color.
TEST_F(JoinedIndirectLight, HasSmallErrorsAtOutlinesOfBrightEmitters)
{
  this->Sphere->SetDiffuseColor(0.0, 0.0, 0.0);
  vtkNew<vtkPlaneSource> panel;
  panel->SetOrigin(1.9, -0.4, 5.0);
  panel->SetPoint1(2.6, -0.3, 5.0);
  panel->SetPoint2(1.8, 0.3, 5.0);
  vtkProperty* property = this->Add(panel);
  property->SetAmbient(1.0);
  property->SetAmbientColor(30.0, 30.0, 30.0);
  property->SetDiffuse(0.0);
  this->Join(true);
  const std::vector<float> joined = this->Render();
  EXPECT_LT(this->Caster->GetEstimatedError(), 2.0 * LightTolerance);
  this->Caster->SetLightTolerance(0.25 * LightTolerance);
  const std::vector<float> better = this->Render();
  EXPECT_LT(ComputeRmse(joined, better), LightTolerance);
}

TEST_F(JoinedIndirectLight, IsBlackWithoutAnyLight)
{
  this->Caster->SetEnvironmentColor(0.0, 0.0, 0.0);
  for (const float value : this->Render())
  {
    ASSERT_EQ(value, 0.f);
  }
}

// On the floor and the smooth sphere, few of the coarse points need a record.
TEST_F(JoinedIndirectLight, GivesWayToRecordsOnSmoothSurfaces)
{
  this->ShowSphereInSunlight();
  this->Caster->SetResolution(256, 256);
  this->Caster->SetBounces(3);
  this->UseRecords(true);
  const std::vector<float> automatic = this->Render();
  EXPECT_GT(this->CountRecords(), 0.0);
  this->UseRecords(false);
  EXPECT_EQ(this->Render(), automatic);
  // Other quantities and settings of the same provider do not change what is chosen.
  this->UseRecords(true);
  this->Caster->AmbientOcclusionOn();
  this->Render();
  this->Caster->AmbientOcclusionOff();
  EXPECT_EQ(this->Render(), automatic);
}

// Spheres of a few pixels each: nearly every coarse point needs a record.
TEST_F(JoinedIndirectLight, IsKeptOnRoughSurfaces)
{
  this->ShowSphereInSunlight();
  this->Caster->SetResolution(96, 96);
  this->Caster->SetLightTolerance(10.0 * LightTolerance);
  for (int i = 0; i < 400; ++i)
  {
    vtkNew<vtkSphereSource> pebble;
    pebble->SetRadius(0.12);
    pebble->SetCenter(-2.4 + 0.25 * (i % 20), -2.4 + 0.25 * (i / 20), 0.05 * (i % 3));
    this->Add(pebble);
  }
  this->Join(true);
  const std::vector<float> joined = this->Render();
  this->UseRecords(true);
  EXPECT_EQ(this->Render(), joined);
  EXPECT_EQ(this->CountRecords(), 0.0);
  const vtkPenumbraIrradianceProvider* provider = this->Caster->GetIrradianceProvider();
  EXPECT_TRUE(provider->JoinsPixels(false, true));
}

// Like the other providers, which light points of surfaces only.
TEST_F(JoinedIndirectLight, LeavesLinesAndPointsAsTheyAre)
{
  this->ShowSphereInSunlight();
  this->Floor->SetRepresentationToPoints();
  this->Floor->SetPointSize(5.0);
  this->Sphere->SetRepresentationToWireframe();
  this->Sphere->SetLineWidth(3.0);
  this->Caster->IndirectLightOff();
  const std::vector<float> direct = this->Render();
  this->Caster->IndirectLightOn();
  this->Join(true);
  EXPECT_EQ(this->Render(), direct);
}

// Where all samples of a pixel are in the shadow, its color does not tell how much indirect light it has:
// no surface of albedo a reflects more than 1 + a of a sun and an emitter of radiance 1.
TEST_F(JoinedIndirectLight, HasNoSpecksWhereShadowsBegin)
{
  this->ShowSphereInSunlight();
  this->Sphere->LightingOff();
  this->Sphere->SetDiffuseColor(1.0, 1.0, 1.0);
  this->Caster->SetEnvironmentColor(0.0, 0.0, 0.0);
  this->Caster->SetResolution(96, 96);
  this->Join(true);
  for (const double angle : { 0.0, 15.0 })
  {
    this->Caster->SetLightAngle(angle);
    this->Caster->SetTimeLimit(0.0);
    const std::vector<float> image = this->Render();
    EXPECT_LE(*std::max_element(image.begin(), image.end()), 1.8f) << angle;
    EXPECT_LT(this->Caster->GetEstimatedError(), LightTolerance) << angle;
    this->Caster->SetTimeLimit(1e-9);
    const std::vector<float> coarse = this->Render();
    EXPECT_LE(*std::max_element(coarse.begin(), coarse.end()), 1.8f) << angle;
    const double error = ComputeRmse(coarse, image);
    EXPECT_GT(this->Caster->GetEstimatedError(), error) << angle;
    EXPECT_LT(this->Caster->GetEstimatedError(), 4.0 * error) << angle;
  }
}
