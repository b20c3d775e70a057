// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraRayCaster.h"

#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraIrradianceSource.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>

struct vtkPenumbraRayCaster::Internals
{
  vtkSmartPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkPenumbraIrradianceSource> IrradianceSource;
  vtkNew<vtkFieldData> Statistics;
  double EstimatedError = 0.0;
};

vtkStandardNewMacro(vtkPenumbraRayCaster);

vtkPenumbraRayCaster::vtkPenumbraRayCaster()
  : Implementation(new Internals)
{
  this->SetNumberOfInputPorts(1);
}

vtkPenumbraRayCaster::~vtkPenumbraRayCaster() = default;

void vtkPenumbraRayCaster::SetRenderer(vtkRenderer* renderer)
{
  if (this->Implementation->Renderer != renderer)
  {
    this->Implementation->Renderer = renderer;
    this->Modified();
  }
}

vtkRenderer* vtkPenumbraRayCaster::GetRenderer()
{
  return this->Implementation->Renderer;
}

void vtkPenumbraRayCaster::SetIrradianceSource(vtkPenumbraIrradianceSource* source)
{
  if (this->Implementation->IrradianceSource != source)
  {
    this->Implementation->IrradianceSource = source;
    this->Modified();
  }
}

vtkPenumbraIrradianceSource* vtkPenumbraRayCaster::GetIrradianceSource()
{
  return this->Implementation->IrradianceSource;
}

void vtkPenumbraRayCaster::SetMaximumLevelFromViewing(double distance, double pixelPitch)
{
  // The eye resolves 2^-13 rad; a pixel seen under `angle` needs sides 2^L times smaller [AA].
  const double angle = std::atan2(pixelPitch, distance);
  this->SetMaximumLevel(static_cast<int>(std::ceil(std::log2(std::max(angle * 8192.0, 1.0)))));
}

vtkFieldData* vtkPenumbraRayCaster::GetStatistics()
{
  return this->Implementation->Statistics;
}

double vtkPenumbraRayCaster::GetEstimatedError()
{
  return this->Implementation->EstimatedError;
}

vtkMTimeType vtkPenumbraRayCaster::GetMTime()
{
  return this->Superclass::GetMTime();
}

int vtkPenumbraRayCaster::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

int vtkPenumbraRayCaster::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  const int extent[6] = { 0, this->Resolution[0] - 1, 0, this->Resolution[1] - 1, 0, 0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 4);
  return 1;
}

int vtkPenumbraRayCaster::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

int vtkPenumbraRayCaster::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkImageData* image = vtkImageData::GetData(info);
  int extent[6];
  info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
  image->SetExtent(extent);
  vtkNew<vtkFloatArray> color;
  color->SetName("Color");
  color->SetNumberOfComponents(4);
  color->SetNumberOfTuples(image->GetNumberOfPoints());
  color->Fill(0.0);
  image->GetPointData()->SetScalars(color);
  return 1;
}

void vtkPenumbraRayCaster::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution[0] << " " << this->Resolution[1] << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
}
