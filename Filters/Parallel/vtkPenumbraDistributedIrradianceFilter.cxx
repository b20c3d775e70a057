// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraDistributedIrradianceFilter.h"

#include "DistributedOccluders.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"

#include <string>

vtkStandardNewMacro(vtkPenumbraDistributedIrradianceFilter);

int vtkPenumbraDistributedIrradianceFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return this->Superclass::RequestData(request, inputs, outputs);
  }
  penumbra::DistributedOccluders occluders(controller, [this](const std::string& text) {
    if (!this->HasWarned)
    {
      vtkWarningMacro(<< text);
      this->HasWarned = true;
    }
  });
  this->SetDistribution(&occluders);
  const int result = this->Superclass::RequestData(request, inputs, outputs);
  this->SetDistribution(nullptr);
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  for (vtkFieldData* fields : { this->GetStatistics(), output->GetFieldData() })
  {
    penumbra::AddStatistics(occluders.GetCounts(), fields);
  }
  return result;
}
