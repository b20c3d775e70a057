// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The modification time of a scene, and the scene's default radius of occlusion.
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTexture.h"

#include <gtest/gtest.h>

#include <cmath>

TEST(SceneModificationTime, ExecutesNoPipeline)
{
  vtkNew<vtkSphereSource> source;
  int executions = 0;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&executions);
  observer->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  source->AddObserver(vtkCommand::StartEvent, observer);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  const vtkMTimeType before = caster->GetMTime();
  source->SetRadius(2.0);
  EXPECT_GT(caster->GetMTime(), before);
  EXPECT_EQ(executions, 0);
  actor->VisibilityOff();
  caster->SetResolution(8, 8);
  caster->Update();
  EXPECT_EQ(executions, 0);
}

TEST(SceneModificationTime, EndsIfTheImageTexturesItsScene)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  vtkNew<vtkTexture> texture;
  texture->SetInputConnection(caster->GetOutputPort());
  vtkNew<vtkSphereSource> source;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetTexture(texture);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  caster->SetRenderer(renderer);
  EXPECT_GT(caster->GetMTime(), 0u);
  caster->SetRenderer(nullptr); // ends the reference cycle
}

TEST(DefaultOcclusionRadius, IgnoresUnusedAndInvalidPoints)
{
  const auto render = [](bool stray) {
    vtkNew<vtkSphereSource> source;
    source->Update();
    vtkNew<vtkPolyData> data;
    data->DeepCopy(source->GetOutput());
    if (stray)
    {
      data->GetPoints()->InsertNextPoint(9.0, 9.0, 9.0);
      data->GetPoints()->InsertNextPoint(std::nan(""), 0.0, 0.0);
      data->GetPointData()->Initialize();
    }
    else
    {
      data->GetPointData()->Initialize();
    }
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-1.0, -1.0, -0.5);
    plane->SetPoint1(1.0, -1.0, -0.5);
    plane->SetPoint2(-1.0, 1.0, -0.5);
    plane->Update();
    vtkNew<vtkPolyData> flat;
    flat->ShallowCopy(plane->GetOutput());
    vtkNew<vtkRenderer> renderer;
    for (vtkPolyData* part : { data.Get(), flat.Get() })
    {
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->SetInputData(part);
      vtkNew<vtkActor> actor;
      actor->SetMapper(mapper);
      renderer->AddActor(actor);
    }
    renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 6.0);
    renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
    vtkNew<vtkPenumbraRayCaster> caster;
    caster->SetRenderer(renderer);
    caster->SetResolution(40, 40);
    caster->AmbientOcclusionOn();
    caster->Update();
    vtkDataArray* color = caster->GetOutput()->GetPointData()->GetArray("Color");
    double sum = 0.0;
    for (vtkIdType i = 0; i < color->GetNumberOfTuples(); ++i)
    {
      sum += color->GetComponent(i, 0);
    }
    return sum / static_cast<double>(color->GetNumberOfTuples());
  };
  EXPECT_NEAR(render(true), render(false), 1e-3);
}

TEST(SceneModificationTime, FollowsTheEnvironment)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  image->GetPointData()->GetScalars()->Fill(50.0);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  vtkNew<vtkSphereSource> source;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetMetallic(1.0);
  actor->GetProperty()->SetRoughness(0.4);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->AutomaticLightCreationOff();
  renderer->SetEnvironmentTexture(texture);
  renderer->UseImageBasedLightingOn();
  renderer->ResetCamera();
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(9, 9);
  caster->KeepSceneOn(); // without, each execution extracts the scene
  double before = 0.0;
  for (const double value : { 50.0, 160.0 })
  {
    const vtkMTimeType time = caster->GetMTime();
    image->GetPointData()->GetScalars()->Fill(value);
    image->GetPointData()->GetScalars()->Modified();
    image->Modified();
    EXPECT_GT(caster->GetMTime(), time);
    caster->Update();
    const double color =
      caster->GetOutput()->GetPointData()->GetArray("Color")->GetComponent(40, 0);
    EXPECT_GT(color, before + 0.05);
    before = color;
  }
}
