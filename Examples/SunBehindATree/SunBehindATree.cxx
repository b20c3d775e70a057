// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders light shafts by ray casting, or with an OpenGL pass in a window. A medium fills the scene
// and scatters light wherever it is not in shadow. Both renderers use the same parameters of the
// medium.
//   SunBehindATree IMAGE.png [window]
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCaster.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCylinderSource.h>
#include <vtkImageData.h>
#include <vtkImageShiftScale.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>
#include <cstdlib>

namespace
{

void Add(vtkRenderer* renderer, vtkAlgorithm* source, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, green, blue);
  actor->GetProperty()->SetAmbient(0.2);
  renderer->AddActor(actor);
}

bool Write(vtkAlgorithm* image, const char* path)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(path);
  writer->Write();
  return writer->GetErrorCode() == 0;
}

bool RenderWithRayCaster(vtkRenderer* renderer, vtkPenumbraMedium* haze, const char* path)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetMedium(haze);
  caster->SetResolution(400, 300);
  vtkNew<vtkImageShiftScale> bytes;
  bytes->SetInputConnection(caster->GetOutputPort());
  bytes->SetScale(255.0);
  bytes->SetShift(0.5 / 255.0);
  bytes->SetOutputScalarTypeToUnsignedChar();
  bytes->ClampOverflowOn();
  return Write(bytes, path);
}

bool RenderInWindow(vtkRenderer* renderer, vtkPenumbraMedium* haze, const char* path)
{
  vtkPenumbraLightShaftPass* shafts = vtkPenumbraLightShaftPass::AddTo(renderer);
  shafts->SetMedium(haze);
  shafts->SetTolerance(1.0 / 1024.0); // small leaves need full resolution
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(400, 300);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  return Write(image, path);
}

}

int main(int argc, char* argv[])
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkCylinderSource> trunk;
  trunk->SetRadius(0.12);
  trunk->SetHeight(2.0);
  trunk->SetResolution(24);
  Add(renderer, trunk, 0.4, 0.25, 0.15);
  // Leaves on a spiral around the top.
  for (int i = 0; i < 60; ++i)
  {
    const double height = (i + 0.5) / 60.0;
    const double radius = 1.1 * std::sqrt(height * (1.0 - height)) + 0.1;
    vtkNew<vtkSphereSource> leaf;
    leaf->SetCenter(radius * std::cos(2.4 * i), 0.8 + 1.6 * height, radius * std::sin(2.4 * i));
    leaf->SetRadius(0.13);
    leaf->SetThetaResolution(16);
    leaf->SetPhiResolution(12);
    Add(renderer, leaf, 0.2, 0.5, 0.15);
  }
  renderer->GetActiveCamera()->SetPosition(0.0, 0.2, 7.0);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.9, 0.0);

  // The directional light is behind the tree.
  vtkNew<vtkLight> light;
  light->SetPosition(0.05, 0.35, -1.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetIntensity(2.0);
  light->SetDiffuseColor(1.0, 0.85, 0.6);
  renderer->AddLight(light);

  vtkNew<vtkPenumbraMedium> haze;
  haze->SetScattering(0.12); // per world unit
  haze->SetPhase(vtkPenumbraMedium::HENYEY_GREENSTEIN);
  haze->SetAsymmetry(0.5); // scatters mainly forward

  const char* path = argc > 1 ? argv[1] : "SunBehindATree.png";
  const bool written =
    argc > 2 ? RenderInWindow(renderer, haze, path) : RenderWithRayCaster(renderer, haze, path);
  return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
