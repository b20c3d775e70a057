// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraDistributedRayCaster.h"

#include "DistributedScene.h"
#include "Statistics/Statistics.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"

#include <string>

vtkStandardNewMacro(vtkPenumbraDistributedRayCaster);

vtkPenumbraDistributedRayCaster::vtkPenumbraDistributedRayCaster()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

void vtkPenumbraDistributedRayCaster::SetController(vtkMultiProcessController* controller)
{
  if (controller != this->Controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkPenumbraDistributedRayCaster::GetController()
{
  return this->Controller;
}

int vtkPenumbraDistributedRayCaster::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!this->Controller || this->Controller->GetNumberOfProcesses() < 2)
  {
    return this->Superclass::RequestData(request, inputs, outputs);
  }
  penumbra::DistributedScene scene(this->Controller, [this](const std::string& text) {
    if (!this->HasWarned)
    {
      vtkWarningMacro(<< text);
      this->HasWarned = true;
    }
  });
  this->SetDistribution(&scene);
  const int result = this->Superclass::RequestData(request, inputs, outputs);
  this->SetDistribution(nullptr);
  const penumbra::ExchangeCounts& counts = scene.GetCounts();
  vtkImageData* image = vtkImageData::GetData(outputs);
  for (vtkFieldData* fields : { this->GetStatistics(), image->GetFieldData() })
  {
    penumbra::AddStatistics(counts, fields);
    penumbra::AddStatistic(fields, "Exchange/PixelBytes", counts.PixelBytes);
    penumbra::AddStatistic(fields, "Exchange/Rays", counts.Rays);
  }
  return result;
}

void vtkPenumbraDistributedRayCaster::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller.Get() << "\n";
}
