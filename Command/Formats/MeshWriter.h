// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Writers of meshes.
#ifndef penumbra_MeshWriter_h
#define penumbra_MeshWriter_h

#include <string>
#include <vector>

class vtkPolyData;

namespace penumbra
{

/// Writes `mesh` with its arrays to `path` in the format of an extension: .vtp, .vtu or .vtk. Returns
/// false if the file is incomplete. Adds a warning for each array whose name the format does not allow.
bool WriteMesh(const std::string& extension, vtkPolyData* mesh, const std::string& path,
  std::vector<std::string>& warnings);

/// Writes the polygons and strips of `mesh` as .ply with the colors of a point array. Returns false if the file is
/// incomplete. Adds a warning if there are lines.
bool WritePly(vtkPolyData* mesh, const std::string& colors, const std::string& path,
  std::vector<std::string>& warnings);

}
#endif
