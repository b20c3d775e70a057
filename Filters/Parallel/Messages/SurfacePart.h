// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Parts of surfaces: some of their primitives, in the same order, with all attributes.
#ifndef penumbra_SurfacePart_h
#define penumbra_SurfacePart_h

#include "AxisAlignedBox.h"
#include "ByteStream.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

struct Surface;

/// Returns the units of which a surface can be divided: instances, or else primitives.
std::size_t CountUnits(const Surface& surface);

/// Returns the bounds of a unit of a surface.
AxisAlignedBox GetUnitBox(const Surface& surface, std::uint32_t unit);

/// Adds the arrays of the part of a surface that has these units, in ascending order. Positions keep
/// their order.
void AddPart(const Surface& surface, const std::vector<std::uint32_t>& units, ByteWriter& bytes);

/// Returns the number of bytes of the arrays that AddPart() adds, for all units of a surface.
std::size_t CountBytes(const Surface& surface);

/// Appends a part to a surface of the same appearance.
void AppendPart(ByteReader& bytes, Surface& surface);

/// Makes a surface complete to which all parts have been appended.
void FinishParts(Surface& surface);

}
#endif
