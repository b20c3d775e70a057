// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "WarningScenes.h"

#include "FeatureProps.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkAppendPolyData.h"
#include "vtkAxisActor.h"
#include "vtkBrush.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkContext2D.h"
#include "vtkContextActor.h"
#include "vtkContextItem.h"
#include "vtkContextScene.h"
#include "vtkImageData.h"
#include "vtkImageMapper3D.h"
#include "vtkImageSlice.h"
#include "vtkLabeledDataMapper.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSelectVisiblePoints.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkShaderProperty.h"
#include "vtkSkybox.h"
#include "vtkTexture.h"
#include "vtkTransform.h"
#include "vtkVolume.h"

#include <algorithm>

using penumbra::Feature;

namespace
{

/// Mapper that the ray caster does not know.
class DerivedMapper : public vtkPolyDataMapper
{
public:
  static DerivedMapper* New();
  vtkTypeMacro(DerivedMapper, vtkPolyDataMapper);
};
vtkStandardNewMacro(DerivedMapper);

/// Stands for the class of VTK, which not all builds have.
class vtkOpenGLSphereMapper : public vtkPolyDataMapper
{
public:
  static vtkOpenGLSphereMapper* New();
  vtkTypeMacro(vtkOpenGLSphereMapper, vtkPolyDataMapper);
};
vtkStandardNewMacro(vtkOpenGLSphereMapper);

/// Mapper of images other than vtkImageSliceMapper.
class OtherImageMapper : public vtkImageMapper3D
{
public:
  static OtherImageMapper* New();
  vtkTypeMacro(OtherImageMapper, vtkImageMapper3D);
  void Render(vtkRenderer*, vtkImageSlice*) override {}
  void ReleaseGraphicsResources(vtkWindow*) override {}
  void GetIndexBounds(double extent[6]) override { std::fill_n(extent, 6, 0.0); }
  double* GetBounds() override { return this->Bounds; }
};
vtkStandardNewMacro(OtherImageMapper);

/// Item of a chart with a texture.
class TexturedItem : public vtkContextItem
{
public:
  static TexturedItem* New();
  vtkTypeMacro(TexturedItem, vtkContextItem);
  bool Paint(vtkContext2D* painter) override
  {
    vtkSmartPointer<vtkImageData> image = MakeImage(4, 4);
    painter->GetBrush()->SetTexture(image);
    painter->GetBrush()->SetTextureProperties(vtkBrush::Repeat);
    painter->DrawRect(2.f, 2.f, 20.f, 20.f);
    painter->GetBrush()->SetTexture(nullptr);
    return true;
  }
};
vtkStandardNewMacro(TexturedItem);

/// Render pass that draws nothing.
class EmptyPass : public vtkRenderPass
{
public:
  static EmptyPass* New();
  vtkTypeMacro(EmptyPass, vtkRenderPass);
  void Render(const vtkRenderState*) override {}
};
vtkStandardNewMacro(EmptyPass);

vtkActor* AddCube(vtkRenderer* renderer)
{
  return Add(renderer, MakeCube());
}

void AddActorScenes(std::vector<WarningScene>& scenes)
{
  const auto add = [&](Feature key, auto&& change, const char* prop = "Object 0") {
    scenes.push_back({ key, prop, [change](vtkRenderer* renderer) { change(AddCube(renderer)); } });
  };
  add(Feature::MultiTexturing, [](vtkActor* actor) {
    vtkNew<vtkTexture> texture;
    texture->SetInputData(MakeImage(8, 8));
    actor->GetProperty()->SetTexture("second", texture);
  });
  add(Feature::TextureCubeMap, [](vtkActor* actor) {
    vtkTexture* texture = AddTexture(actor, MakeImage(8, 8));
    texture->CubeMapOn();
    for (int side = 0; side < 6; ++side)
    {
      texture->SetInputDataObject(side, MakeImage(8, 8));
    }
  });
  add(Feature::CustomShaders, [](vtkActor* actor) {
    actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true, "", false);
  });
  add(Feature::Selection, [](vtkActor* actor) {
    vtkNew<vtkSelection> selection;
    selection->AddNode(vtkNew<vtkSelectionNode>());
    actor->GetMapper()->SetSelection(selection);
  });
  add(
    Feature::DerivedMappers,
    [](vtkActor* actor) {
      vtkNew<DerivedMapper> mapper;
      mapper->SetInputData(MakeCube());
      actor->SetMapper(mapper);
    },
    "Object 0 (DerivedMapper)");
  add(Feature::SplatShaders, [](vtkActor* actor) {
    vtkNew<vtkPointGaussianMapper> mapper;
    mapper->SetInputData(MakeCube());
    mapper->SetSplatShaderCode("//VTK::Color::Impl\nopacity = 0.5;");
    actor->SetMapper(mapper);
  });
  add(
    Feature::ShaderMappers,
    [](vtkActor* actor) {
      vtkNew<vtkOpenGLSphereMapper> mapper;
      mapper->SetInputData(MakeCube());
      actor->SetMapper(mapper);
    },
    "Object 0 (vtkOpenGLSphereMapper)");
}

