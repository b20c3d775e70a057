// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sample points of a pixel, sorted by cells, so that a small triangle is compared with few of them.
#ifndef penumbra_SamplePoints_h
#define penumbra_SamplePoints_h

#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <cstdint>
#include <vector>

namespace penumbra
{

/**
 * A part of a (0, 2)-sequence of points of the unit square. The sequence of a pixel is one
 * Owen-scrambled sequence with a digital shift (exclusive or of the bits), which preserves its
 * elementary intervals, see OwenSobolSequence.
 */
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT SamplePoints
{
public:
  static constexpr int CellsPerSide = 4;
  static constexpr int NumberOfCells = CellsPerSide * CellsPerSide;
  static constexpr int MinimumCount = 64;
  static constexpr int MaximumCount = 4096;

  /// Computes the points [first, first + count) of the sequence of a pixel with hash `seed`. `count`
  /// is a power of two of at least MinimumCount, and `first` is 0 or `count`.
  void Compute(std::uint32_t seed, int first, int count);

  int GetCount() const { return static_cast<int>(this->X.size()); }
  int GetCountPerCell() const { return this->GetCount() / NumberOfCells; }

  /// Coordinates of the points, cell by cell and row by row.
  std::vector<float> X;
  std::vector<float> Y;
  /// Index of each point in the sequence, minus `first`.
  std::vector<std::uint32_t> Indices;
};

}
#endif
