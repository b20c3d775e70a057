// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion of neighboring pixels that is estimated together: accuracy against brute force,
// number of rays, and independence of the requested extent and of threads.
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace penumbra;

namespace
{

constexpr double Tolerance = 1.0 / 256.0;
constexpr double LightTolerance = 2.56 * Tolerance;

/// Bumpy spheres on a floor, without lighting.
vtkSmartPointer<vtkRenderer> MakeSpheres(int count, double distance)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  const vtkSmartPointer<vtkPolyData> burr = Burr();
  for (int i = 0; i < count; ++i)
  {
    AddMesh(renderer, burr, false)->SetPosition(1.1 * (i - 0.5 * (count - 1)), 0.1 * (i % 3), 0.5);
  }
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-30.0, -30.0, 0.0);
  floor->SetPoint1(30.0, -30.0, 0.0);
  floor->SetPoint2(-30.0, 30.0, 0.0);
  floor->Update();
  AddMesh(renderer, floor->GetOutput(), false);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(0.0, -distance, 0.6 * distance);
  camera->SetFocalPoint(0.0, 0.0, 0.3);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(30.0);
  return renderer;
}

/// An image and its statistics.
struct OcclusionImage
{
  vtkNew<vtkPenumbraRayCaster> Caster;

  OcclusionImage(vtkRenderer* renderer, int width, int height, double radius)
  {
    this->Caster->SetRenderer(renderer);
    this->Caster->SetResolution(width, height);
    this->Caster->SetTolerance(Tolerance);
    this->Caster->AmbientOcclusionOn();
    this->Caster->SetAmbientOcclusionRadius(radius);
    this->Caster->SetAmbientOcclusionStrength(1.0);
    this->Caster->SetNumberOfThreads(1);
    vtkNew<vtkPenumbraBruteForceIrradiance> provider;
    provider->JoinPixelsOn();
    this->Caster->SetIrradianceProvider(provider);
  }

  double Get(const char* name, int x, int y)
  {
    vtkImageData* image = this->Caster->GetOutput();
    int index[3] = { x, y, 0 };
    return image->GetPointData()->GetArray(name)->GetComponent(image->ComputePointId(index), 0);
  }

  double GetRaysPerPixel()
  {
    const int* size = this->Caster->GetOutput()->GetDimensions();
    return this->Caster->GetStatistics()->GetArray("Rays/Occlusion")->GetComponent(0, 0) /
      (size[0] * size[1]);
  }
};

/// Returns a reference with independent estimates at each point and a much smaller tolerance.
void EstimatePointsAlone(OcclusionImage& reference, double tolerance)
{
  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  provider->JoinPixelsOff();
  reference.Caster->SetIrradianceProvider(provider);
  reference.Caster->SetTolerance(tolerance);
  reference.Caster->SetLightTolerance(tolerance);
}

/// Returns the RMSE of an image with joined pixels.
double ComputeError(OcclusionImage& image, OcclusionImage& reference)
{
  const int* size = image.Caster->GetOutput()->GetDimensions();
  double squares = 0.0;
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      squares += std::pow(image.Get("Color", x, y) - reference.Get("Color", x, y), 2.0);
    }
  }
  return std::sqrt(squares / (size[0] * size[1]));
}

// The limits of errors include the noise of the references.
TEST(JoinedOcclusion, IsCloseToEstimatesOfSinglePoints)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeSpheres(3, 6.0);
  OcclusionImage image(renderer, 64, 48, 1.0);
  OcclusionImage reference(renderer, 64, 48, 1.0);
  EstimatePointsAlone(reference, 3e-3);
  image.Caster->Update();
  reference.Caster->Update();
  EXPECT_LT(ComputeError(image, reference), 2.0 * LightTolerance);
  EXPECT_LT(image.GetRaysPerPixel(), 0.5 * reference.GetRaysPerPixel());
  EXPECT_NEAR(image.Caster->GetEstimatedError(), LightTolerance, LightTolerance);
}

// The image is wider than the margin within which estimates depend on each other.
TEST(JoinedOcclusion, DoesNotDependOnTheRequestedExtent)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeSpheres(7, 8.0);
  OcclusionImage whole(renderer, 900, 40, 1.0);
  whole.Caster->Update();
  for (const std::array<int, 6>& extent : { std::array<int, 6>{ 0, 70, 0, 39, 0, 0 },
         { 433, 461, 3, 30, 0, 0 }, { 899, 899, 39, 39, 0, 0 } })
  {
    OcclusionImage part(renderer, 900, 40, 1.0);
    part.Caster->UpdateInformation();
    part.Caster->UpdateExtent(extent.data());
    for (const char* name : { "Color", "EstimatedError" })
    {
      for (int y = extent[2]; y <= extent[3]; ++y)
      {
        for (int x = extent[0]; x <= extent[1]; ++x)
        {
          ASSERT_EQ(part.Get(name, x, y), whole.Get(name, x, y)) << name << " " << x << " " << y;
        }
      }
    }
  }
}

