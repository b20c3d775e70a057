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
  // The copied camera has VTK's camera coordinates. VTK applies the user's transform to explicit
  // projections, too.
  vtkNew<vtkMatrix4x4> projection;
  vtkMatrix4x4::Multiply4x4(view.Projection.data(), view.CameraToEye.data(), projection->GetData());
  wide->SetUserTransform(nullptr);
  wide->SetExplicitProjectionTransformMatrix(projection);
  wide->UseExplicitProjectionTransformMatrixOn();
  renderer->SetActiveCamera(wide);
}

ScopedCamera::ScopedCamera(vtkRenderer* renderer, const Matrix& view, const Matrix& projection)
  : Renderer(renderer),
    Saved(renderer->GetActiveCamera())
{
  vtkSmartPointer<vtkCamera> camera = vtkSmartPointer<vtkCamera>::Take(this->Saved->NewInstance());
  vtkNew<vtkMatrix4x4> toWorld;
  vtkMatrix4x4::Invert(view.data(), toWorld->GetData());
  const auto entry = [&](int row, int column) { return toWorld->GetElement(row, column); };
  camera->SetPosition(entry(0, 3), entry(1, 3), entry(2, 3));
  camera->SetFocalPoint(
    entry(0, 3) - entry(0, 2), entry(1, 3) - entry(1, 2), entry(2, 3) - entry(2, 2));
  camera->SetViewUp(entry(0, 1), entry(1, 1), entry(2, 1));
  camera->SetParallelProjection(projection[15] == 1.0);
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(projection.data());
  camera->SetExplicitProjectionTransformMatrix(matrix);
  camera->UseExplicitProjectionTransformMatrixOn();
  renderer->SetActiveCamera(camera);
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
