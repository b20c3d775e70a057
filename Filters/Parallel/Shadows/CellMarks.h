// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of the bounds of a scene that may contain parts of some boxes, or of what is between them and a light.
#ifndef penumbra_CellMarks_h
#define penumbra_CellMarks_h

#include "AxisAlignedBox.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace penumbra
{

struct Light;

class CellMarks
{
public:
  /// `bounds` are those of the whole scene, the same on all ranks.
  explicit CellMarks(const AxisAlignedBox& bounds);

  /// Marks the cells of a box.
  void Mark(const AxisAlignedBox& box);

  /// Marks what is between the marked cells of another object and a light, its size left aside.
  void MarkToward(const Light& light, const CellMarks& from);

  /// Returns true if the box may have a part in a marked cell.
  bool Meet(const AxisAlignedBox& box) const;

  /// Writes the marked cells as bits.
  std::string Write();

  /// Marks the cells that Write() has written.
  void Add(const std::string& bits);

private:
  static constexpr int Side = 64;
  /// Boxes of more cells are large. They are united before they are marked, and meet any cell, which bounds
  /// the work.
  static constexpr int MostCells = 4096;
  /// Margin of boxes in cells, far more than the distance of the origin of a ray from its surface.
  static constexpr double Margin = 0.02;

  /// The cells from Low to High; none if Low > High.
  struct Range
  {
    glm::ivec3 Low, High;

    bool IsEmpty() const;
    bool IsLarge() const;
  };

  static std::size_t GetIndex(glm::ivec3 cell);

  /// Returns the position of a point in cells.
  glm::dvec3 Locate(glm::dvec3 point) const { return (point - this->Low) / this->CellSize; }

  /// Returns the cells of a box that is given in cells.
  static Range GetCells(glm::dvec3 low, glm::dvec3 high);
  Range GetCells(const AxisAlignedBox& box) const;

  void MarkCells(const Range& range);
  void MarkTowardFromCell(const Light& light, glm::ivec3 cell);

  glm::dvec3 Low;
  double CellSize;
  std::vector<char> Marks;
  AxisAlignedBox Large; ///< bounds of large boxes
};

}
#endif
