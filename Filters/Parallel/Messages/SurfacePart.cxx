// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePart.h"

#include "Surface.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace penumbra
{
namespace
{

using Index = std::uint32_t;

/// Returns the selected elements; none if `values` is empty.
template <typename T>
std::vector<T> Select(const std::vector<T>& values, const std::vector<Index>& indices)
{
  std::vector<T> selected;
  if (!values.empty())
  {
    selected.reserve(indices.size());
    std::transform(indices.begin(), indices.end(), std::back_inserter(selected),
      [&](Index i) { return values[i]; });
  }
  return selected;
}

/// The positions of a part.
class UsedPositions
{
public:
  UsedPositions(const Surface& surface, const std::vector<Index>& primitives)
    : NewIds(surface.Positions.size(), None)
  {
    for (const Index primitive : primitives)
    {
      const glm::uvec3 corners = surface.GetCorners(primitive);
      for (int i = 0; i < 3; ++i)
      {
        this->NewIds[corners[i]] = 0;
      }
    }
    for (std::size_t i = 0; i < this->NewIds.size(); ++i)
    {
      if (this->NewIds[i] != None)
      {
        this->NewIds[i] = static_cast<Index>(this->Positions.size());
        this->Positions.push_back(static_cast<Index>(i));
      }
    }
  }

  const std::vector<Index>& GetPositions() const { return this->Positions; }
  Index GetNewId(Index position) const { return this->NewIds[position]; }

private:
  static constexpr Index None = std::numeric_limits<Index>::max();
  std::vector<Index> NewIds;
  std::vector<Index> Positions;
};

/// Returns the indices that a surface of instances needs of its shape: all.
std::vector<Index> ListAll(std::size_t count)
{
  std::vector<Index> all(count);
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/// Seven bits of a packed index; the eighth bit of a byte says that more follow.
constexpr int PackedBits = 7;
constexpr Index MoreBytes = 1u << PackedBits;

/// Adds indices, or vectors of them, as their differences, of which small ones take a byte.
template <typename T>
void AddIndices(const std::vector<T>& values, ByteWriter& bytes)
{
  std::vector<unsigned char> packed;
  Index last = 0;
  for (const T& value : values)
  {
    Index indices[sizeof(T) / sizeof(Index)];
    std::memcpy(indices, &value, sizeof(T));
    for (const Index index : indices)
    {
      const Index difference = index - last;
      // 0, -1, 1, -2, 2, ... as 0, 1, 2, 3, 4, ...
      Index rest = difference >> 31 ? ~(difference << 1) : difference << 1;
      for (; rest >= MoreBytes; rest >>= PackedBits)
      {
        packed.push_back(static_cast<unsigned char>(rest | MoreBytes));
      }
      packed.push_back(static_cast<unsigned char>(rest));
      last = index;
    }
  }
  bytes.Add(static_cast<std::uint64_t>(values.size()));
  bytes.Add(packed);
}

/// Appends the indices of AddIndices(), increased by `offset`.
template <typename T>
void AppendIndices(ByteReader& bytes, Index offset, std::vector<T>& values)
{
  const auto count = bytes.Get<std::uint64_t>();
  const auto packed = bytes.Get<std::vector<unsigned char>>();
  auto byte = packed.begin();
  Index last = offset;
  values.reserve(values.size() + count + 1);
  for (std::uint64_t i = 0; i < count; ++i)
  {
    Index indices[sizeof(T) / sizeof(Index)];
    for (Index& index : indices)
    {
      Index rest = 0;
      int shift = 0;
      for (bool hasMore = true; hasMore && byte != packed.end(); shift += PackedBits)
      {
        hasMore = (*byte & MoreBytes) != 0;
        rest |= (*byte++ & (MoreBytes - 1)) << shift;
      }
      last += rest & 1u ? ~(rest >> 1) : rest >> 1;
      index = last;
    }
    values.emplace_back();
    std::memcpy(static_cast<void*>(&values.back()), indices, sizeof(T));
  }
}

/// Calls visit(values) for the arrays of a surface with an element for each position, except Radii.
template <typename SurfaceT, typename Visit>
void VisitPositionArrays(SurfaceT& s, const Visit& visit)
{
  visit(s.Positions);
  visit(s.Normals);
  visit(s.PointColors);
  visit(s.ColorCoordinates);
  visit(s.Tangents);
  visit(s.TextureCoordinates);
}

}

std::size_t CountUnits(const Surface& surface)
{
  return surface.Instances ? surface.Instances->GetCount() : surface.GetNumberOfPrimitives();
}

AxisAlignedBox GetUnitBox(const Surface& surface, std::uint32_t unit)
{
  if (surface.Instances)
  {
    return surface.Instances->GetBox(unit);
  }
  AxisAlignedBox box;
  if (surface.IsRound())
  {
    const RoundShape shape = surface.GetRoundShape(unit);
    box.Add(shape.A - shape.RadiusA);
    box.Add(shape.A + shape.RadiusA);
    box.Add(shape.B - shape.RadiusB);
    box.Add(shape.B + shape.RadiusB);
    return box;
  }
  for (const glm::vec3& point : surface.GetPoints(unit))
  {
    box.Add(point);
  }
  return box;
}

void AddPart(const Surface& surface, const std::vector<Index>& units, ByteWriter& bytes)
{
  const std::vector<Index> primitives =
    surface.Instances ? ListAll(surface.Triangles.size()) : units;
  const UsedPositions used(surface, primitives);
  const std::vector<Index>& positions = used.GetPositions();
  VisitPositionArrays(surface, [&](const auto& values) { bytes.Add(Select(values, positions)); });
  bytes.Add(surface.Radii.size() > 1 ? Select(surface.Radii, positions) : std::vector<float>());
  std::vector<glm::uvec3> triangles;
  std::vector<glm::uvec2> segments;
  std::vector<Index> cells;
  for (const Index primitive : primitives)
  {
    const glm::uvec3 corners = surface.GetCorners(primitive);
    if (!surface.IsRound())
    {
      triangles.emplace_back(
        used.GetNewId(corners.x), used.GetNewId(corners.y), used.GetNewId(corners.z));
    }
    else if (!surface.Segments.empty())
    {
      segments.emplace_back(used.GetNewId(corners.x), used.GetNewId(corners.y));
    }
    if (!surface.Instances)
    {
      cells.push_back(surface.GetCellId(primitive));
    }
  }
  AddIndices(triangles, bytes);
  AddIndices(segments, bytes);
  AddIndices(cells, bytes);
  bytes.Add(Select(surface.TriangleNormals, primitives));
  bytes.Add(Select(surface.CellColors, primitives));
  bytes.Add(surface.Instances != nullptr);
  if (surface.Instances)
  {
    const SurfaceInstances& all = *surface.Instances;
    bytes(Select(all.Transforms, units), Select(all.Colors, units), Select(all.Ids, units),
      all.Center, all.HalfSize, all.Radius);
  }
}

std::size_t CountBytes(const Surface& surface)
{
  std::size_t sum = 0;
  const auto add = [&](const auto& values) {
    sum += sizeof(std::uint64_t) + values.size() * sizeof(values[0]);
  };
  VisitPositionArrays(surface, add);
  add(surface.Radii.size() > 1 ? surface.Radii : std::vector<float>());
  add(surface.Triangles);
  add(surface.Segments);
  const std::size_t cells = surface.Instances ? 0 : surface.GetNumberOfPrimitives();
  sum += sizeof(std::uint64_t) + cells * sizeof(Index);
  add(surface.TriangleNormals);
  add(surface.CellColors);
  sum += sizeof(bool);
  if (surface.Instances)
  {
    add(surface.Instances->Transforms);
    add(surface.Instances->Colors);
    add(surface.Instances->Ids);
    sum += sizeof(SurfaceInstances::Center) + sizeof(SurfaceInstances::HalfSize) +
      sizeof(SurfaceInstances::Radius);
  }
  return sum;
}

void AppendPart(ByteReader& bytes, Surface& surface)
{
  const auto offset = static_cast<Index>(surface.Positions.size());
  VisitPositionArrays(surface, [&](auto& values) { bytes.Get(values); });
  const auto radii = bytes.Get<std::vector<float>>();
  if (!radii.empty())
  {
    surface.Radii.resize(offset);
    surface.Radii.insert(surface.Radii.end(), radii.begin(), radii.end());
  }
  AppendIndices(bytes, offset, surface.Triangles);
  AppendIndices(bytes, offset, surface.Segments);
  AppendIndices(bytes, 0, surface.CellIds);
  bytes.Get(surface.TriangleNormals);
  bytes.Get(surface.CellColors);
  if (bytes.Get<bool>())
  {
    auto all = std::make_shared<SurfaceInstances>();
    bytes(all->Transforms, all->Colors, all->Ids, all->Center, all->HalfSize, all->Radius);
    surface.Instances = std::move(all);
  }
}

// Embree reads 16 bytes at the last element, see Surface.
void FinishParts(Surface& surface)
{
  surface.Positions.reserve(surface.Positions.size() + 1);
  surface.Triangles.reserve(surface.Triangles.size() + 1);
}

}
