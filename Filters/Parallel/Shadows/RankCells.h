// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The cells of CellMarks, with the ranks that have marked them: a box is compared with the marks of all ranks at once.
#ifndef penumbra_RankCells_h
#define penumbra_RankCells_h

#include "CellMarks.h"

#include <cstdint>
#include <string>
#include <vector>

namespace penumbra
{

class VTKPENUMBRAFILTERSPARALLEL_EXPORT RankCells
{
public:
  /// `marks` are what CellMarks::Write() of each rank has written, with these bounds.
  RankCells(const AxisAlignedBox& bounds, const std::vector<std::string>& marks);

  /// Calls visit(rank), in ascending order, for the ranks that have marked a cell of the box.
  template <typename Visit>
  void VisitRanks(const AxisAlignedBox& box, const Visit& visit) const;

private:
  /// A bit for each of some ranks.
  using Word = std::uint64_t;
  static constexpr std::size_t WordSize = 64;

  CellMarks Cells;
  std::size_t WordsPerCell;
  std::vector<Word> Words;    ///< of each cell
  std::vector<Word> RowWords; ///< of each row, the union of its cells
};

template <typename Visit>
void RankCells::VisitRanks(const AxisAlignedBox& box, const Visit& visit) const
{
  for (std::size_t word = 0; word < this->WordsPerCell; ++word)
  {
    Word found = 0;
    this->Cells.VisitRows(box, [&](std::size_t row, std::size_t first, std::size_t last) {
      const Word all = this->RowWords[row * this->WordsPerCell + word];
      for (std::size_t cell = first; cell < last && (all & ~found) != 0; ++cell)
      {
        found |= this->Words[cell * this->WordsPerCell + word];
      }
    });
    for (std::size_t rank = word * WordSize; found != 0; ++rank, found >>= 1)
    {
      if ((found & 1) != 0)
      {
        visit(rank);
      }
    }
  }
}

}
#endif
