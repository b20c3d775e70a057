// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The execution of vtkPenumbraRayCaster together with other ranks.
#include "RayCasterExecution.h"

#include "Distribution/SceneDistribution.h"
#include "Statistics/Statistics.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <algorithm>
#include <string>

namespace
{

template <typename... Values>
std::string Describe(const Values&... values)
{
  return penumbra::DescribeNumbers(values...);
}

std::string Describe(const glm::dvec3& v)
{
  return Describe(v.x, v.y, v.z);
}

void AddCamera(const penumbra::Scene& scene, penumbra::SettingList& settings)
{
  const penumbra::Camera& camera = scene.ViewCamera;
  settings.emplace_back("the projection of the camera", Describe(camera.Parallel));
  settings.emplace_back("the position of the camera",
    Describe(scene.ToWorld(camera.Position)) + Describe(scene.Scale, camera.Advance));
  settings.emplace_back("the direction of the camera",
    Describe(camera.Forward) + Describe(camera.Right) + Describe(camera.Up));
  settings.emplace_back("the view angle or parallel scale of the camera",
    Describe(camera.PixelSize, camera.Center.x, camera.Center.y));
  settings.emplace_back("the clipping range of the camera", Describe(camera.Near, camera.Far));
}

void AddLights(const std::vector<penumbra::Light>& lights, penumbra::SettingList& settings)
{
  settings.emplace_back("the number of lights", Describe(lights.size()));
  for (const penumbra::Light& light : lights)
  {
    settings.emplace_back("a light",
      Describe(static_cast<int>(light.Kind), light.CastsShadow, light.MovesWithCamera,
        light.ConeCosine, light.Exponent, light.Radius, light.AngularRadius) +
        Describe(glm::dvec3(light.Position)) + Describe(glm::dvec3(light.Direction)) +
        Describe(glm::dvec3(light.DiffuseColor)) + Describe(glm::dvec3(light.SpecularColor)));
  }
}

}

penumbra::SettingList vtkPenumbraRayCaster::Internals::ListSettings(vtkPenumbraRayCaster* self)
{
  const Internals& internals = *self->Implementation;
  const penumbra::RayCasterConstants& constants = internals.Constants;
  return {
    { "the renderer", internals.Renderer ? "set" : "none" },
    { "the number of inputs", Describe(self->GetNumberOfInputConnections(0)) },
    { "Resolution", Describe(self->Resolution[0], self->Resolution[1]) },
    { "Tolerance", Describe(self->Tolerance) },
    { "LightTolerance", Describe(self->LightTolerance) },
    { "CoverageMethod", Describe(static_cast<int>(constants.CoverageMethod)) },
    { "UniformSamples", Describe(constants.UniformSamples) },
    { "MaximumLevel", Describe(constants.MaximumLevel) },
    { "FindSmallObjects", Describe(constants.FindSmallObjects) },
    { "Shadows", Describe(self->GetShadows()) },
    { "LightRadius", Describe(self->LightRadius) },
    { "LightAngle", Describe(self->LightAngle) },
    { "LightShaftSteps", Describe(constants.LightShaftSteps) },
    { "CameraLightShafts", Describe(constants.CameraLightShafts) },
    { "Medium", internals.Medium ? "set" : "none" },
    { "Environment", internals.Environment ? "set" : "none" },
    { "AmbientOcclusion", Describe(self->GetAmbientOcclusion()) },
    { "AmbientOcclusionRadius", Describe(self->AmbientOcclusionRadius) },
    { "AmbientOcclusionFalloff", Describe(self->AmbientOcclusionFalloff) },
    { "AmbientOcclusionStrength", Describe(self->AmbientOcclusionStrength) },
    { "IndirectLight", Describe(self->IndirectLight) },
    { "EnvironmentColor",
      Describe(self->EnvironmentColor[0], self->EnvironmentColor[1], self->EnvironmentColor[2]) },
    { "Albedo", Describe(self->Albedo) },
    { "Bounces", Describe(self->Bounces) },
    { "GeometryArrays", Describe(self->GeometryArrays) },
    { "OcclusionArray", Describe(constants.OcclusionArray) },
    { "Background", Describe(self->Background) },
    { "DPI", Describe(self->DPI) },
    { "PointRadius", Describe(self->PointRadius) },
    { "LineRadius", Describe(self->LineRadius) },
  };
}

