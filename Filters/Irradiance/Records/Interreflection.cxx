// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Interreflection.h"

#include "Embree/RayScene.h"
#include "Gathering/IrradianceConstants.h"
#include "Shading/HemisphereSampling.h"
#include "Surface.h"

namespace penumbra
{
namespace
{

/// Returns a function that looks up the records of `tree`, which must outlive it.
LightGatherer::LightLookup LookUpRecords(const RecordOctree& tree)
{
  return [&tree](glm::vec3 point, const SurfaceNormals& normals) -> std::optional<glm::vec3> {
    ShadingPoint shadingPoint;
    shadingPoint.Position = point;
    shadingPoint.Normal = normals.Shading;
    const InterpolationResult found = tree.LookUp(shadingPoint);
    return found.Found() ? std::optional<glm::vec3>(found.Mean) : std::nullopt;
  };
}

}

Interreflection::Interreflection(
  const Illumination& light, const RecordPlacementSettings& settings, float normalAngle)
  : Light(light),
    Settings(settings),
    NormalAngle(normalAngle)
{
  this->Light.AcceptNoise(settings.Tolerance * settings.Radiance, settings.Side * settings.Side);
  this->Settings.Tolerance *= ReflectionToleranceFactor;
  this->Settings.Side = 0;
  this->Settings.KeepAllValid = true;
  this->Gatherers.push_back(std::make_unique<LightGatherer>(this->Light, nullptr, 0));
}

std::vector<RecordCandidate> Interreflection::FindSites(
  const std::vector<RecordCandidate>& imagePoints, const ProgressCallback& progress)
{
  const RayScene& rays = this->Light.GetRays();
  const HemisphereGrid& grid = HemisphereGrid::Get(ViewpointGridSide);
  const std::size_t step = std::max<std::size_t>(imagePoints.size() / ViewpointCount, 1);
  // Group candidates by ray, so that consecutive ones are far apart.
  std::vector<std::vector<RecordCandidate>> found(grid.Cells());
  std::vector<glm::vec3> directions;
  for (std::size_t i = 0; i < imagePoints.size(); i += step)
  {
    ThrowIfStopped(progress, 0.0);
    const RecordCandidate& from = imagePoints[i];
    const glm::mat3 frame = FrameFromNormal(from.Normal);
    grid.JitterDirections(HashPoint(from.Position, from.Normal), directions);
    for (int k = 0; k < grid.Cells(); ++k)
    {
      const Ray ray =
        Illumination::SpawnRay(from.Position, from.GetNormals(), frame * directions[k]);
      const Hit hit = rays.Intersect(ray);
      ++this->Rays;
      if (!hit.IsHit() || rays.GetSurfaces()[hit.Surface].IsLineOrPoint)
      {
        continue;
      }
      RecordCandidate site;
      site.Position = ray.Origin + hit.Distance * ray.Direction;
      site.Normal = NormalAt(rays, ray, hit);
      site.Normal = glm::dot(site.Normal, ray.Direction) > 0.f ? -site.Normal : site.Normal;
      site.GeometricNormal = site.Normal;
      site.Normal = rays.GetSmoothNormal(hit, site.Normal);
      site.Pixel = PixelPerDistance * hit.Distance;
      if (site.GeometricNormal != glm::vec3(0.f) && site.Pixel > 0.f)
      {
        found[(k * 37) % grid.Cells()].push_back(site);
      }
    }
  }
  std::vector<RecordCandidate> sites;
  double sum = 0.0;
  for (const std::vector<RecordCandidate>& part : found)
  {
    for (const RecordCandidate& site : part)
    {
      sites.push_back(site);
      sum += site.Pixel;
    }
  }
  const auto minimum = MinimumPixelFraction *
    static_cast<float>(sum / std::max<double>(static_cast<double>(sites.size()), 1.0));
  for (RecordCandidate& site : sites)
  {
    site.Pixel = std::max(site.Pixel, minimum);
  }
  return sites;
}

bool Interreflection::Build(
  const std::vector<RecordCandidate>& imagePoints, const ProgressCallback& progress)
{
  const int reflections = this->Light.GetSettings().Bounces - 1;
  if (reflections < 1 || this->Light.GetSettings().Albedo == 0.f)
  {
    return true;
  }
  const std::vector<RecordCandidate> sites = this->FindSites(imagePoints, progress);
  for (int reflection = 1; reflection <= reflections; ++reflection)
  {
    auto tree = std::make_unique<RecordOctree>();
    tree->InitializeFromSurfaces(this->Light.GetRays().GetSurfaces());
    tree->SetNormalAngle(this->NormalAngle);
    RecordPlacement placement(this->GetGatherer(), this->Settings, *tree);
    const auto step = [&](double fraction) {
      return progress && progress((reflection - 1 + .5 * fraction) / reflections);
    };
    std::size_t size = FirstLevel;
    for (std::size_t first = 0; first < sites.size(); first += size, size *= 2)
    {
      size = std::min(size, sites.size() - first);
      const std::size_t before = tree->GetRecords().size();
      if (!placement.AddLevel({ sites.begin() + first, sites.begin() + first + size }, step))
      {
        return false;
      }
      const std::size_t made = tree->GetRecords().size() - before;
      if (static_cast<double>(made) < MinimumRecordFraction * static_cast<double>(size))
      {
        break;
      }
    }
    this->Rays += placement.GetRays();
    this->Gatherers.push_back(
      std::make_unique<LightGatherer>(this->Light, LookUpRecords(*tree), reflection));
    this->Trees.push_back(std::move(tree));
  }
  return true;
}

std::size_t Interreflection::GetRecords() const
{
  std::size_t records = 0;
  for (const auto& tree : this->Trees)
  {
    records += tree->GetRecords().size();
  }
  return records;
}

std::size_t Interreflection::GetBytes() const
{
  std::size_t bytes = 0;
  for (const auto& tree : this->Trees)
  {
    bytes += tree->GetBytes();
  }
  return bytes;
}

}
