// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The header of a PLY file, and its values, row by row.
#ifndef penumbra_PlyFile_h
#define penumbra_PlyFile_h

#include "TextScanner.h"

#include "vtkType.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkDataArray;

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

/// Where the values of a property go: a component of an array, or nowhere.
class PlyTarget
{
public:
  PlyTarget() = default;
  PlyTarget(vtkDataArray* array, int component);

  bool IsEmpty() const { return !this->Values; }
  void Set(long long row, double value) const;

private:
  void* Values = nullptr;
  int Stride = 1;
  int Component = 0;
  int Type = 0;
};

class PlyBody
{
public:
  PlyBody(const char* begin, const char* end, const PlyHeader& header);

  /// Returns whether the rest of the file can hold the rows of `element`, at their smallest size.
  bool CanHold(const PlyElement& element) const;

  enum class Row
  {
    Complete,
    Truncated,
    Damaged
  };

  /// Reads a row. Single values go to `targets`; the values of the property `list`, if it is not
  /// negative, to `indices`.
  Row ReadRow(const PlyElement& element, long long row, const std::vector<PlyTarget>& targets,
    int list, std::vector<vtkIdType>& indices);

private:
  Row ReadValue(int type, double& value);
  Row ReadList(const PlyProperty& property, bool isWanted, std::vector<vtkIdType>& indices);
  std::size_t Left() const;

  bool IsAscii;
  bool IsBigEndian;
  TextScanner Text;
  const char* At;
  const char* End;
};

}
#endif
