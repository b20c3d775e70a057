// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraRayCaster.h"

#include "GeometryArrays.h"
#include "Picture.h"
#include "SceneExtraction.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraBruteForceSource.h"
#include "vtkPointData.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace
{

// Parts of a picture are rendered one after the other, so that memory stays bounded: whole rows of
// tiles with about this many pixels.
constexpr int PixelsPerPart = 1 << 22;
constexpr int Alignment = 32;

// Reach of an occluder as a share of the scene's diagonal, where none is given.
constexpr double DefaultRadiusShare = 0.1;
// A pixel is the mean of about four answers of the irradiance source, so each may err twice as much.
constexpr double OcclusionNoiseShare = 2.0;

void AddStatistic(vtkFieldData* statistics, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  statistics->AddArray(array);
}

/// The latest change of anything that the picture of `renderer` shows.
vtkMTimeType GetSceneMTime(vtkRenderer* renderer)
{
  vtkMTimeType time = renderer->GetMTime();
  if (renderer->IsActiveCameraCreated())
  {
    time = std::max(time, renderer->GetActiveCamera()->GetMTime());
  }
  vtkCollectionSimpleIterator iterator;
  vtkLightCollection* lights = renderer->GetLights();
  lights->InitTraversal(iterator);
  while (vtkLight* light = lights->GetNextLight(iterator))
  {
    time = std::max(time, light->GetMTime());
  }
  vtkPropCollection* props = renderer->GetViewProps();
  time = std::max(time, props->GetMTime());
  props->InitTraversal(iterator);
  while (vtkProp* prop = props->GetNextProp(iterator))
  {
    time = std::max({ time, prop->GetMTime(), prop->GetRedrawMTime() });
  }
  return time;
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

vtkSmartPointer<vtkFloatArray> AddFloatArray(vtkImageData* image, const char* name, int components)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
  return array;
}

}

struct vtkPenumbraRayCaster::Internals
{
  vtkSmartPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkPenumbraIrradianceSource> IrradianceSource;
  vtkNew<vtkFieldData> Statistics;
  double EstimatedError = 0.0;

