// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Worst-case scenes for the cost of rendering: `n` primitives in [-1, 1], identical at every call.
#ifndef penumbra_Adversaries_h
#define penumbra_Adversaries_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPolyData;
class vtkRenderer;

namespace penumbra
{

struct Adversary
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> (*Make)(int n);
};

/// All scenes: coincident slivers, clusters of subpixel triangles, hair, streamlines, soup, fans
/// with and without shared corners, poles, a comb-shaped polygon, coincident copies.
const std::vector<Adversary>& Adversaries();

/// Returns the scene of the given name, or null if there is none.
const Adversary* FindAdversary(const std::string& name);

/// Returns a renderer that shows `mesh` flat, with lines of 2 pixels, in parallel projection with
/// half the height `scale`.
vtkSmartPointer<vtkRenderer> NewAdversaryRenderer(vtkPolyData* mesh, double scale);

}
#endif
