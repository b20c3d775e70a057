// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraRayCaster.h"

#include "Execution/NaNCheck.h"
#include "Execution/Statistics.h"
#include "Image/GeometryArrays.h"
#include "Image/ImageRenderer.h"
#include "Import/SceneExtraction.h"
#include "Import/SceneModificationTime.h"
#include "Media/MediumExtraction.h"
#include "Shading/Illumination.h"

#include "vtkBoundingBox.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraMedium.h"
#include "vtkPointData.h"
#include "vtkPropCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <new>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

namespace
{

// Maximum width and height of the image, in pixels.
constexpr int MaximumResolution = 65535;
// Tolerance of one result of the irradiance provider, in tolerances of the image. The color of a pixel
// is the mean of about four results, which halves their error.
constexpr double SourceToleranceFactor = 2.0;
// Progress reported when the scene has been built. It stays 0 until then.
constexpr double SceneProgress = 1e-6;
// Fraction of the progress for the preparation of the irradiance provider.
constexpr double SourceProgress = 0.25;
// Fraction of the progress for the geometry arrays.
constexpr double GeometryProgress = 0.25;

using penumbra::AddStatistic;

/// Reports progress unless an abort was requested. Returns true if the execution must stop.
bool ReportProgress(vtkAlgorithm* self, double fraction)
{
  if (!self->GetAbortExecute())
  {
    self->UpdateProgress(fraction);
  }
  return self->GetAbortExecute() != 0;
}

/// Returns the diagonal of the bounds of all surfaces, in world units.
double ComputeDiagonal(const penumbra::Scene& scene)
{
  vtkBoundingBox bounds;
  for (const penumbra::Surface& surface : scene.Surfaces)
  {
    // Positions that no triangle uses are not drawn.
    for (const glm::uvec3& triangle : surface.Triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const glm::vec3& p = surface.Positions[triangle[k]];
        bounds.AddPoint(p.x, p.y, p.z);
      }
    }
    for (std::size_t i = 0; surface.IsRound() && i < surface.Positions.size(); ++i)
    {
      const glm::vec3 low = surface.Positions[i] - surface.GetRadius(i);
      const glm::vec3 high = surface.Positions[i] + surface.GetRadius(i);
      bounds.AddPoint(low.x, low.y, low.z);
      bounds.AddPoint(high.x, high.y, high.z);
    }
  }
  return bounds.IsValid() ? bounds.GetDiagonalLength() / scene.Scale : 1.0;
}

}

namespace
{

bool HasVisibleProps(vtkRenderer* renderer)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  while (vtkProp* prop = props->GetNextProp(position))
  {
    if (prop->GetVisibility())
    {
      return true;
    }
  }
  return false;
}

/// Returns the renderers in layers above `renderer` in its window whose viewports overlap.
std::vector<vtkRenderer*> FindLayers(vtkRenderer* renderer, bool enabled)
{
  std::vector<vtkRenderer*> layers;
  vtkRenderWindow* window = enabled && renderer ? renderer->GetRenderWindow() : nullptr;
  if (!window)
  {
    return layers;
  }
  const auto overlaps = [&](vtkRenderer* other) {
    const double* a = renderer->GetViewport();
    const double* b = other->GetViewport();
    return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
  };
  vtkCollectionSimpleIterator position;
  vtkRendererCollection* renderers = window->GetRenderers();
  renderers->InitTraversal(position);
  while (vtkRenderer* other = renderers->GetNextRenderer(position))
  {
    if (other->GetLayer() > renderer->GetLayer() && other->GetDraw() && overlaps(other) &&
      HasVisibleProps(other))
    {
      layers.push_back(other);
    }
  }
  std::stable_sort(layers.begin(), layers.end(),
    [](vtkRenderer* a, vtkRenderer* b) { return a->GetLayer() < b->GetLayer(); });
  return layers;
}

