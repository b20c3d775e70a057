// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RayCasterExecution.h"

#include "Image/GeometryArrays.h"
#include "Image/LayerCompositing.h"
#include "Light/LightRays.h"
#include "Media/MediumExtraction.h"
#include "PhaseTimer.h"
#include "SceneBounds.h"
#include "Shading/Illumination.h"
#include "Shading/LightWarnings.h"
#include "Statistics/Statistics.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{

// Progress reported when the scene has been built. It stays 0 until then.
constexpr double SceneProgress = 1e-6;
// Fraction of the progress for the preparation of the irradiance provider.
constexpr double ProviderProgress = 0.25;
// Fraction of the progress for the geometry arrays.
constexpr double GeometryProgress = 0.25;

// A time limit that is reached at once, in seconds.
constexpr double LeastSeconds = 1e-9;

using penumbra::AddStatistic;

}

double vtkPenumbraRayCaster::Internals::ComputeIrradianceTolerance(vtkPenumbraRayCaster* self)
{
  return SampleToleranceFactor * self->GetEffectiveLightTolerance() * vtkMath::Pi() / self->Albedo;
}

bool vtkPenumbraRayCaster::Internals::BeginProvider(vtkPenumbraRayCaster* self)
{
  const double noise = SampleToleranceFactor * self->GetEffectiveLightTolerance();
  const OcclusionSettings settings = this->FindOcclusion(self);
  const bool occlusion = settings.On || (self->GeometryArrays && this->Constants.OcclusionArray);
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
  this->Light.reset();
  if (self->IndirectLight && self->Albedo > 0.0)
  {
    const double* color = self->EnvironmentColor;
    penumbra::IlluminationSettings light;
    light.Environment = glm::max(glm::dvec3(color[0], color[1], color[2]), glm::dvec3(0.0));
    light.Map = this->Environment ? this->Environment->GetMap() : nullptr;
    light.Albedo = static_cast<float>(self->Albedo);
    light.Bounces = self->Bounces;
    light.Shadows = self->GetShadows();
    this->Light = std::make_shared<const penumbra::Illumination>(*this->Prepared->Rays, light);
    this->WarnOnce(self,
      penumbra::DescribeMissingLight(*this->Prepared->Rays, self->GetShadows(), &*this->Light));
    return this->IrradianceProvider->BeginIrradiance(
      *this->Light, this->ComputeIrradianceTolerance(self), progress);
  }
  return true;
}

void vtkPenumbraRayCaster::Internals::UseProvider(
  vtkPenumbraRayCaster* self, penumbra::CameraRayTracer& tracer) const
{
  const OcclusionSettings settings = this->FindOcclusion(self);
  if (settings.On)
  {
    tracer.SetOcclusion(this->IrradianceProvider, settings.Strength,
      SampleToleranceFactor * self->GetEffectiveLightTolerance());
  }
  if (this->Light)
  {
    tracer.SetIndirectLight(this->IrradianceProvider, this->Light->GetSettings().Albedo,
      this->ComputeIrradianceTolerance(self));
  }
}

// The errors of light from a medium and of light that pixels join are independent.
double vtkPenumbraRayCaster::Internals::FindEffectTolerance(vtkPenumbraRayCaster* self) const
{
  const double tolerance = self->GetEffectiveLightTolerance();
  return this->Medium && this->JoinsPixels(self) ? std::sqrt(0.5) * tolerance : tolerance;
}

std::shared_ptr<const penumbra::LightEffects> vtkPenumbraRayCaster::Internals::MakeLightEffects(
  vtkPenumbraRayCaster* self) const
{
  auto effects = std::make_shared<penumbra::LightEffects>();
  effects->Tolerance = this->FindEffectTolerance(self);
  effects->Light = this->Light;
  if (this->FindOcclusion(self).On)
  {
    effects->Occlusion.emplace(*this->Prepared->Rays,
      penumbra::DistanceFalloff::InScene(this->FindOcclusionRadius(self),
        self->AmbientOcclusionFalloff, this->Prepared->SceneData.Scale),
      effects->Tolerance);
  }
  return effects;
}

