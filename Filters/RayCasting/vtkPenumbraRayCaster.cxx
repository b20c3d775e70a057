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
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraMedium.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

namespace
{

// Of a picture, in pixels.
constexpr int LargestSide = 65535;
// A pixel is the mean of about four answers of the irradiance source, so each may err twice as much.
constexpr double OcclusionNoiseShare = 2.0;
// Of the progress, which is 0 before: the scene is built.
constexpr double ProgressOfScene = 1e-6;
// Of the progress: what the irradiance source prepares.
constexpr double ProgressOfSource = 0.25;
// Of the progress: the arrays beside the colour.
constexpr double ProgressOfGeometry = 0.25;

using penumbra::AddStatistic;

/// True when asked to stop: then nobody is told anything more.
bool TellProgress(vtkAlgorithm* self, double share)
{
  if (!self->GetAbortExecute())
  {
    self->UpdateProgress(share);
  }
  return self->GetAbortExecute() != 0;
}

/// Diagonal of the bounds of what is drawn, in world units.
double GetDiagonal(const penumbra::Scene& scene)
{
  vtkBoundingBox bounds;
  for (const penumbra::Surface& surface : scene.Surfaces)
  {
    for (const glm::vec3& p : surface.Positions)
    {
      bounds.AddPoint(p.x, p.y, p.z);
    }
  }
  return bounds.IsValid() ? bounds.GetDiagonalLength() / scene.Scale : 1.0;
}

}

struct vtkPenumbraRayCaster::Internals
{
  /// A scene that is ready to be traced.
  struct PreparedScene
  {
    penumbra::Scene Drawn;
    std::unique_ptr<penumbra::RayScene> Rays;
    penumbra::SceneEdges Edges;
  };

  vtkSmartPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkPenumbraIrradianceProvider> IrradianceSource =
    vtkSmartPointer<vtkPenumbraBruteForceIrradiance>::New();
  vtkSmartPointer<vtkPenumbraMedium> Medium;
  vtkSmartPointer<vtkPenumbraEnvironment> Environment;
  vtkNew<vtkFieldData> Statistics;
  double EstimatedError = std::nan("");
  std::unique_ptr<PreparedScene> Prepared; ///< kept while parts of its picture are asked for
  vtkMTimeType PreparedTime = 0;

  void Forget();
  void Prepare(vtkPenumbraRayCaster* self, vtkInformationVector* inputs);
  bool Execute(vtkPenumbraRayCaster* self, vtkImageData* image);
  bool BeginSource(vtkPenumbraRayCaster* self, penumbra::CameraRayTracer& sampler);
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

void vtkPenumbraRayCaster::SetIrradianceSource(vtkPenumbraIrradianceProvider* source)
{
  if (this->Implementation->IrradianceSource != source)
  {
    this->Implementation->IrradianceSource = source;
    if (!source)
    {
      this->Implementation->IrradianceSource =
        vtkSmartPointer<vtkPenumbraBruteForceIrradiance>::New();
    }
    this->Modified();
  }
}

vtkPenumbraIrradianceProvider* vtkPenumbraRayCaster::GetIrradianceSource()
{
  return this->Implementation->IrradianceSource;
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
  // The eye resolves 2^-13 rad; a pixel seen under `angle` needs sides 2^L times smaller [AA].
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
  if (this->Implementation->Renderer)
  {
    time = std::max(time, penumbra::GetSceneMTime(this->Implementation->Renderer));
  }
  time = std::max(time, this->Implementation->IrradianceSource->GetMTime());
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
  // Any part of the picture needs the whole scene.
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
    std::max(this->Resolution[0], this->Resolution[1]) > LargestSide)
  {
    vtkErrorMacro("Resolution must be 1 x 1 to " << LargestSide << " x " << LargestSide << ".");
    return 0;
  }

