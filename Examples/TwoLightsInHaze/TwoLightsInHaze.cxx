// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders light shafts with OpenGL. Two directional lights of different colors illuminate a row of
// columns in haze; AddTo() adds the light shafts.
//   TwoLightsInHaze IMAGE.png [parallel]
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraMedium.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCylinderSource.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>

namespace
{

vtkActor* Add(vtkRenderer* renderer, vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.5, 0.5, 0.5);
  renderer->AddActor(actor);
  return actor;
}

void AddDirectionalLight(
  vtkRenderer* renderer, double x, double y, double z, double red, double green, double blue)
{
  vtkNew<vtkLight> light;
  light->SetPosition(x, y, z);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetDiffuseColor(red, green, blue);
  light->SetIntensity(2.0);
  renderer->AddLight(light);
}

}

int main(int argc, char* argv[])
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-12.0, 0.0, 12.0);
  floor->SetPoint1(12.0, 0.0, 12.0);
  floor->SetPoint2(-12.0, 0.0, -12.0);
  Add(renderer, floor);
  vtkNew<vtkCylinderSource> column;
  column->SetRadius(0.35);
  column->SetHeight(4.0);
  column->SetResolution(32);
  for (int i = 0; i < 7; ++i)
  {
    Add(renderer, column)->SetPosition(1.4 * (i - 3), 2.0, i % 2 - 0.5);
  }
  renderer->GetActiveCamera()->SetPosition(0.0, 2.5, 11.0);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 2.0, 0.0);
  renderer->GetActiveCamera()->SetViewAngle(33.0);
  if (argc > 2)
  {
    renderer->GetActiveCamera()->SetPosition(0.0, 8.0, 11.0);
    renderer->GetActiveCamera()->ParallelProjectionOn();
    renderer->GetActiveCamera()->SetParallelScale(3.4);
  }

  AddDirectionalLight(renderer, -0.22, 0.12, -1.0, 1.0, 0.6, 0.25);
  AddDirectionalLight(renderer, 0.22, 0.12, -1.0, 0.25, 0.5, 1.0);
  vtkPenumbraLightShaftPass* shafts = vtkPenumbraLightShaftPass::AddTo(renderer);
  shafts->GetMedium()->SetScattering(0.06); // per world unit
  shafts->GetMedium()->SetPhase(vtkPenumbraMedium::HENYEY_GREENSTEIN);
  shafts->GetMedium()->SetAsymmetry(0.4);

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(960, 640);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "TwoLightsInHaze.png");
  writer->Write();
  return writer->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
