// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Options/RenderOptions.h"
#include "Processes/CommandError.h"
#include "SceneBuilder.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace penumbra
{

namespace
{

// What can be looked at: lengths whose squares are ordinary numbers.
constexpr double ShortestLength = 1e-100;
constexpr double LongestLength = 1e100;
// The eye and what it looks at are at least this share of the scene's radius apart.
constexpr double LeastShare = 1e-12;

// Of length 1, however long it was: the squares of short and long ones are 0 and infinite.
Vector3 Normalize(Vector3 direction)
{
  const double largest =
    std::max({ std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2]) });
  for (double& x : direction)
  {
    x /= largest;
  }
  vtkMath::Normalize(direction.data());
  return direction;
}

Vector3 Move(Vector3 point, const Vector3& direction, double distance)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    point[axis] += distance * direction[axis];
  }
  return point;
}

// VTK's up, or another axis where the camera looks along it.
Vector3 ChooseUp(const CameraOptions& options, const Vector3& direction)
{
  const Vector3 up = Normalize(options.ViewUp.value_or(Vector3{ 0, 1, 0 }));
  double across[3];
  vtkMath::Cross(up.data(), direction.data(), across);
  if (vtkMath::Norm(across) > 1e-6)
  {
    return up;
  }
  return std::abs(up[2]) < 0.5 ? Vector3{ 0, 0, 1 } : Vector3{ 0, 1, 0 };
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
  Vector3 center;
  double diagonal = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
    diagonal = std::hypot(diagonal, bounds[2 * axis + 1] - bounds[2 * axis]);
  }
  const double radius = diagonal > 0.0 ? 0.5 * diagonal : 0.5;

  if (!(radius > ShortestLength && radius < LongestLength))
  {
    throw CommandError(BadInput,
      "the meshes are too " + std::string(radius < 1.0 ? "small" : "large") +
        " to be looked at; bring their coordinates to ordinary sizes");
  }

  Vector3 focalPoint = options.FocalPoint.value_or(center);
  Vector3 position = options.Position.value_or(focalPoint);
  Vector3 direction = options.Direction.value_or(Vector3{ 0, 0, -1 });
  double scale = FitScale(radius, aspect);
  if (options.Position)
  {
    Vector3 sight;
    vtkMath::Subtract(focalPoint.data(), position.data(), sight.data());
    if (vtkMath::Norm(sight.data()) > LeastShare * radius)
    {
      direction = sight;
    }
    else if (options.FocalPoint)
    {
      throw CommandError(
        BadInput, "--camera-focal-point: too close to --camera-position; move one of them");
    }
    else
    {
      // The eye is in the centre of the bounds: it looks on from there.
      focalPoint = Move(position, Normalize(direction), radius);
    }
  }
  else
  {
    const double far = FitDistance(radius, aspect, options.ViewAngle);
    const double distance = options.Orthographic ? far : far / options.ZoomFactor;
    position = Move(focalPoint, Normalize(direction), -distance);
    if (!(distance > LeastShare * radius && distance < LongestLength) || position == focalPoint)
    {
      throw CommandError(BadInput,
        std::string("--camera-zoom-factor: brings the eye too ") +
          (options.ZoomFactor > 1.0 ? "close; make it smaller" : "far away; make it larger"));
    }
    scale /= options.ZoomFactor;
  }

  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(position.data());
  camera->SetFocalPoint(focalPoint.data());
  camera->SetViewUp(ChooseUp(options, Normalize(direction)).data());
  camera->SetViewAngle(options.ViewAngle);
  camera->SetParallelProjection(options.Orthographic);
  camera->SetParallelScale(std::isnan(options.ParallelScale) ? scale : options.ParallelScale);
  camera->Azimuth(options.Azimuth);
  camera->Elevation(options.Elevation);
  camera->OrthogonalizeViewUp();
  renderer->ResetCameraClippingRange(bounds);
}

}
