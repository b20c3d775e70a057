// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraDistributedIrradianceFilter.h"

#include "Scene.h"
#include "SurfaceExchange.h"

#include "vtkBoundingBox.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <limits>

vtkStandardNewMacro(vtkPenumbraDistributedIrradianceFilter);

int vtkPenumbraDistributedIrradianceFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return this->Superclass::RequestData(request, inputs, outputs);
  }
  const vtkSmartPointer<vtkPolyData> local =
    penumbra::ExtractCompositeSurface(vtkDataObject::GetData(inputs[0]));
  const std::vector<vtkBoundingBox> bounds = penumbra::GatherBounds(controller, local);
  vtkBoundingBox globalBounds;
  for (const vtkBoundingBox& box : bounds)
  {
    globalBounds.AddBox(box);
  }
  double radius = std::numeric_limits<double>::infinity();
  if (this->GetQuantity() == AMBIENT_OCCLUSION && globalBounds.IsValid())
  {
    radius = this->GetRadius() > 0.0
      ? this->GetRadius()
      : penumbra::DefaultRadiusFraction * globalBounds.GetDiagonalLength();
  }
  vtkSmartPointer<vtkPolyData> occluders =
    penumbra::GatherRemoteOccluders(controller, local, bounds, radius);
  if (globalBounds.IsValid())
  {
    // Two points without cells extend the occluders to the global bounds, which define the default
    // radius.
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    if (occluders->GetPoints())
    {
      points->DeepCopy(occluders->GetPoints());
    }
    points->InsertNextPoint(globalBounds.GetMinPoint());
    points->InsertNextPoint(globalBounds.GetMaxPoint());
    occluders->SetPoints(points);
  }
  vtkNew<vtkInformation> info;
  info->Set(vtkDataObject::DATA_OBJECT(), occluders);
  vtkNew<vtkInformationVector> occluderVector;
  occluderVector->Append(info);
  vtkInformationVector* allInputs[] = { inputs[0], occluderVector };
  return this->Superclass::RequestData(request, allInputs, outputs);
}
