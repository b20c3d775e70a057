// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef penumbra_ScalarBar_h
#define penumbra_ScalarBar_h

#include <string>

class vtkRenderer;
class vtkScalarsToColors;

namespace penumbra
{

struct RenderOptions;

/// Adds a scalar bar of `table` for the array `name`, with black text if `darkText`, otherwise white
/// text. If `warnsOfFonts`, characters that no font has cause a warning.
void AddScalarBar(vtkRenderer* renderer, vtkScalarsToColors* table, const std::string& name,
  const RenderOptions& options, bool darkText, bool warnsOfFonts);

}
#endif
