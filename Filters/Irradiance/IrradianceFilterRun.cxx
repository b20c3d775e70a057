// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks and descriptions of the settings, errors and warnings of vtkPenumbraIrradianceFilter.
#include "vtkPenumbraIrradianceFilter.h"

#include "Distribution/OccluderDistribution.h"
#include "Execution/NaNCheck.h"
#include "Execution/ParallelFor.h"

#include "vtkFieldData.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraGatherer.h"
#include "vtkSMPTools.h"

#include <cmath>
#include <exception>
#include <new>
#include <string>
#include <vector>

using namespace penumbra;

int vtkPenumbraIrradianceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Statistics->Initialize();
  this->EstimatedError = std::nan("");
  std::string error;
  bool isStopped = false;
  bool isKnown = false; // to all ranks
  try
  {
    RequireNotNaN("Tolerance, Radius, PointRadius, LineRadius, Albedo and EnvironmentColor",
      { this->Tolerance, this->Radius, this->PointRadius, this->LineRadius, this->Albedo,
        this->EnvironmentColor[0], this->EnvironmentColor[1], this->EnvironmentColor[2] });
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config(this->NumberOfThreads), [&]() { this->Execute(inputs, outputs); });
  }
  catch (const Stopped&)
  {
    this->Statistics->Initialize();
    isStopped = true;
  }
  catch (const RankFailure& failure)
  {
    error = failure.what();
    isKnown = true;
  }
  catch (const std::bad_alloc&)
  {
    error = "Out of memory while baking. Use a smaller mesh.";
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
  }
  if (this->Distribution && !isKnown && (isStopped || !error.empty()))
  {
    error = this->Distribution->GetRanks().Fail(isStopped ? "The execution was aborted." : error);
  }
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
  return error.empty();
}

SettingList vtkPenumbraIrradianceFilter::ListSettings()
{
  SettingList settings = {
    { "Quantity", this->GetQuantityAsString() },
    { "Tolerance", DescribeNumbers(this->Tolerance) },
    { "Radius", DescribeNumbers(this->Radius) },
    { "Falloff", this->GetFalloffAsString() },
    { "EnvironmentColor",
      DescribeNumbers(
        this->EnvironmentColor[0], this->EnvironmentColor[1], this->EnvironmentColor[2]) },
    { "Environment", this->Environment ? "set" : "none" },
    { "Albedo", DescribeNumbers(this->Albedo) },
    { "Bounces", DescribeNumbers(this->Bounces) },
    { "LightRadius", DescribeNumbers(this->LightRadius) },
    { "LightAngle", DescribeNumbers(this->LightAngle) },
    { "the number of lights", DescribeNumbers(this->Lights.size()) },
    { "OnCells", DescribeNumbers(this->OnCells) },
    { "ComputeNormals", DescribeNumbers(this->ComputeNormals) },
    { "PointRadius", DescribeNumbers(this->PointRadius) },
    { "LineRadius", DescribeNumbers(this->LineRadius) },
    { "OpacityArray", this->OpacityArray ? this->OpacityArray : "" },
    { "Method", this->GetMethodAsString() },
  };
  for (const std::array<double, 4>& light : this->Lights)
  {
    settings.emplace_back("a light", DescribeNumbers(light[0], light[1], light[2], light[3]));
  }
  return settings;
}

void vtkPenumbraIrradianceFilter::Warn(const std::vector<std::string>& sentences)
{
  for (const std::string& sentence : sentences)
  {
    if (!sentence.empty())
    {
      vtkWarningMacro(<< sentence);
    }
  }
}

const char* vtkPenumbraIrradianceFilter::GetQuantityAsString()
{
  static const char* const names[] = { "AmbientOcclusion", "Irradiance", "DirectLight" };
  return names[this->Quantity];
}

const char* vtkPenumbraIrradianceFilter::GetFalloffAsString()
{
  static const char* const names[] = { "None", "Linear", "Quadratic", "SquareRoot" };
  return names[this->Falloff];
}

const char* vtkPenumbraIrradianceFilter::GetMethodAsString()
{
  static const char* const names[] = { "Automatic", "BruteForce" };
  return names[this->Method];
}

void vtkPenumbraIrradianceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Quantity: " << this->GetQuantityAsString() << "\n";
  os << indent << "Lights: " << this->Lights.size() << "\n";
  os << indent << "LightRadius: " << this->LightRadius << "\n";
  os << indent << "LightAngle: " << this->LightAngle << "\n";
  os << indent << "EnvironmentColor: " << this->EnvironmentColor[0] << " "
     << this->EnvironmentColor[1] << " " << this->EnvironmentColor[2] << "\n";
  os << indent << "Albedo: " << this->Albedo << "\n";
  os << indent << "Bounces: " << this->Bounces << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Falloff: " << this->GetFalloffAsString() << "\n";
  os << indent << "OnCells: " << this->OnCells << "\n";
  os << indent << "ComputeNormals: " << this->ComputeNormals << "\n";
  os << indent << "OpacityArray: " << (this->OpacityArray ? this->OpacityArray : "(none)") << "\n";
  os << indent << "PointRadius: " << this->PointRadius << "\n";
  os << indent << "LineRadius: " << this->LineRadius << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "Gatherer: " << this->Gatherer.Get() << "\n";
  os << indent << "Method: " << this->GetMethodAsString() << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "EstimatedError: " << this->EstimatedError << "\n";
}
