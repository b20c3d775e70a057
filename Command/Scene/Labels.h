// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Text on images.
#ifndef penumbra_Labels_h
#define penumbra_Labels_h

#include <string>
#include <vector>

class vtkRenderer;

namespace penumbra
{

struct RenderOptions;

/// Adds --text, the names of the files if --filename is given, and the label of --time-label in the
/// upper left corner, with black text if `darkText` is true, otherwise white text.
void AddLabels(vtkRenderer* renderer, const std::vector<std::string>& files,
  const RenderOptions& options, bool darkText);

}
#endif
