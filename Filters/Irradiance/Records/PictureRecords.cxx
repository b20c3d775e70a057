// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PictureRecords.h"

#include "Embree/RayScene.h"
#include "PictureSites.h"
#include "Shading/CosineDirections.h"
#include "Shading/ScrambledSequence.h"

namespace penumbra
{
namespace
{

/// Where after the coarse levels more than this share of records does not serve, the rest is left
/// to brute force.
constexpr double MostIdle = 0.7;
constexpr int CoarseStride = 16;

/// The error of n rays over n^(-3/4), as of vtkPenumbraBruteForceSource's, and no more rays than this.
constexpr double KnownError = .42;
constexpr std::uint32_t MostRays = 16384;

}

PictureRecords::PictureRecords(const RayScene& rays, const Gatherer& gatherer,
  const PlacementSettings& settings, float normalAngle, bool onScreen,
  const std::vector<Record>& initial)
  : Rays(rays),
    Source(gatherer),
    Places(gatherer, settings, this->Tree)
{
  this->Tree.Enclose(rays.GetScene());
  this->Tree.SetNormalAngle(normalAngle);
  if (onScreen)
  {
    this->Screen = std::make_unique<ScreenRecords>(rays, this->Places, settings, normalAngle);
    return;
  }
  for (const Record& record : initial)
  {
    this->Tree.Insert(record);
  }
}

bool PictureRecords::PlaceLevels(const ProgressCallback& progress)
{
  if (this->Screen)
  {
    return this->Screen->PlaceLevels(progress);
  }
  for (int level = 0; level < PictureLevels; ++level)
  {
    const auto step = [&](double share) {
      return progress && progress((level + share) / PictureLevels);
    };
    if (!this->Places.AddLevel(SitesOfPicture(this->Rays, level, step), step))
    {
      return false;
    }
    const auto made = static_cast<double>(this->Tree.GetRecords().size());
    if (StrideOf(level) <= CoarseStride &&
      static_cast<double>(this->Places.GetIdle()) > MostIdle * made)
    {
      break;
    }
  }
  return true;
}

Interpolated PictureRecords::LookUpOrGather(const Place& place)
{
  const std::lock_guard<std::mutex> lock(this->Lock);
  Interpolated found = this->Tree.LookUp(place);
  if (!found.Found())
  {
    Site site;
    site.Position = place.Position;
    site.Normal = place.Normal;
    site.Pixel = this->PixelAt(place.Position);
    if (const std::optional<Record> made = this->Places.Gather(site, this->LazyRays))
    {
      this->Tree.Insert(*made);
      found = this->Tree.LookUp(place);
    }
  }
  return found;
}

Interpolated PictureRecords::Gather(const Place& place, double tolerance, long long& rays) const
{
  const double needed = std::pow(KnownError / tolerance, 4.0 / 3.0);
  std::uint32_t count = 4;
  while (count < needed && count < MostRays)
  {
    count *= 2;
  }
  const glm::mat3 frame = FrameOf(place.Normal);
  const ScrambledSequence sequence(SeedOf(place.Position, place.Normal));
  std::vector<glm::vec3> directions;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const glm::vec2 at = sequence.At(i);
    directions.push_back(frame * ToHemisphere(ToDisc(at.x, at.y)));
  }
  std::vector<Sight> sights;
  rays += this->Source.Gather(place.Position, place.Normal, directions, sights);
  Interpolated result;
  const std::uint32_t partner = ScrambledSequence::FindPartner(count);
  float squares = 0.f;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    result.Mean += sights[i].Radiance / static_cast<float>(count);
    const glm::vec3 difference = sights[i].Radiance - sights[i ^ partner].Radiance;
    squares += glm::dot(difference, difference) / 6.f;
  }
  result.Error = std::sqrt(squares) / static_cast<float>(count);
  return result;
}

float PictureRecords::PixelAt(glm::vec3 position) const
{
  const Camera& eye = this->Rays.GetScene().Eye;
  const double depth = eye.Parallel ? 1.0 : eye.Depth(position);
  return static_cast<float>(eye.PixelSize * std::abs(depth));
}

}
