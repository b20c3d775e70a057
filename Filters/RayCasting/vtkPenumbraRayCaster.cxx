// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraRayCaster.h"

#include "RayCasterInternals.h"

#include "Execution/NaNCheck.h"
#include "Image/LayerCompositing.h"
#include "Import/CoincidentTopology.h"
#include "Import/SceneModificationTime.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLight.h"
#include "vtkObjectFactory.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

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
    // A kept scene is compared with the renderer that it was extracted from.
    this->Implementation->Renderer = renderer;
    this->Implementation->ModifyButKeepScene(this);
  }
}

void vtkPenumbraRayCaster::SetTimeLimit(double seconds)
{
  if (this->TimeLimit != seconds)
  {
    this->TimeLimit = seconds;
    this->Implementation->ModifyButKeepScene(this);
  }
}

penumbra::RayCasterConstants& vtkPenumbraRayCaster::GetConstants()
{
  this->Modified();
  return this->Implementation->Constants;
}

vtkRenderer* vtkPenumbraRayCaster::GetRenderer()
{
  return this->Implementation->Renderer;
}

double vtkPenumbraRayCaster::GetEffectiveLightTolerance()
{
  return this->LightTolerance == 0.0
    ? std::min(Internals::LightToleranceFactor * this->Tolerance, 1.0)
    : std::max(this->LightTolerance, 1e-6);
}

void vtkPenumbraRayCaster::SetShadows(bool on)
{
  if (this->Implementation->Shadows != on)
  {
    this->Implementation->Shadows = on;
    this->Modified();
  }
}

bool vtkPenumbraRayCaster::GetShadows()
{
  vtkRenderer* renderer = this->Implementation->Renderer;
  return this->Implementation->Shadows.value_or(renderer && renderer->GetUseShadows());
}

void vtkPenumbraRayCaster::SetAmbientOcclusion(bool on)
{
  if (this->Implementation->AmbientOcclusion != on)
  {
    this->Implementation->AmbientOcclusion = on;
    this->Modified();
  }
}

bool vtkPenumbraRayCaster::GetAmbientOcclusion()
{
  vtkRenderer* renderer = this->Implementation->Renderer;
  return this->Implementation->AmbientOcclusion.value_or(renderer && renderer->GetUseSSAO());
}

void vtkPenumbraRayCaster::SetIrradianceProvider(vtkPenumbraIrradianceProvider* provider)
{
  if (this->Implementation->IrradianceProvider != provider)
  {
    this->Implementation->IrradianceProvider = provider;
    if (!provider)
    {
      this->Implementation->IrradianceProvider =
        vtkSmartPointer<vtkPenumbraBruteForceIrradiance>::New();
    }
    this->Modified();
  }
}

vtkPenumbraIrradianceProvider* vtkPenumbraRayCaster::GetIrradianceProvider()
{
  return this->Implementation->IrradianceProvider;
}

void vtkPenumbraRayCaster::SetLightRadius(vtkLight* light, double radius)
{
  this->Implementation->SizedLights.SetRadius(light, radius);
  this->Modified();
}

void vtkPenumbraRayCaster::SetLightAngle(vtkLight* light, double angle)
{
  this->Implementation->SizedLights.SetAngle(light, angle);
  this->Modified();
}

double vtkPenumbraRayCaster::GetLightRadius(vtkLight* light)
{
  return this->Implementation->SizedLights.GetRadius(light, this->LightRadius);
}

double vtkPenumbraRayCaster::GetLightAngle(vtkLight* light)
{
  return this->Implementation->SizedLights.GetAngle(light, this->LightAngle);
}

void vtkPenumbraRayCaster::ClearLightSizes()
{
  this->Implementation->SizedLights.Clear();
  this->Modified();
}

void vtkPenumbraRayCaster::SetMedium(vtkPenumbraMedium* medium)
{
  if (this->Implementation->Medium != medium)
  {
    this->Implementation->Medium = medium;
    this->Modified();
  }
}

vtkPenumbraMedium* vtkPenumbraRayCaster::GetMedium()
{
  return this->Implementation->Medium;
}

void vtkPenumbraRayCaster::SetEnvironment(vtkPenumbraEnvironment* environment)
{
  if (this->Implementation->Environment != environment)
  {
    this->Implementation->Environment = environment;
    this->Modified();
  }
}

vtkPenumbraEnvironment* vtkPenumbraRayCaster::GetEnvironment()
{
  return this->Implementation->Environment;
}

vtkFieldData* vtkPenumbraRayCaster::GetStatistics()
{
  return this->Implementation->Statistics;
}

double vtkPenumbraRayCaster::GetEstimatedError()
{
  return this->Implementation->EstimatedError;
}

double vtkPenumbraRayCaster::GetEstimatedLightError()
{
  return this->Implementation->EstimatedLightError;
}

double vtkPenumbraRayCaster::GetPhaseSeconds(int phase)
{
  return phase < EXTRACTION || phase > TRACING ? 0.0 : this->Implementation->PhaseSeconds[phase];
}

