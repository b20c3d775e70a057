// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RankCells.h"

namespace penumbra
{

RankCells::RankCells(const AxisAlignedBox& bounds, const std::vector<std::string>& marks)
  : Cells(bounds),
    WordsPerCell((marks.size() + WordSize - 1) / WordSize),
    Words(CellMarks::Count * this->WordsPerCell, 0),
    RowWords(CellMarks::RowCount * this->WordsPerCell, 0)
{
  for (std::size_t rank = 0; rank < marks.size(); ++rank)
  {
    CellMarks marked(bounds);
    marked.Add(marks[rank]);
    const Word bit = Word{ 1 } << (rank % WordSize);
    const std::size_t word = rank / WordSize;
    for (std::size_t cell = 0; cell < CellMarks::Count; ++cell)
    {
      if (marked.IsMarked(cell))
      {
        const std::size_t row = cell * CellMarks::RowCount / CellMarks::Count;
        this->Words[cell * this->WordsPerCell + word] |= bit;
        this->RowWords[row * this->WordsPerCell + word] |= bit;
      }
    }
  }
}

}
