// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Text and scalar bars on images: black if `darkText` is true, otherwise white.
#ifndef penumbra_Annotations_h
#define penumbra_Annotations_h

#include <string>
#include <vector>

class vtkRenderer;
class vtkScalarsToColors;

namespace penumbra
{

struct RenderOptions;

/// Adds --text, the names of the files if --filename is given, and the label of --time-label in the
/// upper left corner.
void AddLabels(vtkRenderer* renderer, const std::vector<std::string>& files,
  const RenderOptions& options, bool darkText);

/// Adds a scalar bar of `table` for the array `name`.
void AddScalarBar(vtkRenderer* renderer, vtkScalarsToColors* table, const std::string& name,
  const RenderOptions& options, bool darkText);

}
#endif
