// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Uses the rendered image as a data set. The ray caster is part of a pipeline. In addition to
// colors, it outputs depth, normals, object and cell ids, statistics, and the estimated error.
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
    std::cout << array->GetName() << ": " << array->GetNumberOfComponents() << " per pixel\n";
  }

  vtkFieldData* statistics = caster->GetStatistics();
  for (int i = 0; i < statistics->GetNumberOfArrays(); ++i)
  {
    std::cout << statistics->GetArrayName(i) << " = " << statistics->GetArray(i)->GetTuple1(0)
              << "\n";
  }
  std::cout << "estimated error = " << caster->GetEstimatedError() << "\n";

  // Depth is infinite for pixels without a surface.
  vtkDataArray* depth = pixels->GetArray("Depth");
  const bool background = std::isinf(depth->GetTuple1(120 * 320 + 160));
  std::cout << "the center pixel shows " << (background ? "the background" : "a surface") << "\n";
  return caster->GetEstimatedError() <= caster->GetTolerance() ? EXIT_SUCCESS : EXIT_FAILURE;
}
