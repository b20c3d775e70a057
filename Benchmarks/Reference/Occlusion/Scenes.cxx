// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkCubeSource.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformFilter.h"

#include <algorithm>

namespace penumbra
{

vtkSmartPointer<vtkPolyData> Moved(vtkPolyData* mesh, vtkTransform* transform)
{
  vtkNew<vtkTransformFilter> filter;
  filter->SetInputData(mesh);
  filter->SetTransform(transform);
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutput());
}

void Show(vtkRenderer* renderer, vtkPolyData* mesh)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  // White regardless of the lights, also in vtkSSAOPass, which requires lighting.
  actor->GetProperty()->SetAmbient(1.0);
  actor->GetProperty()->SetDiffuse(0.0);
  renderer->AddActor(actor);
}

void Look(vtkRenderer* renderer, const double eye[3], const double target[3], double angle)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(eye);
  camera->SetFocalPoint(target);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(angle);
  renderer->ResetCameraClippingRange();
}

void ShowPlane(vtkRenderer* renderer, double low, double high, double z)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(low, low, z);
  plane->SetPoint1(high, low, z);
  plane->SetPoint2(low, high, z);
  plane->Update();
  Show(renderer, plane->GetOutput());
}

OcclusionTestScene Spheres400()
{
  OcclusionTestScene scene{ "S400", vtkSmartPointer<vtkRenderer>::New(), 1.0 };
  vtkNew<vtkAppendPolyData> spheres;
  for (int i = 0; i < 20; ++i)
  {
    for (int j = 0; j < 20; ++j)
    {
      vtkNew<vtkSphereSource> sphere;
      sphere->SetThetaResolution(32);
      sphere->SetPhiResolution(32);
      sphere->SetRadius(.6);
      sphere->SetCenter(i, j, .3 * ((7 * i + 3 * j) % 5));
      spheres->AddInputConnection(sphere->GetOutputPort());
    }
  }
  spheres->Update();
  Show(scene.Renderer, spheres->GetOutput());
  ShowPlane(scene.Renderer, -5.0, 25.0, -.5);
  const double eye[3] = { 10.0, -20.0, 32.0 };
  const double target[3] = { 10.0, 10.0, .5 };
  Look(scene.Renderer, eye, target, 30.0);
  return scene;
}

OcclusionTestScene Sticks()
{
  OcclusionTestScene scene{ "Sticks", vtkSmartPointer<vtkRenderer>::New(), .5 };
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(4);
  const auto between = [&](double low, double high) {
    random->Next();
    return random->GetRangeValue(low, high);
  };
  vtkNew<vtkAppendPolyData> things;
  for (int i = 0; i < 120; ++i)
  {
    // One third each of sticks, plates and boxes.
    const double sizes[3][3] = { { .05, .05, between(.6, 1.6) },
      { between(.4, .8), between(.4, .8), .03 },
      { between(.15, .4), between(.15, .4), between(.15, .4) } };
    vtkNew<vtkCubeSource> cube;
    cube->SetXLength(sizes[i % 3][0]);
    cube->SetYLength(sizes[i % 3][1]);
    cube->SetZLength(sizes[i % 3][2]);
    cube->Update();
    vtkNew<vtkTransform> transform;
    transform->Translate(between(-2.2, 2.2), between(-2.2, 2.2), between(.1, 1.0));
    transform->RotateZ(between(0.0, 360.0));
    transform->RotateX(i % 2 ? between(0.0, 90.0) : 0.0);
    things->AddInputData(Moved(cube->GetOutput(), transform));
  }
  things->Update();
  Show(scene.Renderer, things->GetOutput());
  ShowPlane(scene.Renderer, -3.0, 3.0, 0.0);
  const double eye[3] = { .6, -5.2, 3.4 };
  const double target[3] = { 0.0, 0.0, .4 };
  Look(scene.Renderer, eye, target, 35.0);
  return scene;
}

namespace
{

/// Scales the mesh to the given largest extent, centers it at x, y and places it on z = 0.
vtkSmartPointer<vtkPolyData> Placed(
  vtkPolyData* mesh, bool yIsUp, double extent, double x, double y)
{
  vtkNew<vtkTransform> upright;
  if (yIsUp)
  {
    upright->RotateX(90.0); // (x, y, z) -> (x, -z, y)
  }
  vtkSmartPointer<vtkPolyData> standing = Moved(mesh, upright);
  double bounds[6];
  standing->GetBounds(bounds);
  const double scale =
    extent / std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  vtkNew<vtkTransform> placed;
  placed->Translate(x, y, 0.0);
  placed->Scale(scale, scale, scale);
  placed->Translate(-(bounds[0] + bounds[1]) / 2.0, -(bounds[2] + bounds[3]) / 2.0, -bounds[4]);
  return Moved(standing, placed);
}

}

OcclusionTestScene Scans(vtkPolyData* dragon, vtkPolyData* armadillo, vtkPolyData* elephant)
{
  OcclusionTestScene scene{ "Scans", vtkSmartPointer<vtkRenderer>::New(), .25 };
  Show(scene.Renderer, Placed(dragon, false, 2.2, .2, 0.0));
  Show(scene.Renderer, Placed(armadillo, true, 1.6, -1.2, .6));
  Show(scene.Renderer, Placed(elephant, true, 1.3, 1.3, -.6));
  ShowPlane(scene.Renderer, -3.0, 3.0, 0.0);
  const double eye[3] = { .5, -4.2, 2.2 };
  const double target[3] = { 0.0, 0.0, .5 };
  Look(scene.Renderer, eye, target, 35.0);
  return scene;
}

}
