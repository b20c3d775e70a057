// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Coloring by data arrays.
#ifndef penumbra_Coloring_h
#define penumbra_Coloring_h

#include <vector>

class vtkPolyDataMapper;
class vtkRenderer;

namespace penumbra
{

struct ColoringOptions;

/// Colors every mapper whose data have the array and adds the scalar bar if requested, with black
/// text if `darkText`, otherwise white text. If `warnsOfFonts`, characters that no font has cause a
/// warning. Throws CommandError, which lists the available arrays, if no mapper has the array.
void ColorByData(vtkRenderer* renderer, const std::vector<vtkPolyDataMapper*>& mappers,
  const ColoringOptions& options, bool darkText, bool warnsOfFonts);

}
#endif
