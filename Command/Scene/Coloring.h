// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Colours from the arrays of a file.
#ifndef penumbra_Coloring_h
#define penumbra_Coloring_h

#include <vector>

class vtkPolyDataMapper;
class vtkRenderer;

namespace penumbra
{

struct ColoringOptions;

/// Colour every mapper whose data have the array, and add the scalar bar if it is asked for.
/// Throws Failure, naming the arrays that exist, when none has it.
void ColorByData(vtkRenderer* renderer, const std::vector<vtkPolyDataMapper*>& mappers,
  const ColoringOptions& options);

}
#endif
