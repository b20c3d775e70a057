// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraIrradianceCache.h"

#include "Embree/RayScene.h"
#include "Execution/NaNCheck.h"
#include "Execution/Statistics.h"
#include "Records/Interreflection.h"
#include "Records/PixelCandidates.h"
#include "Records/RecordPolyData.h"
#include "Records/ViewRecords.h"

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

/// Error of interpolated values as a fraction of the tolerance passed to Begin(). Below 1 because errors of
/// neighboring pixels are correlated and do not average out.
constexpr double SharedError = 0.5;

/// Minimum tolerance of the mean over the hemisphere.
constexpr double LeastTolerance = 1e-4;

/// Minimum stride in pixels of the visible points that trace rays to place the records of reflections.
constexpr int StrideOfViewpoints = 8;

/// Error of interpolated irradiance as a fraction of the tolerance.
constexpr double HessianErrorFraction = .5;

/// Error of the grid of one irradiance record over the tolerance. Above 1 because cells are supersampled
/// and several records are interpolated. Twice as many records with half as many rays each have a smaller
/// error (benchmark `irradiance`).
constexpr double GridNoise = 2.5;

/// Fraction of the progress of irradiance spent on all reflections but the last.
constexpr double ProgressOfReflections = 0.5;

/// Converts the records of a view and adds the angle that their weights depend on.
void Copy(
  const ViewRecords& from, penumbra::Quantities quantity, const Scene& scene, vtkPolyData* records)
{
  ToPolyData(from.GetRecords(), quantity, scene, records);
  AddStatistic(
    records->GetFieldData(), "NormalAngle", vtkMath::DegreesFromRadians(from.GetNormalAngle()));
}