std::unique_ptr<vtkPenumbraRayCaster::Internals::Execution>
vtkPenumbraRayCaster::Internals::BeginExecution(vtkPenumbraRayCaster* self)
{
  const penumbra::Scene& scene = this->Prepared->SceneData;
  if (ReportProgress(self, SceneProgress))
  {
    return nullptr;
  }
  auto execution = std::make_unique<Execution>(*this->Prepared, self->GetShadows());
  penumbra::Shading& shading = execution->Lit;
  penumbra::CameraRayTracer& tracer = execution->Tracer;
  const double lightTolerance = self->GetEffectiveLightTolerance();
  tracer.SetPenumbraTolerance(SampleToleranceFactor * lightTolerance);
  execution->UsesProvider = self->GetAmbientOcclusion() || self->IndirectLight ||
    (self->GeometryArrays && this->Constants.OcclusionArray);
  if (execution->UsesProvider && !this->BeginProvider(self))
  {
    return nullptr;
  }
  penumbra::RenderSettings& settings = execution->Settings;
  settings = MakeSettings(self);
  execution->Joins = this->JoinsPixels(self);
  if (execution->Joins)
  {
    const OcclusionSettings occlusion = this->FindOcclusion(self);
    settings.Light = this->MakeLightEffects(self);
    settings.KeepsOcclusion =
      occlusion.On && self->GeometryArrays && this->Constants.OcclusionArray;
    tracer.SetLayerLight(occlusion.On, occlusion.Strength);
    shading.SetUniformLight(glm::vec3(settings.Light->GetUniformLight()));
  }
  else if (execution->UsesProvider)
  {
    this->UseProvider(self, tracer);
  }
  if (self->GetShadows() && !self->IndirectLight)
  {
    this->WarnOnce(self, penumbra::DescribeMissingLight(*this->Prepared->Rays, true, nullptr));
  }

  std::string warning;
  std::optional<penumbra::LightShafts> made =
    penumbra::MakeLightShafts(this->Medium, shading, penumbra::ComputeSceneDiagonal(scene),
      { this->FindEffectTolerance(self), this->Constants.LightShaftSteps }, warning);
  std::optional<penumbra::LightShafts>& shafts = execution->Shafts;
  if (made)
  {
    shafts.emplace(*std::move(made));
  }
  tracer.SetShafts(shafts ? &*shafts : nullptr);
  if (shafts || shading.HasPenumbrae())
  {
    settings.Integration.LightTolerance = lightTolerance;
  }
  penumbra::IntegrationSettings& limits = execution->Limits;
  limits = settings.Integration;
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
  return execution;
}

std::function<bool(double)> vtkPenumbraRayCaster::Internals::MakeProgress(
  vtkPenumbraRayCaster* self, const Execution& execution)
{
  const double from = execution.UsesProvider ? ProviderProgress : 0.0;
  const double to = self->GeometryArrays ? 1.0 - GeometryProgress : 1.0;
  return [self, from, to](double done) { return ReportProgress(self, from + (to - from) * done); };
}

bool vtkPenumbraRayCaster::Internals::Execute(vtkPenumbraRayCaster* self, vtkImageData* image)
{
  if (this->Distribution)
  {
    return this->ExecuteDistributed(self, image);
  }
  this->UpdateEdges(self, [self](double) { return ReportProgress(self, 0.0); });
  penumbra::PhaseTimer timer(this->PhaseSeconds);
  const std::unique_ptr<Execution> execution = this->BeginExecution(self);
  if (!execution)
  {
    return false;
  }
  execution->Limit = this->MakeLimit(self);
  execution->Settings.Limit = execution->Limit.get();
  execution->Settings.Integration.Limit = execution->Limit.get();
  penumbra::ImageTotals totals;
  if (!penumbra::RenderImage(execution->Tracer, this->Prepared->Edges, execution->Settings,
        this->MakeProgress(self, *execution), image, totals) ||
    !this->FinishExecution(self, *execution, totals, image))
  {
    return false;
  }
  timer.End(TRACING);
  return true;
}