void vtkPenumbraRayCaster::Internals::ExchangeScene(
  vtkPenumbraRayCaster* self, penumbra::Scene& scene)
{
  penumbra::SettingList view;
  AddCamera(scene, view);
  AddLights(scene.Lights, view);
  this->Distribution->GetRanks().Compare(view);
  this->DistributedOverlay = std::move(scene.OverlayImage);
  const bool hasPenumbrae = self->GetShadows() &&
    std::any_of(scene.Lights.begin(), scene.Lights.end(),
      [](const penumbra::Light& light) { return light.CastsPenumbra(); });
  const bool needsAll = hasPenumbrae || self->GetAmbientOcclusion() || self->IndirectLight ||
    this->Medium || (self->GeometryArrays && this->Constants.OcclusionArray);
  using LightRays = penumbra::SceneDistribution::LightRays;
  this->Distribution->Exchange(scene,
    needsAll               ? LightRays::All
      : self->GetShadows() ? LightRays::ToLights
                           : LightRays::None);
}

bool vtkPenumbraRayCaster::Internals::RenderRegions(vtkPenumbraRayCaster* self,
  penumbra::RenderJob& job, std::vector<vtkSmartPointer<vtkImageData>>& parts,
  penumbra::ImageTotals& totals)
{
  for (const penumbra::RegionBounds& region : this->Distribution->GetRegions())
  {
    auto part = vtkSmartPointer<vtkImageData>::New();
    part->SetExtent(region.Low.x, region.High.x - 1, region.Low.y, region.High.y - 1, 0, 0);
    if (!penumbra::RenderImage(job.GetTracer(), this->Prepared->Edges, job.GetRenderSettings(),
          this->MakeProgress(self, job), part, totals) ||
      !this->FinishPixels(self, job, totals, part))
    {
      return false;
    }
    parts.push_back(part);
  }
  return true;
}

bool vtkPenumbraRayCaster::Internals::ExecuteDistributed(
  vtkPenumbraRayCaster* self, vtkImageData* image)
{
  int extent[6];
  image->GetExtent(extent);
  penumbra::PhaseTimer timer(this->PhaseSeconds);
  const std::unique_ptr<penumbra::RenderJob> job = this->BeginJob(self);
  if (!job)
  {
    return false;
  }
  job->SetLimit(this->MakeLimit(self), true);
  std::vector<vtkSmartPointer<vtkImageData>> parts;
  penumbra::ImageTotals totals;
  if (!this->RenderRegions(self, *job, parts, totals))
  {
    return false;
  }
  if (this->Distribution->GetRanks().IsFirst())
  {
    image->SetExtent(0, self->Resolution[0] - 1, 0, self->Resolution[1] - 1, 0, 0);
  }
  this->Distribution->Compose(parts, image, totals);
  if (this->Distribution->GetRanks().IsFirst())
  {
    if (this->DistributedOverlay)
    {
      penumbra::CompositeOverlay(*this->DistributedOverlay, image);
    }
    penumbra::SumErrors(image, totals);
    this->FinishImage(self, *job, totals, image);
  }
  this->Distribution->Deliver(extent, image);
  vtkFieldData* fields = image->GetFieldData();
  this->EstimatedError = fields->GetArray("EstimatedError")->GetComponent(0, 0);
  this->EstimatedLightError = fields->GetArray("EstimatedLightError")->GetComponent(0, 0);
  this->Statistics->ShallowCopy(fields);
  for (const char* name :
    { "Tolerance", "LightTolerance", "EstimatedError", "EstimatedLightError" })
  {
    this->Statistics->RemoveArray(name);
  }
  timer.End(TRACING);
  return true;
}
