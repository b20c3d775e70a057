// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CellMarks.h"

#include "Light.h"

#include <algorithm>

namespace penumbra
{

bool CellMarks::Range::IsEmpty() const
{
  return this->Low.x > this->High.x || this->Low.y > this->High.y || this->Low.z > this->High.z;
}

bool CellMarks::Range::IsLarge() const
{
  const glm::ivec3 size = this->High - this->Low + 1;
  return size.x * size.y * size.z > MostCells;
}

std::size_t CellMarks::GetIndex(glm::ivec3 cell)
{
  return (static_cast<std::size_t>(cell.z) * Side + cell.y) * Side + cell.x;
}

CellMarks::CellMarks(const AxisAlignedBox& bounds)
  : Low(bounds.Low),
    Marks(static_cast<std::size_t>(Side) * Side * Side, 0)
{
  const glm::dvec3 extent = glm::dvec3(bounds.High) - this->Low;
  this->CellSize = std::max({ extent.x, extent.y, extent.z, 1e-30 }) / Side;
}

CellMarks::Range CellMarks::GetCells(glm::dvec3 low, glm::dvec3 high)
{
  return { glm::ivec3(glm::clamp(glm::floor(low - Margin), 0.0, double(Side))),
    glm::ivec3(glm::clamp(glm::floor(high + Margin), -1.0, Side - 1.0)) };
}

CellMarks::Range CellMarks::GetCells(const AxisAlignedBox& box) const
{
  return GetCells(this->Locate(glm::dvec3(box.Low)), this->Locate(glm::dvec3(box.High)));
}

void CellMarks::Mark(const AxisAlignedBox& box)
{
  const Range range = this->GetCells(box);
  if (range.IsLarge())
  {
    this->Large.Add(box);
  }
  else
  {
    this->MarkCells(range);
  }
}

void CellMarks::MarkCells(const Range& range)
{
  for (int z = range.Low.z; z <= range.High.z; ++z)
  {
    for (int y = range.Low.y; y <= range.High.y; ++y)
    {
      for (int x = range.Low.x; x <= range.High.x; ++x)
      {
        this->Marks[GetIndex({ x, y, z })] = 1;
      }
    }
  }
}

bool CellMarks::Meet(const AxisAlignedBox& box) const
{
  const Range range = this->GetCells(box);
  bool isMarked = range.IsLarge();
  for (int z = range.Low.z; z <= range.High.z && !isMarked; ++z)
  {
    for (int y = range.Low.y; y <= range.High.y && !isMarked; ++y)
    {
      for (int x = range.Low.x; x <= range.High.x && !isMarked; ++x)
      {
        isMarked = this->Marks[GetIndex({ x, y, z })] != 0;
      }
    }
  }
  return isMarked;
}

std::string CellMarks::Write()
{
  if (!this->Large.IsEmpty())
  {
    this->MarkCells(this->GetCells(this->Large));
  }
  std::string bits(this->Marks.size() / 8, '\0');
  for (std::size_t i = 0; i < this->Marks.size(); ++i)
  {
    bits[i / 8] |= static_cast<char>(this->Marks[i] << i % 8);
  }
  return bits;
}

void CellMarks::Add(const std::string& bits)
{
  for (std::size_t i = 0; i < this->Marks.size(); ++i)
  {
    this->Marks[i] |= static_cast<char>(bits.at(i / 8) >> i % 8 & 1);
  }
}

void CellMarks::MarkToward(const Light& light, const CellMarks& from)
{
  for (int z = 0; z < Side; ++z)
  {
    for (int y = 0; y < Side; ++y)
    {
      for (int x = 0; x < Side; ++x)
      {
        if (from.Marks[GetIndex({ x, y, z })] != 0)
        {
          this->MarkTowardFromCell(light, { x, y, z });
        }
      }
    }
  }
}

// Rays from a cell are within half a cell of the one from its center, which is within half a cell of one of
// the points, whose distance is one cell along an axis.
void CellMarks::MarkTowardFromCell(const Light& light, glm::ivec3 cell)
{
  constexpr double Reach = 1.0;
  const glm::dvec3 center = glm::dvec3(cell) + 0.5;
  const bool isDirectional = light.Kind == Light::Kinds::Directional;
  const glm::dvec3 toLight = isDirectional ? -glm::dvec3(light.Direction)
                                           : this->Locate(glm::dvec3(light.Position)) - center;
  const glm::dvec3 size = glm::abs(toLight);
  const double length = std::max({ size.x, size.y, size.z });
  const glm::dvec3 step = toLight / std::max(length, 1e-30);
  for (int at = 0; isDirectional || at < length + 1.0; ++at)
  {
    const glm::dvec3 point = center + static_cast<double>(at) * step;
    const Range range = GetCells(point - Reach, point + Reach);
    if (range.IsEmpty())
    {
      break; // outside of the bounds
    }
    this->MarkCells(range);
  }
}

}
