// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CollectionItems.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandConstants.h"
#include "Processes/CommandError.h"
#include "SceneBuilder.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkMath.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace penumbra
{

namespace
{

// Range of scene radii and camera distances, in world units: their squares are finite and nonzero.
constexpr double MinimumLength = 1e-100;
constexpr double MaximumLength = 1e100;

// A near plane that clips nothing in the ray caster: a negligible fraction of MaximumLength.
constexpr double NoNearPlane = 1e-10;

// Returns the unit vector. Dividing by the largest component first prevents underflow and overflow of
// the squared length.
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

// Returns the view up vector, or another axis if the view direction is parallel to it.
Vector3 ChooseUp(const CameraOptions& options, const Vector3& direction)
{
  const Vector3 up = Normalize(options.ViewUp.value_or(Vector3{ 0, 1, 0 }));
  double normal[3];
  vtkMath::Cross(up.data(), direction.data(), normal);
  if (vtkMath::Norm(normal) > 1e-6)
  {
    return up;
  }
  return std::abs(up[2]) < 0.5 ? Vector3{ 0, 0, 1 } : Vector3{ 0, 1, 0 };
}

// Computes the parallel scale at which a sphere fits an image of aspect width / height.
double ComputeFittingScale(double radius, double aspect)
{
  return aspect < 1.0 ? radius / aspect : radius;
}

// Computes the distance at which a sphere fits the narrower of the two view angles.
double ComputeFittingDistance(double radius, double aspect, double viewAngle)
{
  double half = vtkMath::RadiansFromDegrees(viewAngle) / 2.0;
  if (aspect < 1.0)
  {
    half = std::atan(std::tan(half) * aspect);
  }
  return radius / std::sin(half);
}

// Returns the largest radius with which the points and the lines of `actor` are drawn, or 0.
double FindRadius(vtkActor* actor, const RenderOptions& options)
{
  vtkPolyData* mesh = vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->GetInput();
  const int representation = actor->GetProperty()->GetRepresentation();
  const bool points = representation == VTK_POINTS || mesh->GetNumberOfVerts() > 0;
  const bool lines = representation == VTK_WIREFRAME ||
    (representation == VTK_SURFACE && mesh->GetNumberOfLines() > 0);
  return std::max(points ? options.PointRadius : 0.0, lines ? options.LineRadius : 0.0);
}

}

vtkBoundingBox ComputeBounds(vtkRenderer* renderer, const RenderOptions& options)
{
  vtkBoundingBox all;
  for (vtkActor* actor : GetItems<vtkActor>(renderer->GetActors()))
  {
    vtkBoundingBox bounds(actor->GetBounds());
    if (bounds.IsValid())
    {
      bounds.Inflate(FindRadius(actor, options));
      all.AddBox(bounds);
    }
  }
  if (!all.IsValid())
  {
    all.AddPoint(0.0, 0.0, 0.0); // An empty time step.
  }
  return all;
}

void PlaceCamera(vtkRenderer* renderer, const RenderOptions& all)
{
  const CameraOptions& options = all.Camera;
  const double aspect = static_cast<double>(all.Resolution[0]) / all.Resolution[1];
  double bounds[6];
  ComputeBounds(renderer, all).GetBounds(bounds);
  Vector3 center;
  double diagonal = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
    diagonal = std::hypot(diagonal, bounds[2 * axis + 1] - bounds[2 * axis]);
  }
  const double radius = diagonal > 0.0 ? 0.5 * diagonal : 0.5;

  if (!(radius > MinimumLength && radius < MaximumLength))
  {
    throw CommandError(BadInput,
      "the meshes are too " + std::string(radius < 1.0 ? "small" : "large") +
        " for the camera; scale their coordinates to between 1e-100 and 1e100");
  }

  Vector3 focalPoint = options.FocalPoint.value_or(center);
  Vector3 position = options.Position.value_or(focalPoint);
  Vector3 direction = options.Direction.value_or(Vector3{ 0, 0, -1 });
  double scale = ComputeFittingScale(radius, aspect);
  if (options.Position)
  {
    Vector3 toFocalPoint;
    vtkMath::Subtract(focalPoint.data(), position.data(), toFocalPoint.data());
    if (vtkMath::Norm(toFocalPoint.data()) > MinimumDistanceFraction * radius)
    {
      direction = toFocalPoint;
    }
    else if (options.FocalPoint)
    {
      throw CommandError(
        BadInput, "--camera-focal-point is too close to --camera-position; move one of them");
    }
    else
    {
      // The camera is at the center of the bounds: keep the view direction.
      focalPoint = Move(position, Normalize(direction), radius);
    }
  }
  else
  {
    const double far = ComputeFittingDistance(radius, aspect, options.ViewAngle);
    const double distance = options.Orthographic ? far : far / options.ZoomFactor;
    position = Move(focalPoint, Normalize(direction), -distance);
    if (!(distance > MinimumDistanceFraction * radius && distance < MaximumLength) ||
      position == focalPoint)
    {
      throw CommandError(BadInput,
        std::string("--camera-zoom-factor moves the camera too ") +
          (options.ZoomFactor > 1.0 ? "close; choose a smaller factor"
                                    : "far away; choose a larger factor"));
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
  if (all.Engine == "ray")
  {
    // Rays need no near plane: keep surfaces close to the camera, and occluders behind it.
    camera->SetClippingRange(NoNearPlane, MaximumLength);
  }
  else
  {
    renderer->ResetCameraClippingRange(bounds);
  }
}

}
