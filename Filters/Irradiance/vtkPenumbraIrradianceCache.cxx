// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraIrradianceCache.h"

#include "Embree/RayScene.h"
#include "Execution/NaNCheck.h"
#include "Gathering/IrradianceConstants.h"
#include "Records/Interreflection.h"
#include "Records/PixelCandidates.h"
#include "Records/RecordDensity.h"
#include "Records/RecordPolyData.h"
#include "Records/ViewRecords.h"
#include "SceneCoordinates.h"
#include "Shading/TranslucentOcclusion.h"
#include "Statistics/Statistics.h"

#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraGatherer.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace
{

using namespace penumbra;

/// Converts the records of a view and adds the angle that their weights depend on.
void Copy(const ViewRecords& from, penumbra::Quantities quantity,
  const SceneCoordinates& coordinates, vtkPolyData* records)
{
  ToPolyData(from.GetRecords(), quantity, coordinates, records);
  AddStatistic(
    records->GetFieldData(), "NormalAngle", vtkMath::DegreesFromRadians(from.GetNormalAngle()));
}

std::vector<RecordCandidate> Viewpoints(const RayScene& rays, const ProgressCallback& progress)
{
  std::vector<RecordCandidate> all;
  for (int level = 0; LevelStride(level) >= ViewpointStride; ++level)
  {
    const std::vector<RecordCandidate> sites = CandidatesInImage(rays, level, progress);
    all.insert(all.end(), sites.begin(), sites.end());
  }
  return all;
}

}

struct vtkPenumbraIrradianceCache::Internals
{
  /// Input that determines the records.
  struct BuildKey
  {
    std::uint64_t Scene = 0;
    double Radius = 0.0;
    int Falloff = 0;
    IlluminationSettings Light;
    double Tolerance = 0.0;
    vtkMTimeType Settings = 0;
    bool operator==(const BuildKey& other) const
    {
      return this->Scene == other.Scene && this->Radius == other.Radius &&
        this->Falloff == other.Falloff && this->Light == other.Light &&
        this->Tolerance == other.Tolerance && this->Settings == other.Settings;
    }
  };

  /// Records of one quantity.
  struct QuantityCache
  {
    BuildKey Key;
    std::unique_ptr<Gatherer> CustomGatherer; ///< null for rays
    SceneCoordinates Units;                   ///< a copy, because records may outlive their scene
    std::unique_ptr<ViewRecords> Records;     ///< null if too many are needed
    long long DensityRays = 0;                ///< that decided whether records are made

    /// Converts a point in world coordinates.
    ShadingPoint ToShadingPoint(
      const double point[3], const double normal[3], const double geometricNormal[3]) const
    {
      ShadingPoint shadingPoint;
      shadingPoint.Position = this->Units.FromWorld(point);
      shadingPoint.Normal = glm::vec3(normal[0], normal[1], normal[2]);
      if (geometricNormal)
      {
        shadingPoint.GeometricNormal =
          glm::vec3(geometricNormal[0], geometricNormal[1], geometricNormal[2]);
      }
      return shadingPoint;
    }

    InterpolationResult LookUp(const ShadingPoint& shadingPoint, bool gatherIfMissing) const
    {
      if (!this->Records)
      {
        return {};
      }
      return gatherIfMissing ? this->Records->LookUpOrGather(shadingPoint)
                             : this->Records->LookUp(shadingPoint);
    }
  };

  QuantityCache Occlusion;
  std::unique_ptr<OcclusionGatherer> Occluders;
  double QueryTolerance = 0.0; ///< tolerance of a single query, set by Begin()
  vtkNew<vtkPenumbraBruteForceIrradiance> BruteForce;

  QuantityCache Irradiance;
  std::unique_ptr<Interreflection> Light;

  vtkSmartPointer<vtkPenumbraGatherer> CustomGatherer;
  vtkSmartPointer<vtkPolyData> InitialRecords;

  static RecordPlacementSettings MakeSettings(
    vtkPenumbraIrradianceCache* self, double accepted, double radiance);
  static float NormalAngle(
    vtkPenumbraIrradianceCache* self, const RecordPlacementSettings& settings);
  static bool UsesRecords(vtkPenumbraIrradianceCache* self, QuantityCache& cache, int reflections,
    const RayGatherer& gatherer, const RecordPlacementSettings& settings, const Progress& progress);
  bool MakeRecords(vtkPenumbraIrradianceCache* self, penumbra::Quantities quantity,
    const RayGatherer& rayGatherer, const RecordPlacementSettings& settings,
    const Progress& progress);
};

vtkStandardNewMacro(vtkPenumbraIrradianceCache);

