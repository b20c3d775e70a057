// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Every change of a scene appears in the next image, and nothing is rendered again without a
// change. The table has one row for each kind of object in a scene.
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkAssembly.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkCoordinate.h"
#include "vtkFloatArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkSphereSource.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkTransform.h"
#include "vtkVersionMacros.h"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>

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

vtkSmartPointer<vtkActor> MakeActor(vtkSmartPointer<vtkMapper> mapper)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

vtkSmartPointer<vtkPolyDataMapper> MapSphere(vtkSphereSource* sphere)
{
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputConnection(sphere->GetOutputPort());
  return mapper;
}

vtkSmartPointer<vtkActor> AddSphere(vtkRenderer* renderer)
{
  const auto actor = MakeActor(MapSphere(vtkNew<vtkSphereSource>()));
  renderer->AddActor(actor);
  return actor;
}

vtkSmartPointer<vtkPolyData> MakeColoredSphere()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkSmartPointer<vtkPolyData> mesh = sphere->GetOutput();
  vtkNew<vtkFloatArray> heights;
  heights->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    heights->SetValue(i, static_cast<float>(mesh->GetPoint(i)[1]));
  }
  mesh->GetPointData()->SetScalars(heights);
  return mesh;
}

Change BuildCamera(vtkRenderer* renderer)
{
  AddSphere(renderer);
  vtkSmartPointer<vtkCamera> camera = renderer->GetActiveCamera();
  return [=] { camera->Azimuth(10.0); };
}

Change BuildCameraTransform(vtkRenderer* renderer)
{
  AddSphere(renderer);
  vtkNew<vtkTransform> transform;
  renderer->GetActiveCamera()->SetUserTransform(transform);
  vtkSmartPointer<vtkTransform> userTransform = transform;
  return [=] { userTransform->Scale(2.0, 2.0, 1.0); };
}

Change BuildLight(vtkRenderer* renderer)
{
  AddSphere(renderer);
  vtkSmartPointer<vtkLight> light = vtkSmartPointer<vtkLight>::New();
  renderer->AddLight(light);
  return [=] { light->SetIntensity(0.5); };
}

Change BuildNewLight(vtkRenderer* renderer)
{
  AddSphere(renderer);
  return [=] {
    vtkNew<vtkLight> light;
    light->SetIntensity(0.5);
    renderer->AddLight(light);
  };
}

Change BuildLightMatrix(vtkRenderer* renderer)
{
  AddSphere(renderer);
  vtkNew<vtkLight> light;
  vtkSmartPointer<vtkMatrix4x4> matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  light->SetPosition(1.0, 0.0, 1.0);
  light->SetTransformMatrix(matrix);
  renderer->AddLight(light);
  return [=] { matrix->SetElement(0, 0, -1.0); };
}

Change BuildBackground(vtkRenderer* renderer)
{
  return [=] { renderer->SetBackground(1.0, 0.0, 0.0); };
}

Change BuildNewActor(vtkRenderer* renderer)
{
  return [=] { AddSphere(renderer); };
}

Change BuildProperty(vtkRenderer* renderer)
{
  const auto actor = AddSphere(renderer);
  return [=] { actor->GetProperty()->SetColor(1.0, 0.0, 0.0); };
}

Change BuildUserMatrix(vtkRenderer* renderer)
{
  const auto actor = AddSphere(renderer);
  vtkSmartPointer<vtkMatrix4x4> matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  actor->SetUserMatrix(matrix);
  return [=] { matrix->SetElement(0, 3, 0.3); };
}

Change BuildSource(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkSphereSource> sphere = vtkSmartPointer<vtkSphereSource>::New();
  renderer->AddActor(MakeActor(MapSphere(sphere)));
  return [=] { sphere->SetRadius(0.3); };
}

Change BuildPoints(vtkRenderer* renderer)
{
  const auto mesh = MakeColoredSphere();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  renderer->AddActor(MakeActor(mapper.Get()));
  return [=] {
    mesh->GetPoints()->SetPoint(0, 0.0, 0.8, 0.2);
    mesh->GetPoints()->Modified();
  };
}

Change BuildLookupTable(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkLookupTable> table = vtkSmartPointer<vtkLookupTable>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeColoredSphere());
  mapper->SetLookupTable(table);
  renderer->AddActor(MakeActor(mapper.Get()));
  return [=] { table->SetHueRange(0.5, 0.5); };
}

Change BuildClippingPlane(vtkRenderer* renderer)
{
  const auto actor = AddSphere(renderer);
  vtkSmartPointer<vtkPlane> plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetNormal(1.0, 0.0, 0.0);
  actor->GetMapper()->AddClippingPlane(plane);
  return [=] { plane->SetOrigin(0.2, 0.0, 0.0); };
}