vtkMTimeType vtkPenumbraRayCaster::GetMTime()
{
  const vtkMTimeType scene = this->Implementation->ComputeSceneTime(this);
  return std::max(this->Superclass::GetMTime(), scene);
}

int vtkPenumbraRayCaster::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

void vtkPenumbraRayCaster::SetDistribution(penumbra::SceneDistribution* distribution)
{
  this->Implementation->Distribution = distribution;
}

int vtkPenumbraRayCaster::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  const int extent[6] = { 0, this->Resolution[0] - 1, 0, this->Resolution[1] - 1, 0, 0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 4);
  return 1;
}

int vtkPenumbraRayCaster::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // Any part of the image needs the whole scene.
  for (int i = 0; i < inputs[0]->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* info = inputs[0]->GetInformationObject(i);
    if (info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
    {
      int extent[6];
      info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
    }
  }
  return 1;
}

int vtkPenumbraRayCaster::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkImageData* image = vtkImageData::GetData(info);
  int extent[6];
  info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
  image->SetExtent(extent);
  std::vector<vtkDataObject*> data;
  for (int i = 0; i < inputs[0]->GetNumberOfInformationObjects(); ++i)
  {
    data.push_back(vtkDataObject::GetData(inputs[0], i));
  }
  Internals& internals = *this->Implementation;
  return internals.Run(this, image, [&]() {
    if (internals.Distribution)
    {
      internals.Distribution->GetRanks().Compare(Internals::ListSettings(this));
    }
    internals.Prepare(this, data);
    const bool finished = internals.Execute(this, image);
    const int* whole = info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
    const bool isWhole = std::equal(extent, extent + 6, whole) || internals.Distribution;
    if (finished && isWhole && !internals.KeepsScene(this))
    {
      internals.DropScene();
    }
    return finished;
  });
}

bool vtkPenumbraRayCaster::RenderFor(double seconds, vtkImageData* image)
{
  if (!image || !this->Implementation->Renderer || !(seconds > 0.0))
  {
    vtkErrorMacro("RenderFor() needs an image, a renderer, and a positive number of seconds.");
    return false;
  }
  Internals& internals = *this->Implementation;
  if (this->AbortExecute)
  {
    this->SetAbortExecute(0);
  }
  internals.CallSeconds = seconds;
  bool isComplete = false;
  image->Initialize();
  internals.Run(this, image, [&]() {
    isComplete = internals.Continue(this, image);
    return true;
  });
  return isComplete;
}

const char* vtkPenumbraRayCaster::GetAmbientOcclusionFalloffAsString()
{
  static const char* const names[] = { "None", "Linear", "Quadratic", "SquareRoot" };
  return names[this->AmbientOcclusionFalloff];
}

void vtkPenumbraRayCaster::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Renderer: " << this->Implementation->Renderer.Get() << "\n";
  os << indent << "IrradianceProvider: " << this->Implementation->IrradianceProvider.Get() << "\n";
  os << indent << "Resolution: " << this->Resolution[0] << " " << this->Resolution[1] << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "LightTolerance: " << this->LightTolerance << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "Shadows: " << this->GetShadows() << "\n";
  os << indent << "LightRadius: " << this->LightRadius << "\n";
  os << indent << "LightAngle: " << this->LightAngle << "\n";
  os << indent << "SizedLights: " << this->Implementation->SizedLights.GetCount() << "\n";
  os << indent << "Environment: " << this->Implementation->Environment.Get() << "\n";
  os << indent << "Medium: " << this->Implementation->Medium.Get() << "\n";
  os << indent << "AmbientOcclusion: " << this->GetAmbientOcclusion() << "\n";
  os << indent << "AmbientOcclusionRadius: " << this->AmbientOcclusionRadius << "\n";
  os << indent << "AmbientOcclusionFalloff: " << this->GetAmbientOcclusionFalloffAsString() << "\n";
  os << indent << "AmbientOcclusionStrength: " << this->AmbientOcclusionStrength << "\n";
  os << indent << "IndirectLight: " << this->IndirectLight << "\n";
  os << indent << "EnvironmentColor: " << this->EnvironmentColor[0] << " "
     << this->EnvironmentColor[1] << " " << this->EnvironmentColor[2] << "\n";
  os << indent << "Albedo: " << this->Albedo << "\n";
  os << indent << "Bounces: " << this->Bounces << "\n";
  os << indent << "GeometryArrays: " << this->GeometryArrays << "\n";
  os << indent << "Background: " << this->Background << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "PointRadius: " << this->PointRadius << "\n";
  os << indent << "LineRadius: " << this->LineRadius << "\n";
  os << indent << "DPI: " << this->DPI << "\n";
  os << indent << "Layers: " << this->Layers << "\n";
  os << indent << "KeepScene: " << this->KeepScene << "\n";
  os << indent << "EstimatedError: " << this->Implementation->EstimatedError << "\n";
  os << indent << "EstimatedLightError: " << this->Implementation->EstimatedLightError << "\n";
}