/// Composites the colors of `layer` over `image`, with its lower left corner at pixel `low`. Errors
/// are combined in proportion to the visible parts.
void CompositeOver(vtkImageData* layer, const int low[2], vtkImageData* image)
{
  auto* from = vtkFloatArray::SafeDownCast(layer->GetPointData()->GetArray("Color"));
  auto* to = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("Color"));
  vtkDataArray* fromErrors = layer->GetPointData()->GetArray("EstimatedError");
  vtkDataArray* toErrors = image->GetPointData()->GetArray("EstimatedError");
  if (!from || !to || !fromErrors || !toErrors)
  {
    return;
  }
  const int* size = layer->GetDimensions();
  const int* extent = image->GetExtent();
  for (int j = std::max(low[1], extent[2]); j <= std::min(low[1] + size[1] - 1, extent[3]); ++j)
  {
    for (int i = std::max(low[0], extent[0]); i <= std::min(low[0] + size[0] - 1, extent[1]); ++i)
    {
      int index[3] = { i, j, 0 };
      int source[3] = { i - low[0], j - low[1], 0 };
      const vtkIdType p = layer->ComputePointId(source);
      const vtkIdType q = image->ComputePointId(index);
      const float* over = from->GetPointer(4 * p);
      float* under = to->GetPointer(4 * q);
      const float below = (1.f - over[3]) * under[3];
      const float alpha = over[3] + below;
      for (int k = 0; k < 3 && alpha > 0.f; ++k)
      {
        under[k] = (over[3] * over[k] + below * under[k]) / alpha;
      }
      under[3] = alpha;
      toErrors->SetComponent(q, 0,
        std::hypot(fromErrors->GetComponent(p, 0), (1.0 - over[3]) * toErrors->GetComponent(q, 0)));
    }
  }
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

struct vtkPenumbraRayCaster::Internals
{
  /// An extracted scene with its ray tracing structures.
  struct PreparedScene
  {
    penumbra::Scene SceneData;
    std::unique_ptr<penumbra::RayScene> Rays;
    penumbra::SceneEdges Edges;
  };

  /// Size of one light; NaN where that of all lights applies.
  struct SizedLight
  {
    vtkWeakPointer<vtkLight> Source;
    double Radius = std::nan("");
    double Angle = std::nan("");
  };

  vtkSmartPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkPenumbraIrradianceProvider> IrradianceProvider =
    vtkSmartPointer<vtkPenumbraBruteForceIrradiance>::New();
  vtkSmartPointer<vtkPenumbraMedium> Medium;
  vtkSmartPointer<vtkPenumbraEnvironment> Environment;
  std::vector<SizedLight> SizedLights;
  vtkNew<vtkFieldData> Statistics;
  double EstimatedError = std::nan("");
  std::unique_ptr<PreparedScene> Prepared; ///< kept while an update requests only part of the image
  vtkMTimeType PreparedTime = 0;
  std::set<std::string> Warned; ///< warnings of the scene that were reported
  bool IsComputingMTime = false;

