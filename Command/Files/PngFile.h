// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Check of .png files: vtkPNGReader may crash if one is damaged.
#ifndef penumbra_PngFile_h
#define penumbra_PngFile_h

#include <cstddef>

namespace penumbra
{

/// Returns whether a .png is complete, its critical chunks are undamaged, and its pixels can be
/// decompressed.
bool IsWholePng(const char* begin, std::size_t size);

}
#endif
