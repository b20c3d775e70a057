// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointMerger.h"

#include "vtkPoints.h"

#include <cstdint>
#include <cstring>

namespace penumbra
{

vtkIdType PointMerger::Insert(const double coordinates[3])
{
  // Adding 0 makes 0 of -0.
  const double point[3] = { coordinates[0] + 0.0, coordinates[1] + 0.0, coordinates[2] + 0.0 };
  if (2 * (this->Coordinates.size() / 3 + 1) > this->Slots.size())
  {
    this->Grow();
  }
  vtkIdType& slot = this->Slots[this->FindSlot(point)];
  if (slot < 0)
  {
    slot = static_cast<vtkIdType>(this->Coordinates.size() / 3);
    this->Coordinates.insert(this->Coordinates.end(), point, point + 3);
  }
  return slot;
}

std::size_t PointMerger::FindSlot(const double point[3]) const
{
  std::uint64_t hash = 0;
  for (int i = 0; i < 3; ++i)
  {
    std::uint64_t bits;
    std::memcpy(&bits, point + i, sizeof(bits));
    hash = (hash ^ bits ^ (bits >> 32)) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 29;
  }
  const std::size_t mask = this->Slots.size() - 1;
  std::size_t slot = static_cast<std::size_t>(hash) & mask;
  while (this->Slots[slot] >= 0 &&
    std::memcmp(&this->Coordinates[3 * this->Slots[slot]], point, 3 * sizeof(double)) != 0)
  {
    slot = (slot + 1) & mask;
  }
  return slot;
}

void PointMerger::Grow()
{
  this->Slots.assign(this->Slots.empty() ? 1024 : 2 * this->Slots.size(), -1);
  for (std::size_t i = 0; i < this->Coordinates.size(); i += 3)
  {
    this->Slots[this->FindSlot(&this->Coordinates[i])] = static_cast<vtkIdType>(i / 3);
  }
}

vtkSmartPointer<vtkPoints> PointMerger::MakePoints(int type) const
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type);
  points->SetNumberOfPoints(static_cast<vtkIdType>(this->Coordinates.size() / 3));
  for (std::size_t i = 0; i < this->Coordinates.size(); i += 3)
  {
    points->SetPoint(static_cast<vtkIdType>(i / 3), &this->Coordinates[i]);
  }
  return points;
}

}