bool vtkPenumbraRayCaster::Internals::FinishExecution(vtkPenumbraRayCaster* self,
  Execution& execution, penumbra::ImageTotals& totals, vtkImageData* image)
{
  if (!this->FinishPixels(self, execution, totals, image))
  {
    return false;
  }
  this->FinishImage(self, execution, totals, image);
  return true;
}

bool vtkPenumbraRayCaster::Internals::FinishPixels(vtkPenumbraRayCaster* self, Execution& execution,
  penumbra::ImageTotals& totals, vtkImageData* image)
{
  penumbra::CameraRayTracer& tracer = execution.Tracer;
  if (this->InspectImage)
  {
    if (execution.Joins)
    {
      execution.Lit.SetUniformLight(glm::vec3(0.f));
      this->UseProvider(self, tracer);
    }
    this->InspectImage(tracer, this->Prepared->Edges);
  }
  if (!self->GeometryArrays)
  {
    return true;
  }
  tracer.SetOcclusion(this->Constants.OcclusionArray && !execution.Settings.KeepsOcclusion
      ? this->IrradianceProvider.Get()
      : nullptr,
    self->AmbientOcclusionStrength, SampleToleranceFactor * self->GetEffectiveLightTolerance());
  const auto geometry = [self](double done) {
    return ReportProgress(self, 1.0 - GeometryProgress + GeometryProgress * done);
  };
  return penumbra::AddGeometryArrays(tracer, geometry, image, totals.Rays);
}

void vtkPenumbraRayCaster::Internals::FinishImage(vtkPenumbraRayCaster* self, Execution& execution,
  const penumbra::ImageTotals& totals, vtkImageData* image)
{
  const bool isEnded = execution.IsEnded();
  const penumbra::ToleranceReport tolerances =
    penumbra::CheckTolerance(execution.Limits, totals, isEnded ? self->TimeLimit : 0.0, image);
  if (!tolerances.Warning.empty())
  {
    vtkWarningWithObjectMacro(self, << tolerances.Warning);
  }
  this->Report(totals, image->GetNumberOfPoints());
  this->ReportLimit(totals, tolerances, isEnded);
  double additional = 0.0;
  if (const std::optional<double> rays = self->Layers ? this->AddLayers(self, image) : std::nullopt)
  {
    additional = *rays;
    AddStatistic(this->Statistics, "Rays/Layers", *rays);
  }
  if (execution.UsesProvider)
  {
    this->IrradianceProvider->Report(this->Statistics);
    vtkDataArray* gathered = this->Statistics->GetArray("Rays/Gather");
    additional += gathered ? gathered->GetComponent(0, 0) : 0.0;
  }
  this->TotalRays = static_cast<double>(totals.Rays.GetTotal()) + additional;
  AddStatistic(this->Statistics, "Rays/Total", *this->TotalRays);
  this->AddFieldData(self, image);
}

void vtkPenumbraRayCaster::Internals::BeginGrowing(vtkPenumbraRayCaster* self)
{
  this->Growing.reset();
  this->Prepare(self, {});
  auto growing = std::make_unique<GrowingState>();
  growing->Job = this->BeginExecution(self);
  if (!growing->Job)
  {
    throw penumbra::Stopped();
  }
  Execution& job = *growing->Job;
  job.Limit = std::make_unique<penumbra::WorkLimit>(
    [this](double) { return this->ComputeElapsedSeconds() >= this->CallSeconds; });
  job.Settings.Limit = job.Limit.get();
  job.Settings.UpdateEdges = [this, self]() { this->UpdateEdges(self, {}); }; // not for a preview
  growing->Image =
    std::make_unique<penumbra::GrowingImage>(job.Tracer, this->Prepared->Edges, job.Settings);
  growing->SceneTime = this->ComputeSceneTime(self);
  this->Growing = std::move(growing);
}

