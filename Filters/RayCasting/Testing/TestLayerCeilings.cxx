// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Stacks of translucent sheets: the color against closed forms, and the number of rays of occlusion,
// indirect light and soft shadows against a bound per sheet.
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace
{

constexpr double Tolerance = 1.0 / 256.0;
constexpr double Spacing = 0.01;
constexpr int Side = 4;
constexpr double Gray = 0.8;
constexpr double Background = 0.3;

struct Stack
{
  int Sheets;
  double Opacity;
};

/// Sheets at z = 0, -Spacing, ..., seen from above; so large that their ends do not matter.
vtkSmartPointer<vtkRenderer> MakeRenderer(const Stack& stack)
{
  constexpr double Size = 100.0;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> quads;
  for (int i = 0; i < stack.Sheets; ++i)
  {
    const vtkIdType corners[4] = { points->InsertNextPoint(-Size, -Size, -i * Spacing),
      points->InsertNextPoint(Size, -Size, -i * Spacing),
      points->InsertNextPoint(Size, Size, -i * Spacing),
      points->InsertNextPoint(-Size, Size, -i * Spacing) };
    quads->InsertNextCell(4, corners);
  }
  vtkNew<vtkPolyData> sheets;
  sheets->SetPoints(points);
  sheets->SetPolys(quads);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(sheets);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(Gray, Gray, Gray);
  actor->GetProperty()->SetAmbient(1.0);
  actor->GetProperty()->SetDiffuse(0.0);
  actor->GetProperty()->SetOpacity(stack.Opacity);
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->AddActor(actor);
  renderer->SetBackground(Background, Background, Background);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.0);
  camera->SetPosition(0.0, 0.0, 10.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetClippingRange(1.0, 100.0);
  return renderer;
}

/// Occlusion of sheet `index` by those above within `radius`: a ray of cosine mu crosses those up to
/// a height of radius * mu, and the square of mu is distributed evenly.
double ComputeOcclusion(const Stack& stack, int index, double radius)
{
  double occlusion = 0.0;
  double transmittance = 1.0;
  for (int j = 1; j <= index; ++j)
  {
    const double height = j * Spacing / radius;
    occlusion += transmittance * stack.Opacity * std::max(1.0 - height * height, 0.0);
    transmittance *= 1.0 - stack.Opacity;
  }
  return occlusion;
}

/// Composites sheets of color Gray * factor(index) over the background.
double Composite(const Stack& stack, const std::function<double(int)>& factor)
{
  double color = 0.0;
  double transmittance = 1.0;
  for (int i = 0; i < stack.Sheets; ++i)
  {
    color += transmittance * stack.Opacity * Gray * factor(i);
    transmittance *= 1.0 - stack.Opacity;
  }
  return color + transmittance * Background;
}

/// Returns the RMSE of an image whose color is `expected`.
double ComputeError(vtkPenumbraRayCaster* caster, double expected)
{
  vtkDataArray* colors = caster->GetOutput()->GetPointData()->GetArray("Color");
  double squares = 0.0;
  for (vtkIdType i = 0; i < Side * Side; ++i)
  {
    const double error = colors->GetComponent(i, 0) - expected;
    squares += error * error / (Side * Side);
  }
  return std::sqrt(squares);
}

class StackedSheets : public ::testing::TestWithParam<Stack>
{
protected:
  void SetUp() override
  {
    const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(this->GetParam());
    this->Light->SetLightTypeToSceneLight();
    this->Light->SetPosition(0.0, 0.0, 1.0);
    this->Light->SetFocalPoint(0.0, 0.0, 0.0);
    renderer->AddLight(this->Light);
    this->Caster->SetRenderer(renderer);
    this->Caster->SetResolution(Side, Side);
    this->Caster->SetTolerance(Tolerance);
    this->Caster->SetLightTolerance(Tolerance);
  }

  void SetMaterial(double ambient, double diffuse)
  {
    vtkProperty* property = this->Caster->GetRenderer()->GetActors()->GetLastActor()->GetProperty();
    property->SetAmbient(ambient);
    property->SetDiffuse(diffuse);
  }

  void UseSkyOnly()
  {
    this->Caster->IndirectLightOn();
    this->Caster->SetEnvironmentColor(1.0, 1.0, 1.0);
    this->SetMaterial(0.0, 1.0);
    this->Light->SetIntensity(0.0);
  }

  double GetRaysPerPixel(const char* name)
  {
    return this->Caster->GetStatistics()->GetArray(name)->GetTuple1(0) / (Side * Side);
  }

  /// Compares the image with one color, and the number of rays per pixel with a bound per sheet.
  void Check(double expected, const char* name, double bound)
  {
    const double error = ComputeError(this->Caster, expected);
    const double rays = this->GetRaysPerPixel(name);
    RecordProperty("Error", std::to_string(error));
    RecordProperty("RaysPerPixel", std::to_string(rays));
    EXPECT_LE(error, 2.0 * Tolerance); // the tolerance of one corner
    EXPECT_LE(rays, bound * this->GetParam().Sheets);
  }

  vtkNew<vtkLight> Light;
  vtkNew<vtkPenumbraRayCaster> Caster;
};

}

TEST_P(StackedSheets, HaveTheOcclusionOfTheClosedForm)
{
  for (const double radius : { 0.1, 1.0, 1e6 })
  {
    this->Caster->AmbientOcclusionOn();
    this->Caster->SetAmbientOcclusionRadius(radius);
    this->Caster->Update();
    const Stack& stack = this->GetParam();
    this->Check(Composite(stack, [&](int i) { return 1.0 - ComputeOcclusion(stack, i, radius); }),
      "Rays/Occlusion", 250.0);
  }
}

TEST_P(StackedSheets, HaveTheIndirectLightOfTheClosedForm)
{
  this->UseSkyOnly();
  this->Caster->SetAlbedo(0.9);
  this->Caster->SetBounces(1); // the sheets above reflect no light
  this->Caster->Update();
  const Stack& stack = this->GetParam();
  this->Check(Composite(stack, [&](int i) { return 0.9 * std::pow(1.0 - stack.Opacity, i); }),
    "Rays/Indirect", 1500.0);
}

TEST_P(StackedSheets, ReflectLightOncePerBounce)
{
  this->UseSkyOnly();
  this->Caster->SetBounces(3);
  this->Caster->SetTolerance(1.0 / 32.0);
  this->Caster->Update();
  EXPECT_LE(this->GetRaysPerPixel("Rays/Indirect"), 3000.0 * this->GetParam().Sheets);
}

TEST_P(StackedSheets, HaveTheSoftShadowsOfTheClosedForm)
{
  this->Caster->ShadowsOn();
  this->Caster->SetLightAngle(10.0);
  this->SetMaterial(0.0, 1.0);
  this->Caster->Update();
  const Stack& stack = this->GetParam();
  this->Check(Composite(stack, [&](int i) { return std::pow(1.0 - stack.Opacity, i); }),
    "Rays/Shadow", 500.0);
}

INSTANTIATE_TEST_SUITE_P(RayCaster, StackedSheets,
  ::testing::Values(Stack{ 1, 0.5 }, Stack{ 4, 0.3 }, Stack{ 16, 0.1 }, Stack{ 64, 0.03 },
    Stack{ 256, 0.008 }, Stack{ 256, 0.05 }),
  [](const ::testing::TestParamInfo<Stack>& stack) {
    return std::to_string(stack.param.Sheets) + "SheetsOfPermille" +
      std::to_string(std::lround(1000.0 * stack.param.Opacity));
  });
