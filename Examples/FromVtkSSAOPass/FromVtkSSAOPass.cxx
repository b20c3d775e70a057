// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces vtkSSAOPass. The image shows the same scene with the pass of VTK on the left and with
// the pass of Penumbra on the right.
//
//   FromVtkSSAOPass IMAGE.png [MESH.ply]
#include "vtkPenumbraTemporalSSAOPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageAppend.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPNGWriter.h>
#include <vtkParametricFunctionSource.h>
#include <vtkParametricTorus.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSSAOPass.h>
#include <vtkSmartPointer.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>
#include <cstdlib>

namespace
{

void Add(vtkRenderer* renderer, vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.95, 0.9, 0.85);
  renderer->AddActor(actor);
}

/// Adds the mesh, or a torus, on a floor.
void AddScene(vtkRenderer* renderer, const char* path)
{
  vtkSmartPointer<vtkPolyDataAlgorithm> shape;
  if (path)
  {
    vtkNew<vtkPLYReader> reader;
    reader->SetFileName(path);
    shape = reader;
  }
  else
  {
    vtkNew<vtkParametricTorus> torus;
    vtkNew<vtkParametricFunctionSource> source;
    source->SetParametricFunction(torus);
    source->SetUResolution(240);
    source->SetVResolution(160);
    shape = source;
  }
  shape->Update();
  double b[6];
  shape->GetOutput()->GetBounds(b);
  const double size = std::hypot(b[1] - b[0], b[3] - b[2], b[5] - b[4]);
  Add(renderer, shape);
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(b[0] - size, b[2], b[4] - size);
  floor->SetPoint1(b[0] - size, b[2], b[5] + size);
  floor->SetPoint2(b[1] + size, b[2], b[4] - size);
  Add(renderer, floor);
  const double center[3] = { (b[0] + b[1]) / 2, (b[2] + b[3]) / 2, (b[4] + b[5]) / 2 };
  renderer->GetActiveCamera()->SetFocalPoint(center);
  renderer->GetActiveCamera()->SetPosition(
    center[0] + 0.6 * size, center[1] + 0.6 * size, center[2] + 1.3 * size);
  renderer->ResetCameraClippingRange();
}

/// Before: the application sets the radius in world units, the number of samples, and a blur.
void AddVTKPass(vtkRenderer* renderer)
{
  double b[6];
  renderer->ComputeVisiblePropBounds(b);
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAOPass> occlusion;
  occlusion->SetRadius(0.1 * std::hypot(b[1] - b[0], b[3] - b[2], b[5] - b[4]));
  occlusion->SetBias(0.01 * occlusion->GetRadius());
  occlusion->SetKernelSize(256);
  occlusion->BlurOn();
  occlusion->SetDelegatePass(steps);
  renderer->SetPass(occlusion);
}

/// After: the radius defaults to a tenth of the diagonal of the visible bounds; the application
/// sets the accepted error.
void AddPenumbraPass(vtkRenderer* renderer)
{
  vtkPenumbraTemporalSSAOPass* occlusion = vtkPenumbraTemporalSSAOPass::AddTo(renderer);
  occlusion->SetTolerance(0.01);
}

}

int main(int argc, char* argv[])
{
  vtkNew<vtkImageAppend> both;
  for (auto* addPass : { AddVTKPass, AddPenumbraPass })
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(0.62, 0.68, 0.74);
    AddScene(renderer, argc > 2 ? argv[2] : nullptr);
    addPass(renderer);
    vtkNew<vtkRenderWindow> window;
    window->OffScreenRenderingOn();
    window->SetMultiSamples(8);
    window->SetSize(420, 420);
    window->AddRenderer(renderer);
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(window);
    image->ReadFrontBufferOff();
    image->Update();
    both->AddInputData(image->GetOutput());
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(both->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "FromVtkSSAOPass.png");
  writer->Write();
  return writer->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
