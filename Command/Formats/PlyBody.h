// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads the values of a PLY file, row by row.
#ifndef penumbra_PlyBody_h
#define penumbra_PlyBody_h

#include "PlyHeader.h"
#include "TextScanner.h"

#include "vtkType.h"

#include <vector>

class vtkDataArray;

namespace penumbra
{

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