vtkPenumbraIrradianceCache::vtkPenumbraIrradianceCache()
  : Implementation(new Internals)
{
}

vtkPenumbraIrradianceCache::~vtkPenumbraIrradianceCache() = default;

void vtkPenumbraIrradianceCache::SetInitialRecords(vtkPolyData* records)
{
  if (this->Implementation->InitialRecords != records)
  {
    this->Implementation->InitialRecords = records;
    this->Modified();
  }
}

vtkPolyData* vtkPenumbraIrradianceCache::GetInitialRecords()
{
  return this->Implementation->InitialRecords;
}

void vtkPenumbraIrradianceCache::SetGatherer(vtkPenumbraGatherer* gatherer)
{
  if (this->Implementation->CustomGatherer != gatherer)
  {
    this->Implementation->CustomGatherer = gatherer;
    this->Modified();
  }
}

vtkPenumbraGatherer* vtkPenumbraIrradianceCache::GetGatherer()
{
  return this->Implementation->CustomGatherer;
}

vtkMTimeType vtkPenumbraIrradianceCache::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->Implementation->CustomGatherer)
  {
    time = std::max(time, this->Implementation->CustomGatherer->GetMTime());
  }
  if (this->Implementation->InitialRecords)
  {
    time = std::max(time, this->Implementation->InitialRecords->GetMTime());
  }
  return time;
}

void vtkPenumbraIrradianceCache::GetRecords(vtkPolyData* records) const
{
  const Internals::QuantityCache& cache = this->Implementation->Occlusion;
  if (cache.Records)
  {
    Copy(*cache.Records, Quantities::Occlusion, cache.Units, records);
  }
}

void vtkPenumbraIrradianceCache::GetIrradianceRecords(vtkPolyData* records) const
{
  const Internals::QuantityCache& cache = this->Implementation->Irradiance;
  if (cache.Records)
  {
    Copy(*cache.Records, Quantities::Irradiance, cache.Units, records);
  }
}

RecordPlacementSettings vtkPenumbraIrradianceCache::Internals::MakeSettings(
  vtkPenumbraIrradianceCache* self, double accepted, double radiance)
{
  RequireNotNaN("Tolerance, MinimumRadius, MaximumRadius and NormalAngle",
    { self->Tolerance, self->MinimumRadius, self->MaximumRadius, self->NormalAngle });
  RecordPlacementSettings settings;
  const double absolute =
    self->Tolerance > 0.0 ? self->Tolerance : InterpolationErrorFraction * accepted;
  const double relative =
    std::max({ absolute / radiance, std::min(absolute, BrightTolerance), MinimumTolerance });
  settings.Tolerance = relative;
  settings.Radiance = std::max(absolute, MinimumTolerance * radiance) / relative;
  settings.Rule = static_cast<penumbra::RadiusRules>(self->RadiusRule);
  settings.MinimumRadiusPixels = self->MinimumRadius;
  settings.MaximumRadiusPixels = std::max(self->MinimumRadius, self->MaximumRadius);
  settings.Side = static_cast<int>(std::lround(std::sqrt(self->RaysPerRecord)));
  return settings;
}

float vtkPenumbraIrradianceCache::Internals::NormalAngle(
  vtkPenumbraIrradianceCache* self, const RecordPlacementSettings& settings)
{
  return self->NormalAngle > 0.0
    ? static_cast<float>(vtkMath::RadiansFromDegrees(self->NormalAngle))
    : RecordPlacement::ComputeNormalAngle(settings.Tolerance);
}

/// Clears the records. Returns false if images join their pixels instead.
bool vtkPenumbraIrradianceCache::Internals::UsesRecords(vtkPenumbraIrradianceCache* self,
  QuantityCache& cache, int reflections, const RayGatherer& gatherer,
  const RecordPlacementSettings& settings, const Progress& progress)
{
  cache.Records.reset();
  cache.DensityRays = 0;
  const RayScene& rays = gatherer.GetRays();
  return !self->JoinPixels ||
    (reflections >= MinimumRecordReflections && !HasTranslucentOccluders(rays.GetSurfaces()) &&
      NeedsFewRecords(
        rays, gatherer, settings, NormalAngle(self, settings),
        [&](double) { return progress && progress(0.0); }, cache.DensityRays));
}

