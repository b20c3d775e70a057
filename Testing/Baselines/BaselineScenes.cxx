// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BaselineScenes.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkCubeSource.h"
#include "vtkGPUVolumeRayCastMapper.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRTAnalyticSource.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderer.h"
#include "vtkSSAOPass.h"
#include "vtkSphereSource.h"
#include "vtkSuperquadricSource.h"
#include "vtkTexture.h"
#include "vtkTextureMapToPlane.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtkXMLPolyDataReader.h"

#include <cmath>

namespace penumbra
{

namespace
{

using Renderer = vtkSmartPointer<vtkRenderer>;

Renderer Empty()
{
  auto renderer = Renderer::New();
  renderer->SetBackground(0.1, 0.2, 0.3);
  return renderer;
}

vtkSmartPointer<vtkActor> Add(vtkRenderer* renderer, vtkAlgorithm* shape)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(shape->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

Renderer SeeAll(Renderer renderer)
{
  renderer->ResetCamera();
  return renderer;
}

vtkSmartPointer<vtkSphereSource> Sphere(double x, double y, double z, double radius)
{
  auto sphere = vtkSmartPointer<vtkSphereSource>::New();
  sphere->SetCenter(x, y, z);
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(48);
  sphere->SetPhiResolution(32);
  return sphere;
}

Renderer Highlights()
{
  const Renderer renderer = Empty();
  for (int i = 0; i < 5; ++i)
  {
    vtkProperty* property =
      Add(renderer, Sphere(1.1 * i, 0.3 * i, 0.2 * i * i, 0.5))->GetProperty();
    property->SetColor(1.0 - 0.2 * i, 0.3, 0.2 * i);
    property->SetSpecular(0.7);
    property->SetSpecularPower(30.0 + 10.0 * i);
  }
  return SeeAll(renderer);
}

vtkSmartPointer<vtkActor> AddBrain(vtkRenderer* renderer)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(PENUMBRA_SOURCE_DIR "/Data/brain.vtp");
  const auto actor = Add(renderer, reader);
  actor->GetMapper()->SetScalarRange(-25.0, 25.0);
  return actor;
}

Renderer Scalars()
{
  const Renderer renderer = Empty();
  AddBrain(renderer)->GetMapper()->InterpolateScalarsBeforeMappingOn();
  return SeeAll(renderer);
}

Renderer Edges()
{
  const Renderer renderer = Empty();
  AddBrain(renderer)->GetProperty()->EdgeVisibilityOn();
  return SeeAll(renderer);
}

Renderer Wires()
{
  const Renderer renderer = Empty();
  vtkNew<vtkSuperquadricSource> torus;
  torus->ToroidalOn();
  torus->SetThetaResolution(64);
  torus->SetPhiResolution(64);
  const auto actor = Add(renderer, torus);
  actor->RotateX(30.0);
  actor->GetProperty()->SetRepresentationToWireframe();
  return SeeAll(renderer);
}

Renderer Glass()
{
  const Renderer renderer = Empty();
  renderer->SetUseDepthPeeling(1);
  renderer->SetMaximumNumberOfPeels(8);
  for (int i = 0; i < 5; ++i)
  {
    vtkProperty* property =
      Add(renderer, Sphere(0.3 * i, 0.1 * i, 0.2 * i * i, 0.5))->GetProperty();
    property->SetColor(1.0 - 0.2 * i, 0.3, 0.2 * i);
    property->SetOpacity(0.4);
  }
  return SeeAll(renderer);
}

// A checkered floor up to the horizon.
Renderer Texture()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(64, 64, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < 64; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      auto* texel = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      const bool isDark = (x / 8 + y / 8) % 2 != 0;
      texel[0] = static_cast<unsigned char>(isDark ? 4 * x : 255);
      texel[1] = static_cast<unsigned char>(isDark ? 20 : 255);
      texel[2] = static_cast<unsigned char>(isDark ? 4 * y : 255);
    }
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOn();
  texture->RepeatOn();
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-5.0, -5.0, 0.0);
  plane->SetPoint1(5.0, -5.0, 0.0);
  plane->SetPoint2(-5.0, 5.0, 0.0);
  vtkNew<vtkTextureMapToPlane> coordinates;
  coordinates->SetInputConnection(plane->GetOutputPort());
  coordinates->SetSRange(0.0, 4.0);
  coordinates->SetTRange(0.0, 4.0);
  const Renderer renderer = Empty();
  Add(renderer, coordinates)->SetTexture(texture);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Elevation(-75.0);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(2.0);
  return renderer;
}

