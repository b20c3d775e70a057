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
class vtkProperty;
class vtkRenderer;

namespace penumbra
{

struct Adversary
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> (*Make)(int n);
  /// Changes the property of the actor, for lines instead of surfaces. May be null.
  void (*Prepare)(vtkProperty*) = nullptr;
};

/// All scenes: coincident slivers, clusters of subpixel triangles, hair, streamlines, soup, fans
/// with and without shared corners, poles, discs, comb-shaped and random polygons, coincident
/// copies, and a smooth mesh in wireframe and with edges.
const std::vector<Adversary>& Adversaries();

/// Returns the scene of the given name, or null if there is none.
const Adversary* FindAdversary(const std::string& name);

/// Builds a wavy height field of about n triangles with point normals, which fills an image of the
/// given ratio of width and height: the scene whose cost the others are compared with.
vtkSmartPointer<vtkPolyData> MakePlainMesh(int n, double aspect);

/// Returns a renderer that shows `mesh` flat unless it has point normals, with lines of 2 pixels,
/// in parallel projection with half the height `scale`.
vtkSmartPointer<vtkRenderer> NewAdversaryRenderer(vtkPolyData* mesh, double scale);

}
#endif
