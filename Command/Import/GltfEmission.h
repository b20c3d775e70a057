// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Emission of glTF materials as VTK's importer needs it: only textures emit.
#ifndef penumbra_GltfEmission_h
#define penumbra_GltfEmission_h

#include <nlohmann/json_fwd.hpp>

#include <cstddef>

namespace penumbra
{

/// Returns whether a material emits without a texture or has KHR_materials_emissive_strength.
bool HasPlainEmission(const nlohmann::json& root);

/// Adds texture coordinates to the primitives that emit and have none.
void AddEmissionCoordinates(nlohmann::json& root);

/// Multiplies emissive factors by KHR_materials_emissive_strength. Adds a texture of the white image in the
/// buffer view `view` to materials that emit without a texture.
void AddEmissionTextures(nlohmann::json& root, std::size_t view);

}
#endif
