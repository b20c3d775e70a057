// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The ray caster follows UseShadows and UseSSAO of the renderer until its own options are set.
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{

constexpr int Size = 32;

/// A sphere on a plane, lit by a directional light from the side.
class RendererEffects : public testing::Test
{
protected:
  void SetUp() override
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(0.0, 0.0, 0.5);
    this->Add(sphere);
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-2.0, -2.0, 0.0);
    plane->SetPoint1(2.0, -2.0, 0.0);
    plane->SetPoint2(-2.0, 2.0, 0.0);
    this->Add(plane);
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(1.0, 0.0, 1.0);
    this->Renderer->AddLight(light);
    this->Renderer->GetActiveCamera()->SetPosition(0.0, -3.0, 4.0);
    this->Renderer->ResetCamera();
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(Size, Size);
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(&this->Messages);
    observer->SetCallback([](vtkObject*, unsigned long, void* data, void* text) {
      *static_cast<std::string*>(data) += static_cast<const char*>(text);
    });
    this->Caster->AddObserver(vtkCommand::WarningEvent, observer);
    this->Caster->AddObserver(vtkCommand::ErrorEvent, observer);
  }

  void Add(vtkPolyDataAlgorithm* source)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
  }

  std::vector<float> Render(const char* array = "Color")
  {
    this->Caster->Update();
    auto* values =
      vtkFloatArray::SafeDownCast(this->Caster->GetOutput()->GetPointData()->GetArray(array));
    return { values->GetPointer(0), values->GetPointer(0) + values->GetNumberOfValues() };
  }

  /// Returns a caster's image with options that were set explicitly.
  template <typename Set>
  std::vector<float> RenderWith(Set&& set)
  {
    vtkNew<vtkPenumbraRayCaster> caster;
    caster->SetRenderer(this->Renderer);
    caster->SetResolution(Size, Size);
    set(caster.GetPointer());
    caster->Update();
    auto* values =
      vtkFloatArray::SafeDownCast(caster->GetOutput()->GetPointData()->GetArray("Color"));
    return { values->GetPointer(0), values->GetPointer(0) + values->GetNumberOfValues() };
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPenumbraRayCaster> Caster;
  std::string Messages; ///< warnings and errors
};

using CasterPointer = vtkPenumbraRayCaster*;

}

TEST_F(RendererEffects, UseShadowsCastsShadows)
{
  const std::vector<float> plain = this->Render();
  const std::vector<float> shadows = this->RenderWith([](CasterPointer c) { c->ShadowsOn(); });
  EXPECT_FALSE(this->Caster->GetShadows());
  this->Renderer->UseShadowsOn();
  EXPECT_TRUE(this->Caster->GetShadows());
  EXPECT_EQ(this->Render(), shadows);
  EXPECT_NE(shadows, plain);
  EXPECT_GT(this->Caster->GetStatistics()->GetArray("Rays/Shadow")->GetComponent(0, 0), 0.0);
  this->Renderer->UseShadowsOff();
  EXPECT_EQ(this->Render(), plain);
}

TEST_F(RendererEffects, UseSSAOComputesOcclusionOfItsRadius)
{
  const std::vector<float> plain = this->Render();
  EXPECT_EQ(this->Messages, "");
  this->Renderer->UseSSAOOn();
  this->Renderer->SetSSAORadius(0.7);
  const std::vector<float> expected = this->RenderWith([](CasterPointer c) {
    c->AmbientOcclusionOn();
    c->SetAmbientOcclusionRadius(0.7);
    c->SetAmbientOcclusionStrength(1.0);
  });
  EXPECT_TRUE(this->Caster->GetAmbientOcclusion());
  EXPECT_EQ(this->Render(), expected);
  EXPECT_NE(expected, plain);
  EXPECT_NE(this->Messages.find("replaced by ray-cast ambient occlusion"), std::string::npos);
}

TEST_F(RendererEffects, RadiusAndStrengthOfTheCasterWin)
{
  this->Renderer->UseSSAOOn();
  this->Caster->SetAmbientOcclusionRadius(0.4);
  this->Caster->SetAmbientOcclusionStrength(0.5);
  EXPECT_EQ(this->Render(), this->RenderWith([](CasterPointer c) {
    c->AmbientOcclusionOn();
    c->SetAmbientOcclusionRadius(0.4);
    c->SetAmbientOcclusionStrength(0.5);
  }));
}

TEST_F(RendererEffects, ExplicitOptionsWin)
{
  const std::vector<float> plain = this->Render();
  this->Caster->ShadowsOff();
  this->Caster->AmbientOcclusionOff();
  this->Renderer->UseShadowsOn();
  this->Renderer->UseSSAOOn();
  EXPECT_FALSE(this->Caster->GetShadows());
  EXPECT_EQ(this->Render(), plain);
  EXPECT_EQ(this->Messages, "");
}

TEST_F(RendererEffects, AreOffWithoutARenderer)
{
  this->Caster->SetRenderer(nullptr);
  EXPECT_FALSE(this->Caster->GetShadows());
  EXPECT_FALSE(this->Caster->GetAmbientOcclusion());
}

TEST_F(RendererEffects, MissingRendererIsAnError)
{
  this->Caster->SetRenderer(nullptr);
  this->Caster->Update();
  EXPECT_NE(this->Messages.find("No renderer: call SetRenderer()"), std::string::npos)
    << this->Messages;
  EXPECT_EQ(this->Caster->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  this->Messages.clear();
  vtkNew<vtkSphereSource> sphere; // data sets need no renderer
  this->Caster->SetInputConnection(sphere->GetOutputPort());
  EXPECT_FALSE(this->Render().empty());
  EXPECT_EQ(this->Messages, "");
}

TEST_F(RendererEffects, OcclusionArrayIsComputedOnlyOnRequest)
{
  this->Caster->GeometryArraysOn();
  std::vector<float> depths = this->Render("Depth");
  const std::vector<float> computed = this->Render("AmbientOcclusion");
  const std::vector<float> color = this->Render();
  this->Caster->GetConstants().OcclusionArray = false;
  const std::vector<float> skipped = this->Render("AmbientOcclusion");
  EXPECT_EQ(this->Render("Depth"), depths);
  EXPECT_EQ(this->Render(), color);
  EXPECT_FALSE(this->Caster->GetStatistics()->GetArray("Rays/Gather"));
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    EXPECT_FALSE(std::isnan(computed[i])) << i;
    EXPECT_EQ(std::isnan(skipped[i]), std::isfinite(depths[i])) << i;
  }
}