std::vector<RecordCandidate> Viewpoints(const RayScene& rays, const ProgressCallback& progress)
{
  std::vector<RecordCandidate> all;
  for (int level = 0; LevelStride(level) >= StrideOfViewpoints; ++level)
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
    Scene Units; ///< only origin and scale, because records may outlive their scene
    std::unique_ptr<ViewRecords> Records;

    /// Converts a point in world coordinates.
    ShadingPoint PlaceOf(const double point[3], const double normal[3]) const
    {
      ShadingPoint place;
      place.Position = this->Units.FromWorld(point);
      place.Normal = glm::vec3(normal[0], normal[1], normal[2]);
      return place;
    }

    InterpolationResult Ask(const double point[3], const double normal[3], bool lazily) const
    {
      const ShadingPoint place = this->PlaceOf(point, normal);
      return lazily ? this->Records->LookUpOrGather(place) : this->Records->LookUp(place);
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

  static RecordPlacementSettings MakeSettings(vtkPenumbraIrradianceCache* self, double accepted);
  static float NormalAngle(
    vtkPenumbraIrradianceCache* self, const RecordPlacementSettings& settings);
  bool MakeRecords(vtkPenumbraIrradianceCache* self, penumbra::Quantities quantity,
    const RayGatherer& seen, const RecordPlacementSettings& settings, const Progress& progress);
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
  const Internals::QuantityCache& half = this->Implementation->Occlusion;
  if (half.Records)
  {
    Copy(*half.Records, Quantities::Occlusion, half.Units, records);
  }
}

void vtkPenumbraIrradianceCache::GetIrradianceRecords(vtkPolyData* records) const
{
  const Internals::QuantityCache& half = this->Implementation->Irradiance;
  if (half.Records)
  {
    Copy(*half.Records, Quantities::Irradiance, half.Units, records);
  }
}

RecordPlacementSettings vtkPenumbraIrradianceCache::Internals::MakeSettings(
  vtkPenumbraIrradianceCache* self, double accepted)
{
  RequireNotNaN("Tolerance, MinimumRadius, MaximumRadius and NormalAngle",
    { self->Tolerance, self->MinimumRadius, self->MaximumRadius, self->NormalAngle });
  RecordPlacementSettings settings;
  settings.Tolerance =
    std::max(self->Tolerance > 0.0 ? self->Tolerance : SharedError * accepted, LeastTolerance);
  settings.Rule = static_cast<penumbra::RadiusRules>(self->RadiusRule);
  settings.MinimumRadiusPixels = self->MinimumRadius;
  settings.MostPixels = std::max(self->MinimumRadius, self->MaximumRadius);
  settings.Side = static_cast<int>(std::lround(std::sqrt(self->RaysPerRecord)));
  return settings;
}

float vtkPenumbraIrradianceCache::Internals::NormalAngle(
  vtkPenumbraIrradianceCache* self, const RecordPlacementSettings& settings)
{
  return self->NormalAngle > 0.0
    ? static_cast<float>(vtkMath::RadiansFromDegrees(self->NormalAngle))
    : RecordPlacement::NormalAngleFor(settings.Tolerance);
}

bool vtkPenumbraIrradianceCache::Internals::MakeRecords(vtkPenumbraIrradianceCache* self,
  penumbra::Quantities quantity, const RayGatherer& seen, const RecordPlacementSettings& settings,
  const Progress& progress)
{
  const RayScene& rays = seen.GetRays();
  QuantityCache& half = quantity == Quantities::Occlusion ? this->Occlusion : this->Irradiance;
  half.Records.reset();
  half.CustomGatherer = this->CustomGatherer ? this->CustomGatherer->Make(seen) : nullptr;
  std::vector<Record> initial;
  const auto other =
    quantity == Quantities::Occlusion ? Quantities::Irradiance : Quantities::Occlusion;
  if (this->InitialRecords && !HasRecords(this->InitialRecords, other))
  {
    std::string problem;
    initial = FromPolyData(this->InitialRecords, quantity, rays.GetScene(), problem);
    if (!problem.empty())
    {
      vtkWarningWithObjectMacro(self,
        "InitialRecords are ignored: " << problem
                                       << ". Set records written by GetRecords() or "
                                          "GetIrradianceRecords().");
    }
  }
  half.Units.Origin = rays.GetScene().Origin;
  half.Units.Scale = rays.GetScene().Scale;
  const Gatherer& gatherer =
    half.CustomGatherer ? *half.CustomGatherer : static_cast<const Gatherer&>(seen);
  half.Records = std::make_unique<ViewRecords>(
    rays, gatherer, settings, NormalAngle(self, settings), self->Space == SCREEN, initial);
  return self->IsLazy() || half.Records->PlaceLevels(progress);
}

bool vtkPenumbraIrradianceCache::Begin(const penumbra::RayScene& rays, const Occluders& occluders,
  double tolerance, const Progress& progress)
{
  Internals& self = *this->Implementation;
  const Internals::BuildKey purpose{ rays.GetId(), occluders.Radius, occluders.Falloff, {},
    tolerance, this->GetMTime() };
  if (self.Occlusion.Key == purpose)
  {
    return true;
  }
  self.Occlusion.Key = Internals::BuildKey();
  self.QueryTolerance = tolerance;
  self.BruteForce->Begin(rays, occluders, tolerance);
  self.Occluders = std::make_unique<OcclusionGatherer>(
    rays, DistanceFalloff::InScene(occluders.Radius, occluders.Falloff, rays.GetScene().Scale));
  try
  {
    if (!self.MakeRecords(this, Quantities::Occlusion, *self.Occluders,
          Internals::MakeSettings(this, tolerance), progress))
    {
      return false;
    }
  }
  catch (const Stopped&)
  {
    return false;
  }
  self.Occlusion.Key = purpose;
  return true;
}

vtkPenumbraIrradianceProvider::Estimate vtkPenumbraIrradianceCache::Occlusion(
  const double point[3], const double normal[3]) const
{
  return this->OcclusionWithin(point, normal, this->Implementation->QueryTolerance);
}

vtkPenumbraIrradianceProvider::Estimate vtkPenumbraIrradianceCache::OcclusionWithin(
  const double point[3], const double normal[3], double tolerance) const
{
  const Internals& self = *this->Implementation;
  const InterpolationResult found = self.Occlusion.Ask(point, normal, this->IsLazy());
  if (!found.Found())
  {
    return self.BruteForce->OcclusionWithin(point, normal, tolerance);
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
  const Internals::BuildKey purpose{ rays.GetId(), 0.0, 0, light.GetSettings(), tolerance,
    this->GetMTime() };
  if (self.Irradiance.Key == purpose)
  {
    return true;
  }
  self.Irradiance.Key = Internals::BuildKey();
  RecordPlacementSettings settings = Internals::MakeSettings(this, tolerance / vtkMath::Pi());
  settings.Refine = true;
  settings.KeepAllValid = true;
  self.Light =
    std::make_unique<Interreflection>(light, settings, Internals::NormalAngle(this, settings));
  if (settings.Side == 0)
  {
    settings.Side = RecordPlacement::SideFor(GridNoise * settings.Tolerance);
  }
  settings.Tolerance *= HessianErrorFraction;
  const auto before = [&](double share) {
    return progress && progress(ProgressOfReflections * share);
  };
  const auto after = [&](double share) {
    return progress && progress(ProgressOfReflections + (1.0 - ProgressOfReflections) * share);
  };
  try
  {
    if (!self.Light->Build(Viewpoints(rays, before), before) ||
      !self.MakeRecords(this, Quantities::Irradiance, self.Light->GetGatherer(), settings, after))
    {
      return false;
    }
  }
  catch (const Stopped&)
  {
    return false;
  }
  self.Irradiance.Key = purpose;
  return true;
}

vtkPenumbraIrradianceProvider::Light vtkPenumbraIrradianceCache::Irradiance(
  const double point[3], const double normal[3], double tolerance) const
{
  const Internals& self = *this->Implementation;
  Light light;
  InterpolationResult found = self.Irradiance.Ask(point, normal, this->IsLazy());
  if (!found.Found())
  {
    found = self.Irradiance.Records->Gather(self.Irradiance.PlaceOf(point, normal),
      std::max(tolerance / vtkMath::Pi(), LeastTolerance), light.Rays);
  }
  const ShadingPoint place = self.Irradiance.PlaceOf(point, normal);
  const auto suns = self.Light->GetLight().EstimateSunlight(
    place.Position, place.Normal, tolerance / vtkMath::Pi(), light.Rays);
  light.Error = vtkMath::Pi() * std::hypot(found.Error, suns.Error);
  for (int c = 0; c < 3; ++c)
  {
    light.Value[c] = vtkMath::Pi() * (found.Mean[c] + suns.Mean[c]);
  }
  return light;
}

void vtkPenumbraIrradianceCache::Report(vtkFieldData* statistics) const
{
  const Internals& self = *this->Implementation;
  std::size_t records = 0;
  std::size_t bytes = 0;
  long long rays = 0;
  for (const Internals::QuantityCache* half : { &self.Occlusion, &self.Irradiance })
  {
    if (half->Records)
    {
      records += half->Records->GetRecords().size();
      bytes += half->Records->GetBytes();
      rays += half->Records->GetRays();
    }
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

void vtkPenumbraIrradianceCache::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Space: " << this->Space << "\n";
  os << indent << "RadiusRule: " << this->RadiusRule << "\n";
  os << indent << "MinimumRadius: " << this->MinimumRadius << "\n";
  os << indent << "MaximumRadius: " << this->MaximumRadius << "\n";
  os << indent << "NormalAngle: " << this->NormalAngle << "\n";
  os << indent << "RaysPerRecord: " << this->RaysPerRecord << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "Gatherer: " << this->Implementation->CustomGatherer.Get() << "\n";
  os << indent << "InitialRecords: " << this->Implementation->InitialRecords.Get() << "\n";
}
