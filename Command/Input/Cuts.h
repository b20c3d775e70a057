// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Slices, clips, contours and thresholds of data sets.
#ifndef penumbra_Cuts_h
#define penumbra_Cuts_h

#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

class vtkDataSet;

namespace penumbra
{

struct Cut
{
  enum class Kinds
  {
    Slice,
    Clip,     ///< keeps the side to which the normal points
    Contour,  ///< of Values[0]
    Threshold ///< keeps cells with all values from Values[0] to Values[1]
  };
  Kinds Kind = Kinds::Slice;
  std::array<double, 6> Plane{}; ///< a point and the normal
  std::string Array;             ///< empty: the default array
  std::array<double, 2> Values{};
};

/// The cuts of a scene, in order, and the array that they use by default.
struct CutList
{
  std::vector<Cut> Cuts;
  std::string Array;    ///< empty: the scalars, else the first array
  bool ByCells = false; ///< prefer cell arrays
};

/// Returns what the cuts leave of a data set. A data set without the array of a contour or threshold
/// leaves nothing; `missing` becomes the name of the array. Throws std::runtime_error if the array
/// has several components.
vtkSmartPointer<vtkDataSet> ApplyCuts(vtkDataSet* data, const CutList& list, std::string& missing);

}
#endif
