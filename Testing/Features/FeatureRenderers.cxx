// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureRenderers.h"

#include "FeatureProps.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkTransform.h"
#include "vtkVersionMacros.h"

using penumbra::Feature;

namespace
{

using Renderer = vtkRenderer*;
using Window = vtkRenderWindow*;

/// Adds a sphere above a plane, and a spotlight or a directional light that casts shadows.
void AddShadows(vtkRenderer* renderer, bool spot)
{
  vtkActor* sphere = Add(renderer, MakeSphere(48));
  sphere->SetScale(0.4);
  sphere->SetPosition(0.05, 0.0, 0.35);
  Add(renderer, MakePlane())->GetProperty()->SetColor(0.8, 0.9, 1.0);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPositional(spot);
  light->SetConeAngle(spot ? 30.0 : 180.0);
  light->SetExponent(0.0);
  light->SetPosition(0.7, 0.4, 2.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(light);
  renderer->UseShadowsOn();
  renderer->GetActiveCamera()->SetPosition(0.3, -1.2, 2.0);
  renderer->GetActiveCamera()->SetViewUp(0.0, 1.0, 0.0);
  renderer->ResetCamera();
}

/// Adds scenes of cameras with unusual view transforms and of the eyes of stereo views.
void AddCameraScenes(std::vector<FeatureScene>& scenes)
{
  for (int kind = 0; kind < 3; ++kind)
  {
    scenes.push_back({ Feature::CameraTransforms, [kind](Renderer r, Window) {
                        Add(r, MakeSphere(48))->SetPosition(-0.6, 0.0, 0.0);
                        vtkActor* cube = Add(r, MakeCube());
                        cube->SetPosition(0.7, 0.0, 0.0);
                        vtkNew<vtkPlane> plane;
                        plane->SetNormal(0.0, 1.0, 0.0);
                        plane->SetOrigin(0.0, -0.3, 0.0);
                        cube->GetMapper()->AddClippingPlane(plane);
                        vtkNew<vtkLight> light;
                        light->SetLightTypeToSceneLight();
                        light->SetPosition(1.0, 3.0, 4.0);
                        r->AddLight(light);
                        Look(r);
                        const double elements[3][16] = { { 0.8, 0.5, 0, 0, 0, 1, 0, 0, 0.2, 0, 1, 0,
                                                           0, 0, 0, 1 },       // shear
                          { -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }, // mirroring
                          { 0.6, 0, 0, 0.2, 0, 1.4, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
                        vtkNew<vtkTransform> transform;
                        transform->SetMatrix(elements[kind]);
                        r->GetActiveCamera()->SetUserViewTransform(transform);
                        r->ResetCameraClippingRange();
                      } });
  }
  scenes.push_back({ Feature::Cameras, [](Renderer r, Window) {
                      Add(r, MakeCube());
                      Look(r);
                      r->GetActiveCamera()->SetViewShear(0.3, -0.2, 1.0);
                    } });
  for (const int type : { VTK_STEREO_LEFT, VTK_STEREO_RIGHT })
  {
    scenes.push_back({ Feature::StereoEyes, [type](Renderer r, Window w) {
                        w->SetStereoType(type);
                        w->StereoRenderOn();
                        Add(r, MakeCube());
                        Add(r, MakeSphere(48))->SetPosition(0.4, 0.3, 1.0);
                        Look(r);
                        r->GetActiveCamera()->SetEyeAngle(8.0);
                        w->Render(); // passes the eye to the camera
                      } });
  }
}

}

void AddRendererScenes(std::vector<FeatureScene>& scenes)
{
  const auto add = [&](Feature key, auto&& build, double different = 0.002) {
    scenes.push_back({ key, build, different });
  };
  for (const bool spot : { true, false })
  {
    add(Feature::RendererShadows, [spot](Renderer r, Window) { AddShadows(r, spot); });
  }
  add(Feature::HiddenLineRemoval, [](Renderer r, Window) {
    r->SetUseHiddenLineRemoval(true);
    vtkActor* cube = Add(r, MakeCube());
    cube->GetProperty()->SetRepresentationToWireframe();
    cube->GetProperty()->LightingOff();
    Look(r);
  });
  // The surface is drawn before the wireframe, which hides only the wireframe behind.
  add(
    Feature::HiddenLineRemoval,
    [](Renderer r, Window) {
      r->SetUseHiddenLineRemoval(true);
      for (int i = 0; i < 3; ++i)
      {
        vtkActor* actor = Add(r, i == 1 ? MakeCube() : MakeSphere(12));
        actor->SetPosition(0.5 * i, 0.1 * i, -0.9 * i);
        if (i != 1)
        {
          actor->GetProperty()->SetRepresentationToWireframe();
          actor->GetProperty()->LightingOff();
          actor->GetProperty()->SetLineWidth(2.f);
        }
      }
      Look(r);
    },
    0.01);
  add(Feature::ForceOpaque, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakeCube());
    actor->GetProperty()->SetOpacity(0.4);
    actor->ForceOpaqueOn();
    Look(r);
  });
  // Actors behind show through only if they are drawn before.
  add(Feature::ForceOpaque, [](Renderer r, Window) {
    r->SetUseDepthPeeling(true);
    for (int i = 0; i < 3; ++i)
    {
      vtkActor* actor = Add(r, i == 1 ? MakeCube() : MakeSphere());
      actor->SetPosition(0.7 * (i - 1), 0.0, -0.6);
      actor->GetProperty()->SetColor(0.2 + 0.3 * i, 0.9 - 0.3 * i, 0.5);
      if (i == 1)
      {
        actor->SetPosition(0.0, 0.0, 0.6);
        actor->GetProperty()->SetOpacity(0.5);
        actor->ForceOpaqueOn();
      }
    }
    vtkActor* translucent = Add(r, MakeSphere());
    translucent->SetPosition(0.3, 0.6, 0.9);
    translucent->GetProperty()->SetOpacity(0.5);
    Look(r);
  });
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 7, 0)
  add(Feature::CoordinateSystems, [](Renderer r, Window w) {
    w->SetPhysicalTranslation(-0.5, 0.2, 0.0);
    w->SetPhysicalScale(2.0);
    Add(r, MakeSphere());
    vtkActor* actor = Add(r, MakeCube());
    actor->SetCoordinateSystemRenderer(r);
    actor->SetCoordinateSystemToDevice();
    actor->SetPosition(0.7, 0.1, 0.0);
    Look(r);
  });
#endif
  AddCameraScenes(scenes);
}
