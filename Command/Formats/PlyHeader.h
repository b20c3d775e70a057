// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The header of a PLY file.
#ifndef penumbra_PlyHeader_h
#define penumbra_PlyHeader_h

#include <cstddef>
#include <string>
#include <vector>

namespace penumbra
{

/// A type of values: number of bytes and meaning of the bits.
struct PlyType
{
  int Size = 0; ///< 0: unknown type
  bool IsFloat = false;
  bool IsSigned = false;
};

struct PlyProperty
{
  PlyType Count; ///< type of the length of a list; Size 0: a single value
  PlyType Type;
  std::string Name;

  bool IsList() const { return this->Count.Size > 0; }
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
