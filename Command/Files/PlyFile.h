// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Structure of a PLY file: the counts of its header, and whether its body is complete.
#ifndef penumbra_PlyFile_h
#define penumbra_PlyFile_h

#include <string>

namespace penumbra
{

struct PlyFile
{
  bool IsPly = false;   ///< the header is valid
  bool IsWhole = false; ///< the body contains every element
  long long Polygons = 0;
  long long Corners = 0; ///< of all polygons together
};

/// Scans the file at `path`.
PlyFile WalkPlyFile(const std::string& path);

}
#endif