Change BuildNewClippingPlane(vtkRenderer* renderer)
{
  const auto actor = AddSphere(renderer);
  return [=] {
    vtkNew<vtkPlane> plane;
    plane->SetNormal(1.0, 0.0, 0.0);
    actor->GetMapper()->AddClippingPlane(plane);
  };
}

Change BuildTexture(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkImageData> image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  image->GetPointData()->GetScalars()->Fill(200.0);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  vtkNew<vtkPlaneSource> plane;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  const auto actor = MakeActor(mapper.Get());
  actor->SetTexture(texture);
  renderer->AddActor(actor);
  return [=] {
    image->GetPointData()->GetScalars()->Fill(100.0);
    image->GetPointData()->GetScalars()->Modified();
  };
}

vtkSmartPointer<vtkGlyph3DMapper> AddGlyphs(vtkRenderer* renderer, vtkSphereSource* shape)
{
  vtkNew<vtkPlaneSource> points;
  auto mapper = vtkSmartPointer<vtkGlyph3DMapper>::New();
  mapper->SetInputConnection(points->GetOutputPort());
  mapper->SetSourceConnection(shape->GetOutputPort());
  renderer->AddActor(MakeActor(mapper));
  return mapper;
}

Change BuildGlyphSource(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkSphereSource> shape = vtkSmartPointer<vtkSphereSource>::New();
  AddGlyphs(renderer, shape);
  return [=] { shape->SetRadius(0.2); };
}

Change BuildGlyphScale(vtkRenderer* renderer)
{
  const auto mapper = AddGlyphs(renderer, vtkNew<vtkSphereSource>());
  return [=] { mapper->SetScaleFactor(0.4); };
}

Change BuildAssemblyPart(vtkRenderer* renderer)
{
  const auto part = MakeActor(MapSphere(vtkNew<vtkSphereSource>()));
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(part);
  renderer->AddActor(assembly);
  return [=] { part->SetPosition(0.3, 0.0, 0.0); };
}

Change BuildAssemblyPartSource(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkSphereSource> sphere = vtkSmartPointer<vtkSphereSource>::New();
  vtkNew<vtkAssembly> inner;
  inner->AddPart(MakeActor(MapSphere(sphere)));
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  renderer->AddActor(outer);
  return [=] { sphere->SetRadius(0.3); };
}

Change BuildAssemblyPlane(vtkRenderer* renderer)
{
  const auto part = MakeActor(MapSphere(vtkNew<vtkSphereSource>()));
  vtkSmartPointer<vtkPlane> plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetNormal(1.0, 0.0, 0.0);
  part->GetMapper()->AddClippingPlane(plane);
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(part);
  renderer->AddActor(assembly);
  return [=] { plane->SetOrigin(0.2, 0.0, 0.0); };
}

vtkSmartPointer<vtkCompositePolyDataMapper> AddBlocks(vtkRenderer* renderer, vtkPolyData* mesh)
{
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, mesh);
  vtkNew<vtkMultiBlockDataSet> outer;
  outer->SetBlock(0, inner);
  auto mapper = vtkSmartPointer<vtkCompositePolyDataMapper>::New();
  mapper->SetInputDataObject(outer);
  renderer->AddActor(MakeActor(mapper));
  return mapper;
}

Change BuildBlock(vtkRenderer* renderer)
{
  const auto mesh = MakeColoredSphere();
  AddBlocks(renderer, mesh);
  return [=] {
    mesh->GetPoints()->SetPoint(0, 0.0, 0.8, 0.2);
    mesh->GetPoints()->Modified();
  };
}

// Composite mappers support these attributes since VTK 9.3.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
Change BuildBlockColor(vtkRenderer* renderer)
{
  const auto mesh = MakeColoredSphere();
  const auto mapper = AddBlocks(renderer, mesh);
  mapper->ScalarVisibilityOff();
  vtkSmartPointer<vtkCompositeDataDisplayAttributes> attributes =
    vtkSmartPointer<vtkCompositeDataDisplayAttributes>::New();
  mapper->SetCompositeDataDisplayAttributes(attributes);
  static const double red[3] = { 1.0, 0.0, 0.0 };
  return [=] { attributes->SetBlockColor(mesh, red); };
}

Change BuildBlockLookupTable(vtkRenderer* renderer)
{
  const auto mesh = MakeColoredSphere();
  const auto mapper = AddBlocks(renderer, mesh);
  vtkSmartPointer<vtkLookupTable> table = vtkSmartPointer<vtkLookupTable>::New();
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  attributes->SetBlockLookupTable(mesh, table);
  mapper->SetCompositeDataDisplayAttributes(attributes);
  return [=] { table->SetHueRange(0.5, 0.5); };
}
#endif

