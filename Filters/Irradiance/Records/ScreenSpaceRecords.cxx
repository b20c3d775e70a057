// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ScreenSpaceRecords.h"

#include "Embree/RayScene.h"
#include "Execution/ParallelFor.h"
#include "Gathering/IrradianceConstants.h"
#include "PixelCandidates.h"
#include "Scene.h"

#include <optional>

namespace penumbra
{
namespace
{

/// Entries of corners without a record.
constexpr std::int32_t Unknown = -1; ///< not sampled yet
constexpr std::int32_t Nothing = -2; ///< background, or no record could be made

int PowerOfTwoBelow(double limit)
{
  int power = 1;
  while (2 * power <= limit)
  {
    power *= 2;
  }
  return power;
}

}

ScreenSpaceRecords::ScreenSpaceRecords(const RayScene& rays, const RecordPlacement& placement,
  const RecordPlacementSettings& settings, float normalAngle)
  : Seen(rays),
    Placement(placement),
    NormalFactor(RecordOctree::ComputeNormalFactor(normalAngle)),
    Unit(PowerOfTwoBelow(settings.MinimumRadiusPixels)),
    Coarsest(PowerOfTwoBelow(settings.MaximumRadiusPixels / this->Unit))
{
  const Camera& camera = rays.GetScene().ViewCamera;
  const int width = this->Coarsest * this->Unit;
  this->Size = this->Coarsest *
    glm::ivec2((camera.Width + width - 1) / width, (camera.Height + width - 1) / width);
  this->Corners.assign(this->CornerAt(this->Size) + 1, Unknown);
  this->Sides.assign(static_cast<std::size_t>(this->Size.x) * this->Size.y, 0);
}

std::size_t ScreenSpaceRecords::CornerAt(glm::ivec2 corner) const
{
  return static_cast<std::size_t>(corner.y) * (this->Size.x + 1) + corner.x;
}

bool ScreenSpaceRecords::PlaceLevels(const ProgressCallback& progress)
{
  std::vector<Square> squares;
  for (int y = 0; y < this->Size.y; y += this->Coarsest)
  {
    for (int x = 0; x < this->Size.x; x += this->Coarsest)
    {
      squares.push_back({ { x, y }, this->Coarsest });
    }
  }
  for (int side = this->Coarsest; !squares.empty(); side /= 2)
  {
    for (const Square& square : squares)
    {
      for (int y = 0; y < side; ++y)
      {
        const auto row = this->Sides.begin() +
          static_cast<std::ptrdiff_t>(square.Low.y + y) * this->Size.x + square.Low.x;
        std::fill(row, row + side, static_cast<std::uint8_t>(side));
      }
    }
    if (!this->MakeRecords(squares, [&](double fraction) {
          return progress && progress((1.0 - .5 * side / this->Coarsest) * fraction);
        }))
    {
      return false;
    }
    if (side == 1)
    {
      break;
    }
    std::vector<char> fails(squares.size());
    const double fraction = 1.0 - .5 * side / this->Coarsest;
    if (!ParallelForWithProgress(static_cast<int>(squares.size()), fraction, fraction, progress,
          [&](int i) { fails[i] = this->NeedsSubdivision(squares[i]); }))
    {
      return false;
    }
    std::vector<Square> halved;
    for (std::size_t i = 0; i < squares.size(); ++i)
    {
      for (int quarter = 0; fails[i] && quarter < 4; ++quarter)
      {
        const glm::ivec2 step(quarter & 1, quarter >> 1);
        halved.push_back({ squares[i].Low + side / 2 * step, side / 2 });
      }
    }
    squares = std::move(halved);
  }
  return true;
}

bool ScreenSpaceRecords::MakeRecords(
  const std::vector<Square>& squares, const ProgressCallback& progress)
{
  std::vector<glm::ivec2> missing;
  for (const Square& square : squares)
  {
    for (int k = 0; k < 4; ++k)
    {
      const glm::ivec2 corner = square.Low + square.Side * glm::ivec2(k & 1, k >> 1);
      std::int32_t& entry = this->Corners[this->CornerAt(corner)];
      if (entry == Unknown)
      {
        entry = Nothing;
        missing.push_back(corner);
      }
    }
  }
  struct Outcome
  {
    std::optional<Record> Made;
    long long Rays = 0;
  };
  std::vector<Outcome> outcomes(missing.size());
  if (!ParallelForWithProgress(static_cast<int>(missing.size()), 0.0, 1.0, progress, [&](int i) {
        RecordCandidate site;
        if (FindCandidate(this->Seen, this->PixelAt(missing[i]), site))
        {
          outcomes[i].Made = this->Placement.Gather(site, outcomes[i].Rays);
        }
      }))
  {
    return false;
  }
  for (std::size_t i = 0; i < missing.size(); ++i)
  {
    this->Rays += outcomes[i].Rays;
    if (outcomes[i].Made)
    {
      this->Corners[this->CornerAt(missing[i])] = static_cast<std::int32_t>(this->Records.size());
      this->Records.push_back(*outcomes[i].Made);
    }
  }
  return true;
}

void ScreenSpaceRecords::FindCorners(glm::dvec2 at, int side, const Record* (&corners)[4]) const
{
  const glm::ivec2 low = glm::ivec2(at) / side * side;
  for (int k = 0; k < 4; ++k)
  {
    const std::int32_t entry =
      this->Corners[this->CornerAt(low + side * glm::ivec2(k & 1, k >> 1))];
    corners[k] = entry >= 0 ? &this->Records[entry] : nullptr;
  }
}

bool ScreenSpaceRecords::NeedsSubdivision(const Square& square) const
{
  const glm::dvec2 center = glm::dvec2(square.Low) + .5 * square.Side;
  RecordCandidate site;
  if (!FindCandidate(this->Seen, this->PixelAt(center), site))
  {
    const Record* corners[4];
    this->FindCorners(center, square.Side, corners);
    return std::any_of(
      corners, corners + 4, [](const Record* record) { return record != nullptr; });
  }
  float maximum = 0.f;
  int matching = 0;
  for (int side = square.Side; side <= this->Coarsest; side *= 2)
  {
    const Record* corners[4];
    this->FindCorners(center, side, corners);
    for (const Record* record : corners)
    {
      const float weight = record ? record->Weight(site, this->NormalFactor) : 0.f;
      if (side == square.Side && record && record->NormalWeight(site, this->NormalFactor) > 0.f)
      {
        ++matching;
        if (weight == 0.f)
        {
          return true;
        }
      }
      maximum = std::max(maximum, weight);
    }
  }
  return maximum <= (matching == 4 ? MinimumWeight : MinimumPartialWeight);
}

InterpolationResult ScreenSpaceRecords::LookUp(const ShadingPoint& point) const
{
  const Camera& camera = this->Seen.GetScene().ViewCamera;
  const glm::dvec2 pixel = camera.Project(point.Position);
  InterpolationResult result;
  if (!(camera.Parallel || camera.Depth(point.Position) > 0.0) ||
    !(pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= camera.Width && pixel.y <= camera.Height))
  {
    return result;
  }
  const glm::dvec2 at =
    glm::clamp((pixel - .5) / double(this->Unit), glm::dvec2(0.0), glm::dvec2(this->Size) - 1e-6);
  const glm::ivec2 finest(at);
  int side = this->Sides[static_cast<std::size_t>(finest.y) * this->Size.x + finest.x];
  for (; side <= this->Coarsest && !result.Found(); side *= 2)
  {
    const Record* corners[4];
    this->FindCorners(at, side, corners);
    const glm::vec2 f = glm::fract(at / double(side));
    float weights[4];
    bool all = true;
    for (int k = 0; k < 4; ++k)
    {
      weights[k] = (k & 1 ? f.x : 1.f - f.x) * (k >> 1 ? f.y : 1.f - f.y);
      all = all && corners[k] && corners[k]->IsValid &&
        glm::distance(point.Position, corners[k]->Position) <
          FourCornerRadiusFactor * corners[k]->Radius &&
        corners[k]->NormalWeight(point, this->NormalFactor) > 0.f;
    }
    RecordInterpolator interpolator;
    for (int k = 0; k < 4; ++k)
    {
      const float weight = corners[k] && corners[k]->IsValid
        ? weights[k] * (all ? 1.f : corners[k]->Weight(point, this->NormalFactor))
        : 0.f;
      if (weight > 0.f)
      {
        interpolator.Add(*corners[k], point, weight);
      }
    }
    result = interpolator.Result();
  }
  return result;
}

std::size_t ScreenSpaceRecords::GetBytes() const
{
  return this->Records.capacity() * sizeof(Record) +
    this->Corners.capacity() * sizeof(std::int32_t) + this->Sides.capacity();
}

}
