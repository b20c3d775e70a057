// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The parts of a .gltf or .glb file.
#ifndef penumbra_GltfContainer_h
#define penumbra_GltfContainer_h

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace penumbra
{

struct GltfContainer
{
  nlohmann::json Root; ///< discarded if it is invalid
  std::string Binary;  ///< chunk of a .glb file
};

GltfContainer ReadGltf(const std::string& path);

/// Returns the list `name` of an object; an empty one if it is missing or no list.
const nlohmann::json& ListOf(const nlohmann::json& object, const char* name);

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

/// Calls `visit` for each reference to a texture of a material, with the object that contains it and its
/// name.
template <typename Object, typename Visitor>
void VisitTextures(Object& object, const Visitor& visit)
{
  std::vector<std::string> names;
  for (auto& [name, value] : object.items())
  {
    const bool isTexture = value.is_object() && value.contains("index") && name.size() >= 7 &&
      name.compare(name.size() - 7, 7, "Texture") == 0;
    if (isTexture)
    {
      names.push_back(name);
    }
    else if (value.is_object())
    {
      VisitTextures(value, visit);
    }
  }
  for (const std::string& name : names)
  {
    visit(object, name);
  }
}

}
#endif
