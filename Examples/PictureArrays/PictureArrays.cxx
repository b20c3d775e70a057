// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One idea: the picture of a data set is itself a data set. The ray caster takes its input from a
// pipeline, and beside the colours it tells depth, normals and what lies in every pixel, the work
// that it did, and the error that it believes it made.
#include "vtkPenumbraRayCaster.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSuperquadricSource.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

int main()
{
  vtkNew<vtkSuperquadricSource> shape;
  shape->ToroidalOn();
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetInputConnection(shape->GetOutputPort());
  caster->SetResolution(320, 240);
  caster->GeometryArraysOn();
  caster->Update();

  vtkPointData* pixels = caster->GetOutput()->GetPointData();
  for (int i = 0; i < pixels->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = pixels->GetArray(i);
    std::cout << array->GetName() << ": " << array->GetNumberOfComponents() << " a pixel\n";
  }

  vtkFieldData* statistics = caster->GetStatistics();
  for (int i = 0; i < statistics->GetNumberOfArrays(); ++i)
  {
    std::cout << statistics->GetArrayName(i) << " = " << statistics->GetArray(i)->GetTuple1(0)
              << "\n";
  }
  std::cout << "estimated error = " << caster->GetEstimatedError() << "\n";

  // Depth is infinite where nothing is seen.
  vtkDataArray* depth = pixels->GetArray("Depth");
  const bool open = std::isinf(depth->GetTuple1(120 * 320 + 160));
  std::cout << "the middle of the picture is " << (open ? "open" : "covered") << "\n";
  return caster->GetEstimatedError() <= caster->GetTolerance() ? EXIT_SUCCESS : EXIT_FAILURE;
}
