// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of the bounds of a scene that may contain parts of some boxes, or of what is between them and a light.
#ifndef penumbra_CellMarks_h
#define penumbra_CellMarks_h

#include "AxisAlignedBox.h"
#include "vtkPenumbraFiltersParallelModule.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace penumbra
{

struct Light;

class VTKPENUMBRAFILTERSPARALLEL_EXPORT CellMarks
{
  static constexpr int Side = 64;

public:
  /// Number of cells, and of rows of them.
  static constexpr std::size_t Count = std::size_t{ Side } * Side * Side;
  static constexpr std::size_t RowCount = Count / Side;

  /// `bounds` are those of the whole scene, the same on all ranks.
  explicit CellMarks(const AxisAlignedBox& bounds);

  /// Marks the cells of a box.
  void Mark(const AxisAlignedBox& box);

  /// Marks what is between the marked cells of another object and a light. Marks all cells if the light has no
  /// finite position, no direction, or a wide angle.
  void MarkToward(const Light& light, const CellMarks& from);

  bool IsMarked(std::size_t cell) const
  {
    return (this->Rows[cell / Side] >> cell % Side & 1) != 0;
  }

  /// Calls visit(row, first, last) for the rows of the cells that Mark() would mark, which are those from `first`
  /// to before `last`.
  template <typename Visit>
  void VisitRows(const AxisAlignedBox& box, const Visit& visit) const
  {
    const Range range = this->GetCells(box);
    for (int z = range.Low.z; z <= range.High.z && !range.IsEmpty(); ++z)
    {
      for (int y = range.Low.y; y <= range.High.y; ++y)
      {
        const std::size_t row = GetIndex(y, z);
        visit(row, row * Side + range.Low.x, row * Side + range.High.x + 1);
      }
    }
  }

  /// Writes the marked cells as bits.
  std::string Write() const;

  /// Marks the cells that Write() has written.
  void Add(const std::string& bits);

private:
  /// A row of cells along x has one bit for each.
  using Row = std::uint64_t;
  /// Margin of boxes in cells, more than the offset of the origin of a ray. This is 1e-5 of
  /// the largest coordinate (RayOriginOffset()), and the origin of coordinates may be at a camera from which the
  /// scene ends at a depth of 34 diagonals (see ComputeAdvance()): 5.9e-4 of the longest side, or 0.038 cells.
  static constexpr double Margin = 0.1;

  /// The cells from Low to High; none if Low > High.
  struct Range
  {
    glm::ivec3 Low, High;

    bool IsEmpty() const;
    Row GetBits() const; ///< of each of its rows, unless it is empty
  };

  static std::size_t GetIndex(int y, int z) { return static_cast<std::size_t>(z) * Side + y; }

  /// Returns the position of a point in cells.
  glm::dvec3 Locate(glm::dvec3 point) const { return (point - this->Low) / this->CellSize; }

  /// Returns the cells of a box that is given in cells.
  static Range GetCells(glm::dvec3 low, glm::dvec3 high);
  Range GetCells(const AxisAlignedBox& box) const;

  /// Distance by which the rays to a light diverge in a cell, above which what is between is not followed closely.
  static constexpr double MostDivergence = 0.25;

  void MarkAll();
  void MarkCells(const Range& range);
  /// `spread`: radius of a light with a position, in cells, or largest distance of the ends of directions of unit
  /// length from that of its center.
  void MarkTowardFromCell(glm::ivec3 cell, glm::dvec3 light, bool isDirectional, double spread);

  glm::dvec3 Low;
  double CellSize;
  std::vector<Row> Rows;
};

}
#endif
