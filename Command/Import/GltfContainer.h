// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The parts of a .gltf or .glb file.
#ifndef penumbra_GltfContainer_h
#define penumbra_GltfContainer_h

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace penumbra
{

struct GltfContainer
{
  nlohmann::json Root; ///< discarded if it is invalid
  std::string Binary;  ///< chunk of a .glb file
};

GltfContainer ReadGltf(const std::string& path);

/// Size in bytes of a number of a `componentType`.
std::size_t ComponentSize(int type);

/// Size in bytes of an element of an accessor.
std::size_t ElementSize(const nlohmann::json& accessor);

/// Writes a temporary .glb file whose only buffer is `binary` and returns its path. Throws
/// CommandError, naming the file at `path`, if it cannot be written.
std::string WriteGlb(
  const nlohmann::json& root, const std::string& binary, const std::string& path);

/// Returns the bytes of a URI that starts with "data:".
std::string DecodeDataUri(const std::string& uri);

/// Returns the path of a relative URI, with / as the separator.
std::string DecodePath(const std::string& uri);

}
#endif