bool vtkPenumbraIrradianceCache::Internals::MakeRecords(vtkPenumbraIrradianceCache* self,
  penumbra::Quantities quantity, const RayGatherer& rayGatherer,
  const RecordPlacementSettings& settings, const Progress& progress)
{
  const RayScene& rays = rayGatherer.GetRays();
  QuantityCache& cache = quantity == Quantities::Occlusion ? this->Occlusion : this->Irradiance;
  cache.CustomGatherer = this->CustomGatherer ? this->CustomGatherer->Make(rayGatherer) : nullptr;
  std::vector<Record> initial;
  const auto other =
    quantity == Quantities::Occlusion ? Quantities::Irradiance : Quantities::Occlusion;
  if (this->InitialRecords && !HasRecords(this->InitialRecords, other))
  {
    std::string problem;
    initial = FromPolyData(this->InitialRecords, quantity, rays.GetCoordinates(), problem);
    if (!problem.empty())
    {
      vtkWarningWithObjectMacro(self,
        "InitialRecords are ignored: " << problem
                                       << ". Set records written by GetRecords() or "
                                          "GetIrradianceRecords().");
    }
  }
  cache.Units = rays.GetCoordinates();
  const Gatherer& gatherer =
    cache.CustomGatherer ? *cache.CustomGatherer : static_cast<const Gatherer&>(rayGatherer);
  cache.Records = std::make_unique<ViewRecords>(
    rays, gatherer, settings, NormalAngle(self, settings), self->Space == SCREEN, initial);
  return self->IsLazy() || cache.Records->PlaceLevels(progress);
}

bool vtkPenumbraIrradianceCache::JoinsPixels(bool occlusion, bool irradiance) const
{
  const Internals& self = *this->Implementation;
  return this->JoinPixels &&
    ((occlusion && !self.Occlusion.Records) || (irradiance && !self.Irradiance.Records));
}

bool vtkPenumbraIrradianceCache::Begin(const penumbra::RayScene& rays, const Occluders& occluders,
  double tolerance, const Progress& progress)
{
  Internals& self = *this->Implementation;
  const Internals::BuildKey key{ rays.GetId(), occluders.Radius, occluders.Falloff, {}, tolerance,
    this->GetMTime() };
  if (self.Occlusion.Key == key)
  {
    return true;
  }
  self.Occlusion.Key = Internals::BuildKey();
  self.QueryTolerance = tolerance;
  self.BruteForce->Begin(rays, occluders, tolerance);
  self.Occluders = std::make_unique<OcclusionGatherer>(rays,
    DistanceFalloff::InScene(occluders.Radius, occluders.Falloff, rays.GetCoordinates().Scale));
  try
  {
    const RecordPlacementSettings settings = Internals::MakeSettings(this, tolerance, 1.0);
    if (Internals::UsesRecords(
          this, self.Occlusion, MinimumRecordReflections, *self.Occluders, settings, progress) &&
      !self.MakeRecords(this, Quantities::Occlusion, *self.Occluders, settings, progress))
    {
      return false;
    }
  }
  catch (const Stopped&)
  {
    return false;
  }
  self.Occlusion.Key = key;
  return true;
}

vtkPenumbraIrradianceProvider::Estimate vtkPenumbraIrradianceCache::Occlusion(
  const double point[3], const double normal[3], const double geometricNormal[3]) const
{
  return this->OcclusionWithin(
    point, normal, this->Implementation->QueryTolerance, geometricNormal);
}

vtkPenumbraIrradianceProvider::Estimate vtkPenumbraIrradianceCache::OcclusionWithin(
  const double point[3], const double normal[3], double tolerance,
  const double geometricNormal[3]) const
{
  const Internals& self = *this->Implementation;
  const InterpolationResult found = self.Occlusion.LookUp(
    self.Occlusion.ToShadingPoint(point, normal, geometricNormal), this->IsLazy());
  if (!found.Found())
  {
    return self.BruteForce->OcclusionWithin(point, normal, tolerance, geometricNormal);
  }
  Estimate estimate;
  estimate.Value = std::min(found.Mean.x, 1.f);
  estimate.Error = found.Error;
  return estimate;
}

bool vtkPenumbraIrradianceCache::BeginIrradiance(
  const penumbra::Illumination& light, double tolerance, const Progress& progress)
{
  Internals& self = *this->Implementation;
  const RayScene& rays = light.GetRays();
  const Internals::BuildKey key{ rays.GetId(), 0.0, 0, light.GetSettings(), tolerance,
    this->GetMTime() };
  if (self.Irradiance.Key == key)
  {
    return true;
  }
  self.Irradiance.Key = Internals::BuildKey();
  RecordPlacementSettings settings =
    Internals::MakeSettings(this, tolerance / vtkMath::Pi(), light.GetSourceRadiance().Largest);
  settings.Refine = true;
  settings.KeepAllValid = true;
  settings.CoverageWeight = MinimumLightWeight;
  settings.ClampReached = true;
  if (settings.Side == 0)
  {
    settings.Side = RecordPlacement::ComputeSide(GridNoise * settings.Tolerance);
  }
  self.Light =
    std::make_unique<Interreflection>(light, settings, Internals::NormalAngle(this, settings));
  settings.Tolerance *= HessianErrorFraction;
  const auto before = [&](double fraction) {
    return progress && progress(ReflectionProgress * fraction);
  };
  const auto after = [&](double fraction) {
    return progress && progress(ReflectionProgress + (1.0 - ReflectionProgress) * fraction);
  };
  try
  {
    const LightGatherer& direct = self.Light->GetGatherer();
    if (!Internals::UsesRecords(
          this, self.Irradiance, light.GetSettings().Bounces, direct, settings, progress))
    {
      self.BruteForce->BeginIrradiance(light, tolerance);
    }
    else if (!self.Light->Build(Viewpoints(rays, before), before) ||
      !self.MakeRecords(this, Quantities::Irradiance, self.Light->GetGatherer(), settings, after))
    {
      return false;
    }
  }
  catch (const Stopped&)
  {
    return false;
  }
  self.Irradiance.Key = key;
  return true;
}

