// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of glTF files: VTK's importer fails if one is missing or damaged.
#ifndef penumbra_GltfImages_h
#define penumbra_GltfImages_h

#include <nlohmann/json.hpp>

#include <set>
#include <string>
#include <vector>

namespace penumbra
{

/// Returns the MIME type of an image that VTK can decode, or an empty string.
std::string FindDecodableType(const std::string& bytes);

/// Returns a .png with an alpha channel of 1 where its product with `factor` is at least `cutoff`, and of 0 elsewhere;
/// empty if that is the image in `bytes`. A cutoff of 0 removes the channel.
std::string MaskAlpha(const std::string& bytes, double factor, double cutoff);

/// Returns a white image of one pixel as .png.
std::string MakeWhitePng();

/// Returns the images that textures use.
std::set<std::size_t> FindUsedImages(const nlohmann::json& root);

/// Returns whether a material refers to a texture.
bool NamesTextures(const nlohmann::json& root);

/// Removes the references of all materials in `root` to textures that do not exist, or whose image is missing or
/// in `badImages`. Adds a warning for each texture that does not exist or whose image only an extension names.
void RemoveTextures(
  nlohmann::json& root, const std::set<std::size_t>& badImages, std::vector<std::string>& warnings);

}
#endif
