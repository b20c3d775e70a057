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
  auto* controller = vtkMultiProcessController::GetGlobalController();
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return this->Superclass::RequestData(request, inputs, outputs);
  }
  vtkNew<vtkInformationVector> gathered;
  for (int i = 0; i < inputs[0]->GetNumberOfInformationObjects(); ++i)
  {
    const vtkSmartPointer<vtkPolyData> local =
      penumbra::ExtractCompositeSurface(vtkDataObject::GetData(inputs[0], i));
    vtkNew<vtkInformation> info;
    info->Set(vtkDataObject::DATA_OBJECT(), penumbra::AllGatherSurfaces(controller, local));
    gathered->Append(info);
  }
  vtkInformationVector* allInputs[] = { gathered };
  return this->Superclass::RequestData(request, allInputs, outputs);
}
