// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks of the settings and errors of vtkPenumbraRayCaster, and the modification time of its scene.
#include "RayCasterExecution.h"

#include "Execution/NaNCheck.h"
#include "Image/LayerCompositing.h"
#include "Import/CoincidentTopology.h"
#include "Import/SceneModificationTime.h"

#include "vtkImageData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace
{

void RequireTimeLimit(double seconds)
{
  if (!(seconds >= 0.0))
  {
    throw std::runtime_error("TimeLimit must be a number of seconds of 0 or more; 0 is no limit.");
  }
}

void RequireResolution(const int* resolution, int maximum)
{
  if (std::min(resolution[0], resolution[1]) < 1 ||
    std::max(resolution[0], resolution[1]) > maximum)
  {
    const std::string limit = std::to_string(maximum);
    throw std::runtime_error("Resolution must be 1 x 1 to " + limit + " x " + limit + ".");
  }
}

}

bool vtkPenumbraRayCaster::Internals::Run(
  vtkPenumbraRayCaster* self, vtkImageData* image, const std::function<bool()>& work)
{
  std::string error;
  bool finished = false;
  bool isKnown = false; // to all ranks
  try
  {
    RequireResolution(self->Resolution, MaximumResolution);
    this->ResetResults();
    penumbra::RequireNotNaN("Tolerance, LightTolerance, PointRadius, LineRadius, "
                            "AmbientOcclusionRadius, AmbientOcclusionStrength, Albedo "
                            "and EnvironmentColor",
      { self->Tolerance, self->LightTolerance, self->PointRadius, self->LineRadius,
        self->AmbientOcclusionRadius, self->AmbientOcclusionStrength, self->Albedo,
        self->EnvironmentColor[0], self->EnvironmentColor[1], self->EnvironmentColor[2] });
    RequireTimeLimit(self->TimeLimit);
    penumbra::RequireLightSize(self->LightRadius, self->LightAngle);
    this->SizedLights.Require();
    std::exception_ptr thrown;
    vtkSMPTools::LocalScope(vtkSMPTools::Config(self->NumberOfThreads), [&]() {
      // LocalScope() does not restore the number of threads after an exception.
      try
      {
        finished = work();
      }
      catch (...)
      {
        thrown = std::current_exception();
      }
    });
    if (thrown)
    {
      std::rethrow_exception(thrown);
    }
  }
  catch (const penumbra::Stopped&)
  {
    finished = false;
  }
  catch (const penumbra::RankFailure& failure)
  {
    error = failure.what();
    isKnown = true;
  }
  catch (const std::bad_alloc&)
  {
    error = "Out of memory. Reduce Resolution or simplify the scene.";
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
  }
  if (!finished || !error.empty())
  {
    if (this->Distribution && !isKnown)
    {
      error =
        this->Distribution->GetRanks().Fail(error.empty() ? "The execution was aborted." : error);
    }
    image->Initialize();
    this->DropScene();
  }
  if (!error.empty())
  {
    vtkErrorWithObjectMacro(self, << error);
  }
  return error.empty();
}

vtkMTimeType vtkPenumbraRayCaster::Internals::ComputeSceneTime(vtkPenumbraRayCaster* self)
{
  // A texture of the scene may depend on this image.
  if (this->IsComputingMTime)
  {
    return 0;
  }
  vtkMTimeType time = this->IrradianceProvider->GetMTime();
  if (this->Renderer)
  {
    this->IsComputingMTime = true;
    time = std::max(time, penumbra::GetSceneMTime(this->Renderer));
    if (self->Layers)
    {
      for (const auto& find : { penumbra::FindLayersAbove, penumbra::FindLayersBelow })
      {
        for (vtkRenderer* layer : find(this->Renderer))
        {
          time = std::max(time, penumbra::GetSceneMTime(layer));
        }
      }
    }
    this->IsComputingMTime = false;
    std::vector<double> offsets = penumbra::GetDepthOffsetSettings(this->Renderer);
    if (offsets != this->DepthOffsets)
    {
      this->DepthOffsets = std::move(offsets);
      self->Modified();
    }
  }
  if (this->Medium)
  {
    time = std::max(time, this->Medium->GetMTime());
  }
  if (this->Environment)
  {
    time = std::max(time, this->Environment->GetMTime());
  }
  return time;
}
