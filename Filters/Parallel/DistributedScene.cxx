// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DistributedScene.h"

#include "Geometry/SmoothSurface.h"
#include "ImageDivision.h"
#include "ImageMessage.h"
#include "Messages/ByteStream.h"
#include "Messages/SurfaceMessages.h"
#include "Messages/SurfacePart.h"
#include "Scene.h"
#include "Shadows/CellMarks.h"
#include "Shadows/RankCells.h"
#include "Surface.h"
#include "UnitSelection.h"

#include "vtkImageData.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace penumbra
{
namespace
{

/// Number of rectangles for each rank. More follow the data better and have longer sides, along which
/// primitives and rays are needed twice; light effects join the pixels of wide margins.
constexpr int PartsPerRank = 4;
constexpr int PartsPerRankWithLight = 1;

ImageDivision DivideImage(const Scene& scene, bool hasLight, RankGroup& ranks)
{
  ByteWriter own;
  own.Add(CountByTile(scene));
  std::vector<std::vector<std::uint32_t>> counts;
  for (const std::string& message : ranks.AllGather(own.Take()))
  {
    ByteReader reader(message);
    counts.push_back(reader.Get<std::vector<std::uint32_t>>());
  }
  return { { scene.ViewCamera.Width, scene.ViewCamera.Height }, counts,
    hasLight ? PartsPerRankWithLight : PartsPerRank };
}

/// Returns a bound of the distance from a unit at which shadow rays start, see ComputeLift().
float GetLargestLift(const Surface& surface, std::uint32_t unit)
{
  if (surface.Normals.empty() || surface.IsRound() || surface.IsLineOrPoint)
  {
    return 0.f;
  }
  if (surface.Instances)
  {
    const AxisAlignedBox box = surface.Instances->GetBox(unit);
    const float diagonal = glm::length(box.High - box.Low); // no edge is longer
    return std::isfinite(diagonal) ? diagonal : 0.f;
  }
  return LargestLift(surface.GetPoints(unit), surface.GetNormals(unit, surface.Normals));
}

/// Returns the box of the origins of shadow rays.
AxisAlignedBox Grow(const AxisAlignedBox& box, float lift)
{
  return { box.Low - lift, box.High + lift };
}

/// Returns the bounds of a scene, the same on all ranks, with the origins of shadow rays from `selected` units.
AxisAlignedBox UniteReceivers(const Scene& scene, const AxisAlignedBox& bounds, RankGroup& ranks,
  const std::vector<std::vector<Units>>& selected)
{
  float lift = 0.f;
  for (std::size_t i = 0; i < selected.size(); ++i)
  {
    for (const Units& units : selected[i])
    {
      for (const std::uint32_t unit : units)
      {
        lift = std::max(lift, GetLargestLift(scene.Surfaces[i], unit));
      }
    }
  }
  const AxisAlignedBox box = Grow(bounds, lift);
  double united[6] = { box.Low.x, box.High.x, box.Low.y, box.High.y, box.Low.z, box.High.z };
  ranks.UniteBounds(united);
  return { glm::vec3(united[0], united[2], united[4]), glm::vec3(united[1], united[3], united[5]) };
}

/// Adds to `selected` the units that may cast shadows on those that it contains.
void AddCastersOfShadows(const Scene& scene, const AxisAlignedBox& box, RankGroup& ranks,
  std::vector<std::vector<Units>>& selected)
{
  const AxisAlignedBox bounds = UniteReceivers(scene, box, ranks, selected);
  const auto count = static_cast<std::size_t>(ranks.GetCount());
  std::vector<CellMarks> marks(count, CellMarks(bounds));
  for (std::size_t i = 0; i < selected.size(); ++i)
  {
    for (std::size_t rank = 0; rank < count; ++rank)
    {
      for (const std::uint32_t unit : selected[i][rank])
      {
        const Surface& surface = scene.Surfaces[i];
        marks[rank].Mark(Grow(GetUnitBox(surface, unit), GetLargestLift(surface, unit)));
      }
    }
  }
  CellMarks seen(bounds);
  for (const std::string& bits : ranks.Exchange([&](int rank) { return marks[rank].Write(); }))
  {
    seen.Add(bits);
  }
  CellMarks needed(bounds);
  for (const Light& light : scene.Lights)
  {
    if (light.CastsShadow)
    {
      needed.MarkToward(light, seen);
    }
  }
  const RankCells cells(bounds, ranks.AllGather(needed.Write()));
  for (std::size_t i = 0; i < selected.size(); ++i)
  {
    const Surface& surface = scene.Surfaces[i];
    const std::vector<Units> casters =
      surface.IsLineOrPoint ? std::vector<Units>(count) : SelectUnits(surface, cells, count);
    for (std::size_t rank = 0; rank < count; ++rank)
    {
      Units both;
      std::set_union(casters[rank].begin(), casters[rank].end(), selected[i][rank].begin(),
        selected[i][rank].end(), std::back_inserter(both));
      selected[i][rank] = std::move(both);
    }
  }
}

/// Makes the surfaces of the scene of which this rank has received parts.
std::vector<Surface> Assemble(const std::vector<UnitedSurface>& united, ReceivedSurfaces& received)
{
  std::vector<Surface> surfaces;
  for (const UnitedSurface& surface : united)
  {
    surfaces.push_back(MakeEmptySurface(surface.Appearance, received.GetTextures()));
    surfaces.back().Whole = surface.Whole;
  }
  received.AppendTo(surfaces, 0, received.GetCount());
  std::for_each(surfaces.begin(), surfaces.end(), FinishParts);
  return surfaces;
}

}

DistributedScene::DistributedScene(
  vtkMultiProcessController* controller, std::function<void(const std::string&)> warn)
  : Ranks(controller),
    Warn(std::move(warn))
{
}

void DistributedScene::UniteExtent(double bounds[6], double& radius)
{
  this->Ranks.UniteBounds(bounds);
  ByteWriter own;
  own.Add(radius);
  for (const std::string& message : this->Ranks.AllGather(own.Take()))
  {
    radius = std::max(radius, ByteReader(message).Get<double>());
  }
}

std::vector<std::vector<Units>> DistributedScene::Select(const Scene& scene,
  const ImageDivision& division, LightRays lightRays, const AxisAlignedBox& bounds)
{
  std::vector<std::vector<Units>> selected;
  for (const Surface& surface : scene.Surfaces)
  {
    selected.push_back(
      SelectSeenUnits(surface, scene.ViewCamera, division, this->Ranks.GetCount()));
  }
  if (lightRays == LightRays::ToLights && !bounds.IsEmpty())
  {
    AddCastersOfShadows(scene, bounds, this->Ranks, selected);
  }
  return selected;
}

void DistributedScene::Exchange(Scene& scene, LightRays lightRays)
{
  std::vector<UnitedSurface> united = UniteSurfaces(scene, this->Ranks);
  FindDenseSurfaces(scene, this->Ranks, united);
  AxisAlignedBox bounds;
  for (const UnitedSurface& surface : united)
  {
    bounds.Add(surface.Whole->DrawnBounds);
  }
  const bool needsAll = lightRays == LightRays::All;
  const ImageDivision division = DivideImage(scene, needsAll, this->Ranks);
  this->Regions = division.GetRegions(this->Ranks.GetRank());
  const std::size_t ranks = static_cast<std::size_t>(this->Ranks.GetCount());
  const bool sendsAll = needsAll || (lightRays == LightRays::ToLights && ranks == 1);
  std::vector<std::vector<Units>> selected;
  if (!sendsAll)
  {
    selected = this->Select(scene, division, lightRays, bounds);
  }
  CountWhole(scene, united, this->Ranks, this->Counts);
  std::vector<SurfaceMessage> messages(sendsAll ? 1 : ranks);
  for (std::uint32_t i = 0; i < united.size(); ++i)
  {
    for (const std::uint32_t own : united[i].Own)
    {
      Surface& surface = scene.Surfaces[own];
      for (std::size_t rank = 0; rank < messages.size(); ++rank)
      {
        messages[rank].Add(i, surface, sendsAll ? ListAllUnits(surface) : selected[own][rank]);
      }
      surface = Surface(); // frees the memory
    }
  }
  selected.clear();
  const std::string all = sendsAll ? messages[0].Take() : std::string();
  ReceivedSurfaces received(ExchangeSurfaces(
    [&](int rank) { return sendsAll ? all : messages[rank].Take(); }, this->Ranks, this->Counts));
  scene.Surfaces = Assemble(united, received);
  CountPrimitives(scene, this->Counts);
  if (needsAll && this->Ranks.GetCount() > 1)
  {
    std::vector<double> bytes(1, static_cast<double>(this->Counts.SceneBytes));
    this->Ranks.Sum(bytes);
    if (this->Ranks.IsFirst())
    {
      this->Warn("Soft shadows, ambient occlusion, indirect light and media need the surfaces of "
                 "all ranks on "
                 "each rank. All together received " +
        std::to_string(static_cast<long long>(bytes[0])) + " bytes of them.");
    }
  }
}

void DistributedScene::Compose(
  const std::vector<vtkSmartPointer<vtkImageData>>& parts, vtkImageData* image, ImageTotals& totals)
{
  this->Counts.Rays = totals.Rays.GetTotal() + totals.Rays.Repeated;
  ByteWriter own;
  own.Add(totals);
  for (vtkImageData* part : parts)
  {
    AddPixels(part, part->GetExtent(), own);
  }
  const long long before = this->Ranks.GetReceivedBytes();
  const std::vector<std::string> messages =
    this->Ranks.Exchange([&](int rank) { return rank == 0 ? own.Take() : std::string(); });
  this->Counts.PixelBytes += this->Ranks.GetReceivedBytes() - before;
  if (!this->Ranks.IsFirst())
  {
    return;
  }
  totals = ImageTotals();
  for (const std::string& message : messages)
  {
    ByteReader reader(message);
    const auto other = reader.Get<ImageTotals>();
    totals.Rays += other.Rays;
    totals.Pixels += other.Pixels;
    totals.Edges += other.Edges;
    totals.Unfinished += other.Unfinished;
    while (!reader.IsAtEnd())
    {
      GetPixels(reader, image);
    }
  }
}

void DistributedScene::Deliver(const int extent[6], vtkImageData* image)
{
  ByteWriter own;
  own.Add(std::vector<int>(extent, extent + 6));
  const std::vector<std::string> extents = this->Ranks.AllGather(own.Take());
  const long long before = this->Ranks.GetReceivedBytes();
  const std::vector<std::string> messages = this->Ranks.Exchange([&](int rank) {
    ByteWriter writer;
    if (this->Ranks.IsFirst() && rank > 0)
    {
      ByteReader reader(extents[rank]);
      AddPixels(image, reader.Get<std::vector<int>>().data(), writer);
    }
    return writer.Take();
  });
  this->Counts.PixelBytes += this->Ranks.GetReceivedBytes() - before;
  if (this->Ranks.IsFirst())
  {
    CropImage(extent, image);
    return;
  }
  image->Initialize();
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  ByteReader reader(messages[0]);
  GetPixels(reader, image);
}

}
