// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderOptions.h"
#include "SceneBuilder.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkRenderer.h"

#include <cmath>

namespace penumbra
{

namespace
{

// VTK's up, or another axis where the camera looks along it.
Triple ChooseUp(const CameraOptions& options, const Triple& direction)
{
  const Triple up = options.ViewUp.value_or(Triple{ 0, 1, 0 });
  double across[3];
  vtkMath::Cross(up.data(), direction.data(), across);
  const double sine =
    vtkMath::Norm(across) / (vtkMath::Norm(up.data()) * vtkMath::Norm(direction.data()));
  if (sine > 1e-6)
  {
    return up;
  }
  return std::abs(up[2]) < 0.5 * vtkMath::Norm(up.data()) ? Triple{ 0, 0, 1 } : Triple{ 0, 1, 0 };
}

// Half the height that shows a sphere of `radius` in a picture of that aspect.
double FitScale(double radius, double aspect)
{
  return aspect < 1.0 ? radius / aspect : radius;
}

// From how far the sphere fills the narrower angle of view.
double FitDistance(double radius, double aspect, double viewAngle)
{
  double half = vtkMath::RadiansFromDegrees(viewAngle) / 2.0;
  if (aspect < 1.0)
  {
    half = std::atan(std::tan(half) * aspect);
  }
  return radius / std::sin(half);
}

}

void PlaceCamera(vtkRenderer* renderer, const CameraOptions& options, double aspect)
{
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  Triple center;
  double diagonal = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
    diagonal = std::hypot(diagonal, bounds[2 * axis + 1] - bounds[2 * axis]);
  }
  const double radius = diagonal > 0.0 ? 0.5 * diagonal : 0.5;

  Triple focalPoint = options.FocalPoint.value_or(center);
  Triple position = options.Position.value_or(focalPoint);
  Triple direction = options.Direction.value_or(Triple{ 0, 0, -1 });
  const double distance = FitDistance(radius, aspect, options.ViewAngle) / options.ZoomFactor;
  double scale = FitScale(radius, aspect) / options.ZoomFactor;
  if (options.Position)
  {
    vtkMath::Subtract(focalPoint.data(), position.data(), direction.data());
    scale = FitScale(radius, aspect);
    if (vtkMath::Norm(direction.data()) == 0.0)
    {
      // The eye is in the centre of the bounds: it looks on from there.
      direction = options.Direction.value_or(Triple{ 0, 0, -1 });
      vtkMath::Add(position.data(), direction.data(), focalPoint.data());
    }
  }
  else
  {
    const double length = vtkMath::Norm(direction.data());
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = focalPoint[axis] - direction[axis] / length * distance;
    }
  }

  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(position.data());
  camera->SetFocalPoint(focalPoint.data());
  camera->SetViewUp(ChooseUp(options, direction).data());
  camera->SetViewAngle(options.ViewAngle);
  camera->SetParallelProjection(options.Orthographic);
  camera->SetParallelScale(std::isnan(options.ParallelScale) ? scale : options.ParallelScale);
  camera->Azimuth(options.Azimuth);
  camera->Elevation(options.Elevation);
  camera->OrthogonalizeViewUp();
  renderer->ResetCameraClippingRange(bounds);
}

}