// The tolerance is that of whole tiles, so the worst pixel alone is no reason for a warning.
TEST(JoinedOcclusion, WorstPixelAloneIsNotReported)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeSpheres(1, 4.0);
  OcclusionImage image(renderer, 64, 48, 1.0);
  image.Caster->Update();
  int worst[2] = { 0, 0 };
  for (int y = 0; y < 48; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      if (image.Get("EstimatedError", x, y) > image.Get("EstimatedError", worst[0], worst[1]))
      {
        worst[0] = x;
        worst[1] = y;
      }
    }
  }
  ASSERT_GT(image.Get("EstimatedError", worst[0], worst[1]), 1.5 * LightTolerance);
  const auto countTiles = [](OcclusionImage& of) {
    return of.Caster->GetStatistics()->GetArray("Tiles/AboveTolerance")->GetComponent(0, 0);
  };
  ASSERT_EQ(countTiles(image), 0.0);
  OcclusionImage part(renderer, 64, 48, 1.0);
  int extent[6] = { worst[0], worst[0], worst[1], worst[1], 0, 0 };
  part.Caster->UpdateInformation();
  part.Caster->UpdateExtent(extent);
  EXPECT_EQ(part.Get("EstimatedError", worst[0], worst[1]),
    image.Get("EstimatedError", worst[0], worst[1]));
  EXPECT_EQ(countTiles(part), 0.0);
}

TEST(JoinedOcclusion, DoesNotDependOnThreads)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeSpheres(3, 6.0);
  OcclusionImage one(renderer, 96, 64, 1.0);
  OcclusionImage many(renderer, 96, 64, 1.0);
  many.Caster->SetNumberOfThreads(4);
  one.Caster->Update();
  many.Caster->Update();
  for (int y = 0; y < 64; ++y)
  {
    for (int x = 0; x < 96; ++x)
    {
      ASSERT_EQ(one.Get("Color", x, y), many.Get("Color", x, y)) << x << " " << y;
    }
  }
}

// Surfaces behind glass have sites of their own.
TEST(JoinedOcclusion, JoinsSurfacesBehindGlass)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeSpheres(3, 6.0);
  vtkNew<vtkPlaneSource> pane;
  pane->SetOrigin(-3.0, -1.5, 0.0);
  pane->SetPoint1(3.0, -1.5, 0.0);
  pane->SetPoint2(-3.0, -1.5, 3.0);
  pane->Update();
  AddMesh(renderer, pane->GetOutput(), false)->GetProperty()->SetOpacity(0.25);
  OcclusionImage image(renderer, 64, 48, 1.0);
  OcclusionImage reference(renderer, 64, 48, 1.0);
  EstimatePointsAlone(reference, 3e-3);
  image.Caster->Update();
  reference.Caster->Update();
  EXPECT_LT(ComputeError(image, reference), 2.0 * LightTolerance);
}

// A ray from a sheet meets all sheets above it, whatever its direction.
TEST(JoinedOcclusion, HasTheOcclusionOfTheClosedFormBetweenSheets)
{
  constexpr double Opacity = 0.3;
  constexpr int Sheets = 8;
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  double expected = 0.0;
  double transmittance = 1.0;
  for (int i = 0; i < Sheets; ++i)
  {
    vtkNew<vtkPlaneSource> sheet;
    sheet->SetOrigin(-100.0, -100.0, -0.01 * i);
    sheet->SetPoint1(100.0, -100.0, -0.01 * i);
    sheet->SetPoint2(-100.0, 100.0, -0.01 * i);
    sheet->Update();
    AddMesh(renderer, sheet->GetOutput(), false)->GetProperty()->SetOpacity(Opacity);
    // The rays from sheet i cross all sheets above it, and the image sees through the same ones.
    expected += transmittance * transmittance * Opacity;
    transmittance *= 1.0 - Opacity;
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.0);
  camera->SetPosition(0.0, 0.0, 10.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->SetBackground(0.0, 0.0, 0.0);
  OcclusionImage image(renderer, 4, 4, 1e6);
  image.Caster->Update();
  double squares = 0.0;
  for (int i = 0; i < 16; ++i)
  {
    squares += std::pow(image.Get("Color", i % 4, i / 4) - expected, 2.0) / 16.0;
  }
  EXPECT_LT(std::sqrt(squares), LightTolerance);
}

}
