// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DistributedScene.h"

#include "ByteStream.h"
#include "ImageDivision.h"
#include "ImageMessage.h"
#include "Scene.h"
#include "SceneUnion.h"
#include "Shadows/CellMarks.h"
#include "SurfaceAppearance.h"
#include "SurfacePart.h"
#include "UnitTiles.h"

#include "vtkImageData.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace penumbra
{
namespace
{

using Units = std::vector<std::uint32_t>;

/// Returns the number of primitives of the scene in each tile.
std::vector<std::uint32_t> CountByTile(const Scene& scene)
{
  const glm::ivec2 tiles =
    ImageDivision::CountTiles({ scene.ViewCamera.Width, scene.ViewCamera.Height });
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(tiles.x) * tiles.y, 0);
  for (const Surface& surface : scene.Surfaces)
  {
    VisitTilesOfUnits(surface, scene.ViewCamera, [&](std::uint32_t, int tile) { ++counts[tile]; });
  }
  return counts;
}

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

Units ListUnits(const Surface& surface)
{
  Units units(CountUnits(surface));
  std::iota(units.begin(), units.end(), 0u);
  return units;
}

/// Returns the units of a surface that each rank needs to render its part of the image.
std::vector<Units> SelectSeenUnits(
  const Surface& surface, const Camera& camera, const ImageDivision& division, int ranks)
{
  std::vector<Units> selected(static_cast<std::size_t>(ranks));
  VisitTilesOfUnits(surface, camera, [&](std::uint32_t unit, int tile) {
    Units& units = selected[static_cast<std::size_t>(division.GetOwner(tile))];
    if (units.empty() || units.back() != unit)
    {
      units.push_back(unit);
    }
  });
  return selected;
}

/// Messages to all ranks: textures, then parts of surfaces.
class SurfaceMessages
{
public:
  explicit SurfaceMessages(int ranks)
    : Textures(static_cast<std::size_t>(ranks)),
      Parts(static_cast<std::size_t>(ranks))
  {
  }

  void Add(std::uint32_t united, const Surface& surface, std::size_t rank, const Units& units)
  {
    if (!units.empty())
    {
      CollectTextures(surface, this->Textures[rank]);
      this->Parts[rank].Add(united);
      AddPart(surface, units, this->Parts[rank]);
    }
  }

  std::string Take(int rank)
  {
    ByteWriter textures;
    textures.Add(static_cast<std::uint64_t>(this->Textures[rank].size()));
    for (const auto& [hash, texture] : this->Textures[rank])
    {
      textures.Add(hash);
      AddTexture(*texture, textures);
    }
    return textures.Take() + this->Parts[rank].Take();
  }

private:
  std::vector<TextureMap> Textures;
  std::vector<ByteWriter> Parts;
};

void GetTextures(ByteReader& bytes, TextureMap& textures)
{
  const auto count = bytes.Get<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const auto hash = bytes.Get<std::uint64_t>();
    textures[hash] = GetTexture(bytes);
  }
}

