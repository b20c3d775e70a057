// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Materials of glTF files as VTK's importer needs them: it knows no specular color, and only textures emit.
#ifndef penumbra_GltfMaterials_h
#define penumbra_GltfMaterials_h

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace penumbra
{

/// Gives materials that only KHR_materials_pbrSpecularGlossiness describes the base color of its diffuse
/// color, with a warning.
void ReplaceSpecularGlossiness(nlohmann::json& root, std::vector<std::string>& warnings);

/// Returns whether a material emits without a texture or has KHR_materials_emissive_strength.
bool HasPlainEmission(const nlohmann::json& root);

/// Adds texture coordinates to the primitives that emit and have none.
void AddEmissionCoordinates(nlohmann::json& root);

/// Multiplies emissive factors by KHR_materials_emissive_strength. Adds a texture of the white image in the
/// buffer view `view` to materials that emit without a texture.
void AddEmissionTextures(nlohmann::json& root, std::size_t view);

}
#endif
