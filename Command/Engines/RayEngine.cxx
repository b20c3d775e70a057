// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CollectionItems.h"
#include "Engine.h"

#include "Files/FileExtension.h"
#include "Files/ImageFiles.h"
#include "Files/Report.h"
#include "Input/EnvironmentFile.h"
#include "Input/Readers.h"
#include "Input/Surfaces.h"
#include "MediumSetup.h"
#include "ObjectNames.h"
#include "Options/RenderOptions.h"
#include "Options/SharedOptions.h"
#include "Processes/Clock.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/OptionNames.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPenumbraCubeMapGatherer.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkPenumbraVectorExporter.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"

#include <chrono>
#include <cmath>

namespace penumbra
{

namespace
{

struct AlgorithmObserver
{
  const ProgressListener& Listener;
  Clock::time_point FirstRay;
  bool Started = false;
};

// The first progress above 0 is reported when the scene is built.
void OnProgress(vtkObject*, unsigned long, void* clientData, void* callData)
{
  AlgorithmObserver& observer = *static_cast<AlgorithmObserver*>(clientData);
  if (!observer.Started && *static_cast<double*>(callData) > 0.0)
  {
    observer.Started = true;
    observer.FirstRay = Clock::now();
  }
  observer.Listener(*static_cast<double*>(callData));
}

// Replaces `CellId` of extracted surfaces by the cell id in the data set of the file. The former array
// is not changed.
void RestoreCellIds(vtkImageData* image, vtkRenderer* renderer)
{
  vtkDataArray* objects = image->GetPointData()->GetArray("ObjectId");
  vtkDataArray* extracted = image->GetPointData()->GetArray("CellId");
  if (!objects || !extracted)
  {
    return;
  }
  const auto cells = vtkSmartPointer<vtkDataArray>::Take(extracted->NewInstance());
  cells->DeepCopy(extracted);
  std::vector<vtkDataArray*> originals;
  for (vtkActor* actor : GetItems<vtkActor>(renderer->GetActors()))
  {
    originals.push_back(actor->GetMapper()->GetInput()->GetCellData()->GetArray(OriginalCellIds));
  }
  for (vtkIdType i = 0; i < cells->GetNumberOfTuples(); ++i)
  {
    const int object = static_cast<int>(objects->GetComponent(i, 0));
    const vtkIdType cell = static_cast<vtkIdType>(cells->GetComponent(i, 0));
    const bool known = object >= 0 && object < static_cast<int>(originals.size());
    if (known && originals[object] && cell >= 0 && cell < originals[object]->GetNumberOfTuples())
    {
      cells->SetComponent(i, 0, originals[object]->GetComponent(cell, 0));
    }
  }
  image->GetPointData()->AddArray(cells);
}

vtkSmartPointer<vtkImageData> ReadDensity(const std::string& path)
{
  std::vector<std::string> warnings;
  const vtkSmartPointer<vtkDataObject> data = ReadFile(path, std::nullopt, warnings);
  NameFile(path, warnings);
  PrintWarnings(warnings);
  const std::string invalid = vtkPenumbraMedium::FindInvalidDensity(data);
  if (!invalid.empty())
  {
    throw CommandError(BadInput, "--shafts-density: " + path + " " + NameOptions(invalid));
  }
  return vtkImageData::SafeDownCast(data);
}

vtkSmartPointer<vtkPenumbraMedium> MakeMedium(const ShaftOptions& shafts, vtkRenderer* renderer)
{
  vtkNew<vtkPenumbraMedium> medium;
  SetUpMedium(shafts, renderer, medium);
  if (!shafts.Density.empty())
  {
    medium->SetDensity(ReadDensity(shafts.Density));
  }
  medium->SetSurfaceLight(shafts.SurfaceLight == "attenuated" ? vtkPenumbraMedium::ATTENUATED
      : shafts.SurfaceLight == "unattenuated"                 ? vtkPenumbraMedium::UNATTENUATED
                                                              : vtkPenumbraMedium::AUTOMATIC);
  medium->SetTranslucentSurfaces(!shafts.BehindTranslucent);
  return medium;
}

int FindVectorFormat(const std::string& path)
{
  return LowerExtension(path) == ".pdf" ? vtkPenumbraVectorExporter::PDF
                                        : vtkPenumbraVectorExporter::SVG;
}

/// Returns true if --cache chooses between records and joined pixels.
bool ChoosesCache(const RenderOptions& options)
{
  return options.Cache == "auto" && options.Gatherer == "rays";
}

/// Returns true if occlusion or indirect light may be interpolated between records. Only joined pixels
/// end at a time limit, and both quantities are joined if one is.
bool MayUseCache(const RenderOptions& options)
{
  return ChoosesCache(options)
    ? options.Light.Indirect && !options.AmbientOcclusion && options.TimeLimit == 0.0
    : options.Cache != "none" && (options.AmbientOcclusion || options.Light.Indirect);
}

vtkSmartPointer<vtkPenumbraRayCaster> MakeCaster(
  vtkRenderer* renderer, const RenderOptions& options)
{
  auto caster = vtkSmartPointer<vtkPenumbraRayCaster>::New();
  caster->SetRenderer(renderer);
  caster->SetResolution(options.Resolution[0], options.Resolution[1]);
  caster->SetTolerance(options.Tolerance);
  caster->SetLightTolerance(options.LightTolerance);
  caster->SetTimeLimit(options.TimeLimit);
  caster->GetConstants().MaximumLevel = options.MaximumLevel;
  caster->GetConstants().FindSmallObjects = options.FindSmallObjects;
  caster->SetNumberOfThreads(options.Threads);
  caster->SetShadows(options.Shadows || options.LightRadius > 0.0 || options.LightAngle > 0.0);
  caster->SetLightRadius(options.LightRadius);
  caster->SetLightAngle(options.LightAngle);
  if (options.Shafts.Enabled)
  {
    caster->SetMedium(MakeMedium(options.Shafts, renderer));
  }
  caster->SetAmbientOcclusion(options.AmbientOcclusion);
  caster->SetAmbientOcclusionRadius(
    std::min(options.AmbientOcclusionRadius, std::numeric_limits<double>::max()));
  caster->SetAmbientOcclusionFalloff(FindFalloff(options.AmbientOcclusionFalloff));
  caster->SetAmbientOcclusionStrength(
    std::isnan(options.AmbientOcclusionStrength) ? -1.0 : options.AmbientOcclusionStrength);
  const LightOptions& light = options.Light;
  caster->SetIndirectLight(light.Indirect);
  const Vector3 environment =
    light.EnvironmentColor.value_or(options.BackgroundColor.value_or(Vector3{ 0.0, 0.0, 0.0 }));
  caster->SetEnvironmentColor(environment[0], environment[1], environment[2]);
  if (light.Indirect && !light.EnvironmentFile.empty())
  {
    caster->SetEnvironment(ReadEnvironment(light.EnvironmentFile, light.EnvironmentUp));
  }
  caster->SetAlbedo(light.Albedo);
  caster->SetBounces(light.Bounces);
  if (MayUseCache(options))
  {
    vtkNew<vtkPenumbraIrradianceCache> cache;
    cache->SetJoinPixels(ChoosesCache(options));
    cache->SetSpace(options.Cache == "screen" ? vtkPenumbraIrradianceCache::SCREEN
                                              : vtkPenumbraIrradianceCache::WORLD);
    if (options.Gatherer == "cube-map")
    {
      cache->SetGatherer(vtkNew<vtkPenumbraCubeMapGatherer>());
    }
    caster->SetIrradianceProvider(cache);
  }
  caster->SetBackground(options.Background);
  caster->SetDPI(options.DotsPerInch);
  caster->SetPointRadius(options.PointRadius);
  caster->SetLineRadius(options.LineRadius);
  caster->SetGeometryArrays(HoldsArrays(options.Output));
  caster->GetConstants().OcclusionArray = options.AmbientOcclusion || options.OcclusionArray;
  return caster;
}

RenderResult Draw(vtkPenumbraRayCaster* caster, vtkRenderer* renderer, const RenderOptions& options,
  const ProgressListener& progress)
{
  AlgorithmObserver state{ progress, Clock::now() };
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(OnProgress);
  observer->SetClientData(&state);
  caster->AddObserver(vtkCommand::ProgressEvent, observer);

  RenderResult result;
  const unsigned long warningObserver = CollectWarnings(caster, result.Warnings);

  TakeErrors();
  const Clock::time_point start = Clock::now();
  vtkNew<vtkPenumbraVectorExporter> exporter;
  if (IsVectorGraphic(options.Output))
  {
    exporter->SetRayCaster(caster);
    exporter->SetMaximumPaths(options.MaximumPaths);
    exporter->SetOutlineWidth(options.OutlineWidth);
    result.VectorGraphics = exporter->Encode(FindVectorFormat(options.Output));
  }
  else
  {
    caster->Update();
  }
  const Clock::time_point end = Clock::now();
  caster->RemoveObserver(observer);
  caster->RemoveObserver(warningObserver);
  for (std::string& warning : result.Warnings)
  {
    warning = NameObjects(warning, renderer);
  }
  ThrowErrors("--engine ray");

  result.Image = vtkSmartPointer<vtkImageData>::New();
  result.Image->ShallowCopy(caster->GetOutput());
  RestoreCellIds(result.Image, renderer);
  result.Statistics = ToTable(caster->GetStatistics());
  const ReportTable figure = ToTable(exporter->GetStatistics());
  for (const auto& [name, value] : figure)
  {
    result.Statistics[name] = value;
  }
  if (!exporter->GetImageReason().empty())
  {
    result.Statistics["Vector/ImageReason"] = exporter->GetImageReason();
  }
  const bool empty = result.Statistics["Pixels/Empty"] == result.Statistics["Pixels/Total"] &&
    (figure.count("Vector/Lines") == 0 || figure.at("Vector/Lines") == ReportValue(0LL));
  result.Coverage = empty ? RenderResult::Coverages::Empty : RenderResult::Coverages::Some;
  result.Tolerance = options.Tolerance;
  result.LightTolerance = caster->GetEffectiveLightTolerance();
  result.EstimatedError = caster->GetEstimatedError();
  result.EstimatedLightError = caster->GetEstimatedLightError();
  result.Threads =
    options.Threads > 0 ? options.Threads : vtkSMPTools::GetEstimatedNumberOfThreads();
  const Clock::time_point firstRay = state.Started ? state.FirstRay : start;
  result.BuildSeconds = std::chrono::duration<double>(firstRay - start).count();
  result.RenderSeconds = std::chrono::duration<double>(end - firstRay).count();
  return result;
}

}

RenderResult RenderWithRays(
  vtkRenderer* renderer, const RenderOptions& options, const ProgressListener& progress)
{
  return Draw(MakeCaster(renderer, options), renderer, options, progress);
}

std::function<RenderResult(const ProgressListener&)> PrepareRays(
  vtkRenderer* renderer, const RenderOptions& options)
{
  const vtkSmartPointer<vtkPenumbraRayCaster> caster = MakeCaster(renderer, options);
  caster->KeepSceneOn();
  return [caster, options, scene = vtkSmartPointer<vtkRenderer>(renderer)](
           const ProgressListener& progress) { return Draw(caster, scene, options, progress); };
}

}