// Rays exactly along edges and through corners: touching cubes on a grid, seen along an axis.
Renderer Corners()
{
  const Renderer renderer = Empty();
  for (int i = 0; i < 16; ++i)
  {
    vtkNew<vtkCubeSource> cube;
    cube->SetCenter(i % 4, i / 4, (i * 7) % 3);
    Add(renderer, cube)->GetProperty()->SetColor(0.06 * i, 1.0 - 0.06 * i, i % 2);
  }
  renderer->ResetCamera();
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->GetActiveCamera()->SetParallelScale(3.0);
  return renderer;
}

void AddPlane(vtkRenderer* renderer, double x, double rise, double red, double green)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(x, 0.0, -rise);
  plane->SetPoint1(x + 1.0, 0.0, rise);
  plane->SetPoint2(x, 1.0, -rise);
  Add(renderer, plane)->GetProperty()->SetColor(red, green, 0.2);
}

// Left: two coplanar surfaces. Right: two planes that intersect.
Renderer Ties()
{
  const Renderer renderer = Empty();
  AddPlane(renderer, 0.0, 0.0, 1.0, 0.0);
  AddPlane(renderer, 0.0, 0.0, 0.0, 1.0);
  AddPlane(renderer, 1.2, 0.2, 1.0, 0.0);
  AddPlane(renderer, 1.2, -0.1, 0.0, 1.0);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Azimuth(20.0);
  return SeeAll(renderer);
}

// Contacts, shadows and ambient occlusion.
Renderer Shelf()
{
  const Renderer renderer = Empty();
  for (int i = 0; i < 9; ++i)
  {
    Add(renderer, Sphere(i % 3, i / 3, 0.5, 0.5));
  }
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-1.0, -1.0, 0.0);
  floor->SetPoint1(3.0, -1.0, 0.0);
  floor->SetPoint2(-1.0, 3.0, 0.0);
  Add(renderer, floor);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(3.0, -2.0, 4.0);
  light->SetFocalPoint(1.0, 1.0, 0.0);
  renderer->AddLight(light);
  renderer->GetActiveCamera()->SetPosition(0.3, -5.0, 4.0);
  renderer->GetActiveCamera()->SetFocalPoint(1.0, 1.0, 0.2);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCamera();
  return renderer;
}

Renderer Occlusion()
{
  const Renderer renderer = Scalars();
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAOPass> occlusion;
  occlusion->SetDelegatePass(steps);
  occlusion->SetRadius(10.0);
  occlusion->SetBias(0.1);
  occlusion->SetKernelSize(32);
  occlusion->BlurOn();
  renderer->SetPass(occlusion);
  return renderer;
}

Renderer Tubes()
{
  const Renderer renderer = Empty();
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(20);
  vtkProperty* property = Add(renderer, sphere)->GetProperty();
  property->SetRepresentationToWireframe();
  property->SetLineWidth(5.0f);
  property->RenderLinesAsTubesOn();
  return SeeAll(renderer);
}

Renderer Volume()
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-16, 16, -16, 16, -16, 16);
  vtkNew<vtkGPUVolumeRayCastMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  mapper->SetUseJittering(0);
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(100.0, 0.0);
  opacity->AddPoint(270.0, 0.3);
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(50.0, 0.0, 0.0, 1.0);
  color->AddRGBPoint(250.0, 1.0, 0.5, 0.0);
  volume->GetProperty()->SetScalarOpacity(opacity);
  volume->GetProperty()->SetColor(color);
  volume->GetProperty()->SetInterpolationTypeToLinear();
  volume->GetProperty()->ShadeOn();
  const Renderer renderer = Empty();
  renderer->AddVolume(volume);
  return SeeAll(renderer);
}

}

const std::vector<BaselineScene>& Gallery()
{
  static const std::vector<BaselineScene> exhibits = {
    { "highlights", true, false, Highlights },
    { "scalars", true, false, Scalars },
    { "texture", true, false, Texture },
    { "glass", true, false, Glass },
    { "edges", false, false, Edges },
    { "wires", false, false, Wires },
    { "corners", true, false, Corners },
    { "ties", true, false, Ties },
    { "shelf", true, true, Shelf },
    { "occlusion", false, false, Occlusion },
    { "tubes", false, false, Tubes },
    { "volume", false, false, Volume },
  };
  return exhibits;
}

}
