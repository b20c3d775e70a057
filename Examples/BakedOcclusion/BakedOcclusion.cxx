// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Bakes ambient occlusion. A filter adds the array `AmbientOcclusion` to the points of a mesh.
// Here, the array is mapped to gray and rendered without lighting.
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPenumbraRayCaster.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageShiftScale.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkParametricFunctionSource.h>
#include <vtkParametricTorus.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

int main(int argc, char* argv[])
{
  vtkNew<vtkParametricTorus> torus;
  torus->SetRingRadius(1.0);
  torus->SetCrossSectionRadius(0.6);
  vtkNew<vtkParametricFunctionSource> mesh;
  mesh->SetParametricFunction(torus);
  mesh->SetUResolution(120);
  mesh->SetVResolution(60);

  vtkNew<vtkPenumbraIrradianceFilter> bake;
  bake->SetInputConnection(mesh->GetOutputPort());
  bake->SetTolerance(0.01); // RMSE over all points
  bake->SetRadius(10.0);    // maximum distance of an occluder, in world units
  bake->Update();
  double range[2];
  vtkPolyData* baked = vtkPolyData::SafeDownCast(bake->GetOutput());
  baked->GetPointData()->GetArray("AmbientOcclusion")->GetRange(range);
  std::cout << "ambient occlusion from " << range[0] << " to " << range[1] << "\n";

  vtkNew<vtkLookupTable> gray; // white: no occlusion
  gray->SetHueRange(0.0, 0.0);
  gray->SetSaturationRange(0.0, 0.0);
  gray->SetValueRange(1.0, 0.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(baked);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("AmbientOcclusion");
  mapper->SetLookupTable(gray);
  mapper->SetScalarRange(0.0, 1.0);
  mapper->InterpolateScalarsBeforeMappingOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->SetPosition(0.0, -4.0, 5.0);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.0);

  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(400, 300);
  vtkNew<vtkImageShiftScale> bytes;
  bytes->SetInputConnection(caster->GetOutputPort());
  bytes->SetScale(255.0);
  bytes->SetShift(0.5 / 255.0);
  bytes->SetOutputScalarTypeToUnsignedChar();
  bytes->ClampOverflowOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(bytes->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "BakedOcclusion.png");
  writer->Write();
  // The outside of the torus is not occluded; its hole is.
  return range[0] < 0.01 && range[1] > 0.2 ? EXIT_SUCCESS : EXIT_FAILURE;
}
