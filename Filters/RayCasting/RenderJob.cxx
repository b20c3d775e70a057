// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderJob.h"

#include "Execution/ParallelFor.h"
#include "Execution/RankAgreement.h"
#include "Light/LightRays.h"
#include "LightWarnings.h"
#include "Media/MediumExtraction.h"
#include "Sampling/CameraRayTracer.h"
#include "Scene.h"
#include "SceneBounds.h"
#include "Surface.h"
#include "vtkPenumbraIrradianceProvider.h"
#include "vtkPenumbraMedium.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTypeInt64Array.h"

#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace penumbra
{
namespace
{

template <typename Array>
void AddArray(Array* array, const char* name, int components, vtkImageData* image)
{
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
}

/// Adds `Depth`, `Normal`, `ObjectId`, `CellId` and `AmbientOcclusion` for the extent of `image`.
/// `tracer` must have an occlusion provider. Adds the number of rays to `counts`. Returns false if
/// `progress` requested a stop.
bool AddGeometryArrays(const CameraRayTracer& tracer, const ProgressCallback& progress,
  vtkImageData* image, RayCounts& counts)
{
  vtkNew<vtkFloatArray> depths;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkFloatArray> occlusions;
  vtkNew<vtkIntArray> objects;
  vtkNew<vtkTypeInt64Array> cells;
  AddArray(depths.Get(), "Depth", 1, image);
  AddArray(normals.Get(), "Normal", 3, image);
  AddArray(objects.Get(), "ObjectId", 1, image);
  AddArray(cells.Get(), "CellId", 1, image);
  vtkFloatArray* const means =
    vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("AmbientOcclusion"));
  if (!means)
  {
    AddArray(occlusions.Get(), "AmbientOcclusion", 1, image);
  }

  const Scene& scene = tracer.GetScene();
  int extent[6];
  image->GetExtent(extent);
  const int width = extent[1] - extent[0] + 1;
  std::mutex totalsMutex;
  return ParallelForWithProgress(extent[3] - extent[2] + 1, 0.0, 1.0, progress, [&](int row) {
    RayCounts rowCounts;
    for (int column = 0; column < width; ++column)
    {
      const vtkIdType id = static_cast<vtkIdType>(row) * width + column;
      const glm::dvec2 p(extent[0] + column + 0.5, extent[2] + row + 0.5);
      const Ray ray = tracer.MakeRay(p);
      const Hit hit = tracer.TraceFirstHit(p);
      ++rowCounts.Auxiliary;
      if (!hit.IsHit())
      {
        depths->SetValue(id, std::numeric_limits<float>::infinity());
        normals->SetTypedComponent(id, 0, 0.f);
        normals->SetTypedComponent(id, 1, 0.f);
        normals->SetTypedComponent(id, 2, 0.f);
        objects->SetValue(id, -1);
        cells->SetValue(id, -1);
        (means ? means : occlusions.Get())->SetValue(id, 0.f);
        continue;
      }
      const Surface& surface = scene.Surfaces[hit.Surface];
      const ShadedHit shaded = tracer.GetShading().Shade(ray, hit, rowCounts.Shadow);
      depths->SetValue(
        id, static_cast<float>((hit.Distance + scene.ViewCamera.Advance) / scene.Scale));
      for (int axis = 0; axis < 3; ++axis)
      {
        normals->SetTypedComponent(id, axis, shaded.Normal[axis]);
      }
      objects->SetValue(id, surface.ObjectId);
      cells->SetValue(id, surface.GetCellId(hit.Primitive));
      if (!means)
      {
        occlusions->SetValue(id,
          tracer.HasOcclusion() ? tracer.ComputeOcclusion(ray, hit, shaded, rowCounts)
                                : std::numeric_limits<float>::quiet_NaN());
      }
    }
    const std::lock_guard<std::mutex> lock(totalsMutex);
    counts.Auxiliary += rowCounts.Auxiliary + rowCounts.Shadow + rowCounts.Occlusion;
  });
}

/// Tolerance of the light of one sample, in light tolerances of the image. The color of a pixel is
/// the mean of about four samples, which halves their error.
constexpr double SampleToleranceFactor = 2.0;

}

