// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CellMarks.h"

#include "Light.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace penumbra
{

bool CellMarks::Range::IsEmpty() const
{
  return this->Low.x > this->High.x || this->Low.y > this->High.y || this->Low.z > this->High.z;
}

CellMarks::Row CellMarks::Range::GetBits() const
{
  static_assert(Side == 64, "a bit for each cell");
  return ~Row{ 0 } >> (Side - 1 - (this->High.x - this->Low.x)) << this->Low.x;
}

CellMarks::CellMarks(const AxisAlignedBox& bounds)
  : Low(bounds.Low),
    Rows(static_cast<std::size_t>(Side) * Side, 0)
{
  const glm::dvec3 extent = glm::dvec3(bounds.High) - this->Low;
  this->CellSize = std::max({ extent.x, extent.y, extent.z, 1e-30 }) / Side;
}

// The order of the arguments of glm::min and max makes not-a-number the bounds.
CellMarks::Range CellMarks::GetCells(glm::dvec3 low, glm::dvec3 high)
{
  const glm::dvec3 side(Side);
  const glm::dvec3 first = glm::min(side, glm::max(glm::dvec3(0.0), glm::floor(low - Margin)));
  const glm::dvec3 last =
    glm::max(glm::dvec3(-1.0), glm::min(side - 1.0, glm::floor(high + Margin)));
  return { glm::ivec3(first), glm::ivec3(last) };
}

CellMarks::Range CellMarks::GetCells(const AxisAlignedBox& box) const
{
  return GetCells(this->Locate(glm::dvec3(box.Low)), this->Locate(glm::dvec3(box.High)));
}

void CellMarks::Mark(const AxisAlignedBox& box)
{
  this->MarkCells(this->GetCells(box));
}

void CellMarks::MarkCells(const Range& range)
{
  if (range.IsEmpty())
  {
    return;
  }
  const Row bits = range.GetBits();
  for (int z = range.Low.z; z <= range.High.z; ++z)
  {
    for (int y = range.Low.y; y <= range.High.y; ++y)
    {
      this->Rows[GetIndex(y, z)] |= bits;
    }
  }
}

std::string CellMarks::Write() const
{
  std::string bits(this->Rows.size() * sizeof(Row), '\0');
  std::memcpy(&bits[0], this->Rows.data(), bits.size());
  return bits;
}

void CellMarks::Add(const std::string& bits)
{
  std::vector<Row> rows(this->Rows.size(), 0);
  bits.copy(reinterpret_cast<char*>(rows.data()), rows.size() * sizeof(Row));
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    this->Rows[i] |= rows[i];
  }
}

void CellMarks::MarkToward(const Light& light, const CellMarks& from)
{
  if (std::all_of(from.Rows.begin(), from.Rows.end(), [](Row row) { return row == 0; }))
  {
    return; // nothing is lit
  }
  const bool isDirectional = light.Kind == Light::Kinds::Directional;
  const glm::dvec3 toward =
    isDirectional ? -glm::dvec3(light.Direction) : this->Locate(glm::dvec3(light.Position));
  const bool isFinite = std::isfinite(toward.x + toward.y + toward.z);
  if (!isFinite || (isDirectional && toward == glm::dvec3(0.0)))
  {
    this->MarkAll();
    return;
  }
  const double spread =
    isDirectional ? 2.0 * std::sin(0.5 * light.AngularRadius) : light.Radius / this->CellSize;
  if (isDirectional && spread > MostDivergence)
  {
    this->MarkAll();
    return;
  }
  for (int z = 0; z < Side; ++z)
  {
    for (int y = 0; y < Side; ++y)
    {
      const Row row = from.Rows[GetIndex(y, z)];
      for (int x = 0; x < Side && row >> x != 0; ++x)
      {
        if ((row >> x & 1) != 0)
        {
          this->MarkTowardFromCell({ x, y, z }, toward, isDirectional, spread);
        }
      }
    }
  }
}

void CellMarks::MarkAll()
{
  std::fill(this->Rows.begin(), this->Rows.end(), ~Row{ 0 });
}

// The ray from a cell to the center of the light is within half a cell of the one from the center of the cell, and
// that is within half a cell of one of the points, whose distance is one cell along an axis. Other rays to a light
// with a size diverge from it: all have left the bounds after their diagonal, those of a sphere, which are at least
// three quarters as long, after 4 / 3 of it.
void CellMarks::MarkTowardFromCell(
  glm::ivec3 cell, glm::dvec3 light, bool isDirectional, double spread)
{
  const glm::dvec3 center = glm::dvec3(cell) + 0.5;
  const glm::dvec3 toLight = isDirectional ? light : light - center;
  const glm::dvec3 size = glm::abs(toLight);
  const double length = std::max({ size.x, size.y, size.z, 1e-30 });
  const glm::dvec3 step = toLight / length;
  const double divergence = isDirectional ? spread * glm::length(step) : spread / length;
  if (!isDirectional && divergence > MostDivergence)
  {
    const double reach = spread + 0.5;
    this->MarkCells(
      GetCells(glm::min(center - 0.5, light - reach), glm::max(center + 0.5, light + reach)));
    return;
  }
  const double most = spread > 0.0 ? 3.0 * Side : Side + 2.0;
  const double end = isDirectional ? most : std::min(length + 1.0, most);
  for (int at = 0; at < end; ++at)
  {
    const glm::dvec3 point = center + static_cast<double>(at) * step;
    // Estimators of lights with a size also ask for surfaces at their borders.
    const double reach = (spread > 0.0 ? 2.0 : 1.0) + divergence * (at + 0.5);
    const Range range = GetCells(point - reach, point + reach);
    if (range.IsEmpty())
    {
      break; // outside of the bounds
    }
    this->MarkCells(range);
  }
}

}
