// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RayCasterExecution.h"

#include "Features/SceneFeatures.h"
#include "Image/LayerCompositing.h"
#include "Import/SceneExtraction.h"
#include "Import/SceneModificationTime.h"
#include "LightWarnings.h"
#include "PassEffects.h"
#include "PhaseTimer.h"
#include "Sampling/OpaqueDepths.h"
#include "Scene.h"
#include "SceneBounds.h"
#include "Surface.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkRenderPass.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <vector>

namespace
{

void RequireScene(bool exists)
{
  if (!exists)
  {
    throw std::runtime_error(
      "No renderer: call SetRenderer(), or connect data sets to the input port.");
  }
}

void RequireUsable(const penumbra::Scene& scene)
{
  if (!scene.ViewCamera.IsUsable())
  {
    throw std::runtime_error(
      "The camera is not usable: position, focal point, view up, view angle and "
      "parallel scale must be finite.");
  }
}

/// Returns the effects of the pass of a renderer that rays do not compute.
penumbra::EffectList FindMissingEffects(vtkRenderPass* pass, bool occlusion, bool shafts)
{
  penumbra::EffectList missing;
  if (pass && !pass->IsA("vtkPenumbraRayCastPass"))
  {
    auto* passes = dynamic_cast<penumbra::PassEffects*>(pass);
    missing = passes ? passes->GetEffects() : penumbra::FindEffectsOfClass(pass);
    missing.AmbientOcclusion &= !occlusion;
    missing.LightShafts &= !shafts;
  }
  return missing;
}

/// Returns the warning of missing ambient occlusion, light shafts, or both.
std::string DescribeMissingEffects(const penumbra::EffectList& missing)
{
  const std::string text = "The render pass of the renderer is ignored: ";
  if (missing.AmbientOcclusion && missing.LightShafts)
  {
    return text +
      "ambient occlusion and light shafts of its pass are not in the image. Call "
      "SetAmbientOcclusion(true) and SetMedium().";
  }
  return text +
    (missing.AmbientOcclusion
        ? "ambient occlusion of its pass is not in the image. Call SetAmbientOcclusion(true)."
        : "light shafts of its pass are not in the image. Call SetMedium().");
}

}

bool vtkPenumbraRayCaster::Internals::ReportProgress(vtkPenumbraRayCaster* self, double fraction)
{
  if (!self->GetAbortExecute())
  {
    self->UpdateProgress(fraction);
  }
  return self->GetAbortExecute() != 0;
}

vtkPenumbraRayCaster::Internals::OcclusionSettings vtkPenumbraRayCaster::Internals::FindOcclusion(
  vtkPenumbraRayCaster* self) const
{
  OcclusionSettings settings{ self->GetAmbientOcclusion(), self->AmbientOcclusionRadius,
    self->AmbientOcclusionStrength, false };
  settings.OfRenderer = settings.On && !this->AmbientOcclusion.has_value();
  if (settings.OfRenderer)
  {
    // VTK's pass ignores how surfaces are colored.
    settings.Strength = settings.Strength < 0.0 ? 1.0 : settings.Strength;
    settings.Radius = settings.Radius > 0.0 ? settings.Radius : this->Renderer->GetSSAORadius();
  }
  return settings;
}

vtkPenumbraRayCaster::Internals::Internals() = default;
vtkPenumbraRayCaster::Internals::~Internals() = default;

void vtkPenumbraRayCaster::Internals::ResetResults()
{
  this->Statistics->Initialize();
  this->TotalRays.reset();
  this->EstimatedError = std::nan("");
  this->EstimatedLightError = std::nan("");
  this->PhaseSeconds.fill(0.0);
  this->Extractions = 0;
  this->ChangedSurfaces = 0;
  this->Start = std::chrono::steady_clock::now();
}

void vtkPenumbraRayCaster::Internals::ModifyButKeepScene(vtkPenumbraRayCaster* self)
{
  const bool isPrepared = this->SettingsTime == self->vtkAlgorithm::GetMTime();
  self->Modified();
  if (isPrepared)
  {
    this->SettingsTime = self->vtkAlgorithm::GetMTime();
  }
}