  Internals& own = *this->Implementation;
  own.Forget();
  try
  {
    penumbra::RequireNotNaN(
      "Tolerance, AmbientOcclusionRadius, AmbientOcclusionStrength, Albedo and "
      "EnvironmentColor",
      { this->Tolerance, this->AmbientOcclusionRadius, this->AmbientOcclusionStrength, this->Albedo,
        this->EnvironmentColor[0], this->EnvironmentColor[1], this->EnvironmentColor[2] });
    own.Prepare(this, inputs[0]);
    bool finished = true;
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config(this->NumberOfThreads), [&]() { finished = own.Execute(this, image); });
    if (!finished)
    {
      image->Initialize();
    }
    const int* whole = info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
    if (!finished || std::equal(extent, extent + 6, whole))
    {
      own.Prepared.reset();
    }
  }
  catch (const penumbra::Stopped&)
  {
    image->Initialize();
    own.Prepared.reset();
  }
  catch (const std::bad_alloc&)
  {
    image->Initialize();
    vtkErrorMacro("Out of memory: ask for a smaller resolution or a smaller scene.");
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

void vtkPenumbraRayCaster::Internals::Forget()
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
  const auto changed = [&]() {
    vtkMTimeType time = self->GetMTime();
    for (vtkDataObject* one : data)
    {
      time = std::max(time, one->GetMTime());
    }
    return time;
  };
  if (this->Prepared && changed() <= this->PreparedTime)
  {
    return;
  }
  penumbra::ExtractionOptions options;
  options.Resolution[0] = self->Resolution[0];
  options.Resolution[1] = self->Resolution[1];
  options.DPI = self->DPI;
  options.Background = self->Background;
  options.Progress = [self](double) { return TellProgress(self, 0.0); };
  this->Prepared.reset(); // two scenes may be more than the memory holds
  auto prepared = std::make_unique<PreparedScene>();
  penumbra::Scene& scene = prepared->Drawn;
  scene = this->Renderer ? penumbra::ExtractScene(this->Renderer, options)
                         : penumbra::ExtractScene(data, options);
  if (!scene.ViewCamera.IsUsable())
  {
    throw std::runtime_error(
      "The camera sees nothing: position, focal point, view up, view angle and "
      "parallel scale must be finite.");
  }
  for (const std::string& warning : scene.Warnings)
  {
    vtkWarningWithObjectMacro(self, << warning);
  }
  prepared->Rays =
    std::make_unique<penumbra::RayScene>(scene, self->NumberOfThreads, options.Progress);
  prepared->Edges = penumbra::FindSceneEdges(scene, MakeSettings(self), options.Progress);
  this->Prepared = std::move(prepared);
  this->PreparedTime = changed(); // mappers may have made their colours meanwhile
}

penumbra::RenderSettings vtkPenumbraRayCaster::Internals::MakeSettings(vtkPenumbraRayCaster* self)
{
  penumbra::RenderSettings settings;
  settings.Packets = self->Packets;
  settings.Integration.Method =
    static_cast<penumbra::IntegrationSettings::Methods>(self->CoverageMethod);
  settings.Integration.Tolerance = self->Tolerance;
  settings.Integration.MaximumLevel = self->MaximumLevel;
  settings.Integration.FindSmallObjects = self->FindSmallObjects;
  settings.Integration.Shadows = self->Shadows;
  settings.Integration.UniformSamples = self->UniformSamples;
  settings.Integration.Noise =
    self->AmbientOcclusion || self->IndirectLight ? OcclusionNoiseShare * self->Tolerance : 0.0;
  return settings;
}

bool vtkPenumbraRayCaster::Internals::BeginSource(
  vtkPenumbraRayCaster* self, penumbra::CameraRayTracer& sampler)
{
  const double noise = OcclusionNoiseShare * self->Tolerance;
  const bool occlusion = self->AmbientOcclusion || self->GeometryArrays;
  const double half = occlusion && self->IndirectLight ? .5 : 1.0;
  double done = 0.0;
  const auto progress = [&](double share) {
    return TellProgress(self, ProgressOfSource * (done + half * share));
  };
  if (occlusion)
  {
    const double radius = self->AmbientOcclusionRadius > 0.0
      ? self->AmbientOcclusionRadius
      : penumbra::DefaultRadiusFraction * GetDiagonal(this->Prepared->Drawn);
    if (!this->IrradianceSource->Begin(
          *this->Prepared->Rays, { radius, self->AmbientOcclusionFalloff }, noise, progress))
    {
      return false;
    }
    done = half;
  }
  if (self->AmbientOcclusion)
  {
    sampler.SetOcclusion(this->IrradianceSource, self->AmbientOcclusionStrength, noise);
  }
  if (self->IndirectLight && self->Albedo > 0.0)
  {
    const double* color = self->EnvironmentColor;
    penumbra::IlluminationSettings settings;
    settings.Environment = glm::max(glm::dvec3(color[0], color[1], color[2]), glm::dvec3(0.0));
    settings.Picture = this->Environment ? this->Environment->GetMap() : nullptr;
    settings.Albedo = static_cast<float>(self->Albedo);
    settings.Bounces = self->Bounces;
    settings.Shadows = self->Shadows;
    const penumbra::Illumination light(*this->Prepared->Rays, settings);
    // Of the irradiance, Albedo / pi is seen.
    const double tolerance = noise * vtkMath::Pi() / self->Albedo;
    sampler.SetIndirectLight(this->IrradianceSource, settings.Albedo, tolerance);
    return this->IrradianceSource->BeginIrradiance(light, tolerance, progress);
  }
  return true;
}

