// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Copy of a glTF file that VTK's reader and importer accept: with dense accessors, one buffer and,
// if at all, images that can be decoded.
#ifndef penumbra_GltfCopy_h
#define penumbra_GltfCopy_h

#include <string>
#include <vector>

namespace penumbra
{

/// Returns the path of a temporary .glb file with the geometry of the file at `path`; empty if
/// VTK's reader can read that file itself. The caller removes it. Throws CommandError if a buffer
/// is missing or too short, or if the geometry is compressed.
std::string CopyGltfGeometry(const std::string& path);

/// The same with materials and images. Images that are missing or damaged are replaced; each causes
/// a warning.
std::string CopyGltfScene(const std::string& path, std::vector<std::string>& warnings);

}
#endif
