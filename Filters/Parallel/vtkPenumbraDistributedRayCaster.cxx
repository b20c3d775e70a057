// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraDistributedRayCaster.h"

#include "SurfaceExchange.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkPenumbraDistributedRayCaster);

int vtkPenumbraDistributedRayCaster::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  auto* ranks = vtkMultiProcessController::GetGlobalController();
  if (!ranks || ranks->GetNumberOfProcesses() < 2)
  {
    return this->Superclass::RequestData(request, inputs, outputs);
  }
  vtkNew<vtkInformationVector> joined;
  for (int i = 0; i < inputs[0]->GetNumberOfInformationObjects(); ++i)
  {
    const vtkSmartPointer<vtkPolyData> own =
      penumbra::ExtractCompositeSurface(vtkDataObject::GetData(inputs[0], i));
    vtkNew<vtkInformation> info;
    info->Set(vtkDataObject::DATA_OBJECT(), penumbra::AllGatherSurfaces(ranks, own));
    joined->Append(info);
  }
  vtkInformationVector* all[] = { joined };
  return this->Superclass::RequestData(request, all, outputs);
}