bool vtkPenumbraRayCaster::Internals::Execute(vtkPenumbraRayCaster* self, vtkImageData* image)
{
  const penumbra::Scene& scene = this->Prepared->Drawn;
  if (TellProgress(self, ProgressOfScene))
  {
    return false;
  }
  const penumbra::Shading shading(*this->Prepared->Rays, self->Shadows);
  penumbra::CameraRayTracer sampler(*this->Prepared->Rays, shading, scene.ViewCamera);
  const penumbra::RenderSettings settings = MakeSettings(self);
  const bool asks = self->AmbientOcclusion || self->IndirectLight || self->GeometryArrays;
  if (asks && !this->BeginSource(self, sampler))
  {
    return false;
  }

  std::string warning;
  const std::optional<penumbra::LightShafts> shafts = penumbra::MakeLightShafts(
    this->Medium, shading, GetDiagonal(scene), { self->Tolerance, self->LightShaftSteps }, warning);
  sampler.SetShafts(shafts ? &*shafts : nullptr);
  if (!warning.empty())
  {
    vtkWarningWithObjectMacro(self, << warning);
  }

  const double begun = asks ? ProgressOfSource : 0.0;
  const double ended = self->GeometryArrays ? 1.0 - ProgressOfGeometry : 1.0;
  const auto progress = [self, begun, ended](double done) {
    return TellProgress(self, begun + (ended - begun) * done);
  };
  penumbra::ImageRegion totals;
  double squaredError = 0.0;
  if (!penumbra::RenderImage(
        sampler, this->Prepared->Edges, settings, progress, image, totals, squaredError))
  {
    return false;
  }
  // What colours err by themselves is the source's to keep.
  const double limit = std::hypot(self->Tolerance, 0.5 * settings.Integration.Noise);
  const penumbra::TileErrors judged = penumbra::JudgeTiles(image, limit);
  if (self->CoverageMethod != UNIFORM && judged.Over > 0)
  {
    vtkWarningWithObjectMacro(self,
      "The tolerance of " << self->Tolerance << " was not reached in " << judged.Over << " of "
                          << judged.Tiles << " tiles of 16x16 pixels: the worst of them is believed"
                          << " to err by " << judged.Worst << ".");
  }
  if (self->GeometryArrays)
  {
    sampler.SetOcclusion(this->IrradianceSource, self->AmbientOcclusionStrength,
      OcclusionNoiseShare * self->Tolerance);
    const auto geometry = [self, ended](double done) {
      return TellProgress(self, ended + (1.0 - ended) * done);
    };
    if (!penumbra::AddGeometryArrays(sampler, geometry, image, totals.Rays))
    {
      return false;
    }
  }
  this->Report(totals, squaredError, image->GetNumberOfPoints());
  if (asks)
  {
    this->IrradianceSource->Report(this->Statistics);
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
  AddStatistic(s, "Rays/PerPixel", static_cast<double>(rays.InPicture()) / pixels);
  AddStatistic(s, "Pixels/Total", pixels);
  AddStatistic(s, "Pixels/Empty", totals.Pixels.Empty);
  AddStatistic(s, "Pixels/Interior", totals.Pixels.Interior);
  AddStatistic(s, "Pixels/Edge", totals.Pixels.Border);
  AddStatistic(s, "Pixels/SmallObject", totals.Pixels.Small);
  AddStatistic(s, "Pixels/Refined", totals.Pixels.Refined);
  AddStatistic(s, "Pixels/Uniform", totals.Pixels.Uniform);
  AddStatistic(s, "Edges/Projected", totals.Edges);
  this->EstimatedError = std::sqrt(squaredError / pixels);
}

void vtkPenumbraRayCaster::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Renderer: " << this->Implementation->Renderer.Get() << "\n";
  os << indent << "IrradianceSource: " << this->Implementation->IrradianceSource.Get() << "\n";
  os << indent << "Resolution: " << this->Resolution[0] << " " << this->Resolution[1] << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "CoverageMethod: " << this->CoverageMethod << "\n";
  os << indent << "UniformSamples: " << this->UniformSamples << "\n";
  os << indent << "MaximumLevel: " << this->MaximumLevel << "\n";
  os << indent << "FindSmallObjects: " << this->FindSmallObjects << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
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
  os << indent << "Packets: " << this->Packets << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "DPI: " << this->DPI << "\n";
  os << indent << "EstimatedError: " << this->Implementation->EstimatedError << "\n";
}
