// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Widths, materials and colors of edges and vertices.
#ifndef penumbra_LineMaterials_h
#define penumbra_LineMaterials_h

#include "Material.h"

class vtkProperty;

namespace penumbra
{

struct Surface;

double FindEdgeWidth(vtkProperty* property);
double FindEdgeOpacity(vtkProperty* property);

/// Returns a material whose color does not depend on the lights.
Material MakeUnlitMaterial(const double color[3], double opacity);

/// Returns the lit material of edges and vertices that are drawn as tubes and spheres.
Material MakeRoundMaterial(vtkProperty* property, const Material& unlit);

/// Replaces the material and the colors of a surface. Its opacity and those of its points and cells
/// stay, as in VTK, which draws edges as parts of the cells.
void ReplaceColors(const Material& material, Surface& surface);

}
#endif
