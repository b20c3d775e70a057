// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares adaptively rendered scenes with a reference of up to 32 x 32 samples per pixel.
#include "BruteForce/StratifiedReference.h"
#include "Scenes/TestScene.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkConeSource.h"
#include "vtkCubeSource.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

using namespace penumbra;

namespace
{

constexpr int Side = 128;

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
  const auto cast = [&](int samples) { // 0: adaptive
    return Cast(renderer, Side, Side, [samples](vtkPenumbraRayCaster* caster) {
      caster->SetShadows(GetParam().Shadows);
      if (samples > 0)
      {
        caster->GetConstants().CoverageMethod = CoverageMethods::Uniform;
        caster->GetConstants().UniformSamples = samples;
      }
    });
  };
  const Answer adaptive = cast(0);
  // Errors of the reference itself add to those of the image on average: fewer samples suffice if the sum is small.
  TileAccuracy worst = { GetParam().Bound + 1.0, 0.0 };
  for (int samples = 16; worst.Error > GetParam().Bound && samples <= 32; samples += 16)
  {
    const std::vector<TileAccuracy> tiles = CompareTiles(adaptive, cast(samples), Side);
    worst = *std::max_element(tiles.begin(), tiles.end(),
      [](const TileAccuracy& a, const TileAccuracy& b) { return a.Error < b.Error; });
  }
  RecordProperty("WorstTile", std::to_string(worst.Error));
  RecordProperty("RaysPerPixel", std::to_string(adaptive.RaysPerPixel));
  EXPECT_LE(worst.Error, GetParam().Bound) << "estimated error of this tile: " << worst.Estimate;
  EXPECT_LE(adaptive.RaysPerPixel, 6.0);
}

INSTANTIATE_TEST_SUITE_P(RayCaster, CoverageOfScenes, ::testing::ValuesIn(Rows), MakeName);
