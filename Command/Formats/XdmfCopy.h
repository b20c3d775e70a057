// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks of XDMF files, whose reader crashes if data are missing.
#ifndef penumbra_XdmfCopy_h
#define penumbra_XdmfCopy_h

#include <string>
#include <vector>

namespace penumbra
{

struct Appearance;

/// Throws CommandError if a file with data that the XDMF file at `path` names is missing. Returns the path of a
/// temporary copy that VTK can read, or an empty path if it can read the file: it does not know the namespace of
/// XInclude with which DOLFINx refers to a mesh.
std::string CopyXdmf(
  const std::string& path, Appearance* appearance, std::vector<std::string>& warnings);

}
#endif
