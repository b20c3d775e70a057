// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry that occludes in baking, extracted from polygonal data.
#ifndef penumbra_OccluderGeometry_h
#define penumbra_OccluderGeometry_h

#include "Execution/ParallelFor.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

class vtkPolyData;

namespace penumbra
{

struct Scene;
struct Surface;

bool IsFinite(const double x[3]);

/// Returns the triangles of all polygons whose points are `finite`.
std::vector<glm::uvec3> Triangulate(
  vtkPolyData* mesh, const std::vector<char>& finite, const ProgressCallback& progress);

/// Adds spheres at the vertices or tubes along the lines of `mesh` to `scene`, with the given radius
/// in world units.
void AddRoundOccluders(vtkPolyData* mesh, bool tubes, double radius, Scene& scene);

/// Sets the opacity of the points of `surface` from an array of `data`. Returns false if the array
/// is named but missing or invalid.
bool SetOpacity(vtkPolyData* data, const std::string& name, Surface& surface);

/// Throws std::runtime_error that says what opacity arrays must be.
[[noreturn]] void RejectOpacityArray(const std::string& name, const std::string& where);

}
#endif