vtkPenumbraIrradianceProvider::Light vtkPenumbraIrradianceCache::Irradiance(const double point[3],
  const double normal[3], double tolerance, const double geometricNormal[3]) const
{
  const Internals& self = *this->Implementation;
  if (!self.Irradiance.Records)
  {
    return self.BruteForce->Irradiance(point, normal, tolerance, geometricNormal);
  }
  Light light;
  const ShadingPoint shadingPoint = self.Irradiance.ToShadingPoint(point, normal, geometricNormal);
  InterpolationResult found = self.Irradiance.LookUp(shadingPoint, this->IsLazy());
  if (!found.Found())
  {
    found = self.Irradiance.Records->Gather(shadingPoint, tolerance / vtkMath::Pi(), light.Rays);
  }
  const auto sampled = self.Light->GetLight().EstimateSampledLight(
    shadingPoint.Position, shadingPoint.GetNormals(), tolerance / vtkMath::Pi(), light.Rays);
  light.Error = vtkMath::Pi() * std::hypot(found.Error, sampled.Error);
  for (int c = 0; c < 3; ++c)
  {
    light.Value[c] = vtkMath::Pi() * (found.Mean[c] + sampled.Mean[c]);
  }
  return light;
}

void vtkPenumbraIrradianceCache::Report(vtkFieldData* statistics) const
{
  const Internals& self = *this->Implementation;
  std::size_t records = 0;
  std::size_t bytes = 0;
  long long rays = 0;
  for (const Internals::QuantityCache* cache : { &self.Occlusion, &self.Irradiance })
  {
    if (cache->Records)
    {
      records += cache->Records->GetRecords().size();
      bytes += cache->Records->GetBytes();
      rays += cache->Records->GetRays();
    }
    rays += cache->DensityRays;
  }
  if (self.Light)
  {
    records += self.Light->GetRecords();
    bytes += self.Light->GetBytes();
    rays += self.Light->GetRays();
  }
  AddStatistic(statistics, "Cache/Records", static_cast<double>(records));
  AddStatistic(statistics, "Cache/Bytes", static_cast<double>(bytes));
  AddStatistic(statistics, "Rays/Gather", static_cast<double>(rays));
  if (self.CustomGatherer)
  {
    self.CustomGatherer->Report(statistics);
  }
}

const char* vtkPenumbraIrradianceCache::GetSpaceAsString()
{
  static const char* const names[] = { "World", "Screen" };
  return names[this->Space];
}

const char* vtkPenumbraIrradianceCache::GetRadiusRuleAsString()
{
  static const char* const names[] = { "NearestHit", "HarmonicMean", "OcclusionHessian" };
  return names[this->RadiusRule];
}

const char* vtkPenumbraIrradianceCache::GetOrderAsString()
{
  static const char* const names[] = { "Levels", "Lazy" };
  return names[this->Order];
}

void vtkPenumbraIrradianceCache::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Space: " << this->GetSpaceAsString() << "\n";
  os << indent << "RadiusRule: " << this->GetRadiusRuleAsString() << "\n";
  os << indent << "MinimumRadius: " << this->MinimumRadius << "\n";
  os << indent << "MaximumRadius: " << this->MaximumRadius << "\n";
  os << indent << "NormalAngle: " << this->NormalAngle << "\n";
  os << indent << "RaysPerRecord: " << this->RaysPerRecord << "\n";
  os << indent << "Order: " << this->GetOrderAsString() << "\n";
  os << indent << "JoinPixels: " << this->JoinPixels << "\n";
  os << indent << "Gatherer: " << this->Implementation->CustomGatherer.Get() << "\n";
  os << indent << "InitialRecords: " << this->Implementation->InitialRecords.Get() << "\n";
}
