// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DistributedOccluders.h"

#include "Messages/SurfaceMessages.h"
#include "Messages/SurfacePart.h"
#include "Scene.h"
#include "Shadows/CellMarks.h"
#include "Shadows/RankCells.h"
#include "Surface.h"
#include "UnitSelection.h"

#include <algorithm>
#include <utility>

namespace penumbra
{
namespace
{

/// Marks what rays from the query points may meet, see OccluderDistribution::Exchange().
CellMarks MarkNeeded(const Scene& scene, const AxisAlignedBox& bounds,
  const std::vector<glm::vec3>& points, std::optional<double> radius)
{
  CellMarks seen(bounds);
  AxisAlignedBox box;
  const auto add = [&](const AxisAlignedBox& part) {
    seen.Mark(part);
    box.Add(part);
  };
  const Surface& own = scene.Surfaces.front();
  for (std::uint32_t unit = 0; unit < CountUnits(own) && !points.empty(); ++unit)
  {
    add(GetUnitBox(own, unit));
  }
  for (const glm::vec3& point : points)
  {
    add({ point, point });
  }
  CellMarks needed(bounds);
  if (radius && !points.empty())
  {
    const auto reach = static_cast<float>(*radius);
    needed.Mark({ box.Low - reach, box.High + reach });
  }
  for (const Light& light : scene.Lights)
  {
    needed.MarkToward(light, seen);
  }
  return needed;
}

/// Appends a surface of the same appearance, with the arrays that baking uses.
void Append(const Surface& from, Surface& to)
{
  const auto offset = static_cast<std::uint32_t>(to.Positions.size());
  to.Positions.insert(to.Positions.end(), from.Positions.begin(), from.Positions.end());
  to.PointColors.insert(to.PointColors.end(), from.PointColors.begin(), from.PointColors.end());
  for (const glm::uvec3& corners : from.Triangles)
  {
    to.Triangles.push_back(corners + offset);
  }
  for (const glm::uvec2& ends : from.Segments)
  {
    to.Segments.push_back(ends + offset);
  }
}

/// Replaces the surfaces of a scene by those that they are parts of, with the received primitives in the order of the
/// ranks, of which `rank` is this one. The first surface remains the first one. Returns the index that its first
/// position has now.
std::uint32_t Assemble(const std::vector<UnitedSurface>& united, std::vector<std::string> messages,
  std::size_t rank, Scene& scene)
{
  ReceivedSurfaces received(std::move(messages));
  std::vector<Surface> surfaces;
  for (const UnitedSurface& whole : united)
  {
    surfaces.push_back(MakeEmptySurface(whole.Appearance, received.GetTextures()));
    surfaces.back().Whole = whole.Whole;
  }
  received.AppendTo(surfaces, 0, rank);
  std::size_t first = 0;
  std::size_t offset = 0;
  for (std::size_t i = 0; i < united.size(); ++i)
  {
    for (const std::uint32_t own : united[i].Own)
    {
      first = own == 0 ? i : first;
      offset = own == 0 ? surfaces[i].Positions.size() : offset;
      Append(scene.Surfaces[own], surfaces[i]);
      scene.Surfaces[own] = Surface(); // frees the memory
    }
  }
  received.AppendTo(surfaces, rank, received.GetCount());
  scene.Surfaces.clear();
  scene.Surfaces.push_back(std::move(surfaces[first]));
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    if (i != first && surfaces[i].GetNumberOfPrimitives() > 0)
    {
      scene.Surfaces.push_back(std::move(surfaces[i]));
    }
  }
  for (Surface& surface : scene.Surfaces)
  {
    surface.CellIds.clear(); // of the received primitives only; baking needs none
    FinishParts(surface);
  }
  return static_cast<std::uint32_t>(offset);
}

}

DistributedOccluders::DistributedOccluders(
  vtkMultiProcessController* controller, std::function<void(const std::string&)> warn)
  : Ranks(controller),
    Warn(std::move(warn))
{
}

std::vector<std::string> DistributedOccluders::ExchangeParts(const Scene& scene,
  const std::vector<UnitedSurface>& united, const AxisAlignedBox& bounds, const CellMarks& needed)
{
  const auto ranks = static_cast<std::size_t>(this->Ranks.GetCount());
  const RankCells cells(bounds, this->Ranks.AllGather(needed.Write()));
  std::vector<std::vector<Units>> selected;
  for (const Surface& surface : scene.Surfaces)
  {
    selected.push_back(SelectUnits(surface, cells, ranks));
  }
  return ExchangeSurfaces(
    [&](int rank) {
      SurfaceMessage message;
      for (std::uint32_t i = 0; i < united.size() && rank != this->Ranks.GetRank(); ++i)
      {
        for (const std::uint32_t own : united[i].Own)
        {
          message.Add(i, scene.Surfaces[own], selected[own][rank]);
        }
      }
      return message.Take();
    },
    this->Ranks, this->Counts);
}

std::uint32_t DistributedOccluders::Exchange(
  Scene& scene, const std::vector<glm::vec3>& points, std::optional<double> radius)
{
  const std::vector<UnitedSurface> united = UniteSurfaces(scene, this->Ranks);
  AxisAlignedBox bounds;
  for (const UnitedSurface& surface : united)
  {
    bounds.Add(surface.Whole->DrawnBounds);
  }
  CountWhole(scene, united, this->Ranks, this->Counts);
  std::uint32_t first = 0;
  if (!bounds.IsEmpty())
  {
    const CellMarks needed = MarkNeeded(scene, bounds, points, radius);
    first = Assemble(united, this->ExchangeParts(scene, united, bounds, needed),
      static_cast<std::size_t>(this->Ranks.GetRank()), scene);
  }
  CountPrimitives(scene, this->Counts);
  const bool isGathered =
    radius && !bounds.IsEmpty() && *radius >= glm::distance(bounds.Low, bounds.High);
  if (isGathered)
  {
    std::vector<double> received(1, static_cast<double>(this->Counts.SceneBytes));
    this->Ranks.Sum(received);
    if (this->Ranks.IsFirst())
    {
      this->Warn("Irradiance, and occlusion with a radius of the size of the scene, need the "
                 "surfaces of all ranks on each rank. All together received " +
        std::to_string(static_cast<long long>(received[0])) + " bytes of them.");
    }
  }
  return first;
}

}
