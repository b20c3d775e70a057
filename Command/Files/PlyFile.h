// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The structure of a PLY file: what its header announces and whether its body holds as much.
#ifndef penumbra_PlyFile_h
#define penumbra_PlyFile_h

#include <string>

namespace penumbra
{

struct PlyFile
{
  bool IsPly = false;   ///< the header can be understood
  bool IsWhole = false; ///< every element is there
  long long Polygons = 0;
  long long Corners = 0; ///< of all polygons together
};

PlyFile WalkPlyFile(const std::string& path);

}
#endif
