// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The header of a PLY file.
#ifndef penumbra_PlyHeader_h
#define penumbra_PlyHeader_h

#include "vtkType.h"

#include <cstddef>
#include <string>
#include <vector>

namespace penumbra
{

struct PlyProperty
{
  int Count = VTK_VOID; ///< VTK type of the length of a list; VTK_VOID: a single value
  int Type = VTK_VOID;  ///< VTK type
  std::string Name;

  bool IsList() const { return this->Count != VTK_VOID; }
};

struct PlyElement
{
  std::string Name;
  long long Count = 0;
  std::vector<PlyProperty> Properties;
};

struct PlyHeader
{
  bool IsAscii = false;
  bool IsBigEndian = false;
  std::vector<PlyElement> Elements;
  std::size_t Size = 0; ///< in bytes
};

/// Parses the header; returns false if it is invalid.
bool ParsePlyHeader(const char* begin, const char* end, PlyHeader& header);

}
#endif
