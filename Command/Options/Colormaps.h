// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The colormaps that --colormap knows by name.
#ifndef penumbra_Colormaps_h
#define penumbra_Colormaps_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkLookupTable;

namespace penumbra
{

std::vector<std::string> ColormapNames();

/// A table of 256 colours over [0, 1], values that are not numbers grey; null for an unknown name.
vtkSmartPointer<vtkLookupTable> MakeColormap(const std::string& name);

}
#endif