  bool Execute(vtkPenumbraRayCaster* self, const penumbra::Scene& scene, vtkImageData* image);
  void Report(const penumbra::Picture& totals, double squaredError, vtkIdType pixels);
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

void vtkPenumbraRayCaster::SetIrradianceSource(vtkPenumbraIrradianceSource* source)
{
  if (this->Implementation->IrradianceSource != source)
  {
    this->Implementation->IrradianceSource = source;
    this->Modified();
  }
}

vtkPenumbraIrradianceSource* vtkPenumbraRayCaster::GetIrradianceSource()
{
  return this->Implementation->IrradianceSource;
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
    time = std::max(time, GetSceneMTime(this->Implementation->Renderer));
  }
  if (this->Implementation->IrradianceSource)
  {
    time = std::max(time, this->Implementation->IrradianceSource->GetMTime());
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
  if (this->Resolution[0] < 1 || this->Resolution[1] < 1)
  {
    vtkErrorMacro("Resolution must be at least 1 x 1.");
    return 0;
  }

  penumbra::ExtractionOptions options;
  options.Resolution[0] = this->Resolution[0];
  options.Resolution[1] = this->Resolution[1];
  options.DPI = this->DPI;
  options.Background = this->Background;
  try
  {
    penumbra::Scene scene;
    if (this->Implementation->Renderer)
    {
      scene = penumbra::ExtractScene(this->Implementation->Renderer, options);
    }
    else
    {
      std::vector<vtkDataObject*> data;
      for (int i = 0; i < inputs[0]->GetNumberOfInformationObjects(); ++i)
      {
        data.push_back(vtkDataObject::GetData(inputs[0], i));
      }
      scene = penumbra::ExtractScene(data, options);
    }
    for (const std::string& warning : scene.Warnings)
    {
      vtkWarningMacro(<< warning);
    }
    bool finished = true;
    vtkSMPTools::LocalScope(vtkSMPTools::Config(this->NumberOfThreads),
      [&]() { finished = this->Implementation->Execute(this, scene, image); });
    if (!finished)
    {
      image->Initialize();
    }
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

bool vtkPenumbraRayCaster::Internals::Execute(
  vtkPenumbraRayCaster* self, const penumbra::Scene& scene, vtkImageData* image)
{
  const penumbra::RayScene rays(scene, self->NumberOfThreads);
  self->UpdateProgress(0.0); // The scene is built.
  const penumbra::Shading shading(rays, self->Shadows);
  penumbra::Sampler sampler(rays, shading, scene.Eye);

  penumbra::PictureSettings settings;
  settings.Packets = self->Packets;
  settings.Integration.Method =
    static_cast<penumbra::IntegrationSettings::Methods>(self->CoverageMethod);
  settings.Integration.Tolerance = self->Tolerance;
  settings.Integration.MaximumLevel = self->MaximumLevel;
  settings.Integration.SmallObjects = self->SmallObjects;
  settings.Integration.Shadows = self->Shadows;
  settings.Integration.UniformSamples = self->UniformSamples;
  if (self->AmbientOcclusion || self->GeometryArrays)
  {
    if (!this->IrradianceSource)
    {
      this->IrradianceSource = vtkSmartPointer<vtkPenumbraBruteForceSource>::New();
    }
    const double radius = self->AmbientOcclusionRadius > 0.0
      ? self->AmbientOcclusionRadius
      : DefaultRadiusShare * GetDiagonal(scene);
    const double noise = OcclusionNoiseShare * self->Tolerance;
    this->IrradianceSource->Begin(rays, radius, noise);
    if (self->AmbientOcclusion)
    {
      settings.Integration.Noise = noise;
      sampler.SetOcclusion(this->IrradianceSource, self->AmbientOcclusionStrength);
    }
  }

  const auto color = AddFloatArray(image, "Color", 4);
  image->GetPointData()->SetActiveScalars("Color");
  const auto rayShares = AddFloatArray(image, "Rays", 1);
  const auto errors = AddFloatArray(image, "EstimatedError", 1);

  int extent[6];
  image->GetExtent(extent);
  const int width = extent[1] - extent[0] + 1;
  const int height = extent[3] - extent[2] + 1;
  const int left = extent[0] / Alignment * Alignment;
  const int right = std::min((extent[1] / Alignment + 1) * Alignment, self->Resolution[0]);
  const int bottom = extent[2] / Alignment * Alignment;
  const int rows = std::max(PixelsPerPart / std::max(right - left, 1) / Alignment, 1) * Alignment;

  penumbra::Picture totals;
  double squaredError = 0.0;
  for (int low = bottom; low <= extent[3]; low += rows)
  {
    const int high =
      std::min({ low + rows, (extent[3] / Alignment + 1) * Alignment, self->Resolution[1] });
    penumbra::Picture part;
    part.Low = { left, low };
    part.High = { right, high };
    const double done = static_cast<double>(std::max(low, extent[2]) - extent[2]) / height;
    const double share = static_cast<double>(high - low) / height;
    const auto progress = [&](double inPart) {
      self->UpdateProgress(std::min(done + share * inPart, 1.0));
      return self->GetAbortExecute() != 0;
    };
    if (!penumbra::RenderPicture(sampler, settings, progress, part))
    {
      return false;
    }
    for (int y = std::max(low, extent[2]); y < std::min(high, extent[3] + 1); ++y)
    {
      const std::size_t from = part.Index(extent[0], y);
      const vtkIdType to = static_cast<vtkIdType>(y - extent[2]) * width;
      scene.Over.PutOver(extent[0], y, width, &part.Colors[from]);
      std::copy_n(&part.Colors[from].x, 4 * width, color->GetPointer(4 * to));
      std::copy_n(&part.RayShares[from], width, rayShares->GetPointer(to));
      std::copy_n(&part.Errors[from], width, errors->GetPointer(to));
      for (int x = 0; x < width; ++x)
      {
        squaredError += static_cast<double>(part.Errors[from + x]) * part.Errors[from + x];
      }
    }
    totals.Rays += part.Rays;
    totals.Pixels += part.Pixels;
    totals.Edges = std::max(totals.Edges, part.Edges);
  }
  const vtkIdType pixels = static_cast<vtkIdType>(width) * height;
  if (self->GeometryArrays)
  {
    sampler.SetOcclusion(this->IrradianceSource, self->AmbientOcclusionStrength);
    const auto aborted = [self](double) { return self->GetAbortExecute() != 0; };
    if (!penumbra::AddGeometryArrays(sampler, aborted, image, totals.Rays))
    {
      return false;
    }
  }
  this->Report(totals, squaredError, pixels);
  image->GetFieldData()->ShallowCopy(this->Statistics);
  return true;
}

void vtkPenumbraRayCaster::Internals::Report(
  const penumbra::Picture& totals, double squaredError, vtkIdType pixels)
{
  const penumbra::RayCounts& rays = totals.Rays;
  vtkFieldData* s = this->Statistics;
  s->Initialize();
  AddStatistic(s, "Rays/Primary", rays.Primary);
  AddStatistic(s, "Rays/Refinement", rays.Refinement);
  AddStatistic(s, "Rays/Shadow", rays.Shadow);
  AddStatistic(s, "Rays/Occlusion", rays.Occlusion);
  AddStatistic(s, "Rays/Auxiliary", rays.Auxiliary);
  AddStatistic(s, "Rays/Total",
    rays.Primary + rays.Refinement + rays.Shadow + rays.Occlusion + rays.Auxiliary);
  AddStatistic(s, "Rays/PerPixel", static_cast<double>(rays.InPicture()) / pixels);
  AddStatistic(s, "Pixels/Total", pixels);
  AddStatistic(s, "Pixels/Empty", totals.Pixels.Empty);
  AddStatistic(s, "Pixels/Interior", totals.Pixels.Interior);
  AddStatistic(s, "Pixels/Border", totals.Pixels.Border);
  AddStatistic(s, "Pixels/Small", totals.Pixels.Small);
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
  os << indent << "SmallObjects: " << this->SmallObjects << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
  os << indent << "AmbientOcclusion: " << this->AmbientOcclusion << "\n";
  os << indent << "AmbientOcclusionRadius: " << this->AmbientOcclusionRadius << "\n";
  os << indent << "AmbientOcclusionStrength: " << this->AmbientOcclusionStrength << "\n";
  os << indent << "GeometryArrays: " << this->GeometryArrays << "\n";
  os << indent << "Background: " << this->Background << "\n";
  os << indent << "Packets: " << this->Packets << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "DPI: " << this->DPI << "\n";
  os << indent << "EstimatedError: " << this->Implementation->EstimatedError << "\n";
}