bool vtkPenumbraRayCaster::Internals::Continue(vtkPenumbraRayCaster* self, vtkImageData* image)
{
  if (!this->Growing || this->SettingsTime != self->vtkAlgorithm::GetMTime() ||
    this->PreparedRenderer.Get() != this->Renderer.Get() ||
    this->Growing->SceneTime != this->ComputeSceneTime(self))
  {
    this->BeginGrowing(self);
  }
  GrowingState& growing = *this->Growing;
  if (growing.Final)
  {
    image->ShallowCopy(growing.Final);
    return true;
  }
  penumbra::PhaseTimer timer(this->PhaseSeconds);
  Execution& job = *growing.Job;
  job.Limit->BeginPart(1.0);
  const bool isComplete = growing.Image->Run(this->MakeProgress(self, job));
  image->SetDimensions(self->Resolution[0], self->Resolution[1], 1);
  penumbra::ImageTotals totals;
  growing.Image->Store(image, totals);
  if (!isComplete)
  {
    this->Report(totals, image->GetNumberOfPoints());
    this->ReportLimit(totals, penumbra::CheckTolerance(job.Limits, totals, 0.0, image), true);
    this->AddFieldData(self, image);
    timer.End(TRACING);
    return false;
  }
  growing.Image.reset();
  job.Limit.reset();
  if (!this->FinishExecution(self, job, totals, image))
  {
    throw penumbra::Stopped();
  }
  timer.End(TRACING);
  growing.Final = vtkSmartPointer<vtkImageData>::New();
  growing.Final->ShallowCopy(image);
  return true;
}

std::optional<double> vtkPenumbraRayCaster::Internals::AddLayer(
  vtkPenumbraRayCaster* self, vtkRenderer* layer, bool isAbove, vtkImageData* image)
{
  const penumbra::LayerRectangle part =
    penumbra::FindLayerRectangle(this->Renderer, layer, self->Resolution);
  if (std::min(part.Size[0], part.Size[1]) < 1 ||
    std::max(part.Size[0], part.Size[1]) > MaximumResolution)
  {
    return std::nullopt;
  }
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(layer);
  caster->SetLayers(false);
  caster->SetResolution(part.Size[0], part.Size[1]);
  caster->SetTolerance(self->Tolerance);
  caster->SetLightTolerance(self->LightTolerance);
  caster->Implementation->Constants = this->Constants;
  caster->SetNumberOfThreads(self->NumberOfThreads);
  caster->SetDPI(self->DPI);
  if (self->TimeLimit > 0.0)
  {
    caster->SetTimeLimit(std::max(self->TimeLimit - this->ComputeElapsedSeconds(), LeastSeconds));
  }
  caster->SetBackground(!isAbove && self->Background && !layer->GetPreserveColorBuffer());
  caster->Update();
  penumbra::CompositeLayer(caster->GetOutput(), part.Low, isAbove, image);
  return caster->Implementation->TotalRays;
}

std::optional<double> vtkPenumbraRayCaster::Internals::AddLayers(
  vtkPenumbraRayCaster* self, vtkImageData* image)
{
  std::optional<double> sum;
  const auto add = [&](vtkRenderer* layer, bool isAbove) {
    if (const std::optional<double> rays = this->AddLayer(self, layer, isAbove, image))
    {
      sum = sum.value_or(0.0) + *rays;
    }
  };
  for (vtkRenderer* layer : penumbra::FindLayersBelow(this->Renderer))
  {
    add(layer, false);
  }
  for (vtkRenderer* layer : penumbra::FindLayersAbove(this->Renderer))
  {
    add(layer, true);
  }
  return sum;
}

void vtkPenumbraRayCaster::Internals::ReportLimit(
  const penumbra::ImageTotals& totals, const penumbra::ToleranceReport& tolerances, bool isEnded)
{
  AddStatistic(this->Statistics, "Pixels/Unfinished", totals.Unfinished);
  AddStatistic(this->Statistics, "Tiles/AboveTolerance", tolerances.TilesAboveTolerance);
  AddStatistic(this->Statistics, "TimeLimit/Reached", isEnded ? 1 : 0);
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
  AddStatistic(s, "Rays/Total", rays.GetTotal());
  AddStatistic(s, "Rays/Repeated", rays.Repeated);
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
  AddStatistic(s, "Scene/ChangedSurfaces", this->ChangedSurfaces);
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
