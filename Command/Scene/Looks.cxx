// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Looks.h"

#include "CollectionItems.h"
#include "Options/LookOptions.h"
#include "Options/RenderOptions.h"
#include "SceneBuilder.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkDataSet.h"
#include "vtkLight.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Fraction of the image that surfaces may fill.
constexpr double FilledFraction = 0.94;

/// A right-handed frame: the up direction, the direction to the front, and to its right.
struct Frame
{
  Vector3 Up;
  Vector3 Front;
  Vector3 Right;
};

Vector3 Scale(const Vector3& v, double factor)
{
  return { factor * v[0], factor * v[1], factor * v[2] };
}

Vector3 Add(const Vector3& a, const Vector3& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

double Dot(const Vector3& a, const Vector3& b)
{
  return vtkMath::Dot(a.data(), b.data());
}

Vector3 Normalize(Vector3 v)
{
  vtkMath::Normalize(v.data());
  return v;
}

/// Makes a frame whose front is as close to `front` as the up direction allows.
Frame MakeFrame(const Vector3& up, const Vector3& front)
{
  Frame frame;
  frame.Up = Normalize(up);
  Vector3 level = Add(front, Scale(frame.Up, -Dot(front, frame.Up)));
  if (vtkMath::Norm(level.data()) < 0.1)
  {
    const Vector3 other{ 0.0, -1.0, 0.0 }; // the front of scenes whose z axis points up
    level = Add(other, Scale(frame.Up, -Dot(other, frame.Up)));
  }
  if (vtkMath::Norm(level.data()) < 0.1)
  {
    level = { 0.0, 0.0, 1.0 };
  }
  frame.Front = Normalize(level);
  vtkMath::Cross(frame.Up.data(), frame.Front.data(), frame.Right.data());
  return frame;
}

/// Returns the direction at these angles in degrees.
Vector3 FindDirection(const Frame& frame, double azimuth, double elevation)
{
  const double a = vtkMath::RadiansFromDegrees(azimuth);
  const double e = vtkMath::RadiansFromDegrees(elevation);
  return Add(Scale(frame.Up, std::sin(e)),
    Add(Scale(frame.Front, std::cos(e) * std::cos(a)),
      Scale(frame.Right, std::cos(e) * std::sin(a))));
}

Vector3 GetUp(const RenderOptions& options)
{
  return options.Camera.ViewUp.value_or(Vector3{ 0.0, 1.0, 0.0 });
}

/// Calls `visit` with each point that an actor of `renderer` shows.
template <typename Visitor>
void ForEachPoint(vtkRenderer* renderer, const Visitor& visit)
{
  for (vtkActor* actor : GetItems<vtkActor>(renderer->GetActors()))
  {
    vtkDataSet* mesh = actor->GetMapper()->GetInput();
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      Vector3 point;
      mesh->GetPoint(i, point.data());
      visit(point);
    }
  }
}

/// Sets the focal point and the zoom factor, which is relative to a view that fits the bounding
/// sphere, such that the points fill the image.
void FitView(vtkRenderer* renderer, const vtkBoundingBox& box, const RenderOptions& options,
  CameraOptions& camera)
{
  // The up direction of the frame is the view direction, its front the up direction of the image.
  const Frame frame = MakeFrame(*camera.Direction, GetUp(options));
  Vector3 center;
  box.GetCenter(center.data());
  double bounds[4] = { Infinity, -Infinity, Infinity, -Infinity };
  ForEachPoint(renderer, [&](const Vector3& point) {
    const Vector3 offset = Add(point, Scale(center, -1.0));
    const double x = Dot(offset, frame.Right);
    const double y = Dot(offset, frame.Front);
    bounds[0] = std::min(bounds[0], x);
    bounds[1] = std::max(bounds[1], x);
    bounds[2] = std::min(bounds[2], y);
    bounds[3] = std::max(bounds[3], y);
  });
  center = Add(center,
    Add(Scale(frame.Right, 0.5 * (bounds[0] + bounds[1])),
      Scale(frame.Front, 0.5 * (bounds[2] + bounds[3]))));
  const double aspect = static_cast<double>(options.Resolution[0]) / options.Resolution[1];
  const double slope = std::tan(vtkMath::RadiansFromDegrees(camera.ViewAngle) / 2.0);
  double distance = 0.0; // of the perspective camera from the center
  double height = 0.0;   // half of the parallel view
  ForEachPoint(renderer, [&](const Vector3& point) {
    const Vector3 offset = Add(point, Scale(center, -1.0));
    const double extent =
      std::max(std::abs(Dot(offset, frame.Front)), std::abs(Dot(offset, frame.Right)) / aspect) /
      FilledFraction;
    height = std::max(height, extent);
    distance = std::max(distance, extent / slope - Dot(offset, frame.Up));
  });
  const double radius = 0.5 * box.GetDiagonalLength();
  const double smaller = std::min(1.0, aspect);
  const double whole =
    camera.Orthographic ? radius / smaller : radius / std::sin(std::atan(slope * smaller));
  const double needed = camera.Orthographic ? height : distance;
  if (needed > 0.0)
  {
    camera.FocalPoint = center;
    camera.ZoomFactor = whole / needed;
  }
}

}

RenderOptions UseLookCamera(vtkRenderer* renderer, RenderOptions options)
{
  const Look& look = FindLook(options.Look);
  CameraOptions& camera = options.Camera;
  if (look.Lights.empty() || camera.Position)
  {
    return options;
  }
  if (!camera.Direction)
  {
    const Frame frame = MakeFrame(GetUp(options), { 0.0, 0.0, 1.0 });
    camera.Direction = Scale(FindDirection(frame, look.CameraAzimuth, look.CameraElevation), -1.0);
  }
  const vtkBoundingBox box = ComputeBounds(renderer, options);
  const bool isTurned = camera.Azimuth != 0.0 || camera.Elevation != 0.0;
  if (!camera.HasZoomFactor && !camera.FocalPoint && std::isnan(camera.ParallelScale) &&
    !isTurned && box.GetDiagonalLength() > 0.0)
  {
    FitView(renderer, box, options, camera);
  }
  return options;
}

bool AddLookLights(vtkRenderer* renderer, const RenderOptions& options)
{
  const Look& look = FindLook(options.Look);
  vtkCamera* camera = renderer->GetActiveCamera();
  const double* p = camera->GetDirectionOfProjection();
  const Frame frame = MakeFrame(GetUp(options), { -p[0], -p[1], -p[2] });
  for (const LookLight& row : look.Lights)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(FindDirection(frame, row.Azimuth, row.Elevation).data());
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetColor(row.Color.data());
    light->SetIntensity(options.LightIntensity);
    renderer->AddLight(light);
  }
  return !look.Lights.empty();
}

}