void AddPropScenes(std::vector<WarningScene>& scenes)
{
  const auto add = [&](Feature key, const char* name, auto&& make) {
    scenes.push_back({ key, name, [make](vtkRenderer* renderer) {
                        AddCube(renderer);
                        make(renderer);
                      } });
  };
  add(Feature::ObliqueImageSlices, "vtkImageSlice", [](vtkRenderer* renderer) {
    vtkNew<OtherImageMapper> mapper;
    mapper->SetInputData(MakeImage(8, 8));
    vtkNew<vtkImageSlice> slice;
    slice->SetMapper(mapper);
    renderer->AddViewProp(slice);
  });
  add(Feature::FilteredVisiblePoints, "vtkActor2D", [](vtkRenderer* renderer) {
    vtkNew<vtkSelectVisiblePoints> visible;
    visible->SetInputData(MakeCube());
    visible->SetRenderer(renderer);
    vtkNew<vtkAppendPolyData> between;
    between->SetInputConnection(visible->GetOutputPort());
    vtkNew<vtkLabeledDataMapper> mapper;
    mapper->SetInputConnection(between->GetOutputPort());
    vtkNew<vtkActor2D> labels;
    labels->SetMapper(mapper);
    renderer->AddViewProp(labels);
  });
  add(Feature::ChartTextures, "vtkOpenGLContextActor", [](vtkRenderer* renderer) {
    vtkNew<vtkContextActor> actor;
    actor->GetScene()->AddItem(vtkNew<TexturedItem>());
    renderer->AddViewProp(actor);
  });
  add(Feature::AxisActors, "vtkAxisActor",
    [](vtkRenderer* renderer) { renderer->AddActor(vtkNew<vtkAxisActor>()); });
  add(Feature::OtherProps, "vtkOpenGLSkybox",
    [](vtkRenderer* renderer) { renderer->AddActor(vtkNew<vtkSkybox>()); });
  add(Feature::Volumes, "vtkVolume",
    [](vtkRenderer* renderer) { renderer->AddViewProp(vtkNew<vtkVolume>()); });
}

void AddRendererScenes(std::vector<WarningScene>& scenes)
{
  const auto add = [&](Feature key, auto&& change) {
    scenes.push_back({ key, "", [change](vtkRenderer* renderer) {
                        AddCube(renderer);
                        change(renderer);
                      } });
  };
  add(Feature::CameraShear, [](vtkRenderer* renderer) {
    vtkNew<vtkTransform> transform;
    transform->Scale(1.0, 2.0, 1.0);
    renderer->GetActiveCamera()->SetUserTransform(transform);
  });
  add(Feature::Stereo, [](vtkRenderer* renderer) {
    vtkRenderWindow* window = renderer->GetRenderWindow();
    window->SetStereoTypeToRedBlue();
    window->StereoRenderOn();
    window->Render(); // sets the camera's Stereo
  });
  add(Feature::RenderPass, [](vtkRenderer* renderer) { renderer->SetPass(vtkNew<EmptyPass>()); });
  add(Feature::RendererOcclusion, [](vtkRenderer* renderer) { renderer->UseSSAOOn(); });
}

}

std::vector<WarningScene> MakeWarningScenes()
{
  std::vector<WarningScene> scenes;
  AddActorScenes(scenes);
  AddPropScenes(scenes);
  AddRendererScenes(scenes);
  return scenes;
}
