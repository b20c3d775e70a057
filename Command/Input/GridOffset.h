// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Images and rectilinear grids far from the origin. The filters of VTK give them points of single precision, so
// they are moved to the origin before, and their surfaces back in double precision.
#ifndef penumbra_GridOffset_h
#define penumbra_GridOffset_h

#include "Cuts.h"

#include "vtkSmartPointer.h"

#include <array>

class vtkDataSet;
class vtkPolyData;

namespace penumbra
{

/// Returns the distance of coordinates of single precision if it is a visible fraction of the bounds, else 0.
double FindRoundingStep(const double bounds[6]);

/// Displacement of a data set; 0 unless the surfaces of its grid would be rounded.
class GridOffset
{
public:
  explicit GridOffset(vtkDataSet* data);

  /// Returns the data set, or a copy at the origin.
  vtkSmartPointer<vtkDataSet> ToOrigin(vtkDataSet* data) const;
  /// Returns the cuts of that copy.
  CutList ToOrigin(CutList cuts) const;
  /// Returns a mesh of that copy at its place, in double precision.
  vtkSmartPointer<vtkPolyData> FromOrigin(vtkPolyData* mesh) const;

private:
  bool IsZero() const;

  std::array<double, 3> Offset{};
};

}
#endif
