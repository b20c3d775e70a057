// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion in images against a closed form: a floor under a sphere that is outside of the
// view. The floor is one square, a checkerboard, or a mesh of triangles smaller than pixels.
#include "BruteForce/ImageErrors.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra;

namespace
{

constexpr int Size = 64;
// The view: x in [1.2, 2.8], and the same extent in y around 0. The floor is larger.
constexpr double Left = 1.2;
constexpr double Side = 1.6;
constexpr double FloorLeft = -3.6;
constexpr double FloorSide = 9.6;
// Height of the center of the sphere, whose radius is 1.
constexpr double Height = 1.3;

// Cells smaller than pixels have one color, so that only occlusion varies.
bool IsDark(int column, int row, int cells)
{
  return cells < Size * 6 && (column + row) % 2 == 1;
}

vtkSmartPointer<vtkRenderer> FloorBesideASphere(int cells)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(FloorLeft, -0.5 * FloorSide, 0.0);
  plane->SetPoint1(FloorLeft + FloorSide, -0.5 * FloorSide, 0.0);
  plane->SetPoint2(FloorLeft, 0.5 * FloorSide, 0.0);
  plane->SetResolution(cells, cells);
  plane->Update();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < cells * cells; ++i)
  {
    const double value = IsDark(i % cells, i / cells, cells) ? 51.0 : 255.0;
    colors->InsertNextTuple3(value, value, value);
  }
  plane->GetOutput()->GetCellData()->SetScalars(colors);
  AddMesh(renderer, plane->GetOutput(), false)->GetMapper()->ScalarVisibilityOn();
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetCenter(0.0, 0.0, Height);
  sphere->SetThetaResolution(150);
  sphere->SetPhiResolution(150);
  sphere->Update();
  AddMesh(renderer, sphere->GetOutput(), false);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(Left + 0.5 * Side, 0.0, 0.0);
  camera->SetPosition(Left + 0.5 * Side, 0.0, 10.0);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.5 * Side);
  return renderer;
}

double ColorAt(glm::dvec2 p, int cells)
{
  const glm::dvec2 cell =
    glm::floor((p - glm::dvec2(FloorLeft, -0.5 * FloorSide)) * (cells / FloorSide));
  const double color =
    IsDark(static_cast<int>(cell.x), static_cast<int>(cell.y), cells) ? 0.2 : 1.0;
  return color * (1.0 - Height / std::pow(Height * Height + glm::dot(p, p), 1.5));
}

std::vector<glm::dvec3> Truth(int cells)
{
  constexpr int Samples = 40; // the edges of 80 cells lie between samples
  std::vector<glm::dvec3> reference;
  for (int i = 0; i < Size * Size; ++i)
  {
    double sum = 0.0;
    for (int k = 0; k < Samples * Samples; ++k)
    {
      const glm::dvec2 pixel(
        i % Size + (k % Samples + 0.5) / Samples, i / Size + (k / Samples + 0.5) / Samples);
      sum += ColorAt(glm::dvec2(Left, -0.5 * Side) + pixel * (Side / Size), cells);
    }
    reference.emplace_back(sum / (Samples * Samples));
  }
  return reference;
}

/// Floors of few cells, of many, and of more cells than pixels, at two tolerances.
void CheckImages(bool joinsPixels, ErrorCalibration& calibration)
{
  for (const int cells : { 1, 80, 400 })
  {
    const vtkSmartPointer<vtkRenderer> renderer = FloorBesideASphere(cells);
    const std::vector<glm::dvec3> reference = Truth(cells);
    for (const double tolerance : { 1.0 / 64.0, 1.0 / 256.0 })
    {
      SCOPED_TRACE(std::to_string(cells) + " cells, tolerance " + std::to_string(tolerance));
      double raysPerPixel = 0.0;
      const Answer answer = Cast(renderer, Size, Size, [&](vtkPenumbraRayCaster* caster) {
        vtkNew<vtkPenumbraBruteForceIrradiance> provider;
        provider->SetJoinPixels(joinsPixels);
        caster->SetIrradianceProvider(provider);
        caster->SetTolerance(tolerance);
        caster->SetLightTolerance(tolerance);
        caster->AmbientOcclusionOn();
        caster->SetAmbientOcclusionRadius(1e4);
        caster->SetAmbientOcclusionStrength(1.0);
        caster->Update();
        raysPerPixel =
          caster->GetStatistics()->GetArray("Rays/Occlusion")->GetTuple1(0) / (Size * Size);
      });
      const Errors errors =
        Compare(answer.Colors, reference, std::vector<bool>(reference.size(), false));
      EXPECT_LT(errors.Full, tolerance);
      EXPECT_LT(raysPerPixel, joinsPixels ? 200.0 : 4000.0);
      ErrorCalibration own;
      AddTiles(own, answer.Colors, reference, answer.Estimates, Size);
      EXPECT_LE(own.LargestError, std::sqrt(2.0) * tolerance);
      AddTiles(calibration, answer.Colors, reference, answer.Estimates, Size);
    }
  }
}

TEST(OcclusionImage, KeepsToleranceAndEstimatesItsErrorAtSinglePoints)
{
  ErrorCalibration calibration;
  CheckImages(false, calibration);
  EXPECT_GE(calibration.ConservativeFraction(), 0.95);
  EXPECT_LE(calibration.MedianRatio(), 3.0);
}

// The estimate of joined pixels is their expected squared error, not a bound of it.
TEST(OcclusionImage, KeepsToleranceAndEstimatesItsErrorInJoinedPixels)
{
  ErrorCalibration calibration;
  CheckImages(true, calibration);
  EXPECT_GE(calibration.MedianRatio(), 1.0);
  EXPECT_LE(calibration.MedianRatio(), 3.0);
}

}