RenderSettings MakeRenderSettings(const JobSettings& settings)
{
  RenderSettings result;
  result.UsePackets = settings.Constants.UsePackets;
  result.Integration.Method = settings.Constants.CoverageMethod;
  result.Integration.Tolerance = settings.Tolerance;
  result.Integration.MaximumLevel = settings.Constants.MaximumLevel;
  result.Integration.FindSmallObjects = settings.Constants.FindSmallObjects;
  result.Integration.Shadows = settings.Shadows;
  result.Integration.UniformSamples = settings.Constants.UniformSamples;
  return result;
}

RenderJob::RenderJob(const Scene& scene, const RayScene& rays, const JobSettings& settings)
  : SceneData(scene),
    Rays(rays),
    Wanted(settings),
    Lit(rays, settings.Shadows),
    Tracer(rays, this->Lit, scene.ViewCamera),
    Settings(MakeRenderSettings(settings))
{
}

double RenderJob::GetSampleTolerance() const
{
  return SampleToleranceFactor * this->Wanted.LightTolerance;
}

/// Returns the tolerance of the irradiance at a sample. The image contains Albedo / pi of it.
double RenderJob::GetSampleIrradianceTolerance() const
{
  return this->GetSampleTolerance() * vtkMath::Pi() / this->Wanted.Light.Albedo;
}

/// Returns the accepted error of the light of a medium, and of light that pixels join. Both are independent.
double RenderJob::GetEffectTolerance() const
{
  const double tolerance = this->Wanted.LightTolerance;
  return this->Wanted.Medium && this->Joins ? std::sqrt(0.5) * tolerance : tolerance;
}

double RenderJob::GetOcclusionRadius() const
{
  return this->Wanted.OcclusionRadius > 0.0
    ? this->Wanted.OcclusionRadius
    : DefaultRadiusFraction * ComputeSceneDiagonal(this->SceneData);
}

bool RenderJob::BeginProvider(const ProgressCallback& progress, const WarningFunction& warn)
{
  const JobSettings& wanted = this->Wanted;
  const bool occlusion = wanted.HasOcclusion || wanted.HasOcclusionArray;
  const double fraction = occlusion && wanted.HasIndirectLight ? 0.5 : 1.0;
  double done = 0.0;
  const auto part = [&](double of) { return progress(done + fraction * of); };
  if (occlusion)
  {
    if (!wanted.Provider->Begin(this->Rays, { this->GetOcclusionRadius(), wanted.OcclusionFalloff },
          this->GetSampleTolerance(), part))
    {
      return false;
    }
    done = fraction;
  }
  if (!wanted.HasIndirectLight)
  {
    return true;
  }
  const auto light = std::make_shared<Illumination>(this->Rays, wanted.Light);
  light->AcceptNoise(this->GetEffectTolerance() / wanted.Light.Albedo, FirstSiteRays);
  this->Light = light;
  this->WarnOfMissingLight(warn);
  return wanted.Provider->BeginIrradiance(*this->Light, this->GetSampleIrradianceTolerance(), part);
}

void RenderJob::UseProvider()
{
  if (this->Wanted.HasOcclusion)
  {
    this->Tracer.SetOcclusion(
      this->Wanted.Provider, this->Wanted.OcclusionStrength, this->GetSampleTolerance());
  }
  if (this->Light)
  {
    this->Tracer.SetIndirectLight(
      this->Wanted.Provider, this->Wanted.Light.Albedo, this->GetSampleIrradianceTolerance());
  }
}

void RenderJob::JoinPixels()
{
  const JobSettings& wanted = this->Wanted;
  auto effects = std::make_shared<LightEffects>();
  effects->Tolerance = this->GetEffectTolerance();
  effects->Light = this->Light;
  effects->HasShadows = wanted.Shadows;
  if (wanted.HasOcclusion)
  {
    effects->Occlusion.emplace(this->Rays,
      DistanceFalloff::InScene(
        this->GetOcclusionRadius(), wanted.OcclusionFalloff, this->SceneData.Scale),
      effects->Tolerance);
  }
  this->Settings.KeepsOcclusion = wanted.HasOcclusion && wanted.HasOcclusionArray;
  this->Tracer.SetLayerLight(wanted.HasOcclusion, wanted.OcclusionStrength);
  this->Lit.SetUniformLight(glm::vec3(effects->GetUniformLight()));
  this->Settings.Light = std::move(effects);
}

