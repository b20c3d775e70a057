// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The appearance of a surface as bytes: all that is not per primitive or position. Surfaces of several
// ranks with the same object and appearance are parts of one surface.
#ifndef penumbra_SurfaceAppearance_h
#define penumbra_SurfaceAppearance_h

#include "ByteStream.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace penumbra
{

struct Surface;
struct Texture;

/// Textures of a surface by the hash of their contents.
using TextureMap = std::map<std::uint64_t, std::shared_ptr<const Texture>>;

/// Returns the appearance of a surface. It includes which arrays the surface has.
std::string DescribeAppearance(const Surface& surface);

/// Returns a surface without primitives of this appearance. Its textures are those of `textures`; others
/// are replaced by a single texel.
Surface MakeEmptySurface(const std::string& appearance, const TextureMap& textures);

/// Adds the textures of a surface to `textures`.
void CollectTextures(const Surface& surface, TextureMap& textures);

void AddTexture(const Texture& texture, ByteWriter& bytes);
std::shared_ptr<const Texture> GetTexture(ByteReader& bytes);

}
#endif
