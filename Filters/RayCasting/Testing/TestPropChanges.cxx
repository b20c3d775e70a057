// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Changes of props whose copies or parts are drawn appear in the next image, and drawing them does
// not count as a change. Other props are in TestSceneChanges.
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkAxisActor2D.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCaptionActor2D.h"
#include "vtkCornerAnnotation.h"
#include "vtkCubeAxesActor.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLODProp3D.h"
#include "vtkLegendBoxActor.h"
#include "vtkLegendScaleActor.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyDataMapper.h"
#include "vtkProp3DFollower.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkRenderer.h"
#include "vtkSkybox.h"
#include "vtkSphereSource.h"
#include "vtkTextMapper.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <vector>

namespace
{

using Change = std::function<void()>;

struct Row
{
  const char* Name;
  Change (*Build)(
    vtkRenderer* renderer); ///< adds props; the result is a function that changes the scene
};

std::ostream& operator<<(std::ostream& os, const Row& row)
{
  return os << row.Name;
}

template <typename Prop>
vtkSmartPointer<Prop> Add(vtkRenderer* renderer)
{
  auto prop = vtkSmartPointer<Prop>::New();
  renderer->AddViewProp(prop);
  return prop;
}

vtkSmartPointer<vtkPolyDataMapper> MapSphere()
{
  vtkNew<vtkSphereSource> sphere;
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputConnection(sphere->GetOutputPort());
  return mapper;
}

Change BuildTextMapper(vtkRenderer* renderer)
{
  vtkNew<vtkTextMapper> mapper;
  mapper->SetInput("A");
  Add<vtkActor2D>(renderer)->SetMapper(mapper);
  vtkSmartPointer<vtkTextProperty> property = mapper->GetTextProperty();
  return [=] { property->SetColor(1.0, 0.0, 0.0); };
}

Change BuildCaption(vtkRenderer* renderer)
{
  const auto caption = Add<vtkCaptionActor2D>(renderer);
  caption->SetCaption("A");
  return [=] { caption->SetAttachmentPoint(0.3, 0.0, 0.0); };
}

Change BuildLegend(vtkRenderer* renderer)
{
  const auto legend = Add<vtkLegendBoxActor>(renderer);
  legend->SetNumberOfEntries(1);
  legend->SetEntryString(0, "A");
  return [=] { legend->BorderOff(); };
}

Change BuildAxis(vtkRenderer* renderer)
{
  const auto axis = Add<vtkAxisActor2D>(renderer);
  axis->SetPoint1(0.1, 0.5);
  axis->SetPoint2(0.9, 0.5);
  return [=] { axis->GetProperty()->SetColor(1.0, 0.0, 0.0); };
}

Change BuildScale(vtkRenderer* renderer)
{
  const auto scale = Add<vtkLegendScaleActor>(renderer);
  return [=] { scale->LegendVisibilityOff(); };
}

Change BuildCorner(vtkRenderer* renderer)
{
  const auto corner = Add<vtkCornerAnnotation>(renderer);
  corner->SetText(0, "A");
  return [=] { corner->SetText(0, "B"); };
}

Change BuildSkybox(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkImageData> image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(8, 4, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  image->GetPointData()->GetScalars()->Fill(100.0);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  const auto skybox = Add<vtkSkybox>(renderer);
  skybox->SetProjectionToSphere();
  skybox->SetTexture(texture);
  return [=] {
    image->GetPointData()->GetScalars()->Fill(200.0);
    image->Modified();
  };
}

Change BuildLevels(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkProperty> property = vtkSmartPointer<vtkProperty>::New();
  Add<vtkLODProp3D>(renderer)->AddLOD(MapSphere(), property, 0.0);
  return [=] { property->SetColor(1.0, 0.0, 0.0); };
}

Change BuildFollower(vtkRenderer* renderer)
{
  vtkNew<vtkActor> actor;
  actor->SetMapper(MapSphere());
  actor->SetScale(1.0, 0.5, 1.0);
  vtkSmartPointer<vtkCamera> camera = vtkSmartPointer<vtkCamera>::New();
  const auto follower = Add<vtkProp3DFollower>(renderer);
  follower->SetProp3D(actor);
  follower->SetCamera(camera);
  return [=] { camera->SetViewUp(1.0, 1.0, 0.0); };
}

Change BuildSplats(vtkRenderer* renderer)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(3);
  sphere->SetPhiResolution(3);
  vtkNew<vtkPointGaussianMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  mapper->SetScaleFactor(0.1);
  mapper->SetScaleArray("None");
  vtkSmartPointer<vtkPiecewiseFunction> function = vtkSmartPointer<vtkPiecewiseFunction>::New();
  function->AddPoint(0.0, 1.0);
  function->AddPoint(2.0, 1.0);
  mapper->SetScaleFunction(function);
  Add<vtkActor>(renderer)->SetMapper(mapper);
  return [=] { function->AddPoint(1.0, 2.0); };
}

Change BuildCubeAxes2D(vtkRenderer* renderer)
{
  const auto axes = Add<vtkCubeAxesActor>(renderer);
  axes->SetBounds(-0.5, 0.5, -0.5, 0.5, 0.0, 0.0);
  axes->SetUse2DMode(true);
  axes->SetCamera(renderer->GetActiveCamera());
  return [=] { axes->GetTitleTextProperty(0)->SetColor(1.0, 0.0, 0.0); };
}

const Row Rows[] = {
  { "TextMapper", BuildTextMapper },
  { "Caption", BuildCaption },
  { "Legend", BuildLegend },
  { "Axis", BuildAxis },
  { "Scale", BuildScale },
  { "Corner", BuildCorner },
  { "Skybox", BuildSkybox },
  { "Levels", BuildLevels },
  { "Follower", BuildFollower },
  { "Splats", BuildSplats },
  { "CubeAxes2D", BuildCubeAxes2D },
};

class PropChange : public testing::TestWithParam<Row>
{
protected:
  void SetUp() override
  {
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.2, 4.0);
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(60, 60);
    vtkNew<vtkCallbackCommand> count;
    count->SetClientData(&this->Executions);
    count->SetCallback(
      [](vtkObject*, unsigned long, void* executions, void*) { ++*static_cast<int*>(executions); });
    this->Caster->AddObserver(vtkCommand::EndEvent, count);
  }

