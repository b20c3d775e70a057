// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The colormaps of --colormap: named ones, and those of images.
#ifndef penumbra_Colormaps_h
#define penumbra_Colormaps_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkLookupTable;

namespace penumbra
{

std::vector<std::string> ColormapNames();

/// Returns the name of a colormap, or the path of an image. `text`: either of them, or the name with
/// the extension of an image. Throws InvalidValue.
std::string FindColormap(const std::string& text);

/// Returns a lookup table of 256 colors over [0, 1] with gray for NaN. `name`: of FindColormap().
/// Throws CommandError if an image cannot be read.
vtkSmartPointer<vtkLookupTable> MakeColormap(const std::string& name);

}
#endif
