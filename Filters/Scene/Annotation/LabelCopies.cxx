// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LabelCopies.h"

#include "OverlayRecorder.h"

#include "vtkCoordinate.h"
#include "vtkLabelPlacementMapper.h"
#include "vtkLabeledDataMapper.h"
#include "vtkPlaneCollection.h"
#include "vtkPointSetToLabelHierarchy.h"
#include "vtkPolyData.h"
#include "vtkSelectVisiblePoints.h"
#include "vtkTextProperty.h"
#include "vtkTransform.h"

namespace penumbra
{
namespace
{

vtkSmartPointer<vtkPointSetToLabelHierarchy> Copy(vtkPointSetToLabelHierarchy* from)
{
  auto to = vtkSmartPointer<vtkPointSetToLabelHierarchy>::New();
  to->SetTargetLabelCount(from->GetTargetLabelCount());
  to->SetMaximumDepth(from->GetMaximumDepth());
  to->SetLabelArrayName(from->GetLabelArrayName());
  to->SetSizeArrayName(from->GetSizeArrayName());
  to->SetPriorityArrayName(from->GetPriorityArrayName());
  to->SetIconIndexArrayName(from->GetIconIndexArrayName());
  to->SetOrientationArrayName(from->GetOrientationArrayName());
  to->SetBoundedSizeArrayName(from->GetBoundedSizeArrayName());
  to->SetTextProperty(from->GetTextProperty());
  return to;
}

/// Returns the points that a filter of visible points selects in the image, or null if `producer` is
/// another filter.
vtkSmartPointer<vtkPolyData> FindVisiblePoints(vtkAlgorithm* producer)
{
  auto* filter = vtkSelectVisiblePoints::SafeDownCast(producer);
  const OverlayRecorder* recorder = OverlayRecorder::GetCurrent();
  return filter && recorder && recorder->SelectPoints ? recorder->SelectPoints(filter) : nullptr;
}

/// Returns true if a filter or one before it selects visible points.
bool SelectsVisiblePoints(vtkAlgorithm* filter)
{
  if (vtkSelectVisiblePoints::SafeDownCast(filter))
  {
    return true;
  }
  for (int port = 0; filter && port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      if (SelectsVisiblePoints(filter->GetInputAlgorithm(port, i)))
      {
        return true;
      }
    }
  }
  return false;
}

/// Copies the inputs. Those of vtkSelectVisiblePoints, which needs a window, are selected here.
void CopyInputs(vtkMapper2D* from, vtkMapper2D* to)
{
  for (int i = 0; i < from->GetNumberOfInputConnections(0); ++i)
  {
    vtkAlgorithm* producer = from->GetInputAlgorithm(0, i);
    if (vtkSmartPointer<vtkPolyData> points = FindVisiblePoints(producer))
    {
      to->AddInputDataObject(0, points);
      continue;
    }
    auto* hierarchy = vtkPointSetToLabelHierarchy::SafeDownCast(producer);
    if (hierarchy && hierarchy->GetNumberOfInputConnections(0) > 0)
    {
      if (vtkSmartPointer<vtkPolyData> points = FindVisiblePoints(hierarchy->GetInputAlgorithm()))
      {
        vtkSmartPointer<vtkPointSetToLabelHierarchy> copy = Copy(hierarchy);
        copy->SetInputData(points);
        to->AddInputConnection(0, copy->GetOutputPort());
        continue;
      }
    }
    to->AddInputConnection(0, from->GetInputConnection(0, i));
    if (OverlayRecorder* recorder = OverlayRecorder::GetCurrent())
    {
      recorder->NeedsWindow |= SelectsVisiblePoints(producer);
    }
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
