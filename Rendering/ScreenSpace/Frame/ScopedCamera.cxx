// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ScopedCamera.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"

namespace penumbra
{

ScopedCamera::ScopedCamera(vtkRenderer* renderer, const ScreenTransform& view)
  : Renderer(renderer),
    Saved(renderer->GetActiveCamera())
{
  vtkSmartPointer<vtkCamera> wide = vtkSmartPointer<vtkCamera>::Take(this->Saved->NewInstance());
  wide->DeepCopy(this->Saved);
  vtkNew<vtkMatrix4x4> projection;
  projection->DeepCopy(view.Projection.data());
  wide->SetExplicitProjectionTransformMatrix(projection);
  wide->UseExplicitProjectionTransformMatrixOn();
  renderer->SetActiveCamera(wide);
}

ScopedCamera::~ScopedCamera()
{
  this->Renderer->SetActiveCamera(this->Saved);
}

std::vector<vtkProp*> VisibleProps(vtkRenderer* renderer)
{
  std::vector<vtkProp*> visible;
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  while (vtkProp* prop = props->GetNextProp(position))
  {
    if (prop->GetVisibility())
    {
      visible.push_back(prop);
    }
  }
  return visible;
}

}
