// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Views that no light reaches: one warning that says what to do, and none if there is light.
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCubeSource.h"
#include "vtkLight.h"
#include "vtkLineSource.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace
{

class MissingLight : public testing::Test
{
protected:
  MissingLight()
  {
    this->Positional->SetLightTypeToSceneLight();
    this->Positional->SetPositional(true);
    this->Positional->SetConeAngle(180.0);
    this->Positional->SetPosition(0.0, 0.0, 3.0);
    this->Renderer->AddLight(this->Positional);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0.0, -.9, 0.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetClippingRange(.01, 10.0);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(8, 8);
    this->Caster->SetTolerance(.1);
    this->Caster->SetEnvironmentColor(1.0, 1.0, 1.0);
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(&this->Messages);
    observer->SetCallback([](vtkObject*, unsigned long, void* to, void* text) {
      *static_cast<std::string*>(to) += static_cast<const char*>(text);
    });
    this->Caster->AddObserver(vtkCommand::WarningEvent, observer);
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

  /// A cube around the camera.
  vtkProperty* AddBox()
  {
    vtkNew<vtkCubeSource> box;
    box->SetXLength(2.0);
    box->SetYLength(2.0);
    box->SetZLength(2.0);
    return this->Add(box);
  }

  bool Warns()
  {
    this->Messages.clear();
    this->Caster->Update();
    return this->Messages.find("no light reaches them") != std::string::npos;
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkLight> Positional;
  vtkNew<vtkPenumbraRayCaster> Caster;
  std::string Messages;
};

}

TEST_F(MissingLight, IsReportedOnceInAClosedBox)
{
  this->AddBox();
  this->Caster->IndirectLightOn();
  this->Caster->ShadowsOn();
  EXPECT_TRUE(this->Warns());
  EXPECT_EQ(this->Messages.find('\n', this->Messages.find("The visible surfaces are black")),
    this->Messages.find_last_not_of('\n') + 1)
    << this->Messages; // one line
  this->Caster->Modified();
  EXPECT_FALSE(this->Warns());
}

TEST_F(MissingLight, IsNotReportedIfLightsCastNoShadows)
{
  this->AddBox();
  this->Caster->IndirectLightOn();
  EXPECT_FALSE(this->Warns());
}

TEST_F(MissingLight, IsNotReportedWithALightInTheBox)
{
  this->AddBox();
  this->Positional->SetPosition(.5, 0.0, .5);
  this->Caster->IndirectLightOn();
  this->Caster->ShadowsOn();
  EXPECT_FALSE(this->Warns());
}

TEST_F(MissingLight, IsNotReportedWithASmallEmitterInTheBox)
{
  this->AddBox();
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(.01);
  sphere->SetCenter(-.9, -.95, .9); // behind the camera
  vtkProperty* property = this->Add(sphere);
  property->SetAmbient(1.0);
  property->SetAmbientColor(100.0, 100.0, 100.0);
  this->Caster->IndirectLightOn();
  this->Caster->ShadowsOn();
  EXPECT_FALSE(this->Warns());
}

TEST_F(MissingLight, IsNotReportedUnderTheSky)
{
  vtkNew<vtkPlaneSource> wall;
  wall->SetOrigin(-1.0, 1.0, -1.0);
  wall->SetPoint1(1.0, 1.0, -1.0);
  wall->SetPoint2(-1.0, 1.0, 1.0);
  this->Add(wall);
  this->Positional->SetPosition(0.0, 9.0, 0.0); // behind the wall
  this->Caster->IndirectLightOn();
  this->Caster->ShadowsOn();
  EXPECT_FALSE(this->Warns());
  this->Caster->SetEnvironmentColor(0.0, 0.0, 0.0);
  EXPECT_TRUE(this->Warns());
}

TEST_F(MissingLight, IsReportedForALightInsideASurface)
{
  this->AddBox();
  vtkNew<vtkSphereSource> shade;
  shade->SetRadius(.2);
  shade->SetCenter(.5, 0.0, .5);
  this->Add(shade);
  this->Positional->SetPosition(.5, 0.0, .5);
  this->Caster->ShadowsOn();
  EXPECT_TRUE(this->Warns());
  this->Positional->SetPosition(.5, 0.0, .0);
  EXPECT_FALSE(this->Warns());
}

TEST_F(MissingLight, IsNotReportedForBlackSurfacesOrAnEmptyView)
{
  this->Caster->IndirectLightOn();
  this->Caster->ShadowsOn();
  EXPECT_FALSE(this->Warns());
  this->AddBox()->SetDiffuseColor(0.0, 0.0, 0.0);
  EXPECT_FALSE(this->Warns());
}

TEST_F(MissingLight, OfLinesIsReportedOnlyIfAllAreUnlit)
{
  const auto warns = [this] {
    this->Warns();
    return this->Messages.find("no surface has lighting") != std::string::npos;
  };
  vtkNew<vtkLineSource> line;
  vtkProperty* property = this->Add(line);
  EXPECT_FALSE(warns()); // without indirect light
  this->Caster->IndirectLightOn();
  property->RenderLinesAsTubesOn();
  EXPECT_FALSE(warns());
  property->RenderLinesAsTubesOff();
  vtkProperty* other = this->AddBox();
  EXPECT_FALSE(warns());
  other->SetRepresentationToWireframe(); // VTK lights wireframes
  EXPECT_FALSE(warns());
  this->Renderer->RemoveActor(this->Renderer->GetActors()->GetLastActor());
  EXPECT_TRUE(warns());
  this->Caster->Modified();
  EXPECT_FALSE(warns()); // once
}
