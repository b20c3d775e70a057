// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SessionWindow.h"

#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCastPass.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraTemporalSSAOPass.h"
#include "vtkPenumbraTracedEstimator.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCubeSource.h"
#include "vtkCylinderSource.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkLight.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

namespace penumbra
{

namespace
{

constexpr int MaximumFrames = 200;

/// Number of frames after which light shafts of a static view are final.
constexpr int ShaftFrames = 3;

constexpr double OcclusionRadius = 0.7;
constexpr double UnlimitedSeconds = 1e6;

}

const std::vector<std::string>& SessionWindow::GetMethods()
{
  static const std::vector<std::string> methods = { "march", "rays", "shafts", "shadow-maps",
    "ray-cast" };
  return methods;
}

SessionWindow::SessionWindow(const std::string& method, bool isStill)
{
  this->AddScene();
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(420, 320);
  this->Window->AddRenderer(this->Renderer);
  this->Interactor->SetRenderWindow(this->Window);
  this->Interactor->SetInteractorStyle(vtkNew<vtkInteractorStyleTrackballCamera>());
  if (method == "ray-cast")
  {
    this->UseRayCaster(isStill);
  }
  else if (method == "shafts" || method == "shadow-maps")
  {
    this->UseShafts(method == "shadow-maps");
  }
  else
  {
    this->UseOcclusion(method == "rays" ? "traced" : "march", isStill);
  }
  this->Interactor->Initialize();
}

vtkSmartPointer<vtkActor> SessionWindow::Add(vtkAlgorithm* source, const double (&color)[3])
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  this->Renderer->AddActor(actor);
  return actor;
}

vtkSmartPointer<vtkActor> SessionWindow::AddSphere(const double (&center)[3], double radius)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(48);
  sphere->SetPhiResolution(32);
  vtkSmartPointer<vtkActor> actor = this->Add(sphere, { 0.9, 0.9, 0.9 });
  actor->SetPosition(center[0], center[1], center[2]);
  return actor;
}

void SessionWindow::AddScene()
{
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-4.0, -4.0, 0.0);
  floor->SetPoint1(4.0, -4.0, 0.0);
  floor->SetPoint2(-4.0, 4.0, 0.0);
  this->Add(floor, { 0.9, 0.9, 0.9 });
  for (int i = 0; i < 5; ++i)
  {
    this->AddSphere({ 1.1 * (i % 3) - 1.1, 1.2 * (i / 3), 0.45 }, 0.45);
  }
  for (int i = 0; i < 4; ++i)
  {
    vtkNew<vtkCylinderSource> post;
    post->SetRadius(0.06);
    post->SetHeight(1.6);
    post->SetResolution(24);
    vtkSmartPointer<vtkActor> actor = this->Add(post, { 0.9, 0.85, 0.8 });
    actor->RotateX(90.0);
    actor->SetPosition(1.2 * i - 1.8, -1.6, 0.8);
  }
  vtkNew<vtkCubeSource> box;
  box->SetXLength(0.8);
  box->SetYLength(0.8);
  box->SetZLength(1.2);
  this->Add(box, { 0.8, 0.85, 0.9 })->SetPosition(2.2, 1.0, 0.6);
  this->Hidden = this->AddSphere({ 0.1, -1.0, 0.4 }, 0.4);
  this->Slid = this->AddSphere({ -1.4, -0.8, 0.3 }, 0.3);
  this->Renderer->SetBackground(0.3, 0.35, 0.4);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(0.5, -6.0, 2.6);
  camera->SetFocalPoint(0.0, 0.0, 0.4);
  camera->SetViewUp(0.0, 0.0, 1.0);
  this->Renderer->ResetCameraClippingRange();
}

void SessionWindow::AddLight(const double (&position)[3])
{
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  headlight->SetIntensity(0.5);
  this->Renderer->AddLight(headlight);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(position[0], position[1], position[2]);
  this->Renderer->AddLight(light);
}

void SessionWindow::UseOcclusion(const char* kernel, bool isStill)
{
  vtkPenumbraTracedEstimator::Register();
  auto* pass = vtkPenumbraTemporalSSAOPass::AddTo(this->Renderer);
  pass->SetRadiusUnit(vtkPenumbraTemporalSSAOPass::WORLD);
  pass->SetRadius(OcclusionRadius);
  pass->SetKernelName(kernel);
  pass->SetConvergeInOneRender(
    isStill ? vtkPenumbraTemporalSSAOPass::ALWAYS : vtkPenumbraTemporalSSAOPass::NEVER);
  this->IsFinal = [pass]() { return pass->IsConverged(); };
}

void SessionWindow::UseShafts(bool maps)
{
  this->AddLight({ 3.0, 5.0, 6.0 });
  auto* pass = vtkPenumbraLightShaftPass::AddTo(this->Renderer);
  pass->GetMedium()->SetScattering(0.06);
  pass->SetEstimator(
    maps ? vtkPenumbraLightShaftPass::SHADOW_MAP : vtkPenumbraLightShaftPass::DEPTH);
  int frames = 0;
  this->IsFinal = [frames]() mutable { return ++frames % ShaftFrames == 0; };
}

void SessionWindow::UseRayCaster(bool isStill)
{
  this->AddLight({ 3.0, -5.0, 6.0 });
  vtkNew<vtkPenumbraRayCastPass> pass;
  pass->GetRayCaster()->AmbientOcclusionOn();
  pass->GetRayCaster()->ShadowsOn();
  if (isStill)
  {
    pass->SetTimeLimit(UnlimitedSeconds);
  }
  this->Renderer->SetPass(pass);
  this->IsFinal = [pass = pass.Get()]() { return pass->IsComplete(); };
}

void SessionWindow::CopyView(SessionWindow& other)
{
  const int* size = other.Window->GetSize();
  this->Window->SetSize(size[0], size[1]);
  this->Window->SetStereoType(other.Window->GetStereoType());
  this->Window->SetStereoRender(other.Window->GetStereoRender());
  this->Renderer->GetActiveCamera()->DeepCopy(other.Renderer->GetActiveCamera());
  this->Renderer->GetActiveCamera()->Modified(); // DeepCopy() leaves the time of the matrices.
  this->Hidden->SetVisibility(other.Hidden->GetVisibility());
  this->Slid->SetPosition(other.Slid->GetPosition());
}

void SessionWindow::Settle()
{
  int frames = 0;
  do
  {
    this->Draw();
  }
  while (!this->IsFinal() && ++frames < MaximumFrames);
}

void SessionWindow::Send(unsigned long event, int x, int y)
{
  this->Interactor->SetEventInformation(x, y, 0, 0);
  this->Interactor->InvokeEvent(event);
}

vtkSmartPointer<vtkUnsignedCharArray> SessionWindow::GetPixels()
{
  auto pixels = vtkSmartPointer<vtkUnsignedCharArray>::New();
  const int* size = this->Window->GetSize();
  this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 1, pixels);
  return pixels;
}

}
