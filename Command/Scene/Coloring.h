// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Coloring by data arrays.
#ifndef penumbra_Coloring_h
#define penumbra_Coloring_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkLookupTable;
class vtkPolyDataMapper;

namespace penumbra
{

struct ColoringOptions;

/// The colors of the values of an array.
struct ColorScale
{
  vtkSmartPointer<vtkLookupTable> Table;
  std::string Array;
};

/// Colors every mapper whose data have the array. Throws CommandError, which lists the available
/// arrays, if no mapper has the array.
ColorScale ColorByData(
  const std::vector<vtkPolyDataMapper*>& mappers, const ColoringOptions& options);

}
#endif
