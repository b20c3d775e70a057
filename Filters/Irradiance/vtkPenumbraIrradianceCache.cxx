// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraIrradianceCache.h"

#include "PictureSites.h"
#include "RayGatherer.h"
#include "RayScene.h"
#include "RecordData.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraBruteForceSource.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <mutex>

namespace
{

using namespace penumbra;

/// Of what Begin() accepts from independent answers.
constexpr double SharedError = 0.5;
constexpr double LeastTolerance = 1e-4;

/// Where after the coarse levels more than this share of records does not serve, the rest is left
/// to brute force.
constexpr double MostIdle = 0.7;
constexpr int CoarseStride = 16;

void AddStatistic(vtkFieldData* statistics, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  statistics->AddArray(array);
}

/// Makes the tree's root as large as the scene.
void Enclose(const Scene& scene, RecordTree& tree)
{
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(std::numeric_limits<float>::lowest());
  for (const Surface& surface : scene.Surfaces)
  {
    for (const glm::vec3& p : surface.Positions)
    {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  const glm::vec3 size = glm::max(high - low, glm::vec3(0.f));
  tree.Initialize(low.x <= high.x ? .5f * (low + high) : glm::vec3(0.f),
    .5f * std::max({ size.x, size.y, size.z }));
}

}

struct vtkPenumbraIrradianceCache::Internals
{
  /// What the records were made for.
  struct Purpose
  {
    std::uint64_t Scene = 0;
    double Radius = 0.0;
    double Tolerance = 0.0;
    vtkMTimeType Settings = 0;
    bool operator==(const Purpose& other) const
    {
      return this->Scene == other.Scene && this->Radius == other.Radius &&
        this->Tolerance == other.Tolerance && this->Settings == other.Settings;
    }
  };

  Purpose Made;
  const RayScene* Rays = nullptr;
  const Gatherer* Foreign = nullptr;
  double Accepted = 0.0; ///< by Begin(), for a single answer
  std::unique_ptr<OcclusionGatherer> Own;
  std::unique_ptr<Placement> Places;
  RecordTree Tree;
  std::mutex Lock; ///< LAZY: of Tree and LazyRays
  long long LazyRays = 0;
  vtkNew<vtkPenumbraBruteForceSource> BruteForce;
  vtkSmartPointer<vtkPolyData> InitialRecords;

  bool PlaceRecords(const Progress& progress);
  float PixelAt(glm::vec3 position) const;
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

void vtkPenumbraIrradianceCache::SetGatherer(const penumbra::Gatherer* gatherer)
{
  if (this->Implementation->Foreign != gatherer)
  {
    this->Implementation->Foreign = gatherer;
    this->Modified();
  }
}

void vtkPenumbraIrradianceCache::GetRecords(vtkPolyData* records) const
{
  const Internals& self = *this->Implementation;
  if (self.Rays)
  {
    ToPolyData(self.Tree.GetRecords(), Quantities::Occlusion, self.Rays->GetScene(), records);
  }
}

bool vtkPenumbraIrradianceCache::Begin(
  const penumbra::RayScene& rays, double radius, double tolerance, const Progress& progress)
{
  Internals& self = *this->Implementation;
  const Internals::Purpose purpose{ rays.GetId(), radius, tolerance, this->GetMTime() };
  if (self.Made == purpose)
  {
    return true;
  }
  self.Made = Internals::Purpose();
  const Scene& scene = rays.GetScene();
  const double accepted =
    std::max(this->Tolerance > 0.0 ? this->Tolerance : SharedError * tolerance, LeastTolerance);

  PlacementSettings settings;
  settings.Tolerance = accepted;
  settings.Rule = static_cast<penumbra::RadiusRules>(this->RadiusRule);
  settings.LeastPixels = this->MinimumRadius;
  settings.MostPixels = std::max(this->MinimumRadius, this->MaximumRadius);
  settings.Side = static_cast<int>(std::lround(std::sqrt(this->RaysPerRecord)));

  self.Rays = &rays;
  self.Own = std::make_unique<OcclusionGatherer>(rays, static_cast<float>(radius * scene.Scale));
  self.Accepted = tolerance;
  self.BruteForce->Begin(rays, radius, tolerance);
  Enclose(scene, self.Tree);
  self.Tree.SetNormalAngle(this->NormalAngle > 0.0
      ? static_cast<float>(vtkMath::RadiansFromDegrees(this->NormalAngle))
      : Placement::NormalAngleFor(accepted));
  const Gatherer& gatherer = self.Foreign ? *self.Foreign : *self.Own;
  self.Places = std::make_unique<Placement>(gatherer, settings, self.Tree);
  self.LazyRays = 0;
  if (self.InitialRecords)
  {
    std::string problem;
    for (const Record& record :
      FromPolyData(self.InitialRecords, Quantities::Occlusion, scene, problem))
    {
      self.Tree.Insert(record);
    }
    if (!problem.empty())
    {
      vtkWarningMacro("InitialRecords are not used: " << problem << ".");
    }
  }
  if (this->Order == LEVELS && !self.PlaceRecords(progress))
  {
    return false;
  }
  self.Made = purpose;
  return true;
}

bool vtkPenumbraIrradianceCache::Internals::PlaceRecords(const Progress& progress)
{
  for (int level = 0; level < PictureLevels; ++level)
  {
    const auto step = [&](double share) {
      return progress && progress((level + share) / PictureLevels);
    };
    if (!this->Places->AddLevel(SitesOfPicture(*this->Rays, level), step))
    {
      return false;
    }
    const auto made = static_cast<double>(this->Tree.GetRecords().size());
    if (StrideOf(level) <= CoarseStride &&
      static_cast<double>(this->Places->GetIdle()) > MostIdle * made)
    {
      break;
    }
  }
  return true;
}

float vtkPenumbraIrradianceCache::Internals::PixelAt(glm::vec3 position) const
{
  const Camera& eye = this->Rays->GetScene().Eye;
  const double depth = eye.Parallel ? 1.0 : eye.Depth(position);
  return static_cast<float>(eye.PixelSize * std::abs(depth));
}

vtkPenumbraIrradianceSource::Estimate vtkPenumbraIrradianceCache::Occlusion(
  const double point[3], const double normal[3]) const
{
  return this->OcclusionWithin(point, normal, this->Implementation->Accepted);
}

vtkPenumbraIrradianceSource::Estimate vtkPenumbraIrradianceCache::OcclusionWithin(
  const double point[3], const double normal[3], double tolerance) const
{
  Internals& self = *this->Implementation;
  const Scene& scene = self.Rays->GetScene();
  Site site;
  site.Position = (glm::dvec3(point[0], point[1], point[2]) - scene.Origin) * scene.Scale;
  site.Normal = glm::vec3(normal[0], normal[1], normal[2]);
  std::unique_lock<std::mutex> lock(self.Lock, std::defer_lock);
  if (this->Order == LAZY)
  {
    lock.lock();
  }
  Estimate estimate;
  Interpolated found = self.Tree.LookUp(site);
  if (!found.Found() && this->Order == LAZY)
  {
    site.Pixel = self.PixelAt(site.Position);
    self.Tree.Insert(self.Places->Gather(site, self.LazyRays));
    found = self.Tree.LookUp(site);
  }
  if (!found.Found())
  {
    return self.BruteForce->OcclusionWithin(point, normal, tolerance);
  }
  estimate.Value = std::min(found.Mean.x, 1.f);
  estimate.Error = found.Error;
  return estimate;
}

void vtkPenumbraIrradianceCache::Report(vtkFieldData* statistics) const
{
  const Internals& self = *this->Implementation;
  AddStatistic(statistics, "Cache/Records", static_cast<double>(self.Tree.GetRecords().size()));
  AddStatistic(statistics, "Cache/Bytes", static_cast<double>(self.Tree.GetBytes()));
  AddStatistic(statistics, "Rays/Gather",
    static_cast<double>(self.LazyRays + (self.Places ? self.Places->GetRays() : 0)));
}

void vtkPenumbraIrradianceCache::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "RadiusRule: " << this->RadiusRule << "\n";
  os << indent << "MinimumRadius: " << this->MinimumRadius << "\n";
  os << indent << "MaximumRadius: " << this->MaximumRadius << "\n";
  os << indent << "NormalAngle: " << this->NormalAngle << "\n";
  os << indent << "RaysPerRecord: " << this->RaysPerRecord << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "InitialRecords: " << this->Implementation->InitialRecords.Get() << "\n";
}
