// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Attributes of points and scenes of glTF files that VTK's reader does not accept.
#ifndef penumbra_GltfAttributes_h
#define penumbra_GltfAttributes_h

#include <nlohmann/json.hpp>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace penumbra
{

/// Returns the accessors of points, normals, tangents and texture coordinates that are integers, as
/// KHR_mesh_quantization allows, except those that VTK's reader converts.
std::set<std::size_t> FindQuantizedAccessors(const nlohmann::json& root);

/// Converts numbers of the component type and `normalized` of an accessor.
std::vector<float> ToFloats(const std::string& elements, const nlohmann::json& accessor);

/// Adds a scene of all nodes without a parent if there is none.
void AddScene(nlohmann::json& root);

/// Makes every material use the first set of texture coordinates, as VTK does: another set that all its
/// textures use becomes the first one. Of several sets, textures that do not use that of the base color
/// are removed, with a warning.
void UseFirstTextureCoordinates(nlohmann::json& root, std::vector<std::string>& warnings);

}
#endif