  std::vector<float> Render() { return Render(this->Caster); }

  static std::vector<float> Render(vtkPenumbraRayCaster* caster)
  {
    caster->Update();
    auto* color =
      vtkFloatArray::SafeDownCast(caster->GetOutput()->GetPointData()->GetArray("Color"));
    return { color->GetPointer(0), color->GetPointer(0) + color->GetNumberOfValues() };
  }

  int Executions = 0;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPenumbraRayCaster> Caster;
};

}

TEST_P(PropChange, AppearsInTheNextImage)
{
  const Change change = GetParam().Build(this->Renderer);
  const std::vector<float> before = this->Render();
  EXPECT_EQ(this->Render(), before);
  EXPECT_EQ(this->Executions, 1) << "rendered again without a change";
  change();
  EXPECT_NE(this->Render(), before);
  EXPECT_EQ(this->Executions, 2);
}

// With KeepScene, too, and after a camera motion in between, during which the scene is kept.
TEST_P(PropChange, AppearsInTheNextImageOfAKeptScene)
{
  this->Caster->KeepSceneOn();
  const Change change = GetParam().Build(this->Renderer);
  this->Render();
  this->Renderer->GetActiveCamera()->Azimuth(3.0);
  const std::vector<float> before = this->Render();
  change();
  const std::vector<float> after = this->Render();
  EXPECT_NE(after, before);
  vtkNew<vtkPenumbraRayCaster> fresh;
  fresh->SetRenderer(this->Renderer);
  fresh->SetResolution(60, 60);
  fresh->KeepSceneOn();
  EXPECT_EQ(after, Render(fresh));
}

INSTANTIATE_TEST_SUITE_P(Props, PropChange, testing::ValuesIn(Rows),
  [](const testing::TestParamInfo<Row>& row) { return row.param.Name; });
