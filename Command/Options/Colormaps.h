// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The named colormaps of --colormap.
#ifndef penumbra_Colormaps_h
#define penumbra_Colormaps_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkLookupTable;

namespace penumbra
{

std::vector<std::string> ColormapNames();

/// Returns a lookup table of 256 colors over [0, 1] with gray for NaN; null if the name is unknown.
vtkSmartPointer<vtkLookupTable> MakeColormap(const std::string& name);

}
#endif