/// Adds to `selected` the units that may cast shadows on those that it contains.
void AddCastersOfShadows(const Scene& scene, const AxisAlignedBox& bounds, RankGroup& ranks,
  std::vector<std::vector<Units>>& selected)
{
  const auto count = static_cast<std::size_t>(ranks.GetCount());
  std::vector<CellMarks> marks(count, CellMarks(bounds));
  for (std::size_t i = 0; i < selected.size(); ++i)
  {
    for (std::size_t rank = 0; rank < count; ++rank)
    {
      for (const std::uint32_t unit : selected[i][rank])
      {
        marks[rank].Mark(GetUnitBox(scene.Surfaces[i], unit));
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
  marks.assign(count, CellMarks(bounds));
  const std::vector<std::string> bits = ranks.AllGather(needed.Write());
  for (std::size_t rank = 0; rank < count; ++rank)
  {
    marks[rank].Add(bits[rank]);
  }
  for (std::size_t i = 0; i < selected.size(); ++i)
  {
    const Surface& surface = scene.Surfaces[i];
    std::vector<Units> casters(count);
    const std::size_t units = surface.IsLineOrPoint ? 0 : CountUnits(surface);
    for (std::uint32_t unit = 0; unit < units; ++unit)
    {
      const AxisAlignedBox box = GetUnitBox(surface, unit);
      for (std::size_t rank = 0; rank < count; ++rank)
      {
        if (marks[rank].Meet(box))
        {
          casters[rank].push_back(unit);
        }
      }
    }
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
std::vector<Surface> Assemble(
  const std::vector<UnitedSurface>& united, std::vector<std::string>& messages)
{
  TextureMap textures;
  std::vector<ByteReader> readers(messages.begin(), messages.end());
  for (ByteReader& reader : readers)
  {
    GetTextures(reader, textures);
  }
  std::vector<Surface> surfaces;
  for (const UnitedSurface& surface : united)
  {
    surfaces.push_back(MakeEmptySurface(surface.Appearance, textures));
    surfaces.back().Whole = surface.Whole;
  }
  for (std::size_t i = 0; i < readers.size(); ++i)
  {
    while (!readers[i].IsAtEnd())
    {
      const auto index = readers[i].Get<std::uint32_t>();
      AppendPart(readers[i], surfaces.at(index));
    }
    messages[i] = std::string(); // frees the memory
  }
  std::for_each(surfaces.begin(), surfaces.end(), FinishParts);
  return surfaces;
}

/// Returns the surface that each surface of this rank is a part of.
std::vector<std::uint32_t> FindUnited(
  const std::vector<UnitedSurface>& united, std::size_t surfaces)
{
  std::vector<std::uint32_t> result(surfaces);
  for (std::uint32_t i = 0; i < united.size(); ++i)
  {
    for (const std::uint32_t own : united[i].Own)
    {
      result[own] = i;
    }
  }
  return result;
}

}

DistributedScene::DistributedScene(
  vtkMultiProcessController* controller, std::function<void(const std::string&)> warn)
  : Ranks(controller),
    Warn(std::move(warn))
{
}

void DistributedScene::Compare(const SettingList& settings)
{
  ByteWriter own;
  for (const auto& [name, value] : settings)
  {
    own.Add(name);
    own.Add(value);
  }
  const std::vector<std::string> messages = this->Ranks.AllGather(own.Take());
  for (std::size_t rank = 1; rank < messages.size(); ++rank)
  {
    ByteReader first(messages[0]);
    ByteReader other(messages[rank]);
    while (!first.IsAtEnd() && !other.IsAtEnd())
    {
      const std::string name = first.Get<std::string>();
      const std::string value = first.Get<std::string>();
      if (other.Get<std::string>() != name || other.Get<std::string>() != value)
      {
        throw RankFailure("The ranks 0 and " + std::to_string(rank) + " disagree about " + name +
          ". Give all ranks the same settings.");
      }
    }
  }
}

void DistributedScene::UniteExtent(double bounds[6], double& radius)
{
  ByteWriter own;
  own.Add(std::vector<double>(bounds, bounds + 6));
  own.Add(radius);
  for (const std::string& message : this->Ranks.AllGather(own.Take()))
  {
    ByteReader reader(message);
    const auto other = reader.Get<std::vector<double>>();
    radius = std::max(radius, reader.Get<double>());
    for (int axis = 0; axis < 3 && other[0] <= other[1]; ++axis)
    {
      const bool isEmpty = !(bounds[0] <= bounds[1]) && axis == 0;
      if (isEmpty)
      {
        std::copy(other.begin(), other.end(), bounds);
        break;
      }
      bounds[2 * axis] = std::min(bounds[2 * axis], other[2 * axis]);
      bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], other[2 * axis + 1]);
    }
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
  const std::vector<UnitedSurface> united = UniteSurfaces(scene, this->Ranks);
  const std::vector<std::uint32_t> unitedOf = FindUnited(united, scene.Surfaces.size());
  AxisAlignedBox bounds;
  for (const UnitedSurface& surface : united)
  {
    this->Counts.WholePrimitives += static_cast<long long>(surface.Count);
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
  long long bytes = 0;
  SurfaceMessages messages(this->Ranks.GetCount());
  for (std::size_t i = 0; i < scene.Surfaces.size(); ++i)
  {
    Surface& surface = scene.Surfaces[i];
    bytes += static_cast<long long>(CountBytes(surface));
    const Units all = sendsAll ? ListUnits(surface) : Units();
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      messages.Add(unitedOf[i], surface, rank, sendsAll ? all : selected[i][rank]);
    }
    surface = Surface(); // frees the memory
    if (!sendsAll)
    {
      selected[i] = std::vector<Units>();
    }
  }
  const long long before = this->Ranks.GetReceivedBytes();
  std::vector<std::string> received =
    this->Ranks.Exchange([&](int rank) { return messages.Take(rank); });
  this->Counts.SceneBytes = this->Ranks.GetReceivedBytes() - before;
  scene.Surfaces = Assemble(united, received);
  this->Count(scene, bytes);
  if (needsAll && this->IsFirst() && this->Ranks.GetCount() > 1)
  {
    this->Warn(
      "Soft shadows, ambient occlusion, indirect light and media need the surfaces of all ranks on "
      "each rank, which received " +
      std::to_string(this->Counts.SceneBytes) + " bytes of them.");
  }
}

void DistributedScene::Count(const Scene& scene, long long bytes)
{
  ByteWriter own;
  own.Add(bytes);
  for (const std::string& message : this->Ranks.AllGather(own.Take()))
  {
    this->Counts.WholeBytes += ByteReader(message).Get<long long>();
  }
  for (const Surface& surface : scene.Surfaces)
  {
    this->Counts.Primitives += static_cast<long long>(surface.GetNumberOfPrimitives());
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
  if (!this->IsFirst())
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
    if (this->IsFirst() && rank > 0)
    {
      ByteReader reader(extents[rank]);
      AddPixels(image, reader.Get<std::vector<int>>().data(), writer);
    }
    return writer.Take();
  });
  this->Counts.PixelBytes += this->Ranks.GetReceivedBytes() - before;
  if (this->IsFirst())
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
