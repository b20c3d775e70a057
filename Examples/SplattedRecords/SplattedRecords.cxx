// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders the records of an irradiance cache with OpenGL, without tracing further rays. The ray
// caster computes the records. The left image shows their positions, which are dense near contacts.
// The right image interpolates the same records from another camera position.
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraIrradianceSplatPass.h"
#include "vtkPenumbraRayCaster.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>
#include <iostream>

namespace
{

void Add(vtkRenderer* renderer, vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff(); // to show occlusion only
  renderer->AddActor(actor);
}

void AddScene(vtkRenderer* renderer)
{
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-8.0, -8.0, 0.0);
  floor->SetPoint1(8.0, -8.0, 0.0);
  floor->SetPoint2(-8.0, 8.0, 0.0);
  Add(renderer, floor);
  const double spheres[3][4] = { { 0.0, 0.0, 1.0, 1.0 }, { 1.9, -0.6, 0.6, 0.6 },
    { -1.7, -0.9, 1.1, 0.5 } };
  for (const double* sphere : spheres)
  {
    vtkNew<vtkSphereSource> source;
    source->SetCenter(sphere);
    source->SetRadius(sphere[3]);
    source->SetThetaResolution(128);
    source->SetPhiResolution(96);
    Add(renderer, source);
  }
  renderer->SetBackground(0.62, 0.68, 0.74);
}

void SetCamera(vtkRenderer* renderer, double x, double y, double z)
{
  renderer->GetActiveCamera()->SetPosition(x, y, z);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.6);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCameraClippingRange();
}

/// Adds the records as points. They are slightly translucent, so that they are rendered after the
/// pass.
void AddPoints(vtkRenderer* renderer, vtkPolyData* records)
{
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(records);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> points;
  points->SetMapper(mapper);
  points->GetProperty()->LightingOff();
  points->GetProperty()->SetColor(0.85, 0.1, 0.1);
  points->GetProperty()->SetOpacity(0.999);
  points->GetProperty()->SetPointSize(3.0f);
  renderer->AddActor(points);
}

}

int main(int argc, char* argv[])
{
  vtkNew<vtkRenderer> left;
  AddScene(left);
  SetCamera(left, 0.0, -7.0, 4.0);

  vtkNew<vtkPenumbraIrradianceCache> cache;
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(left);
  caster->SetAmbientOcclusion(true);
  caster->SetAmbientOcclusionRadius(6.0);
  caster->SetIrradianceProvider(cache);
  caster->SetLightTolerance(0.01);
  caster->SetResolution(450, 400);
  caster->Update();
  vtkNew<vtkPolyData> records;
  cache->GetRecords(records);
  std::cout << records->GetNumberOfPoints() << " records from "
            << caster->GetStatistics()->GetArray("Rays/Gather")->GetComponent(0, 0) << " rays\n";

  vtkNew<vtkRenderer> right;
  AddScene(right);
  SetCamera(right, 1.6, -6.9, 3.3);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(4);
  window->SetSize(900, 400);
  left->SetViewport(0.0, 0.0, 0.5, 1.0);
  right->SetViewport(0.5, 0.0, 1.0, 1.0);
  for (vtkRenderer* renderer : { left.Get(), right.Get() })
  {
    window->AddRenderer(renderer);
    vtkPenumbraIrradianceSplatPass::AddTo(renderer)->SetRecords(records);
  }
  AddPoints(left, records);
  window->Render();

  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "SplattedRecords.png");
  writer->Write();
  const double interpolated = vtkPenumbraIrradianceSplatPass::AddTo(right)
                                ->GetStatistics()
                                ->GetArray("Pixels/Interpolated")
                                ->GetComponent(0, 0);
  std::cout << "from the other camera, " << 100.0 * interpolated
            << " % of the pixels are interpolated\n";
  return interpolated > 0.5 ? EXIT_SUCCESS : EXIT_FAILURE;
}
