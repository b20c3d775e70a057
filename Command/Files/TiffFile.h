// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Completeness of TIFF files, which VTK's reader does not check.
#ifndef penumbra_TiffFile_h
#define penumbra_TiffFile_h

#include <string>

namespace penumbra
{

/// Returns whether a .tif of the machine's byte order contains its directory and all strips.
bool IsWholeTiff(const std::string& path);

}
#endif
