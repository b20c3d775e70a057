// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Conversion of glTF 1 to glTF 2.
#ifndef penumbra_GltfVersion1_h
#define penumbra_GltfVersion1_h

#include <nlohmann/json.hpp>

namespace penumbra
{

/// Returns whether `root` is the document of a file of version 1, whose lists are objects.
bool IsVersion1(const nlohmann::json& root);

/// Converts a document of version 1: references by name become indices, and diffuse and emitted colors,
/// textures and transparency of materials those of version 2. Shaders, skins and lights are left out.
/// Throws nlohmann::json::exception if it is invalid.
nlohmann::json ConvertVersion1(const nlohmann::json& root);

}
#endif
