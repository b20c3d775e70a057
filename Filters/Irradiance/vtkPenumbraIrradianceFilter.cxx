// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraIrradianceFilter.h"

#include "Baking/BakeInput.h"
#include "Baking/BakedArrays.h"
#include "Baking/Baking.h"
#include "Baking/CompositeMesh.h"
#include "Baking/Contacts.h"
#include "Baking/DirectLight.h"
#include "Baking/OcclusionBaking.h"
#include "Distribution/OccluderDistribution.h"
#include "Embree/RayScene.h"
#include "Gathering/IrradianceConstants.h"
#include "Gathering/RayGatherer.h"
#include "LightWarnings.h"
#include "Records/Interreflection.h"
#include "Statistics/Statistics.h"
#include "Surface.h"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraGatherer.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace
{

using namespace penumbra;

/// Distance up to which a record is used toward a wall, as a fraction of the wall's distance. Points
/// of a mesh often lie in the plane of a wall, whose edge decides what they see.
constexpr float WallFraction = 0.9f;

/// Adds the light of suns and sampled emitters, which records do not include, to the values that are not
/// `complete`. Returns false if stopped.
bool AddSampledLight(const Illumination& light, const std::vector<RecordCandidate>& sites,
  const std::vector<char>& complete, double tolerance, const ProgressCallback& progress,
  BakedValues& baked)
{
  std::atomic<long long> rays(0);
  const bool done =
    ParallelForWithProgress(static_cast<int>(sites.size()), 1.0, 1.0, progress, [&](int i) {
      if (complete[i])
      {
        return;
      }
      long long count = 0;
      const auto sampled =
        light.EstimateSampledLight(sites[i].Position, sites[i].GetNormals(), tolerance, count);
      baked.Values[i].Mean += sampled.Mean;
      baked.Values[i].Error = std::hypot(baked.Values[i].Error, sampled.Error);
      rays += count;
    });
  baked.BruteForceRays += rays;
  return done;
}

}

/// State of one execution.
struct vtkPenumbraIrradianceFilter::Work
{
  BakeInput Mesh;
  std::unique_ptr<RayScene> Rays;
  RecordPlacementSettings Settings;
  RecordOctree Tree;
  BakedValues Baked;
  std::unique_ptr<Interreflection> Reflections; ///< null for occlusion
  ProgressCallback Progress;
};

vtkStandardNewMacro(vtkPenumbraIrradianceFilter);

vtkPenumbraIrradianceFilter::vtkPenumbraIrradianceFilter()
  : Statistics(vtkSmartPointer<vtkFieldData>::New()),
    EstimatedError(std::nan(""))
{
  this->SetNumberOfInputPorts(2);
}

vtkPenumbraIrradianceFilter::~vtkPenumbraIrradianceFilter()
{
  this->SetOpacityArray(nullptr);
}

vtkCxxSetSmartPointerMacro(vtkPenumbraIrradianceFilter, Environment, vtkPenumbraEnvironment);

void vtkPenumbraIrradianceFilter::AddLight(double x, double y, double z, double w)
{
  this->Lights.push_back({ x, y, z, w });
  this->Modified();
}

void vtkPenumbraIrradianceFilter::RemoveAllLights()
{
  this->Lights.clear();
  this->Modified();
}

vtkPenumbraEnvironment* vtkPenumbraIrradianceFilter::GetEnvironment()
{
  return this->Environment;
}

vtkCxxSetSmartPointerMacro(vtkPenumbraIrradianceFilter, Gatherer, vtkPenumbraGatherer);

vtkPenumbraGatherer* vtkPenumbraIrradianceFilter::GetGatherer()
{
  return this->Gatherer;
}

vtkMTimeType vtkPenumbraIrradianceFilter::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->Environment)
  {
    time = std::max(time, this->Environment->GetMTime());
  }
  if (this->Gatherer)
  {
    time = std::max(time, this->Gatherer->GetMTime());
  }
  return time;
}

vtkFieldData* vtkPenumbraIrradianceFilter::GetStatistics()
{
  return this->Statistics;
}

int vtkPenumbraIrradianceFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  // Execute() rejects other types with a remedy, which VTK's message lacks.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

void vtkPenumbraIrradianceFilter::SetDistribution(penumbra::OccluderDistribution* distribution)
{
  this->Distribution = distribution;
}

