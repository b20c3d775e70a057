// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LabelCopies.h"

#include "vtkCoordinate.h"
#include "vtkLabelPlacementMapper.h"
#include "vtkLabeledDataMapper.h"
#include "vtkPlaneCollection.h"
#include "vtkTextProperty.h"
#include "vtkTransform.h"

namespace penumbra
{
namespace
{

void CopyInputs(vtkMapper2D* from, vtkMapper2D* to)
{
  for (int i = 0; i < from->GetNumberOfInputConnections(0); ++i)
  {
    to->AddInputConnection(0, from->GetInputConnection(0, i));
  }
  to->SetClippingPlanes(from->GetClippingPlanes());
}

vtkSmartPointer<vtkMapper2D> Copy(vtkLabeledDataMapper* from)
{
  auto to = vtkSmartPointer<vtkLabeledDataMapper>::New();
  CopyInputs(from, to);
  to->SetLabelMode(from->GetLabelMode());
  to->SetLabelFormat(from->GetLabelFormat());
  to->SetLabeledComponent(from->GetLabeledComponent());
  to->SetComponentSeparator(from->GetComponentSeparator());
  to->SetFieldDataArray(from->GetFieldDataArray());
  to->SetFieldDataName(from->GetFieldDataName());
  to->SetTransform(from->GetTransform());
  to->SetCoordinateSystem(from->GetCoordinateSystem());
  vtkNew<vtkTextProperty> property;
  property->ShallowCopy(from->GetLabelTextProperty());
  to->SetLabelTextProperty(property);
  return to;
}

vtkSmartPointer<vtkMapper2D> Copy(vtkLabelPlacementMapper* from)
{
  auto to = vtkSmartPointer<vtkLabelPlacementMapper>::New();
  CopyInputs(from, to);
  to->SetMaximumLabelFraction(from->GetMaximumLabelFraction());
  to->SetIteratorType(from->GetIteratorType());
  to->SetPositionsAsNormals(from->GetPositionsAsNormals());
  to->SetPlaceAllLabels(from->GetPlaceAllLabels());
  to->SetShape(from->GetShape());
  to->SetStyle(from->GetStyle());
  to->SetMargin(from->GetMargin());
  to->SetBackgroundColor(from->GetBackgroundColor());
  to->SetBackgroundOpacity(from->GetBackgroundOpacity());
  to->GetAnchorTransform()->SetCoordinateSystem(from->GetAnchorTransform()->GetCoordinateSystem());
  return to;
}

}

vtkSmartPointer<vtkMapper2D> CopyLabelMapper(vtkMapper2D* mapper)
{
  if (auto* labels = vtkLabeledDataMapper::SafeDownCast(mapper))
  {
    return labels->IsA("vtkDynamic2DLabelMapper") ? nullptr : Copy(labels);
  }
  auto* placed = vtkLabelPlacementMapper::SafeDownCast(mapper);
  return placed && !placed->GetUseDepthBuffer() ? Copy(placed) : nullptr;
}

}
