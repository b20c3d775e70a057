// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftScene.h"
#include "vtkPenumbraShaftConstants.h"

#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkCubeSource.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderPass.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>

namespace
{

vtkSmartPointer<vtkActor> AddActor(vtkRenderer* renderer, vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0.0, 0.0, 0.0);
  renderer->AddActor(actor);
  return actor;
}

std::vector<double> Component(vtkImageData* image, const char* name)
{
  vtkDataArray* array = image->GetPointData()->GetArray(name);
  std::vector<double> values(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    values[i] = array->GetComponent(i, 0);
  }
  return values;
}

}

ShaftScene::ShaftScene(int width, int height)
  : Width(width),
    Height(height)
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
  this->Pass = vtkPenumbraLightShaftPass::AddTo(this->Renderer);
}

vtkSmartPointer<vtkActor> ShaftScene::AddBox(const Vector& center, const Vector& size)
{
  vtkNew<vtkCubeSource> cube;
  cube->SetCenter(center[0], center[1], center[2]);
  cube->SetXLength(size[0]);
  cube->SetYLength(size[1]);
  cube->SetZLength(size[2]);
  return AddActor(this->Renderer, cube);
}

vtkSmartPointer<vtkActor> ShaftScene::AddSphere(const Vector& center, double radius)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(center[0], center[1], center[2]);
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(32);
  sphere->SetPhiResolution(32);
  return AddActor(this->Renderer, sphere);
}

vtkSmartPointer<vtkActor> ShaftScene::AddFloor(double size)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-size, -size, 0.0);
  plane->SetPoint1(size, -size, 0.0);
  plane->SetPoint2(-size, size, 0.0);
  return AddActor(this->Renderer, plane);
}

vtkSmartPointer<vtkActor> ShaftScene::AddComb(int posts)
{
  const double pitch = 8.0 / posts;
  vtkNew<vtkAppendPolyData> comb;
  for (int i = 0; i <= posts; ++i)
  {
    vtkNew<vtkCubeSource> part;
    part->SetCenter(i == posts ? 0.0 : pitch * (i + 0.5) - 4.0, 0.0, i == posts ? -0.1 : 2.0);
    part->SetXLength(i == posts ? 10.0 : 0.4 * pitch);
    part->SetYLength(i == posts ? 10.0 : 0.3);
    part->SetZLength(i == posts ? 0.2 : 4.0);
    comb->AddInputConnection(part->GetOutputPort());
  }
  return AddActor(this->Renderer, comb);
}

void ShaftScene::AddSolids(int count, unsigned int seed)
{
  const auto next = [&seed]() {
    seed = 1664525u * seed + 1013904223u;
    return (seed >> 8) / 16777216.0;
  };
  for (int i = 0; i < count; ++i)
  {
    const double x = 8.0 * next() - 4.0;
    const double y = 8.0 * next() - 4.0;
    const double size = 0.3 + 0.5 * next();
    const double z = size + 2.5 * next();
    if (i % 2)
    {
      this->AddSphere({ x, y, z }, size);
    }
    else
    {
      this->AddBox({ x, y, z }, { 2.0 * size, 1.6 * size, 2.0 * size });
    }
  }
}

vtkSmartPointer<vtkLight> ShaftScene::AddSun(const Vector& toward)
{
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetLightTypeToSceneLight();
  light->SetPosition(toward[0], toward[1], toward[2]);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  this->Renderer->AddLight(light);
  return light;
}

vtkSmartPointer<vtkLight> ShaftScene::AddLamp(const Vector& place)
{
  vtkSmartPointer<vtkLight> light = this->AddSun(place);
  light->PositionalOn();
  light->SetConeAngle(90.0);
  light->SetAttenuationValues(0.0, 0.0, 1.0);
  return light;
}

void ShaftScene::Look(const Vector& from, const Vector& at, double angle)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(from.data());
  camera->SetFocalPoint(at.data());
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(angle);
  this->Renderer->ResetCameraClippingRange();
}

void ShaftScene::SetMedium(double scattering, double extinction)
{
  this->Pass->GetMedium()->SetScattering(scattering);
  this->Pass->GetMedium()->SetExtinction(extinction);
}

std::vector<double> ShaftScene::RenderWithPass()
{
  this->Window->Render();
  vtkNew<vtkImageData> image;
  this->Pass->CopyShafts(image);
  return Component(image, "LightShafts");
}

std::vector<double> ShaftScene::Transmittance()
{
  vtkNew<vtkImageData> image;
  this->Pass->CopyShafts(image);
  return Component(image, "Transmittance");
}

std::vector<double> ShaftScene::RenderWithRayCaster(int steps, long long* shadowRays)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(this->Renderer);
  caster->SetResolution(this->Width, this->Height);
  caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  caster->GetConstants().UniformSamples = 1;
  caster->SetMedium(this->Pass->GetMedium());
  caster->GetConstants().LightShaftSteps = steps;
  const vtkSmartPointer<vtkRenderPass> passes = this->Renderer->GetPass();
  this->Renderer->SetPass(nullptr);
  caster->Update();
  this->Renderer->SetPass(passes);
  if (shadowRays)
  {
    *shadowRays =
      static_cast<long long>(caster->GetStatistics()->GetArray("Rays/Shaft")->GetTuple1(0));
  }
  return Component(caster->GetOutput(), "Color");
}

std::vector<bool> ShaftScene::NearEdges(int reach)
{
  // Reconstruct the depth from the transmittance.
  std::vector<double> depths = this->Transmittance();
  for (double& depth : depths)
  {
    depth = -std::log(std::max(depth, 1e-8)) / this->Pass->GetMedium()->GetExtinction();
  }
  std::vector<bool> near(depths.size(), false);
  const int side = 2 * reach + 1;
  for (std::size_t at = 0; at < depths.size(); ++at)
  {
    const int x = static_cast<int>(at) % this->Width;
    const int y = static_cast<int>(at) / this->Width;
    for (int k = 0; k < side * side && !near[at]; ++k)
    {
      const int i = std::clamp(x + k % side - reach, 0, this->Width - 1);
      const int j = std::clamp(y + k / side - reach, 0, this->Height - 1);
      near[at] = std::abs(depths[j * this->Width + i] - depths[at]) > 0.1 * depths[at];
    }
  }
  return near;
}