void vtkPenumbraIrradianceFilter::Execute(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* surroundings = vtkPolyData::GetData(inputs[1]);
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  vtkPointSet* input = vtkPointSet::GetData(inputs[0]);
  if (!input && !vtkCompositeDataSet::GetData(inputs[0]))
  {
    throw std::runtime_error(std::string("The input is a ") +
      vtkDataObject::GetData(inputs[0])->GetClassName() +
      ", not a vtkPointSet. Extract its surface with vtkGeometryFilter (Extract Surface "
      "in ParaView) and bake that.");
  }
  const int pieces = outputs->GetInformationObject(0)->Get(
    vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
  if (this->Distribution)
  {
    this->Distribution->GetRanks().Compare(this->ListSettings());
  }
  else if (pieces > 1 && !surroundings)
  {
    vtkWarningMacro("The input is one of "
      << pieces
      << " pieces, and the other pieces do not occlude it. Set their surfaces "
         "on input port 1, or use vtkPenumbraDistributedIrradianceFilter.");
  }
  std::vector<std::string> warnings;
  if (auto* composite = vtkCompositeDataSet::GetData(inputs[0]))
  {
    const CompositeMesh blocks(composite);
    if (blocks.GetNumberOfSkippedBlocks() > 0)
    {
      vtkWarningMacro(<< blocks.GetNumberOfSkippedBlocks()
                      << " blocks were skipped because they are not vtkPointSets. Extract their "
                         "surfaces with vtkGeometryFilter (Extract Surface in ParaView).");
    }
    vtkPointSet* joined = blocks.GetMerged();
    const auto baked = vtkSmartPointer<vtkPointSet>::Take(joined->NewInstance());
    baked->ShallowCopy(joined);
    warnings = this->BakeOnto(joined, surroundings, baked);
    blocks.Distribute(baked, vtkCompositeDataSet::SafeDownCast(output));
  }
  else
  {
    output->ShallowCopy(input);
    warnings = this->BakeOnto(input, surroundings, vtkPointSet::SafeDownCast(output));
  }
  for (int i = 0; i < this->Statistics->GetNumberOfArrays(); ++i)
  {
    output->GetFieldData()->AddArray(this->Statistics->GetAbstractArray(i));
  }
  if (this->Distribution)
  {
    // All ranks have finished; none may fail after this.
    this->Distribution->GetRanks().UniteSentences(warnings);
  }
  this->Warn(warnings);
}

std::vector<std::string> vtkPenumbraIrradianceFilter::BakeOnto(
  vtkPointSet* input, vtkPolyData* surroundings, vtkPointSet* output)
{
  BakeInputOptions options;
  options.OnCells = this->OnCells;
  options.ComputeNormals = this->ComputeNormals;
  options.PointRadius = this->PointRadius;
  options.LineRadius = this->LineRadius;
  options.OpacityArray = this->OpacityArray ? this->OpacityArray : "";
  Work work;
  work.Progress = [this](double fraction) {
    if (!this->GetAbortExecute())
    {
      this->UpdateProgress(fraction);
    }
    return this->GetAbortExecute() != 0;
  };
  options.Ranks = this->Distribution ? &this->Distribution->GetRanks() : nullptr;
  BakeInput& mesh = work.Mesh;
  mesh = PrepareBakeInput(input, options, work.Progress);
  if (surroundings)
  {
    AddOccluders(surroundings, options, mesh, work.Progress);
  }
  UniteBounds(options, mesh);
  this->Warn(DescribeDefects(options, mesh));
  if (this->Quantity == DIRECT_LIGHT)
  {
    mesh.OccluderScene.Lights =
      MakeLights({ this->Lights, this->LightRadius, this->LightAngle }, mesh.OccluderScene);
  }
  if (this->Distribution)
  {
    this->Exchange(work);
  }
  std::vector<std::string> warnings = DescribeLightOverlaps(mesh.OccluderScene);
  work.Rays = std::make_unique<RayScene>(mesh.OccluderScene, this->NumberOfThreads, work.Progress);
  SeparateContacts(*work.Rays, mesh, work.Progress);
  work.Tree.Initialize(glm::vec3(0.f), .5f);
  work.Settings.MaximumRadiusPixels = MaximumRadiusPixels;
  const bool done = this->Quantity == IRRADIANCE ? this->BakeIrradiance(work)
    : this->Quantity == DIRECT_LIGHT
    ? BakeDirectLight(*work.Rays, mesh.Sites, this->Tolerance, work.Progress, work.Baked)
    : this->BakeOcclusion(work);
  if (!done)
  {
    throw Stopped();
  }
  if (this->Quantity == IRRADIANCE)
  {
    warnings.push_back(DescribeBlack(work.Baked, options.Ranks));
  }
  if (this->Quantity == AMBIENT_OCCLUSION)
  {
    warnings.push_back(DescribeOccluded(work.Baked, options.Ranks));
  }
  vtkDataSetAttributes* attributes = this->OnCells
    ? static_cast<vtkDataSetAttributes*>(output->GetCellData())
    : static_cast<vtkDataSetAttributes*>(output->GetPointData());
  const vtkIdType size = this->OnCells ? input->GetNumberOfCells() : input->GetNumberOfPoints();
  attributes->AddArray(this->Quantity == IRRADIANCE
      ? CreateArray(mesh, work.Baked, size, "Irradiance", 3, static_cast<float>(vtkMath::Pi()))
      : CreateArray(mesh, work.Baked, size,
          this->Quantity == DIRECT_LIGHT ? "DirectLight" : "AmbientOcclusion", 1, 1.f));
  this->Report(work, size);
  return warnings;
}

double vtkPenumbraIrradianceFilter::ComputeRadius(const Work& work) const
{
  return this->Radius > 0.0 ? this->Radius : DefaultRadiusFraction * work.Mesh.Diagonal;
}

void vtkPenumbraIrradianceFilter::Exchange(Work& work)
{
  Scene& scene = work.Mesh.OccluderScene;
  std::vector<glm::vec3> points;
  for (const RecordCandidate& site : work.Mesh.Sites)
  {
    points.push_back(site.Position);
  }
  std::optional<double> radius = std::numeric_limits<double>::infinity();
  if (this->Quantity == AMBIENT_OCCLUSION)
  {
    radius = this->ComputeRadius(work) * scene.Scale;
  }
  else if (this->Quantity == DIRECT_LIGHT)
  {
    radius.reset();
  }
  const std::uint32_t first = this->Distribution->Exchange(scene, points, radius);
  for (std::uint32_t& corner : work.Mesh.Corners)
  {
    corner += first;
  }
}

bool vtkPenumbraIrradianceFilter::BakeOcclusion(Work& work)
{
  const Scene& scene = work.Mesh.OccluderScene;
  const double radius = this->ComputeRadius(work);
  const OcclusionBakingSettings settings{ this->Tolerance, { radius, this->Falloff },
    this->Method == AUTOMATIC };
  const OcclusionGatherer rayGatherer(
    *work.Rays, penumbra::DistanceFalloff::InScene(radius, this->Falloff, scene.Scale));
  const std::unique_ptr<penumbra::Gatherer> customGatherer =
    this->Gatherer && settings.UsesRecords ? this->Gatherer->Make(rayGatherer) : nullptr;
  return penumbra::BakeOcclusion(work.Mesh, *work.Rays,
    customGatherer ? *customGatherer : static_cast<const penumbra::Gatherer&>(rayGatherer),
    settings, OcclusionBakingConstants(), work.Tree, work.Progress, work.Baked);
}

bool vtkPenumbraIrradianceFilter::BakeIrradiance(Work& work)
{
  const Scene& scene = work.Mesh.OccluderScene;
  IlluminationSettings settings;
  settings.Environment = glm::max(
    glm::vec3(this->EnvironmentColor[0], this->EnvironmentColor[1], this->EnvironmentColor[2]),
    glm::vec3(0.f));
  settings.Map = this->Environment ? this->Environment->GetMap() : nullptr;
  settings.Albedo = static_cast<float>(this->Albedo);
  settings.Bounces = this->Bounces;
  const Illumination light(*work.Rays, settings);
  const double radiance = light.GetSourceRadiance().Mean;
  const double tolerance = this->Tolerance / vtkMath::Pi(); // for the mean over the hemisphere
  work.Settings.Radiance = radiance;
  work.Settings.Tolerance = HessianErrorFraction * tolerance;
  // The noise increases with the largest radiance, which few rays meet.
  work.Settings.Side = RecordPlacement::ComputeSide(
    RecordNoiseFactor * tolerance * std::sqrt(radiance / light.GetSourceRadiance().Largest));
  const float angle = RecordPlacement::ComputeNormalAngle(RotationErrorFraction * tolerance);
  work.Tree.SetNormalAngle(angle);

  const bool records = this->Method == AUTOMATIC;
  const bool several = records && this->Bounces > 1;
  work.Reflections = std::make_unique<Interreflection>(light, work.Settings, angle);
  std::vector<RecordCandidate> viewpoints;
  const std::size_t step = std::max<std::size_t>(work.Mesh.Sites.size() / BakingViewpointCount, 1);
  for (std::size_t i = 0; i < work.Mesh.Sites.size(); i += step)
  {
    viewpoints.push_back(work.Mesh.Sites[i]);
  }
  const auto before = [&](double fraction) {
    return work.Progress(BakingReflectionProgress * fraction);
  };
  if (several && !work.Reflections->Build(viewpoints, before))
  {
    return false;
  }
  const auto after = [&](double fraction) {
    return work.Progress(
      several ? BakingReflectionProgress + (1.0 - BakingReflectionProgress) * fraction : fraction);
  };
  const LightGatherer& rayGatherer = work.Reflections->GetGatherer();
  const std::unique_ptr<penumbra::Gatherer> customGatherer =
    this->Gatherer && records ? this->Gatherer->Make(rayGatherer) : nullptr;
  work.Settings.CoverageWeight = MinimumLightWeight; // of the last reflection only
  work.Settings.ClearanceFraction = WallFraction;
  RecordPlacement placement(
    customGatherer ? *customGatherer : static_cast<const penumbra::Gatherer&>(rayGatherer),
    work.Settings, work.Tree);
  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  provider->SetMinimumRays(MinimumRays);
  provider->BeginIrradiance(light, radiance * this->Tolerance);
  std::vector<char> complete(work.Mesh.Sites.size(), records ? 0 : 1);
  const auto bruteForce = [&](const RecordCandidate& site, long long& count) {
    if (const auto made = records ? placement.Gather(site, count) : std::nullopt)
    {
      return BakedValue{ made->Gathered.Mean, made->Gathered.Error };
    }
    complete[&site - work.Mesh.Sites.data()] = 1;
    const glm::dvec3 world = scene.ToWorld(site.Position);
    const glm::dvec3 normal(site.Normal);
    const glm::dvec3 geometricNormal(site.GetNormals().Geometric);
    const auto estimate = provider->Irradiance(
      &world.x, &normal.x, BruteForceErrorFactor * radiance * this->Tolerance, &geometricNormal.x);
    count += estimate.Rays;
    return BakedValue{ glm::vec3(estimate.Value[0], estimate.Value[1], estimate.Value[2]) /
        static_cast<float>(vtkMath::Pi()),
      static_cast<float>(estimate.Error / vtkMath::Pi()) };
  };
  const PointEstimators estimators{ bruteForce, {}, 0.f };
  const bool done =
    Bake(work.Mesh, *work.Rays, records, placement, work.Tree, estimators, after, work.Baked);
  work.Baked.GatherRays = placement.GetRays() + work.Reflections->GetRays();
  return done &&
    AddSampledLight(
      light, work.Mesh.Sites, complete, radiance * tolerance, work.Progress, work.Baked);
}

void vtkPenumbraIrradianceFilter::Report(const Work& work, vtkIdType size)
{
  const BakedValues& baked = work.Baked;
  const double unit = this->Quantity == IRRADIANCE ? vtkMath::Pi() : 1.0;
  double square = 0.0;
  for (const BakedValue& value : baked.Values)
  {
    square += std::pow(unit * value.Error, 2.0);
  }
  this->EstimatedError =
    baked.Values.empty() ? 0.0 : std::sqrt(square / static_cast<double>(baked.Values.size()));
  std::size_t records = work.Tree.GetRecords().size();
  std::size_t bytes = work.Tree.GetBytes();
  if (work.Reflections)
  {
    records += work.Reflections->GetRecords();
    bytes += work.Reflections->GetBytes();
  }
  const std::string what = this->OnCells ? "Cells/" : "Points/";
  vtkFieldData* s = this->Statistics;
  AddStatistic(s, what + "Total", static_cast<double>(size));
  const std::array<double, 3> counts = CountMethods(work.Mesh, baked, size);
  AddStatistic(s, what + "Interpolated", counts[0]);
  AddStatistic(s, what + "Denoised", counts[1]);
  AddStatistic(s, what + "BruteForce", counts[2]);
  AddStatistic(s, what + "Unused", static_cast<double>(work.Mesh.Unused));
  AddStatistic(s, what + "NotFinite", static_cast<double>(work.Mesh.NotFinite));
  AddStatistic(s, "Cache/Records", static_cast<double>(records));
  AddStatistic(s, "Cache/Bytes", static_cast<double>(bytes));
  AddStatistic(s, "Rays/Gather", static_cast<double>(work.Baked.GatherRays));
  AddStatistic(s,
    this->Quantity == IRRADIANCE       ? "Rays/Indirect"
      : this->Quantity == DIRECT_LIGHT ? "Rays/Shadow"
                                       : "Rays/Occlusion",
    static_cast<double>(baked.BruteForceRays));
  AddStatistic(s, "Rays/Total", static_cast<double>(work.Baked.GatherRays + baked.BruteForceRays));
  if (this->Gatherer && this->Method == AUTOMATIC && this->Quantity != DIRECT_LIGHT)
  {
    this->Gatherer->Report(s);
  }
}
