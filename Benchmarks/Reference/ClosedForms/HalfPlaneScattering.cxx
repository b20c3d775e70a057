// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HalfPlaneScattering.h"

#include "vtkPenumbraMedium.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

constexpr double Pi = glm::pi<double>();

/// Finite stand-in for infinity that single precision represents without loss.
constexpr double Wide = 1000.0;

}

vtkLight* HalfPlaneInHaze::AddTo(vtkRenderer* renderer) const
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-Wide, -Wide, 1.0);
  plane->SetPoint1(0.0, -Wide, 1.0);
  plane->SetPoint2(-Wide, Wide, 1.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0.0, 0.0, 0.0);
  renderer->AddActor(actor);
  renderer->SetBackground(0.0, 0.0, 0.0);
  vtkNew<vtkLight> sun;
  sun->SetPosition(0.0, 0.0, 1.0);
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  sun->SetIntensity(this->Intensity);
  renderer->AddLight(sun);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(Eye);
  camera->SetFocalPoint(0.0, 0.0, Eye[2]);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(90.0);
  return sun;
}

void HalfPlaneInHaze::Describe(vtkPenumbraMedium* medium) const
{
  medium->SetScattering(Scattering);
  medium->SetExtinction(Extinction);
  medium->SetBounds(
    this->Low[0], this->High[0], this->Low[1], this->High[1], this->Low[2], this->High[2]);
}

double HalfPlaneInHaze::Exact(double right, double up) const
{
  // Distances are along x. The lit region begins at the edge of the half-plane, x = 0.
  const double direction[3] = { 1.0, -right, up };
  const double near = -Eye[0];
  const double enters = std::max(this->Low[0] - Eye[0], 0.0);
  double far = Endless;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double face = direction[axis] > 0.0 ? this->High[axis] : this->Low[axis];
    if (direction[axis] != 0.0)
    {
      far = std::min(far, (face - Eye[axis]) / direction[axis]);
    }
  }
  const bool meetsHalfPlane = up > 0.0 && (1.0 - Eye[2]) / up < near;
  if (meetsHalfPlane || far <= near)
  {
    return 0.0;
  }
  const double length = std::hypot(1.0, right, up);
  const double a = Extinction * (this->High[2] - (Eye[2] + enters * up));
  const double b = Extinction * (1.0 - up / length);
  const double t0 = (near - enters) * length;
  const double t1 = (far - enters) * length;
  const double spread =
    std::abs(b * (t1 - t0)) < 1e-9 ? t1 - t0 : (std::exp(-b * t0) - std::exp(-b * t1)) / b;
  return this->Intensity * Scattering / (4.0 * Pi) * std::exp(-a) * spread;
}

}
