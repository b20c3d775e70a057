// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the readers of mesh formats share: errors, warnings and arrays of colors.
#ifndef penumbra_MeshArrays_h
#define penumbra_MeshArrays_h

#include "vtkSmartPointer.h"

#include <string>

class vtkDataArray;
class vtkDataObject;
class vtkDataSetAttributes;

namespace penumbra
{

/// Throws CommandError: the file at `path` is damaged; `reason` says why.
[[noreturn]] void ThrowDamaged(const std::string& path, const std::string& reason);

/// Throws CommandError: the file at `path` ends before its last `item`.
[[noreturn]] void ThrowTruncated(const std::string& path, const std::string& item);

/// Adds a warning of what was left out to the array UnreadContent.
void AddUnread(vtkDataObject* data, const std::string& warning);

/// Adds colors of 3 or 4 components as bytes, with the name RGB or RGBA, and makes them the active
/// scalars. The range of `colors` is 0 to 1 if they are of a floating-point type and none exceeds 1,
/// 0 to 65535 if they are integers of more than 8 bits and one exceeds 255, otherwise 0 to 255.
/// Opacity has a range of its own.
void AddColors(vtkDataSetAttributes* attributes, vtkDataArray* colors);

}
#endif
