// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Copies of a glTF file that VTK's reader and importer accept: with dense accessors, one buffer and
// images that can be decoded.
#ifndef penumbra_GltfCopy_h
#define penumbra_GltfCopy_h

#include <string>
#include <vector>

namespace penumbra
{

struct Appearance;

/// Returns the path of a temporary .glb file with the geometry of the file at `path`; empty if
/// VTK's reader can read that file itself. The caller removes it. `appearance`: if it is not null,
/// its Copy becomes a file with the materials and images, too; images that are missing or damaged
/// are replaced, each with a warning. Throws CommandError if a buffer is missing or too short, or
/// if the geometry is compressed. Appends warnings of extensions that are not supported.
std::string CopyGltf(
  const std::string& path, Appearance* appearance, std::vector<std::string>& warnings);

}
#endif
