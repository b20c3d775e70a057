// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What VTK's readers overlook in files: an early end, polygons that they cut.
#ifndef penumbra_MeshFileValidation_h
#define penumbra_MeshFileValidation_h

#include <string>

class vtkDataObject;

namespace penumbra
{

/// What a file promises; negative: nothing is known.
struct DeclaredCounts
{
  long long Polygons = -1;
  long long Corners = -1; ///< of all polygons together
};

/// Walk through the file at `path` without keeping it. Throws Failure when it ends early.
DeclaredCounts CheckMeshFile(const std::string& path);

/// Throws Failure when `data`, as read from `path`, hold less than promised.
void CheckDeclaredCounts(
  const std::string& path, vtkDataObject* data, const DeclaredCounts& promise);

}
#endif