void RenderJob::AddMedium(const WarningFunction& warn)
{
  std::string warning;
  std::optional<LightShafts> made =
    MakeLightShafts(this->Wanted.Medium, this->Lit, ComputeSceneDiagonal(this->SceneData),
      { this->GetEffectTolerance(), this->Wanted.Constants.LightShaftSteps,
        this->Wanted.Constants.CameraLightShafts },
      warning);
  if (made)
  {
    this->Shafts.emplace(*std::move(made));
  }
  this->Tracer.SetShafts(this->Shafts ? &*this->Shafts : nullptr);
  if (this->Shafts && this->Shafts->GetMedium().AttenuatesSurfaceLight)
  {
    this->Lit.SetAttenuation(&this->Shafts->GetMedium());
  }
  warn(warning, false);
}

void RenderJob::WarnOfMissingLight(const WarningFunction& warn)
{
  const JobSettings& wanted = this->Wanted;
  FoundLight found = FindLight(this->Rays, wanted.Shadows, this->Light.get(), wanted.RendersPixel);
  if (wanted.Ranks)
  {
    std::vector<double> counts = { found.IsLit ? 1.0 : 0.0, found.IsDark ? 1.0 : 0.0 };
    wanted.Ranks->Sum(counts);
    found = { counts[0] > 0.0, counts[1] > 0.0 };
  }
  if (!wanted.Ranks || wanted.Ranks->IsFirst())
  {
    warn(DescribeMissingLight(found), true);
  }
}

bool RenderJob::Begin(const ProgressCallback& progress, const WarningFunction& warn)
{
  const JobSettings& wanted = this->Wanted;
  this->Tracer.SetPenumbraTolerance(this->GetSampleTolerance());
  if (wanted.UsesProvider() && !this->BeginProvider(progress, warn))
  {
    return false;
  }
  const bool isLit = wanted.HasOcclusion || wanted.HasIndirectLight;
  this->Joins = isLit && wanted.Constants.CoverageMethod != CoverageMethods::Uniform &&
    wanted.Provider->JoinsPixels(wanted.HasOcclusion, wanted.HasIndirectLight);
  IntegrationSettings& integration = this->Settings.Integration;
  if (this->Joins)
  {
    this->JoinPixels();
  }
  else if (isLit)
  {
    integration.LightTolerance = wanted.LightTolerance;
    integration.Noise = this->GetSampleTolerance();
    this->UseProvider();
  }
  if (wanted.Shadows && !wanted.HasIndirectLight)
  {
    this->WarnOfMissingLight(warn);
  }
  if (wanted.HasIndirectLight && !wanted.Ranks)
  {
    warn(DescribeUnlitLines(this->SceneData), true);
  }
  this->AddMedium(warn);
  if (this->Shafts || this->Lit.HasPenumbrae())
  {
    integration.LightTolerance = wanted.LightTolerance;
  }
  this->Limits = integration;
  this->Limits.LightTolerance = this->Settings.HasLightErrors() ? wanted.LightTolerance : 0.0;
  return true;
}

void RenderJob::SetLimit(std::unique_ptr<WorkLimit> limit, bool endsTiles)
{
  this->Limit = std::move(limit);
  this->Settings.Limit = this->Limit.get();
  this->Settings.Integration.Limit = endsTiles ? this->Limit.get() : nullptr;
}

void RenderJob::LightSamplesAlone()
{
  if (this->Joins)
  {
    this->Lit.SetUniformLight(glm::vec3(0.f));
    this->UseProvider();
  }
}

bool RenderJob::AddArrays(const ProgressCallback& progress, vtkImageData* image, RayCounts& rays)
{
  if (!this->Wanted.HasGeometryArrays)
  {
    return true;
  }
  const bool asks = this->Wanted.HasOcclusionArray && !this->Settings.KeepsOcclusion;
  this->Tracer.SetOcclusion(asks ? this->Wanted.Provider : nullptr, this->Wanted.OcclusionStrength,
    this->GetSampleTolerance());
  return AddGeometryArrays(this->Tracer, progress, image, rays);
}

}
