// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewRecords.h"

#include "Embree/RayScene.h"
#include "Gathering/IrradianceConstants.h"
#include "PixelCandidates.h"
#include "Scene.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/OwenSobolSequence.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{
ViewRecords::ViewRecords(const RayScene& rays, const Gatherer& gatherer,
  const RecordPlacementSettings& settings, float normalAngle, bool onScreen,
  const std::vector<Record>& initial)
  : Rays(rays),
    Source(gatherer),
    Radiance(settings.Radiance),
    Placement(gatherer, settings, this->Tree)
{
  this->Tree.InitializeFromSurfaces(rays.GetSurfaces());
  this->Tree.SetNormalAngle(normalAngle);
  if (onScreen)
  {
    this->Screen =
      std::make_unique<ScreenSpaceRecords>(rays, this->Placement, settings, normalAngle);
    return;
  }
  for (const Record& record : initial)
  {
    this->Tree.Insert(record);
  }
}

bool ViewRecords::PlaceLevels(const ProgressCallback& progress)
{
  if (this->Screen)
  {
    return this->Screen->PlaceLevels(progress);
  }
  for (int level = 0; level < ImageLevels; ++level)
  {
    const auto step = [&](double fraction) {
      return progress && progress((level + fraction) / ImageLevels);
    };
    if (!this->Placement.AddLevel(CandidatesInImage(this->Rays, level, step), step))
    {
      return false;
    }
    const auto made = static_cast<double>(this->Tree.GetRecords().size());
    if (LevelStride(level) <= CoarseStride &&
      static_cast<double>(this->Placement.GetNumberOfInvalidRecords()) >
        MaximumInvalidFraction * made)
    {
      break;
    }
  }
  return true;
}

InterpolationResult ViewRecords::LookUpOrGather(const ShadingPoint& point)
{
  const std::lock_guard<std::mutex> lock(this->Lock);
  InterpolationResult found = this->Tree.LookUp(point);
  if (!found.Found() && !this->Placement.IsCovered(point))
  {
    RecordCandidate site;
    site.Position = point.Position;
    site.Normal = point.Normal;
    site.GeometricNormal = point.GeometricNormal;
    site.Pixel = this->PixelAt(point.Position);
    if (const std::optional<Record> made = this->Placement.Gather(site, this->LazyRays))
    {
      this->Tree.Insert(*made);
      found = this->Tree.LookUp(point);
    }
  }
  return found;
}

InterpolationResult ViewRecords::Gather(
  const ShadingPoint& point, double tolerance, long long& rays) const
{
  const double accepted = std::max(tolerance, MinimumTolerance * this->Radiance);
  std::uint32_t count = 4;
  const auto increase = [&count](double needed) {
    while (count < needed && count < MaximumRays)
    {
      count *= 2;
    }
  };
  increase(std::pow(ReferenceRayError * this->Radiance / accepted, 4.0 / 3.0));
  InterpolationResult result = this->GatherWithRays(point, count, rays);
  if (result.Error > accepted && count < MaximumRays)
  {
    // The second estimate does not use the rays of the first, so that it has no bias.
    increase(count * std::pow(result.Error / accepted, 4.0 / 3.0));
    result = this->GatherWithRays(point, count, rays);
  }
  return result;
}

InterpolationResult ViewRecords::GatherWithRays(
  const ShadingPoint& point, std::uint32_t count, long long& rays) const
{
  const glm::mat3 frame = FrameFromNormal(point.Normal);
  const OwenSobolSequence sequence(HashPoint(point.Position, point.Normal) + count);
  std::vector<glm::vec3> directions;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const glm::vec2 at = sequence.At(i);
    directions.push_back(frame * DiskToHemisphere(SampleUniformDiskConcentric(at.x, at.y)));
  }
  std::vector<HemisphereSample> samples;
  rays += this->Source.Gather(point.Position, point.GetNormals(), directions, samples);
  InterpolationResult result;
  const std::uint32_t partner = OwenSobolSequence::FindPartner(count);
  glm::vec3 squares(0.f);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    result.Mean += samples[i].Radiance / static_cast<float>(count);
    const glm::vec3 difference = samples[i].Radiance - samples[i ^ partner].Radiance;
    squares += .5f * difference * difference;
  }
  result.Error =
    std::sqrt(std::max({ squares.x, squares.y, squares.z })) / static_cast<float>(count);
  return result;
}

float ViewRecords::PixelAt(glm::vec3 position) const
{
  const Camera& camera = this->Rays.GetScene().ViewCamera;
  const double depth = camera.Parallel ? 1.0 : camera.Depth(position);
  return static_cast<float>(camera.PixelSize * std::abs(depth));
}

}
