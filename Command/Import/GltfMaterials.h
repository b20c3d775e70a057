// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Materials of glTF files as VTK's importer needs them: it knows no specular color, only textures emit, opaque
// materials are as transparent as their alpha, and colors of vertices replace the base color.
#ifndef penumbra_GltfMaterials_h
#define penumbra_GltfMaterials_h

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace penumbra
{

/// Gives materials that only KHR_materials_pbrSpecularGlossiness describes the base color of its diffuse
/// color, with a warning.
void ReplaceSpecularGlossiness(nlohmann::json& root, std::vector<std::string>& warnings);

/// Returns whether a primitive has colors of vertices, or a material an alpha that it does not use.
bool HasPlainColors(const nlohmann::json& root);

/// Functions that read and extend the buffers of a file.
struct GltfBuffers
{
  std::function<std::string(const nlohmann::json& accessor)> ReadElements;
  std::function<std::string(const nlohmann::json& image)> ReadImage;
  std::function<std::size_t(const std::string& bytes)> AddView;
};

/// Multiplies colors of vertices by the base color of their material, and encodes the linear product as VTK needs
/// it: with an exponent of 1/2.2. Accessors must be dense.
void MultiplyVertexColors(nlohmann::json& root, const GltfBuffers& buffers);

/// Makes the base colors of materials whose mode is not BLEND opaque, and transparent below the cutoff of MASK. All
/// images must be in buffer views.
void MaskBaseColors(nlohmann::json& root, const GltfBuffers& buffers);

/// Returns whether a material emits without a texture or has KHR_materials_emissive_strength.
bool HasPlainEmission(const nlohmann::json& root);

/// Adds texture coordinates to the primitives that emit and have none.
void AddEmissionCoordinates(nlohmann::json& root);

/// Multiplies emissive factors by KHR_materials_emissive_strength. Adds a texture of the white image in the
/// buffer view `view` to materials that emit without a texture.
void AddEmissionTextures(nlohmann::json& root, std::size_t view);

}
#endif
