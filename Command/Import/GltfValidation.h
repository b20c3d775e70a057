// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Validation of glTF files. VTK's reader crashes at references to missing objects and cycles of nodes, and
// reads beyond the end of buffers.
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

}
#endif