void vtkPenumbraRayCaster::Internals::Prepare(
  vtkPenumbraRayCaster* self, const std::vector<vtkDataObject*>& data)
{
  const auto computeTime = [&]() {
    vtkMTimeType time = self->GetMTime();
    for (vtkDataObject* object : data)
    {
      time = std::max(time, object->GetMTime());
    }
    return time;
  };
  if (!this->Distribution && this->Prepared && computeTime() <= this->PreparedTime)
  {
    return;
  }
  this->Growing.reset();
  RequireScene(this->Renderer || !data.empty() || this->Distribution); // a rank may have no data
  const penumbra::ExtractionOptions options = this->MakeExtractionOptions(self);
  if (this->UpdatePrepared(self, options))
  {
    this->PreparedTime = computeTime();
    return;
  }
  this->Prepared.reset(); // frees the memory before the next scene is built
  auto prepared = std::make_unique<PreparedScene>();
  penumbra::Scene& scene = prepared->SceneData;
  penumbra::PhaseTimer timer(this->PhaseSeconds);
  scene = this->Renderer ? penumbra::ExtractScene(this->Renderer, options,
                             this->KeepsScene(self) ? &prepared->Record : nullptr)
                         : penumbra::ExtractScene(data, options);
  timer.End(EXTRACTION);
  ++this->Extractions;
  RequireUsable(scene);
  if (this->ChangeScene)
  {
    this->ChangeScene(scene);
  }
  this->WarnOfScene(self, scene);
  if (this->Distribution)
  {
    this->ExchangeScene(self, scene);
  }
  const bool isDynamic = prepared->Record.Props.size() > 1;
  prepared->Rays =
    std::make_unique<penumbra::RayScene>(scene, self->NumberOfThreads, options.Progress, isDynamic);
  timer.End(BUILD);
  prepared->Edges = penumbra::FindSceneEdges(
    scene, penumbra::MakeRenderSettings(this->MakeJobSettings(self)), options.Progress);
  timer.End(EDGES);
  this->Prepared = std::move(prepared);
  this->PreparedTime = computeTime(); // extraction may have updated the mappers
  this->PreparedRenderer = this->Renderer;
  this->SettingsTime = self->vtkAlgorithm::GetMTime();
}

void vtkPenumbraRayCaster::Internals::DropScene()
{
  this->Growing.reset();
  this->Prepared.reset();
}

bool vtkPenumbraRayCaster::Internals::KeepsScene(vtkPenumbraRayCaster* self) const
{
  return self->KeepScene && this->Renderer && !this->ChangeScene && !this->Distribution;
}

bool vtkPenumbraRayCaster::Internals::UpdatePrepared(
  vtkPenumbraRayCaster* self, const penumbra::ExtractionOptions& options)
{
  penumbra::PhaseTimer timer(this->PhaseSeconds);
  if (!this->Prepared || !this->KeepsScene(self) ||
    this->PreparedRenderer.Get() != this->Renderer.Get() ||
    self->vtkAlgorithm::GetMTime() != this->SettingsTime)
  {
    return false;
  }
  PreparedScene& prepared = *this->Prepared;
  const auto updateRays = [&](const std::vector<penumbra::SurfaceChange>& changes) {
    timer.End(EXTRACTION);
    prepared.Rays->Update(changes, options.Progress);
    timer.End(BUILD);
    std::vector<penumbra::SurfaceChange>& all = prepared.ChangesSinceEdges;
    all.insert(all.end(), changes.begin(), changes.end());
    this->ChangedSurfaces = static_cast<int>(changes.size());
  };
  if (!penumbra::UpdateScene(
        this->Renderer, options, prepared.Record, prepared.SceneData, updateRays))
  {
    return false;
  }
  RequireUsable(prepared.SceneData);
  this->WarnOfScene(self, prepared.SceneData);
  timer.End(EXTRACTION);
  prepared.AreEdgesCurrent = false;
  return true;
}

void vtkPenumbraRayCaster::Internals::UpdateEdges(
  vtkPenumbraRayCaster* self, const penumbra::ProgressCallback& progress)
{
  PreparedScene& prepared = *this->Prepared;
  if (!prepared.AreEdgesCurrent)
  {
    penumbra::PhaseTimer timer(this->PhaseSeconds);
    penumbra::UpdateSceneEdges(prepared.SceneData,
      penumbra::MakeRenderSettings(this->MakeJobSettings(self)), prepared.ChangesSinceEdges,
      progress, prepared.Edges);
    timer.End(EDGES);
    prepared.AreEdgesCurrent = true;
    prepared.ChangesSinceEdges.clear();
  }
}

penumbra::ExtractionOptions vtkPenumbraRayCaster::Internals::MakeExtractionOptions(
  vtkPenumbraRayCaster* self)
{
  penumbra::ExtractionOptions options;
  options.Resolution[0] = self->Resolution[0];
  options.Resolution[1] = self->Resolution[1];
  options.DPI = self->DPI;
  options.Background =
    self->Background && !(self->Layers && !penumbra::FindLayersBelow(this->Renderer).empty());
  // What the camera clips still blocks light.
  options.ClipToRange =
    !self->GetShadows() && !self->GetAmbientOcclusion() && !self->IndirectLight && !this->Medium;
  options.KeepOrigin = this->KeepsScene(self);
  options.PointRadius = self->PointRadius;
  options.LineRadius = self->LineRadius;
  options.GetLightSize = [self](vtkLight* light) {
    return penumbra::LightSize{ self->GetLightRadius(light), self->GetLightAngle(light) };
  };
  options.Progress = [self](double) { return ReportProgress(self, 0.0); };
  if (this->Distribution)
  {
    options.UniteExtent = [this](double bounds[6], double& radius) {
      this->Distribution->UniteExtent(bounds, radius);
    };
  }
  options.FindDepths = [this, self](const auto& scene, const std::vector<glm::dvec2>& points) {
    return this->Prepared && &scene == &this->Prepared->SceneData
      ? penumbra::FindOpaqueDepths(*this->Prepared->Rays, points)
      : penumbra::FindOpaqueDepths(penumbra::RayScene(scene, self->NumberOfThreads), points);
  };
  return options;
}

