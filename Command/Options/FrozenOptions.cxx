// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FrozenOptions.h"

#include "Conventions/MediumCoefficients.h"
#include "Processes/CommandConstants.h"
#include "RenderOptions.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkMapper.h"
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
  options.Position = position;
  options.FocalPoint = focalPoint;
  options.ViewUp = viewUp;
  options.ParallelScale = camera->GetParallelScale();
  options.Azimuth = 0.0;
  options.Elevation = 0.0;
}

void FreezeColoring(vtkRenderer* renderer, ColoringOptions& options)
{
  vtkCollectionSimpleIterator cookie;
  renderer->GetActors()->InitTraversal(cookie);
  while (vtkActor* actor = renderer->GetActors()->GetNextActor(cookie))
  {
    vtkMapper* mapper = actor->GetMapper();
    if (mapper && mapper->GetScalarVisibility())
    {
      const double* range = mapper->GetLookupTable()->GetRange();
      options.Array = mapper->GetArrayName();
      options.Range = { range[0], range[1] };
      return;
    }
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

}
