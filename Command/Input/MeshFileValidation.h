// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks of mesh files that VTK's readers omit: truncated files and polygons that are cut.
#ifndef penumbra_MeshFileValidation_h
#define penumbra_MeshFileValidation_h

#include <string>

class vtkDataObject;

namespace penumbra
{

/// Counts that a file header declares; negative: unknown.
struct DeclaredCounts
{
  long long Polygons = -1;
  long long Corners = -1; ///< of all polygons together
};

/// Scans the file at `path`. Throws CommandError if it is truncated.
DeclaredCounts CheckMeshFile(const std::string& path);

/// Throws CommandError if `data`, as read from `path`, have other counts than declared.
void CheckDeclaredCounts(
  const std::string& path, vtkDataObject* data, const DeclaredCounts& counts);

}
#endif
