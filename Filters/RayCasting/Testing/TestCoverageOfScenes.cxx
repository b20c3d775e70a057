// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares adaptively rendered scenes with a reference of up to 32 x 32 samples per pixel.
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkConeSource.h"
#include "vtkCubeSource.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace
{

constexpr int Side = 128;
constexpr int Tile = 16;

struct SceneRow
{
  std::string Name;
  std::function<void(vtkRenderer*)> AddProps;
  bool Shadows;
  double Bound; ///< upper bound of the RMSE of a tile of 16 x 16 pixels
};

vtkActor* Add(vtkRenderer* renderer, vtkPolyDataAlgorithm* source, bool smooth = false)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(source->GetOutputPort());
  normals->SplittingOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(smooth ? normals->GetOutputPort() : source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  if (!smooth)
  {
    actor->GetProperty()->SetInterpolationToFlat();
  }
  renderer->AddActor(actor);
  return actor;
}

vtkActor* AddSphere(
  vtkRenderer* renderer, double x, double y, double z, double r, bool smooth = false)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(x, y, z);
  sphere->SetRadius(r);
  sphere->SetThetaResolution(20);
  sphere->SetPhiResolution(20);
  return Add(renderer, sphere, smooth);
}

vtkActor* AddFloor(vtkRenderer* renderer)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-3.0, -3.0, -0.8);
  plane->SetPoint1(3.0, -3.0, -0.8);
  plane->SetPoint2(-3.0, 3.0, -0.8);
  vtkActor* actor = Add(renderer, plane);
  actor->GetProperty()->SetColor(0.8, 0.7, 0.5);
  return actor;
}

const SceneRow Rows[] = {
  { "InterpenetratingSpheres",
    [](vtkRenderer* r) {
      AddSphere(r, -0.3, 0.0, 0.0, 0.7);
      AddSphere(r, 0.4, 0.1, 0.1, 0.7)->GetProperty()->SetColor(0.9, 0.2, 0.1);
    },
    false, 1.0 / 256.0 },
  { "CubeIntersectingACone",
    [](vtkRenderer* r) {
      vtkNew<vtkConeSource> cone;
      cone->SetHeight(2.0);
      cone->SetRadius(0.6);
      cone->SetResolution(9);
      Add(r, cone)->GetProperty()->SetColor(0.1, 0.6, 0.9);
      vtkNew<vtkCubeSource> cube;
      Add(r, cube)->RotateWXYZ(33.0, 1.0, 2.0, 3.0);
    },
    false, 1.0 / 256.0 },
  { "SmoothSpheres",
    [](vtkRenderer* r) {
      AddSphere(r, -0.3, 0.0, 0.0, 0.7, true);
      AddSphere(r, 0.4, 0.1, 0.6, 0.4, true)->GetProperty()->SetColor(0.9, 0.2, 0.1);
    },
    false, 1.0 / 256.0 },
  { "SpecularHighlight",
    [](vtkRenderer* r) {
      vtkActor* sphere = AddSphere(r, 0.0, 0.0, 0.0, 0.9, true);
      sphere->GetProperty()->SetSpecular(0.8);
      sphere->GetProperty()->SetSpecularPower(60.0);
    },
    false, 1.0 / 256.0 },
  { "TransparentSpheres",
    [](vtkRenderer* r) {
      AddSphere(r, -0.3, 0.0, 0.0, 0.7)->GetProperty()->SetOpacity(0.4);
      AddSphere(r, 0.4, 0.1, -0.5, 0.7)->GetProperty()->SetColor(0.9, 0.2, 0.1);
    },
    false, 1.0 / 256.0 },
  { "Shadows",
    [](vtkRenderer* r) {
      AddFloor(r);
      AddSphere(r, 0.2, 0.1, 0.2, 0.5);
      vtkNew<vtkCubeSource> cube;
      cube->SetCenter(-0.9, 0.4, -0.3);
      Add(r, cube)->GetProperty()->SetColor(0.3, 0.8, 0.4);
      vtkNew<vtkLight> light;
      light->SetLightTypeToSceneLight();
      light->SetPosition(3.0, -2.0, 4.0);
      light->SetFocalPoint(0.0, 0.0, 0.0);
      r->AddLight(light);
    },
    true, 1.0 / 256.0 },
};