  SizedLight* FindSizedLight(vtkLight* light);
  SizedLight& GetOrAddSizedLight(vtkLight* light);
  void CheckLightSizes(vtkPenumbraRayCaster* self) const;
  void ResetResults();
  void Prepare(vtkPenumbraRayCaster* self, vtkInformationVector* inputs);
  bool Execute(vtkPenumbraRayCaster* self, vtkImageData* image);
  void AddLayers(vtkPenumbraRayCaster* self, vtkImageData* image);
  bool BeginSource(vtkPenumbraRayCaster* self, penumbra::CameraRayTracer& tracer);
  void Report(const penumbra::ImageRegion& totals, double squaredError, vtkIdType pixels);
  static penumbra::RenderSettings MakeSettings(vtkPenumbraRayCaster* self);
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

vtkPenumbraRayCaster::Internals::SizedLight* vtkPenumbraRayCaster::Internals::FindSizedLight(
  vtkLight* light)
{
  const auto found = std::find_if(this->SizedLights.begin(), this->SizedLights.end(),
    [light](const SizedLight& sized) { return sized.Source == light; });
  return light && found != this->SizedLights.end() ? &*found : nullptr;
}

vtkPenumbraRayCaster::Internals::SizedLight& vtkPenumbraRayCaster::Internals::GetOrAddSizedLight(
  vtkLight* light)
{
  if (SizedLight* found = this->FindSizedLight(light))
  {
    return *found;
  }
  this->SizedLights.emplace_back();
  this->SizedLights.back().Source = light;
  return this->SizedLights.back();
}

void vtkPenumbraRayCaster::Internals::CheckLightSizes(vtkPenumbraRayCaster* self) const
{
  const auto check = [](double radius, double angle) {
    if (!(radius >= 0.0 && std::isfinite(radius)))
    {
      throw std::runtime_error("LightRadius must be finite and not negative.");
    }
    if (!(angle >= 0.0 && angle <= 180.0))
    {
      throw std::runtime_error("LightAngle must be between 0 and 180 degrees.");
    }
  };
  check(self->LightRadius, self->LightAngle);
  for (const SizedLight& light : this->SizedLights)
  {
    check(
      std::isnan(light.Radius) ? 0.0 : light.Radius, std::isnan(light.Angle) ? 0.0 : light.Angle);
  }
}

void vtkPenumbraRayCaster::SetLightRadius(vtkLight* light, double radius)
{
  // NaN means that no radius is set, so it is replaced by another invalid one.
  this->Implementation->GetOrAddSizedLight(light).Radius = std::isnan(radius) ? -1.0 : radius;
  this->Modified();
}

void vtkPenumbraRayCaster::SetLightAngle(vtkLight* light, double angle)
{
  this->Implementation->GetOrAddSizedLight(light).Angle = std::isnan(angle) ? -1.0 : angle;
  this->Modified();
}

double vtkPenumbraRayCaster::GetLightRadius(vtkLight* light)
{
  const Internals::SizedLight* sized = this->Implementation->FindSizedLight(light);
  return sized && !std::isnan(sized->Radius) ? sized->Radius : this->LightRadius;
}

double vtkPenumbraRayCaster::GetLightAngle(vtkLight* light)
{
  const Internals::SizedLight* sized = this->Implementation->FindSizedLight(light);
  return sized && !std::isnan(sized->Angle) ? sized->Angle : this->LightAngle;
}

void vtkPenumbraRayCaster::ClearLightSizes()
{
  this->Implementation->SizedLights.clear();
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

void vtkPenumbraRayCaster::SetMaximumLevelFromViewing(double distance, double pixelPitch)
{
  // The eye resolves 2^-13 rad. A pixel that subtends `angle` is divided 2^L times per side [AA].
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
  vtkMTimeType time = this->Superclass::GetMTime();
  // A texture of the scene may depend on this image.
  if (this->Implementation->IsComputingMTime)
  {
    return time;
  }
  if (this->Implementation->Renderer)
  {
    this->Implementation->IsComputingMTime = true;
    time = std::max(time, penumbra::GetSceneMTime(this->Implementation->Renderer));
    for (vtkRenderer* layer : FindLayers(this->Implementation->Renderer, this->Layers))
    {
      time = std::max(time, penumbra::GetSceneMTime(layer));
    }
    this->Implementation->IsComputingMTime = false;
  }
  time = std::max(time, this->Implementation->IrradianceProvider->GetMTime());
  if (this->Implementation->Medium)
  {
    time = std::max(time, this->Implementation->Medium->GetMTime());
  }
  if (this->Implementation->Environment)
  {
    time = std::max(time, this->Implementation->Environment->GetMTime());
  }
  return time;
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
  if (std::min(this->Resolution[0], this->Resolution[1]) < 1 ||
    std::max(this->Resolution[0], this->Resolution[1]) > MaximumResolution)
  {
    vtkErrorMacro(
      "Resolution must be 1 x 1 to " << MaximumResolution << " x " << MaximumResolution << ".");
    return 0;
  }

  Internals& internals = *this->Implementation;
  internals.ResetResults();
  try
  {
    penumbra::RequireNotNaN("Tolerance, PointRadius, LineRadius, AmbientOcclusionRadius, "
                            "AmbientOcclusionStrength, Albedo "
                            "and EnvironmentColor",
      { this->Tolerance, this->PointRadius, this->LineRadius, this->AmbientOcclusionRadius,
        this->AmbientOcclusionStrength, this->Albedo, this->EnvironmentColor[0],
        this->EnvironmentColor[1], this->EnvironmentColor[2] });
    internals.CheckLightSizes(this);
    bool finished = true;
    std::exception_ptr thrown;
    vtkSMPTools::LocalScope(vtkSMPTools::Config(this->NumberOfThreads), [&]() {
      // LocalScope() does not restore the number of threads after an exception.
      try
      {
        internals.Prepare(this, inputs[0]);
        finished = internals.Execute(this, image);
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
    if (!finished)
    {
      image->Initialize();
    }
    const int* whole = info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
    if (!finished || std::equal(extent, extent + 6, whole))
    {
      internals.Prepared.reset();
    }
  }
  catch (const penumbra::Stopped&)
  {
    image->Initialize();
    internals.Prepared.reset();
  }
  catch (const std::bad_alloc&)
  {
    image->Initialize();
    vtkErrorMacro("Out of memory. Reduce Resolution or simplify the scene.");
    return 0;
  }
  catch (const std::exception& error)
  {
    image->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkPenumbraRayCaster::Internals::ResetResults()
{
  this->Statistics->Initialize();
  this->EstimatedError = std::nan("");
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
  penumbra::ExtractionOptions options;
  options.Resolution[0] = self->Resolution[0];
  options.Resolution[1] = self->Resolution[1];
  options.DPI = self->DPI;
  options.Background = self->Background;
  // What the camera clips still blocks light.
  options.ClipToRange =
    !self->Shadows && !self->AmbientOcclusion && !self->IndirectLight && !this->Medium;
  options.PointRadius = self->PointRadius;
  options.LineRadius = self->LineRadius;
  options.SizeOfLight = [self](vtkLight* light) {
    return penumbra::LightSize{ self->GetLightRadius(light), self->GetLightAngle(light) };
  };
  options.Progress = [self](double) { return ReportProgress(self, 0.0); };
  this->Prepared.reset(); // frees the memory before the next scene is built
  auto prepared = std::make_unique<PreparedScene>();
  penumbra::Scene& scene = prepared->SceneData;
  scene = this->Renderer ? penumbra::ExtractScene(this->Renderer, options)
                         : penumbra::ExtractScene(data, options);
  if (!scene.ViewCamera.IsUsable())
  {
    throw std::runtime_error(
      "The camera is not usable: position, focal point, view up, view angle and "
      "parallel scale must be finite.");
  }
  for (const std::string& warning : scene.Warnings)
  {
    if (this->Warned.insert(warning).second)
    {
      vtkWarningWithObjectMacro(self, << warning);
    }
  }
  prepared->Rays =
    std::make_unique<penumbra::RayScene>(scene, self->NumberOfThreads, options.Progress);
  prepared->Edges = penumbra::FindSceneEdges(scene, MakeSettings(self), options.Progress);
  this->Prepared = std::move(prepared);
  this->PreparedTime = computeTime(); // extraction may have updated the mappers
}

penumbra::RenderSettings vtkPenumbraRayCaster::Internals::MakeSettings(vtkPenumbraRayCaster* self)
{
  penumbra::RenderSettings settings;
  settings.UsePackets = self->UsePackets;
  settings.Integration.Method =
    static_cast<penumbra::IntegrationSettings::Methods>(self->CoverageMethod);
  settings.Integration.Tolerance = self->Tolerance;
  settings.Integration.MaximumLevel = self->MaximumLevel;
  settings.Integration.FindSmallObjects = self->FindSmallObjects;
  settings.Integration.Shadows = self->Shadows;
  settings.Integration.UniformSamples = self->UniformSamples;
  settings.Integration.Noise =
    self->AmbientOcclusion || self->IndirectLight ? SourceToleranceFactor * self->Tolerance : 0.0;
  return settings;
}

bool vtkPenumbraRayCaster::Internals::BeginSource(
  vtkPenumbraRayCaster* self, penumbra::CameraRayTracer& tracer)
{
  const double noise = SourceToleranceFactor * self->Tolerance;
  const bool occlusion = self->AmbientOcclusion || self->GeometryArrays;
  const double phaseFraction = occlusion && self->IndirectLight ? 0.5 : 1.0;
  double done = 0.0;
  const auto progress = [&](double fraction) {
    return ReportProgress(self, SourceProgress * (done + phaseFraction * fraction));
  };
  if (occlusion)
  {
    const double radius = self->AmbientOcclusionRadius > 0.0
      ? self->AmbientOcclusionRadius
      : penumbra::DefaultRadiusFraction * ComputeDiagonal(this->Prepared->SceneData);
    if (!this->IrradianceProvider->Begin(
          *this->Prepared->Rays, { radius, self->AmbientOcclusionFalloff }, noise, progress))
    {
      return false;
    }
    done = phaseFraction;
  }
  if (self->AmbientOcclusion)
  {
    tracer.SetOcclusion(this->IrradianceProvider, self->AmbientOcclusionStrength, noise);
  }
  if (self->IndirectLight && self->Albedo > 0.0)
  {
    const double* color = self->EnvironmentColor;
    penumbra::IlluminationSettings settings;
    settings.Environment = glm::max(glm::dvec3(color[0], color[1], color[2]), glm::dvec3(0.0));
    settings.Map = this->Environment ? this->Environment->GetMap() : nullptr;
    settings.Albedo = static_cast<float>(self->Albedo);
    settings.Bounces = self->Bounces;
    settings.Shadows = self->Shadows;
    const penumbra::Illumination light(*this->Prepared->Rays, settings);
    // The image contains Albedo / pi of the irradiance.
    const double tolerance = noise * vtkMath::Pi() / self->Albedo;
    tracer.SetIndirectLight(this->IrradianceProvider, settings.Albedo, tolerance);
    return this->IrradianceProvider->BeginIrradiance(light, tolerance, progress);
  }
  return true;
}

bool vtkPenumbraRayCaster::Internals::Execute(vtkPenumbraRayCaster* self, vtkImageData* image)
{
  const penumbra::Scene& scene = this->Prepared->SceneData;
  if (ReportProgress(self, SceneProgress))
  {
    return false;
  }
  const penumbra::Shading shading(*this->Prepared->Rays, self->Shadows);
  penumbra::CameraRayTracer tracer(*this->Prepared->Rays, shading, scene.ViewCamera);
  tracer.SetPenumbraTolerance(SourceToleranceFactor * self->Tolerance);
  const penumbra::RenderSettings settings = MakeSettings(self);
  const bool usesSource = self->AmbientOcclusion || self->IndirectLight || self->GeometryArrays;
  if (usesSource && !this->BeginSource(self, tracer))
  {
    return false;
  }

  std::string warning;
  const std::optional<penumbra::LightShafts> shafts = penumbra::MakeLightShafts(this->Medium,
    shading, ComputeDiagonal(scene), { self->Tolerance, self->LightShaftSteps }, warning);
  tracer.SetShafts(shafts ? &*shafts : nullptr);
  if (!warning.empty())
  {
    vtkWarningWithObjectMacro(self, << warning);
  }

  const double progressBegin = usesSource ? SourceProgress : 0.0;
  const double progressEnd = self->GeometryArrays ? 1.0 - GeometryProgress : 1.0;
  const auto progress = [self, progressBegin, progressEnd](double done) {
    return ReportProgress(self, progressBegin + (progressEnd - progressBegin) * done);
  };
  penumbra::ImageRegion totals;
  double squaredError = 0.0;
  if (!penumbra::RenderImage(
        tracer, this->Prepared->Edges, settings, progress, image, totals, squaredError))
  {
    return false;
  }
  // The error of the irradiance provider itself is bounded by the provider, so the limit allows for it.
  const double limit = std::hypot(self->Tolerance, 0.5 * settings.Integration.Noise);
  const penumbra::TileErrors tiles = penumbra::EvaluateTiles(image, limit);
  if (self->CoverageMethod != UNIFORM && tiles.AboveTolerance > 0)
  {
    vtkWarningWithObjectMacro(self,
      "The tolerance of " << self->Tolerance << " was not reached in " << tiles.AboveTolerance
                          << " of " << tiles.Tiles
                          << " tiles of 16x16 pixels. The largest estimated error of a"
                          << " tile is " << tiles.MaximumError
                          << ". Increase Tolerance or MaximumLevel.");
  }
  if (self->GeometryArrays)
  {
    tracer.SetOcclusion(this->IrradianceProvider, self->AmbientOcclusionStrength,
      SourceToleranceFactor * self->Tolerance);
    const auto geometry = [self, progressEnd](double done) {
      return ReportProgress(self, progressEnd + (1.0 - progressEnd) * done);
    };
    if (!penumbra::AddGeometryArrays(tracer, geometry, image, totals.Rays))
    {
      return false;
    }
  }
  this->Report(totals, squaredError, image->GetNumberOfPoints());
  this->AddLayers(self, image);
  if (usesSource)
  {
    this->IrradianceProvider->Report(this->Statistics);
    vtkDataArray* gathered = this->Statistics->GetArray("Rays/Gather");
    if (gathered)
    {
      vtkDataArray* total = this->Statistics->GetArray("Rays/Total");
      total->SetComponent(0, 0, total->GetComponent(0, 0) + gathered->GetComponent(0, 0));
    }
  }
  image->GetFieldData()->ShallowCopy(this->Statistics);
  return true;
}

void vtkPenumbraRayCaster::Internals::AddLayers(vtkPenumbraRayCaster* self, vtkImageData* image)
{
  for (vtkRenderer* layer : FindLayers(this->Renderer, self->Layers))
  {
    const double* whole = this->Renderer->GetViewport();
    const double* part = layer->GetViewport();
    int low[2];
    int size[2];
    for (int k = 0; k < 2; ++k)
    {
      const double scale = self->Resolution[k] / (whole[k + 2] - whole[k]);
      low[k] = static_cast<int>(std::lround((part[k] - whole[k]) * scale));
      size[k] = static_cast<int>(std::lround((part[k + 2] - whole[k]) * scale)) - low[k];
    }
    if (std::min(size[0], size[1]) < 1 || std::max(size[0], size[1]) > MaximumResolution)
    {
      continue;
    }
    vtkNew<vtkPenumbraRayCaster> caster;
    caster->SetRenderer(layer);
    caster->SetLayers(false);
    caster->SetResolution(size);
    caster->SetTolerance(self->Tolerance);
    caster->SetCoverageMethod(self->CoverageMethod);
    caster->SetUniformSamples(self->UniformSamples);
    caster->SetMaximumLevel(self->MaximumLevel);
    caster->SetFindSmallObjects(self->FindSmallObjects);
    caster->SetUsePackets(self->UsePackets);
    caster->SetNumberOfThreads(self->NumberOfThreads);
    caster->SetDPI(self->DPI);
    caster->SetBackground(!layer->GetPreserveColorBuffer() && layer->GetLayer() == 0);
    caster->Update();
    CompositeOver(caster->GetOutput(), low, image);
    AddLayerRays(caster->GetStatistics(), this->Statistics);
  }
}

void vtkPenumbraRayCaster::Internals::Report(
  const penumbra::ImageRegion& totals, double squaredError, vtkIdType pixels)
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
  AddStatistic(s, "Rays/PerPixel", static_cast<double>(rays.GetImageRays()) / pixels);
  AddStatistic(s, "Pixels/Total", pixels);
  AddStatistic(s, "Pixels/Empty", totals.Pixels.Empty);
  AddStatistic(s, "Pixels/Interior", totals.Pixels.Interior);
  AddStatistic(s, "Pixels/Edge", totals.Pixels.Edge);
  AddStatistic(s, "Pixels/SmallObject", totals.Pixels.SmallObject);
  AddStatistic(s, "Pixels/Refined", totals.Pixels.Refined);
  AddStatistic(s, "Pixels/Uniform", totals.Pixels.Uniform);
  AddStatistic(s, "Edges/Projected", totals.Edges);
  this->EstimatedError = std::sqrt(squaredError / pixels);
}

void vtkPenumbraRayCaster::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Renderer: " << this->Implementation->Renderer.Get() << "\n";
  os << indent << "IrradianceProvider: " << this->Implementation->IrradianceProvider.Get() << "\n";
  os << indent << "Resolution: " << this->Resolution[0] << " " << this->Resolution[1] << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "CoverageMethod: " << this->CoverageMethod << "\n";
  os << indent << "UniformSamples: " << this->UniformSamples << "\n";
  os << indent << "MaximumLevel: " << this->MaximumLevel << "\n";
  os << indent << "FindSmallObjects: " << this->FindSmallObjects << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
  os << indent << "LightRadius: " << this->LightRadius << "\n";
  os << indent << "LightAngle: " << this->LightAngle << "\n";
  os << indent << "SizedLights: " << this->Implementation->SizedLights.size() << "\n";
  os << indent << "Environment: " << this->Implementation->Environment.Get() << "\n";
  os << indent << "Medium: " << this->Implementation->Medium.Get() << "\n";
  os << indent << "LightShaftSteps: " << this->LightShaftSteps << "\n";
  os << indent << "AmbientOcclusion: " << this->AmbientOcclusion << "\n";
  os << indent << "AmbientOcclusionRadius: " << this->AmbientOcclusionRadius << "\n";
  os << indent << "AmbientOcclusionFalloff: " << this->AmbientOcclusionFalloff << "\n";
  os << indent << "AmbientOcclusionStrength: " << this->AmbientOcclusionStrength << "\n";
  os << indent << "IndirectLight: " << this->IndirectLight << "\n";
  os << indent << "EnvironmentColor: " << this->EnvironmentColor[0] << " "
     << this->EnvironmentColor[1] << " " << this->EnvironmentColor[2] << "\n";
  os << indent << "Albedo: " << this->Albedo << "\n";
  os << indent << "Bounces: " << this->Bounces << "\n";
  os << indent << "GeometryArrays: " << this->GeometryArrays << "\n";
  os << indent << "Background: " << this->Background << "\n";
  os << indent << "UsePackets: " << this->UsePackets << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "PointRadius: " << this->PointRadius << "\n";
  os << indent << "LineRadius: " << this->LineRadius << "\n";
  os << indent << "DPI: " << this->DPI << "\n";
  os << indent << "Layers: " << this->Layers << "\n";
  os << indent << "EstimatedError: " << this->Implementation->EstimatedError << "\n";
}