void vtkPenumbraRayCaster::Internals::WarnOfScene(
  vtkPenumbraRayCaster* self, penumbra::Scene& scene)
{
  if (this->FindOcclusion(self).OfRenderer)
  {
    penumbra::WarnFeature(penumbra::Feature::RendererOcclusion, "", scene.Warnings);
  }
  const penumbra::EffectList missing =
    FindMissingEffects(this->Renderer ? this->Renderer->GetPass() : nullptr,
      self->GetAmbientOcclusion(), this->Medium != nullptr);
  if (missing.Other)
  {
    penumbra::WarnFeature(penumbra::Feature::RenderPass, "", scene.Warnings);
  }
  else if (missing.AmbientOcclusion || missing.LightShafts)
  {
    scene.Warnings.push_back(DescribeMissingEffects(missing));
  }
  if (self->GetShadows())
  {
    const std::vector<std::string> overlaps = penumbra::DescribeLightOverlaps(scene);
    scene.Warnings.insert(scene.Warnings.end(), overlaps.begin(), overlaps.end());
  }
  for (const std::string& warning : scene.Warnings)
  {
    this->WarnOnce(self, warning);
  }
}

void vtkPenumbraRayCaster::Internals::WarnOnce(
  vtkPenumbraRayCaster* self, const std::string& warning)
{
  if (!warning.empty() && this->Warned.insert(warning).second)
  {
    vtkWarningWithObjectMacro(self, << warning);
  }
}

penumbra::JobSettings vtkPenumbraRayCaster::Internals::MakeJobSettings(
  vtkPenumbraRayCaster* self) const
{
  const OcclusionSettings occlusion = this->FindOcclusion(self);
  const double* color = self->EnvironmentColor;
  penumbra::JobSettings settings;
  settings.Constants = this->Constants;
  settings.Tolerance = self->Tolerance;
  settings.LightTolerance = self->GetEffectiveLightTolerance();
  settings.Shadows = self->GetShadows();
  settings.HasOcclusion = occlusion.On;
  settings.HasOcclusionArray = self->GeometryArrays && this->Constants.OcclusionArray;
  settings.OcclusionRadius = occlusion.Radius;
  settings.OcclusionStrength = occlusion.Strength;
  settings.OcclusionFalloff = self->AmbientOcclusionFalloff;
  settings.HasIndirectLight = self->IndirectLight && self->Albedo > 0.0;
  settings.Light.Environment = glm::max(glm::dvec3(color[0], color[1], color[2]), glm::dvec3(0.0));
  settings.Light.Map = this->Environment ? this->Environment->GetMap() : nullptr;
  settings.Light.Albedo = static_cast<float>(self->Albedo);
  settings.Light.Bounces = self->Bounces;
  settings.Light.Shadows = settings.Shadows;
  settings.HasGeometryArrays = self->GeometryArrays;
  settings.Provider = this->IrradianceProvider;
  settings.Medium = this->Medium;
  if (this->Distribution)
  {
    settings.Ranks = &this->Distribution->GetRanks();
    settings.RendersPixel = [this](glm::ivec2 pixel) {
      const std::vector<penumbra::RegionBounds>& regions = this->Distribution->GetRegions();
      return std::any_of(
        regions.begin(), regions.end(), [pixel](const penumbra::RegionBounds& region) {
          return glm::all(glm::greaterThanEqual(pixel, region.Low)) &&
            glm::all(glm::lessThan(pixel, region.High));
        });
    };
  }
  return settings;
}

double vtkPenumbraRayCaster::Internals::ComputeElapsedSeconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
}

std::unique_ptr<penumbra::WorkLimit> vtkPenumbraRayCaster::Internals::MakeLimit(
  vtkPenumbraRayCaster* self) const
{
  if (self->TimeLimit == 0.0)
  {
    return nullptr;
  }
  const double begin = this->ComputeElapsedSeconds();
  const double rest = std::max(self->TimeLimit - begin, 0.0);
  return std::make_unique<penumbra::WorkLimit>([this, begin, rest](double fraction) {
    return this->ComputeElapsedSeconds() >= begin + fraction * rest;
  });
}