struct Pixels
{
  std::vector<float> Colors;
  std::vector<float> Errors;
  double RaysPerPixel;
};

Pixels Render(vtkPenumbraRayCaster* caster)
{
  caster->Update();
  vtkPointData* data = caster->GetOutput()->GetPointData();
  const auto copy = [&](const char* name) {
    auto* array = vtkFloatArray::SafeDownCast(data->GetArray(name));
    return std::vector<float>(
      array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
  };
  return { copy("Color"), copy("EstimatedError"),
    caster->GetStatistics()->GetArray("Rays/PerPixel")->GetTuple1(0) };
}

struct WorstTile
{
  double Error = 0.0; ///< largest RMSE of a tile
  double Estimate = 0.0;
  std::string Place;
};

WorstTile FindWorstTile(const Pixels& adaptive, const Pixels& reference)
{
  WorstTile worst;
  for (int ty = 0; ty < Side; ty += Tile)
  {
    for (int tx = 0; tx < Side; tx += Tile)
    {
      double squares = 0.0;
      double estimated = 0.0;
      for (int i = 0; i < Tile * Tile; ++i)
      {
        const std::size_t pixel = (ty + i / Tile) * Side + tx + i % Tile;
        for (int c = 0; c < 3; ++c)
        {
          const double d = adaptive.Colors[4 * pixel + c] - reference.Colors[4 * pixel + c];
          squares += d * d / 3.0;
        }
        estimated += static_cast<double>(adaptive.Errors[pixel]) * adaptive.Errors[pixel];
      }
      const double error = std::sqrt(squares / (Tile * Tile));
      if (error > worst.Error)
      {
        worst = { error, std::sqrt(estimated / (Tile * Tile)),
          std::to_string(tx) + "," + std::to_string(ty) };
      }
    }
  }
  return worst;
}

std::ostream& operator<<(std::ostream& os, const SceneRow& row)
{
  return os << row.Name;
}

class CoverageOfScenes : public ::testing::TestWithParam<SceneRow>
{
};

std::string MakeName(const ::testing::TestParamInfo<SceneRow>& row)
{
  return row.param.Name;
}

}

TEST_P(CoverageOfScenes, IsWithinTheTolerance)
{
  vtkNew<vtkRenderer> renderer;
  GetParam().AddProps(renderer);
  renderer->SetBackground(0.2, 0.3, 0.4);
  renderer->GetActiveCamera()->SetPosition(1.0, -5.0, 2.5);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->GetActiveCamera()->SetViewAngle(24.0);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Side, Side);
  caster->SetShadows(GetParam().Shadows);
  const Pixels adaptive = Render(caster);
  caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  // Errors of the reference itself add to those of the image on average: fewer samples suffice if the sum is small.
  WorstTile worst;
  worst.Error = GetParam().Bound + 1.0;
  for (int samples = 16; worst.Error > GetParam().Bound && samples <= 32; samples += 16)
  {
    caster->GetConstants().UniformSamples = samples;
    worst = FindWorstTile(adaptive, Render(caster));
  }
  RecordProperty("At", worst.Place);
  RecordProperty("WorstTile", std::to_string(worst.Error));
  RecordProperty("RaysPerPixel", std::to_string(adaptive.RaysPerPixel));
  EXPECT_LE(worst.Error, GetParam().Bound) << "estimated error of this tile: " << worst.Estimate;
  EXPECT_LE(adaptive.RaysPerPixel, 6.0);
}

INSTANTIATE_TEST_SUITE_P(RayCaster, CoverageOfScenes, ::testing::ValuesIn(Rows), MakeName);
