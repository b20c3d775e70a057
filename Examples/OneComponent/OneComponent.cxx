// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ray casts a triangle that covers half of the image, and prints the version and the covered fraction.
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraVersionMacros.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

int main()
{
  // The half of the square [-1, 1]^2 below its diagonal.
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(-1.0, -1.0, 0.0);
  points->InsertNextPoint(1.0, -1.0, 0.0);
  points->InsertNextPoint(-1.0, 1.0, 0.0);
  vtkNew<vtkCellArray> triangles;
  triangles->InsertNextCell({ 0, 1, 2 });
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.0);
  camera->SetPosition(0.0, 0.0, 2.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetClippingRange(1.0, 3.0);

  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(64, 64);
  caster->Update();
  vtkDataArray* colors = caster->GetOutput()->GetPointData()->GetArray("Color");
  double covered = 0.0;
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    covered += colors->GetComponent(i, 0) / static_cast<double>(colors->GetNumberOfTuples());
  }
  std::cout << "Penumbra " << PENUMBRA_VERSION << ": covered fraction " << covered << "\n";
  return std::abs(covered - 0.5) < 1e-4 ? EXIT_SUCCESS : EXIT_FAILURE;
}
