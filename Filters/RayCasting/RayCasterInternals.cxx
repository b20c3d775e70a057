// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RayCasterInternals.h"

#include "Conventions/Statistics.h"
#include "Features/SceneFeatures.h"
#include "Image/GeometryArrays.h"
#include "Image/LayerCompositing.h"
#include "Import/SceneExtraction.h"
#include "Import/SceneModificationTime.h"
#include "Light/OcclusionRays.h"
#include "Media/MediumExtraction.h"
#include "PhaseTimer.h"
#include "Sampling/OpaqueDepths.h"
#include "Scene.h"
#include "SceneBounds.h"
#include "Shading/Illumination.h"
#include "Shading/LightWarnings.h"
#include "Surface.h"
#include "ToleranceWarning.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

namespace
{

// Tolerance of the light of one sample, in light tolerances of the image. The color of a pixel is the
// mean of about four samples, which halves their error.
constexpr double SampleToleranceFactor = 2.0;
// Progress reported when the scene has been built. It stays 0 until then.
constexpr double SceneProgress = 1e-6;
// Fraction of the progress for the preparation of the irradiance provider.
constexpr double ProviderProgress = 0.25;
// Fraction of the progress for the geometry arrays.
constexpr double GeometryProgress = 0.25;

// A time limit that is reached at once, in seconds.
constexpr double LeastSeconds = 1e-9;

using penumbra::AddStatistic;

void RequireUsable(const penumbra::Scene& scene)
{
  if (!scene.ViewCamera.IsUsable())
  {
    throw std::runtime_error(
      "The camera is not usable: position, focal point, view up, view angle and "
      "parallel scale must be finite.");
  }
}

/// Reports progress unless an abort was requested. Returns true if the execution must stop.
bool ReportProgress(vtkAlgorithm* self, double fraction)
{
  if (!self->GetAbortExecute())
  {
    self->UpdateProgress(fraction);
  }
  return self->GetAbortExecute() != 0;
}

/// Adds the rays of a layer to the statistics of the image.
void AddLayerRays(vtkFieldData* layer, vtkFieldData* statistics)
{
  vtkDataArray* rays = layer->GetArray("Rays/Total");
  if (!rays)
  {
    return;
  }
  vtkDataArray* sum = statistics->GetArray("Rays/Layers");
  const double count = rays->GetComponent(0, 0);
  if (sum)
  {
    sum->SetComponent(0, 0, sum->GetComponent(0, 0) + count);
  }
  else
  {
    AddStatistic(statistics, "Rays/Layers", count);
  }
  vtkDataArray* total = statistics->GetArray("Rays/Total");
  total->SetComponent(0, 0, total->GetComponent(0, 0) + count);
}

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

void vtkPenumbraRayCaster::Internals::ResetResults()
{
  this->Statistics->Initialize();
  this->EstimatedError = std::nan("");
  this->EstimatedLightError = std::nan("");
  this->PhaseSeconds.fill(0.0);
  this->Extractions = 0;
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
  vtkPenumbraRayCaster* self, vtkInformationVector* inputs)
{
  std::vector<vtkDataObject*> data;
  for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
  {
    data.push_back(vtkDataObject::GetData(inputs, i));
  }
  const auto computeTime = [&]() {
    vtkMTimeType time = self->GetMTime();
    for (vtkDataObject* object : data)
    {
      time = std::max(time, object->GetMTime());
    }
    return time;
  };
  if (this->Prepared && computeTime() <= this->PreparedTime)
  {
    return;
  }
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
  scene = this->Renderer ? penumbra::ExtractScene(this->Renderer, options)
                         : penumbra::ExtractScene(data, options);
  timer.End(EXTRACTION);
  ++this->Extractions;
  RequireUsable(scene);
  if (this->ChangeScene)
  {
    this->ChangeScene(scene);
  }
  this->WarnOfScene(self, scene);
  prepared->Rays =
    std::make_unique<penumbra::RayScene>(scene, self->NumberOfThreads, options.Progress);
  timer.End(BUILD);
  prepared->Edges = penumbra::FindSceneEdges(scene, MakeSettings(self), options.Progress);
  timer.End(EDGES);
  this->Prepared = std::move(prepared);
  this->PreparedTime = computeTime(); // extraction may have updated the mappers
  this->PreparedRenderer = this->Renderer;
  this->SettingsTime = self->vtkAlgorithm::GetMTime();
  this->GeometryTime = this->Renderer ? penumbra::GetGeometryMTime(this->Renderer) : 0;
}

bool vtkPenumbraRayCaster::Internals::KeepsScene(vtkPenumbraRayCaster* self) const
{
  return self->KeepScene && this->Renderer && !this->ChangeScene;
}

bool vtkPenumbraRayCaster::Internals::UpdatePrepared(
  vtkPenumbraRayCaster* self, const penumbra::ExtractionOptions& options)
{
  penumbra::PhaseTimer timer(this->PhaseSeconds);
  // UpdateView() computes the visible bounds, which updates the pipelines of the mappers.
  if (!this->Prepared || !this->KeepsScene(self) ||
    this->PreparedRenderer.Get() != this->Renderer.Get() ||
    self->vtkAlgorithm::GetMTime() != this->SettingsTime ||
    penumbra::GetGeometryMTime(this->Renderer) != this->GeometryTime ||
    !penumbra::UpdateView(this->Renderer, options, this->Prepared->SceneData) ||
    penumbra::GetGeometryMTime(this->Renderer) != this->GeometryTime)
  {
    return false;
  }
  RequireUsable(this->Prepared->SceneData);
  this->Prepared->Rays->RenewId();
  this->WarnOfScene(self, this->Prepared->SceneData);
  timer.End(EXTRACTION);
  penumbra::UpdateSceneEdges(
    this->Prepared->SceneData, MakeSettings(self), options.Progress, this->Prepared->Edges);
  timer.End(EDGES);
  return true;
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

penumbra::RenderSettings vtkPenumbraRayCaster::Internals::MakeSettings(
  vtkPenumbraRayCaster* self) const
{
  penumbra::RenderSettings settings;
  settings.UsePackets = self->UsePackets;
  settings.Integration.Method =
    static_cast<penumbra::IntegrationSettings::Methods>(self->CoverageMethod);
  settings.Integration.Tolerance = self->Tolerance;
  settings.Integration.MaximumLevel = self->MaximumLevel;
  settings.Integration.FindSmallObjects = self->FindSmallObjects;
  settings.Integration.Shadows = self->GetShadows();
  settings.Integration.UniformSamples = self->UniformSamples;
  if ((self->GetAmbientOcclusion() || self->IndirectLight) && !this->JoinsPixels(self))
  {
    settings.Integration.LightTolerance = self->GetEffectiveLightTolerance();
    settings.Integration.Noise = SampleToleranceFactor * self->GetEffectiveLightTolerance();
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

double vtkPenumbraRayCaster::Internals::FindOcclusionRadius(vtkPenumbraRayCaster* self) const
{
  const double radius = this->FindOcclusion(self).Radius;
  return radius > 0.0
    ? radius
    : penumbra::DefaultRadiusFraction * penumbra::ComputeSceneDiagonal(this->Prepared->SceneData);
}

// Occlusion does not act on indirect light and on the light of a medium.
bool vtkPenumbraRayCaster::Internals::JoinsPixels(vtkPenumbraRayCaster* self) const
{
  return this->IrradianceProvider->JoinsPixels() && self->CoverageMethod != UNIFORM &&
    this->FindOcclusion(self).On && !self->IndirectLight && !this->Medium;
}

bool vtkPenumbraRayCaster::Internals::BeginProvider(
  vtkPenumbraRayCaster* self, penumbra::CameraRayTracer& tracer)
{
  const double noise = SampleToleranceFactor * self->GetEffectiveLightTolerance();
  const OcclusionSettings settings = this->FindOcclusion(self);
  const bool occlusion = settings.On || (self->GeometryArrays && self->OcclusionArray);
  const double phaseFraction = occlusion && self->IndirectLight ? 0.5 : 1.0;
  double done = 0.0;
  const auto progress = [&](double fraction) {
    return ReportProgress(self, ProviderProgress * (done + phaseFraction * fraction));
  };
  if (occlusion)
  {
    if (!this->IrradianceProvider->Begin(*this->Prepared->Rays,
          { this->FindOcclusionRadius(self), self->AmbientOcclusionFalloff }, noise, progress))
    {
      return false;
    }
    done = phaseFraction;
  }
  if (settings.On && !this->JoinsPixels(self))
  {
    tracer.SetOcclusion(this->IrradianceProvider, settings.Strength, noise);
  }
  if (self->IndirectLight && self->Albedo > 0.0)
  {
    const double* color = self->EnvironmentColor;
    penumbra::IlluminationSettings light;
    light.Environment = glm::max(glm::dvec3(color[0], color[1], color[2]), glm::dvec3(0.0));
    light.Map = this->Environment ? this->Environment->GetMap() : nullptr;
    light.Albedo = static_cast<float>(self->Albedo);
    light.Bounces = self->Bounces;
    light.Shadows = self->GetShadows();
    const penumbra::Illumination illumination(*this->Prepared->Rays, light);
    this->WarnOnce(self,
      penumbra::DescribeMissingLight(*this->Prepared->Rays, self->GetShadows(), &illumination));
    // The image contains Albedo / pi of the irradiance.
    const double tolerance = noise * vtkMath::Pi() / self->Albedo;
    tracer.SetIndirectLight(this->IrradianceProvider, light.Albedo, tolerance);
    return this->IrradianceProvider->BeginIrradiance(illumination, tolerance, progress);
  }
  return true;
}

bool vtkPenumbraRayCaster::Internals::Execute(vtkPenumbraRayCaster* self, vtkImageData* image)
{
  const penumbra::Scene& scene = this->Prepared->SceneData;
  penumbra::PhaseTimer timer(this->PhaseSeconds);
  if (ReportProgress(self, SceneProgress))
  {
    return false;
  }
  penumbra::Shading shading(*this->Prepared->Rays, self->GetShadows());
  penumbra::CameraRayTracer tracer(*this->Prepared->Rays, shading, scene.ViewCamera);
  const double lightTolerance = self->GetEffectiveLightTolerance();
  tracer.SetPenumbraTolerance(SampleToleranceFactor * lightTolerance);
  penumbra::RenderSettings settings = MakeSettings(self);
  const bool joins = this->JoinsPixels(self);
  tracer.SetOcclusionStrength(this->FindOcclusion(self).Strength);
  const bool usesProvider = self->GetAmbientOcclusion() || self->IndirectLight ||
    (self->GeometryArrays && self->OcclusionArray);
  if (usesProvider && !this->BeginProvider(self, tracer))
  {
    return false;
  }
  if (self->GetShadows() && !self->IndirectLight)
  {
    this->WarnOnce(self, penumbra::DescribeMissingLight(*this->Prepared->Rays, true, nullptr));
  }

  std::string warning;
  const std::optional<penumbra::LightShafts> shafts =
    penumbra::MakeLightShafts(this->Medium, shading, penumbra::ComputeSceneDiagonal(scene),
      { lightTolerance, self->LightShaftSteps }, warning);
  tracer.SetShafts(shafts ? &*shafts : nullptr);
  if (shafts || shading.HasPenumbrae())
  {
    settings.Integration.LightTolerance = lightTolerance;
  }
  if (joins)
  {
    settings.Occlusion = std::make_shared<penumbra::OcclusionRays>(*this->Prepared->Rays,
      penumbra::DistanceFalloff::InScene(
        this->FindOcclusionRadius(self), self->AmbientOcclusionFalloff, scene.Scale),
      lightTolerance);
    settings.OcclusionTolerance = lightTolerance;
    settings.KeepsOcclusion = self->GeometryArrays && self->OcclusionArray;
  }
  penumbra::IntegrationSettings limits = settings.Integration;
  limits.LightTolerance = settings.HasLightErrors() ? lightTolerance : 0.0;
  this->TileTolerance = limits.GetTileTolerance();
  if (shafts && shafts->GetMedium().AttenuatesSurfaceLight)
  {
    shading.SetAttenuation(&shafts->GetMedium());
  }
  if (!warning.empty())
  {
    vtkWarningWithObjectMacro(self, << warning);
  }

  const double progressBegin = usesProvider ? ProviderProgress : 0.0;
  const double progressEnd = self->GeometryArrays ? 1.0 - GeometryProgress : 1.0;
  const auto progress = [self, progressBegin, progressEnd](double done) {
    return ReportProgress(self, progressBegin + (progressEnd - progressBegin) * done);
  };
  const std::unique_ptr<penumbra::WorkLimit> limit = this->MakeLimit(self);
  settings.Limit = limit.get();
  settings.Integration.Limit = limit.get();
  penumbra::ImageTotals totals;
  if (!penumbra::RenderImage(tracer, this->Prepared->Edges, settings, progress, image, totals))
  {
    return false;
  }
  if (this->InspectImage)
  {
    if (joins)
    {
      tracer.SetOcclusion(this->IrradianceProvider, this->FindOcclusion(self).Strength,
        SampleToleranceFactor * lightTolerance);
    }
    this->InspectImage(tracer, this->Prepared->Edges);
  }
  const bool isEnded = limit && limit->HasEndedWork();
  const penumbra::ToleranceReport tolerances =
    penumbra::CheckTolerance(limits, totals, isEnded ? self->TimeLimit : 0.0, image);
  if (!tolerances.Warning.empty())
  {
    vtkWarningWithObjectMacro(self, << tolerances.Warning);
  }
  if (self->GeometryArrays)
  {
    tracer.SetOcclusion(self->OcclusionArray && !joins ? this->IrradianceProvider.Get() : nullptr,
      self->AmbientOcclusionStrength, SampleToleranceFactor * lightTolerance);
    const auto geometry = [self, progressEnd](double done) {
      return ReportProgress(self, progressEnd + (1.0 - progressEnd) * done);
    };
    if (!penumbra::AddGeometryArrays(tracer, geometry, image, totals.Rays))
    {
      return false;
    }
  }
  this->Report(totals, image->GetNumberOfPoints());
  AddStatistic(this->Statistics, "Pixels/Unfinished", totals.Unfinished);
  AddStatistic(this->Statistics, "Tiles/AboveTolerance", tolerances.TilesAboveTolerance);
  AddStatistic(this->Statistics, "TimeLimit/Reached", isEnded ? 1 : 0);
  if (self->Layers)
  {
    this->AddLayers(self, image);
  }
  if (usesProvider)
  {
    this->IrradianceProvider->Report(this->Statistics);
    vtkDataArray* gathered = this->Statistics->GetArray("Rays/Gather");
    if (gathered)
    {
      vtkDataArray* total = this->Statistics->GetArray("Rays/Total");
      total->SetComponent(0, 0, total->GetComponent(0, 0) + gathered->GetComponent(0, 0));
    }
  }
  this->AddFieldData(self, image);
  timer.End(TRACING);
  return true;
}

void vtkPenumbraRayCaster::Internals::AddLayer(
  vtkPenumbraRayCaster* self, vtkRenderer* layer, bool isAbove, vtkImageData* image)
{
  const penumbra::LayerRectangle part =
    penumbra::FindLayerRectangle(this->Renderer, layer, self->Resolution);
  if (std::min(part.Size[0], part.Size[1]) < 1 ||
    std::max(part.Size[0], part.Size[1]) > MaximumResolution)
  {
    return;
  }
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(layer);
  caster->SetLayers(false);
  caster->SetResolution(part.Size[0], part.Size[1]);
  caster->SetTolerance(self->Tolerance);
  caster->SetLightTolerance(self->LightTolerance);
  caster->SetCoverageMethod(self->CoverageMethod);
  caster->SetUniformSamples(self->UniformSamples);
  caster->SetMaximumLevel(self->MaximumLevel);
  caster->SetFindSmallObjects(self->FindSmallObjects);
  caster->SetUsePackets(self->UsePackets);
  caster->SetNumberOfThreads(self->NumberOfThreads);
  caster->SetDPI(self->DPI);
  if (self->TimeLimit > 0.0)
  {
    caster->SetTimeLimit(std::max(self->TimeLimit - this->ComputeElapsedSeconds(), LeastSeconds));
  }
  caster->SetBackground(!isAbove && self->Background && !layer->GetPreserveColorBuffer());
  caster->Update();
  penumbra::CompositeLayer(caster->GetOutput(), part.Low, isAbove, image);
  AddLayerRays(caster->GetStatistics(), this->Statistics);
}

void vtkPenumbraRayCaster::Internals::AddLayers(vtkPenumbraRayCaster* self, vtkImageData* image)
{
  for (vtkRenderer* layer : penumbra::FindLayersBelow(this->Renderer))
  {
    this->AddLayer(self, layer, false, image);
  }
  for (vtkRenderer* layer : penumbra::FindLayersAbove(this->Renderer))
  {
    this->AddLayer(self, layer, true, image);
  }
}

void vtkPenumbraRayCaster::Internals::Report(const penumbra::ImageTotals& totals, vtkIdType pixels)
{
  const penumbra::RayCounts& rays = totals.Rays;
  vtkFieldData* s = this->Statistics;
  s->Initialize();
  AddStatistic(s, "Rays/Primary", rays.Primary);
  AddStatistic(s, "Rays/Refinement", rays.Refinement);
  AddStatistic(s, "Rays/Shadow", rays.Shadow);
  AddStatistic(s, "Rays/Shaft", rays.Shaft);
  AddStatistic(s, "Rays/Occlusion", rays.Occlusion);
  AddStatistic(s, "Rays/Indirect", rays.Indirect);
  AddStatistic(s, "Rays/Auxiliary", rays.Auxiliary);
  AddStatistic(s, "Rays/Total",
    rays.Primary + rays.Refinement + rays.Shadow + rays.Shaft + rays.Occlusion + rays.Indirect +
      rays.Auxiliary);
  AddStatistic(s, "Samples/Rasterized", rays.Rasterized);
  AddStatistic(s, "Rays/PerPixel", static_cast<double>(rays.GetImageRays()) / pixels);
  AddStatistic(s, "Pixels/Total", pixels);
  AddStatistic(s, "Pixels/Empty", totals.Pixels.Empty);
  AddStatistic(s, "Pixels/Interior", totals.Pixels.Interior);
  AddStatistic(s, "Pixels/Edge", totals.Pixels.Edge);
  AddStatistic(s, "Pixels/SmallObject", totals.Pixels.SmallObject);
  AddStatistic(s, "Pixels/Refined", totals.Pixels.Refined);
  AddStatistic(s, "Pixels/Uniform", totals.Pixels.Uniform);
  AddStatistic(s, "Edges/Projected", totals.Edges);
  AddStatistic(s, "Scene/Extractions", this->Extractions);
  this->EstimatedError = totals.ComputeError(pixels);
  this->EstimatedLightError = totals.ComputeLightError(pixels);
}

void vtkPenumbraRayCaster::Internals::AddFieldData(vtkPenumbraRayCaster* self, vtkImageData* image)
{
  vtkFieldData* fields = image->GetFieldData();
  fields->ShallowCopy(this->Statistics);
  AddStatistic(fields, "Tolerance", self->Tolerance);
  AddStatistic(fields, "LightTolerance", self->GetEffectiveLightTolerance());
  AddStatistic(fields, "EstimatedError", this->EstimatedError);
  AddStatistic(fields, "EstimatedLightError", this->EstimatedLightError);
}
