// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Validation of glTF files. VTK's reader crashes at references to missing objects and cycles of nodes, and
// reads beyond the end of buffers. It refuses unknown extensions.
#ifndef penumbra_GltfValidation_h
#define penumbra_GltfValidation_h

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace penumbra
{

/// Returns the first fault of a document of version 2, such as "node 3 is its own descendant"; empty if there
/// is none. `bufferBytes`: the sizes of its buffers.
std::string FindGltfFault(const nlohmann::json& root, const std::vector<std::size_t>& bufferBytes);

/// Returns the name of a required extension of compressed geometry; empty if there is none.
std::string FindCompression(const nlohmann::json& root);

/// Appends a warning of extensions that the file requires or that change its surfaces, and that are not
/// drawn. `materials`: also of those of materials, textures and lights.
void WarnOfExtensions(
  const nlohmann::json& root, bool materials, std::vector<std::string>& warnings);

/// Removes extensions at which VTK's reader stops.
void RemoveExtensions(nlohmann::json& root);

}
#endif
