// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders a VTK scene as an antialiased image, without a window or OpenGL. The ray caster accepts
// an unmodified vtkRenderer, and its output is a vtkImageData.
#include "vtkPenumbraRayCaster.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageShiftScale.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char* argv[])
{
  // A scene as for any VTK image.
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(32);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(1.0, 0.6, 0.2);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->SetBackground(0.1, 0.2, 0.3);
  renderer->ResetCamera();

  // The resolution and the accepted RMSE of each tile of 16x16 pixels.
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(400, 300);
  caster->SetTolerance(1.0 / 512.0);
  caster->Update();
  std::cout << "estimated error: " << caster->GetEstimatedError() << "\n";

  // The array Color contains floats in [0, 1]. PNG requires bytes.
  vtkNew<vtkImageShiftScale> bytes;
  bytes->SetInputConnection(caster->GetOutputPort());
  bytes->SetScale(255.0);
  bytes->SetShift(0.5 / 255.0);
  bytes->SetOutputScalarTypeToUnsignedChar();
  bytes->ClampOverflowOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(bytes->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "SceneToImage.png");
  writer->Write();
  return writer->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
