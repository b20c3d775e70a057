// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RayCasterExecution.h"

#include "Image/LayerCompositing.h"
#include "PhaseTimer.h"
#include "Statistics/Statistics.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <algorithm>
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

std::unique_ptr<penumbra::RenderJob> vtkPenumbraRayCaster::Internals::BeginJob(
  vtkPenumbraRayCaster* self)
{
  if (ReportProgress(self, SceneProgress))
  {
    return nullptr;
  }
  auto job = std::make_unique<penumbra::RenderJob>(
    this->Prepared->SceneData, *this->Prepared->Rays, this->MakeJobSettings(self));
  const bool isReady = job->Begin(
    [self](double fraction) { return ReportProgress(self, ProviderProgress * fraction); },
    [this, self](const std::string& warning, bool once) {
      if (once)
      {
        this->WarnOnce(self, warning);
      }
      else if (!warning.empty())
      {
        vtkWarningWithObjectMacro(self, << warning);
      }
    });
  if (!isReady)
  {
    return nullptr;
  }
  this->TileTolerance = job->GetLimits().GetTileTolerance();
  return job;
}

std::function<bool(double)> vtkPenumbraRayCaster::Internals::MakeProgress(
  vtkPenumbraRayCaster* self, const penumbra::RenderJob& job)
{
  const double from = job.GetSettings().UsesProvider() ? ProviderProgress : 0.0;
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
  const std::unique_ptr<penumbra::RenderJob> job = this->BeginJob(self);
  if (!job)
  {
    return false;
  }
  job->SetLimit(this->MakeLimit(self), true);
  penumbra::ImageTotals totals;
  if (!penumbra::RenderImage(job->GetTracer(), this->Prepared->Edges, job->GetRenderSettings(),
        this->MakeProgress(self, *job), image, totals) ||
    !this->FinishExecution(self, *job, totals, image))
  {
    return false;
  }
  timer.End(TRACING);
  return true;
}

bool vtkPenumbraRayCaster::Internals::FinishExecution(vtkPenumbraRayCaster* self,
  penumbra::RenderJob& job, penumbra::ImageTotals& totals, vtkImageData* image)
{
  if (!this->FinishPixels(self, job, totals, image))
  {
    return false;
  }
  this->FinishImage(self, job, totals, image);
  return true;
}

bool vtkPenumbraRayCaster::Internals::FinishPixels(vtkPenumbraRayCaster* self,
  penumbra::RenderJob& job, penumbra::ImageTotals& totals, vtkImageData* image)
{
  if (this->InspectImage)
  {
    job.LightSamplesAlone();
    this->InspectImage(job.GetTracer(), this->Prepared->Edges);
  }
  const auto geometry = [self](double done) {
    return ReportProgress(self, 1.0 - GeometryProgress + GeometryProgress * done);
  };
  return job.AddArrays(geometry, image, totals.Rays);
}

void vtkPenumbraRayCaster::Internals::FinishImage(vtkPenumbraRayCaster* self,
  penumbra::RenderJob& job, const penumbra::ImageTotals& totals, vtkImageData* image)
{
  const bool isEnded = job.IsEnded();
  const penumbra::ToleranceReport tolerances =
    penumbra::CheckTolerance(job.GetLimits(), this->Constants, totals,
      isEnded ? self->TimeLimit : 0.0, image, glm::ivec2(self->Resolution[0], self->Resolution[1]));
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
  if (job.GetSettings().UsesProvider())
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
  growing->Job = this->BeginJob(self);
  if (!growing->Job)
  {
    throw penumbra::Stopped();
  }
  penumbra::RenderJob& job = *growing->Job;
  job.SetLimit(std::make_unique<penumbra::WorkLimit>(
                 [this](double) { return this->ComputeElapsedSeconds() >= this->CallSeconds; }),
    false);
  job.GetRenderSettings().UpdateEdges = [this, self]() {
    this->UpdateEdges(self, {}); // not for a preview
  };
  growing->Image = std::make_unique<penumbra::GrowingImage>(
    job.GetTracer(), this->Prepared->Edges, job.GetRenderSettings());
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
  penumbra::RenderJob& job = *growing.Job;
  job.GetLimit()->BeginPart(1.0);
  const bool isComplete = growing.Image->Run(this->MakeProgress(self, job));
  image->SetDimensions(self->Resolution[0], self->Resolution[1], 1);
  penumbra::ImageTotals totals;
  growing.Image->Store(image, totals);
  if (!isComplete)
  {
    this->Report(totals, image->GetNumberOfPoints());
    const penumbra::ToleranceReport tolerances = penumbra::CheckTolerance(job.GetLimits(),
      this->Constants, totals, 0.0, image, glm::ivec2(self->Resolution[0], self->Resolution[1]));
    this->ReportLimit(totals, tolerances, true);
    this->AddFieldData(self, image);
    timer.End(TRACING);
    return false;
  }
  growing.Image.reset();
  job.SetLimit(nullptr, false);
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