Change BuildText(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkTextActor> text = vtkSmartPointer<vtkTextActor>::New();
  text->SetInput("A");
  renderer->AddViewProp(text);
  return [=] { text->GetTextProperty()->SetColor(1.0, 0.0, 0.0); };
}

Change BuildTextPosition(vtkRenderer* renderer)
{
  vtkNew<vtkTextActor> text;
  text->SetInput("A");
  renderer->AddViewProp(text);
  vtkSmartPointer<vtkCoordinate> reference = vtkSmartPointer<vtkCoordinate>::New();
  reference->SetCoordinateSystemToDisplay();
  text->GetPositionCoordinate()->SetReferenceCoordinate(reference);
  return [=] { reference->SetValue(9.0, 9.0, 0.0); };
}

Change BuildScalarBar(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkLookupTable> table = vtkSmartPointer<vtkLookupTable>::New();
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  renderer->AddViewProp(bar);
  return [=] { table->SetHueRange(0.5, 0.5); };
}

const Row Rows[] = {
  { "Camera", BuildCamera },
  { "CameraTransform", BuildCameraTransform },
  { "Light", BuildLight },
  { "NewLight", BuildNewLight },
  { "LightMatrix", BuildLightMatrix },
  { "Background", BuildBackground },
  { "NewActor", BuildNewActor },
  { "Property", BuildProperty },
  { "UserMatrix", BuildUserMatrix },
  { "Source", BuildSource },
  { "Points", BuildPoints },
  { "LookupTable", BuildLookupTable },
  { "ClippingPlane", BuildClippingPlane },
  { "NewClippingPlane", BuildNewClippingPlane },
  { "Texture", BuildTexture },
  { "GlyphSource", BuildGlyphSource },
  { "GlyphScale", BuildGlyphScale },
  { "AssemblyPart", BuildAssemblyPart },
  { "AssemblyPartSource", BuildAssemblyPartSource },
  { "AssemblyPlane", BuildAssemblyPlane },
  { "Block", BuildBlock },
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  { "BlockColor", BuildBlockColor },
  { "BlockLookupTable", BuildBlockLookupTable },
#endif
  { "Text", BuildText },
  { "TextPosition", BuildTextPosition },
  { "ScalarBar", BuildScalarBar },
};

class SceneChange : public testing::TestWithParam<Row>
{
protected:
  void SetUp() override
  {
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.2, 4.0);
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(40, 40);
    vtkNew<vtkCallbackCommand> count;
    count->SetClientData(&this->Executions);
    count->SetCallback(
      [](vtkObject*, unsigned long, void* executions, void*) { ++*static_cast<int*>(executions); });
    this->Caster->AddObserver(vtkCommand::EndEvent, count);
  }

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

TEST_P(SceneChange, AppearsInTheNextImage)
{
  const Change change = GetParam().Build(this->Renderer);
  const std::vector<float> before = Render(this->Caster);
  EXPECT_EQ(Render(this->Caster), before);
  EXPECT_EQ(this->Executions, 1) << "rendered again without a change";
  change();
  const std::vector<float> after = Render(this->Caster);
  EXPECT_EQ(this->Executions, 2);
  EXPECT_NE(after, before);
  vtkNew<vtkPenumbraRayCaster> fresh;
  fresh->SetRenderer(this->Renderer);
  fresh->SetResolution(40, 40);
  EXPECT_EQ(after, Render(fresh));
}

// With KeepScene, too, and after a camera motion in between, during which the scene is kept.
TEST_P(SceneChange, AppearsInTheNextImageOfAKeptScene)
{
  this->Caster->KeepSceneOn();
  const Change change = GetParam().Build(this->Renderer);
  Render(this->Caster);
  this->Renderer->GetActiveCamera()->Azimuth(3.0);
  const std::vector<float> before = Render(this->Caster);
  change();
  const std::vector<float> after = Render(this->Caster);
  EXPECT_NE(after, before);
  vtkNew<vtkPenumbraRayCaster> fresh;
  fresh->SetRenderer(this->Renderer);
  fresh->SetResolution(40, 40);
  fresh->KeepSceneOn();
  EXPECT_EQ(after, Render(fresh));
}

std::string MakeName(const testing::TestParamInfo<Row>& row)
{
  return row.param.Name;
}

INSTANTIATE_TEST_SUITE_P(Table, SceneChange, testing::ValuesIn(Rows), MakeName);

}
