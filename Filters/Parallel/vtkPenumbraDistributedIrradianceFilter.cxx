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
  auto* ranks = vtkMultiProcessController::GetGlobalController();
  if (!ranks || ranks->GetNumberOfProcesses() < 2)
  {
    return this->Superclass::RequestData(request, inputs, outputs);
  }
  const vtkSmartPointer<vtkPolyData> own =
    penumbra::ExtractCompositeSurface(vtkDataObject::GetData(inputs[0]));
  const std::vector<vtkBoundingBox> bounds = penumbra::GatherBounds(ranks, own);
  vtkBoundingBox whole;
  for (const vtkBoundingBox& box : bounds)
  {
    whole.AddBox(box);
  }
  double reach = std::numeric_limits<double>::infinity();
  if (this->GetQuantity() == AMBIENT_OCCLUSION && whole.IsValid())
  {
    reach = this->GetRadius() > 0.0 ? this->GetRadius()
                                    : penumbra::DefaultRadiusFraction * whole.GetDiagonalLength();
  }
  vtkSmartPointer<vtkPolyData> surroundings =
    penumbra::GatherRemoteOccluders(ranks, own, bounds, reach);
  if (whole.IsValid())
  {
    // Points of no polygon tell of the bounds, from which the radius may follow.
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    if (surroundings->GetPoints())
    {
      points->DeepCopy(surroundings->GetPoints());
    }
    points->InsertNextPoint(whole.GetMinPoint());
    points->InsertNextPoint(whole.GetMaxPoint());
    surroundings->SetPoints(points);
  }
  vtkNew<vtkInformation> info;
  info->Set(vtkDataObject::DATA_OBJECT(), surroundings);
  vtkNew<vtkInformationVector> others;
  others->Append(info);
  vtkInformationVector* both[] = { inputs[0], others };
  return this->Superclass::RequestData(request, both, outputs);
}
