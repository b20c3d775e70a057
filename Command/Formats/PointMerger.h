// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Merges coincident points while a mesh is read.
#ifndef penumbra_PointMerger_h
#define penumbra_PointMerger_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

class vtkPoints;

namespace penumbra
{

class PointMerger
{
public:
  /// Returns the id of the point with exactly these coordinates; adds it if there is none.
  vtkIdType Insert(const double point[3]);

  /// `type`: VTK_FLOAT or VTK_DOUBLE.
  vtkSmartPointer<vtkPoints> MakePoints(int type) const;

private:
  std::size_t FindSlot(const double point[3]) const;
  void Grow();

  std::vector<double> Coordinates;
  std::vector<vtkIdType> Slots; ///< open addressing; -1: empty; the size is a power of two
};

}
#endif
