// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Copy of the geometry of a glTF file that VTK's reader accepts: without images and materials, with
// dense accessors and one buffer.
#ifndef penumbra_GltfCopy_h
#define penumbra_GltfCopy_h

#include <string>

namespace penumbra
{

/// Returns the path of a temporary .glb file with the geometry of the file at `path`; empty if
/// VTK's reader can read that file itself. The caller removes it. Throws CommandError if a buffer
/// is missing or too short, or if the geometry is compressed.
std::string CopyGltfGeometry(const std::string& path);

}
#endif
