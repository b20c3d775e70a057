// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders indirect light with the irradiance cache. The red wall reflects light onto the white
// sphere next to it. The cache computes irradiance at a few hundred points and interpolates between
// them.
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraRayCaster.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkImageShiftScale.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <cstdlib>
#include <iostream>

namespace
{

void Add(vtkRenderer* renderer, vtkAlgorithm* source, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, green, blue);
  renderer->AddActor(actor);
}

/// Adds a wall of a room of size 2 x 2 x 2 that is centered at the origin.
void AddWall(vtkRenderer* renderer, const double normal[3], double red, double green, double blue)
{
  vtkNew<vtkPlaneSource> wall;
  wall->SetOrigin(-1.0, -1.0, 0.0);
  wall->SetPoint1(1.0, -1.0, 0.0);
  wall->SetPoint2(-1.0, 1.0, 0.0);
  wall->SetNormal(normal[0], normal[1], normal[2]);
  wall->SetCenter(-normal[0], -normal[1], -normal[2]);
  Add(renderer, wall, red, green, blue);
}

}

int main(int argc, char* argv[])
{
  vtkNew<vtkRenderer> renderer;
  const double floor[3] = { 0.0, 1.0, 0.0 };
  const double ceiling[3] = { 0.0, -1.0, 0.0 };
  const double back[3] = { 0.0, 0.0, 1.0 };
  const double left[3] = { 1.0, 0.0, 0.0 };
  const double right[3] = { -1.0, 0.0, 0.0 };
  AddWall(renderer, floor, 0.9, 0.9, 0.9);
  AddWall(renderer, ceiling, 0.9, 0.9, 0.9);
  AddWall(renderer, back, 0.9, 0.9, 0.9);
  AddWall(renderer, left, 0.9, 0.15, 0.1);
  AddWall(renderer, right, 0.15, 0.8, 0.2);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.4);
  sphere->SetCenter(-0.4, -0.6, 0.0);
  sphere->SetThetaResolution(96);
  sphere->SetPhiResolution(64);
  Add(renderer, sphere, 0.9, 0.9, 0.9);
  renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 4.6);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.0);

  vtkNew<vtkLight> light;
  light->SetPositional(true);
  light->SetConeAngle(180.0);
  light->SetPosition(0.2, 0.8, 0.3);
  light->SetIntensity(0.7);
  renderer->AddLight(light);

  vtkNew<vtkPenumbraIrradianceCache> cache;
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetShadows(true);
  caster->SetIndirectLight(true);
  caster->SetAlbedo(0.8);
  caster->SetBounces(4);
  caster->SetIrradianceProvider(cache);
  caster->SetLightTolerance(0.01);
  caster->SetResolution(800, 800);
  caster->Update();

  const auto count = [&](const char* name) {
    return caster->GetStatistics()->GetArray(name)->GetComponent(0, 0);
  };
  std::cout << count("Cache/Records") << " records from " << count("Rays/Gather") << " rays\n";

  vtkNew<vtkImageShiftScale> bytes;
  bytes->SetInputConnection(caster->GetOutputPort());
  bytes->SetScale(255.0);
  bytes->SetShift(0.5 / 255.0);
  bytes->SetOutputScalarTypeToUnsignedChar();
  bytes->ClampOverflowOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(bytes->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "LightInARoom.png");
  writer->Write();
  return count("Cache/Records") > 0.0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
