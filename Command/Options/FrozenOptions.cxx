// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FrozenOptions.h"

#include "CollectionItems.h"
#include "Medium/MediumCoefficients.h"
#include "Processes/CommandConstants.h"
#include "RenderOptions.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"

#include <cmath>

namespace penumbra
{

namespace
{

void FreezeCamera(vtkCamera* camera, CameraOptions& options)
{
  Vector3 position;
  Vector3 focalPoint;
  Vector3 viewUp;
  camera->GetPosition(position.data());
  camera->GetFocalPoint(focalPoint.data());
  camera->GetViewUp(viewUp.data());
  // An orbit turns about the up direction of the options, which the camera's is orthogonalized from.
  const Vector3 up = options.ViewUp.value_or(Vector3{ 0.0, 1.0, 0.0 });
  const bool isUpright =
    options.Index < 0 && vtkMath::Dot(up.data(), viewUp.data()) > 0.01 * vtkMath::Norm(up.data());
  options.Position = position;
  options.FocalPoint = focalPoint;
  options.ViewUp = isUpright ? up : viewUp;
  options.ParallelScale = camera->GetParallelScale();
  options.ViewAngle = camera->GetViewAngle();
  options.Orthographic = camera->GetParallelProjection() != 0;
  options.Index = -1;
  options.Azimuth = 0.0;
  options.Elevation = 0.0;
}

}

void FreezeColoring(vtkRenderer* renderer, ColoringOptions& options)
{
  for (vtkActor* actor : GetItems<vtkActor>(renderer->GetActors()))
  {
    vtkMapper* mapper = actor->GetMapper();
    // Mappers with colors of vertices use the active scalars.
    if (mapper && mapper->GetScalarVisibility() &&
      (mapper->GetScalarMode() == VTK_SCALAR_MODE_USE_POINT_FIELD_DATA ||
        mapper->GetScalarMode() == VTK_SCALAR_MODE_USE_CELL_FIELD_DATA))
    {
      const double* range = mapper->GetLookupTable()->GetRange();
      options.Array = mapper->GetArrayName();
      options.Range = { range[0], range[1] };
      return;
    }
  }
}

void FreezeOptions(vtkRenderer* renderer, double diagonal, RenderOptions& options)
{
  FreezeCamera(renderer->GetActiveCamera(), options.Camera);
  if (options.Coloring.Enabled)
  {
    FreezeColoring(renderer, options.Coloring);
  }
  if (options.AmbientOcclusionRadius == 0.0)
  {
    options.AmbientOcclusionRadius = DefaultRadiusFraction * diagonal;
  }
  ShaftOptions& shafts = options.Shafts;
  if (shafts.Scattering.empty())
  {
    shafts.Scattering = { DefaultOpticalDepth / diagonal };
  }
  if (std::isnan(shafts.BaseHeight) && shafts.ScaleHeight > 0.0)
  {
    shafts.BaseHeight = FindLowestHeight(renderer, shafts.Up.value_or(Vector3{ 0, 1, 0 }));
  }
}

JsonObject DescribeFrozen(const RenderOptions& options)
{
  const auto list = [](const Vector3& vector) {
    return std::vector<double>(vector.begin(), vector.end());
  };
  const CameraOptions& camera = options.Camera;
  JsonObject values;
  values["camera-position"] = list(*camera.Position);
  values["camera-focal-point"] = list(*camera.FocalPoint);
  values["camera-view-up"] = list(*camera.ViewUp);
  values["camera-parallel-scale"] = camera.ParallelScale;
  values["camera-view-angle"] = camera.ViewAngle;
  values["camera-orthographic"] = camera.Orthographic ? 1.0 : 0.0;
  values["coloring-array"] = options.Coloring.Array;
  values["coloring-range"] = options.Coloring.Range;
  values["shafts-scattering"] = options.Shafts.Scattering;
  // JSON has neither infinity nor NaN; only options on the command line set them.
  if (std::isfinite(options.AmbientOcclusionRadius))
  {
    values["ambient-occlusion-radius"] = options.AmbientOcclusionRadius;
  }
  if (std::isfinite(options.Shafts.BaseHeight))
  {
    values["shafts-base-height"] = options.Shafts.BaseHeight;
  }
  return values;
}

void ApplyFrozen(const JsonObject& values, RenderOptions& options)
{
  const auto list = [&values](
                      const char* name) { return std::get<std::vector<double>>(values.at(name)); };
  const auto vector = [&list](const char* name) {
    const std::vector<double> numbers = list(name);
    return Vector3{ numbers.at(0), numbers.at(1), numbers.at(2) };
  };
  const auto number = [&values](const char* name, double otherwise) {
    return values.count(name) > 0 ? std::get<double>(values.at(name)) : otherwise;
  };
  CameraOptions& camera = options.Camera;
  camera.Position = vector("camera-position");
  camera.FocalPoint = vector("camera-focal-point");
  camera.ViewUp = vector("camera-view-up");
  camera.ParallelScale = std::get<double>(values.at("camera-parallel-scale"));
  camera.ViewAngle = number("camera-view-angle", camera.ViewAngle);
  camera.Orthographic = number("camera-orthographic", camera.Orthographic ? 1.0 : 0.0) != 0.0;
  camera.Index = -1;
  camera.Azimuth = 0.0;
  camera.Elevation = 0.0;
  options.Coloring.Array = std::get<std::string>(values.at("coloring-array"));
  options.Coloring.Range = list("coloring-range");
  options.Shafts.Scattering = list("shafts-scattering");
  options.AmbientOcclusionRadius =
    number("ambient-occlusion-radius", options.AmbientOcclusionRadius);
  options.Shafts.BaseHeight = number("shafts-base-height", options.Shafts.BaseHeight);
}

}
