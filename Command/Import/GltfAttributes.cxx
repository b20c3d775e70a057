// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfAttributes.h"

#include "GltfContainer.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace penumbra
{

namespace
{

using Json = nlohmann::json;

enum ComponentTypes
{
  Int8 = 5120, // OpenGL's constants
  UInt8 = 5121,
  Int16 = 5122,
  UInt16 = 5123,
  UInt32 = 5125,
  Float32 = 5126
};

void AddQuantized(const Json& root, const Json& attributes, std::set<std::size_t>& found)
{
  for (const auto& [name, index] : attributes.items())
  {
    const bool isTexture = name.compare(0, 8, "TEXCOORD") == 0;
    if (isTexture || name == "POSITION" || name == "NORMAL" || name == "TANGENT")
    {
      const Json& accessor = root.at("accessors").at(index.get<std::size_t>());
      const bool isConverted = isTexture && accessor.value("normalized", false);
      if (accessor.at("componentType") != Float32 && !isConverted)
      {
        found.insert(index.get<std::size_t>());
      }
    }
  }
}

template <typename Integer>
void Append(const std::string& elements, double largest, std::vector<float>& values)
{
  for (std::size_t i = 0; i + sizeof(Integer) <= elements.size(); i += sizeof(Integer))
  {
    Integer value = 0;
    std::memcpy(&value, &elements[i], sizeof(value));
    const double quotient = double(value) / largest;
    values.push_back(static_cast<float>(largest > 1.0 ? std::max(-1.0, quotient) : quotient));
  }
}

/// Values of another type are ignored.
int IntegerOf(const Json& object, const char* name, int otherwise)
{
  const auto found = object.find(name);
  return found != object.end() && found->is_number_integer() ? found->get<int>() : otherwise;
}

Json* FindTransform(Json& texture)
{
  const auto extensions = texture.find("extensions");
  if (extensions == texture.end() || !extensions->is_object())
  {
    return nullptr;
  }
  const auto transform = extensions->find("KHR_texture_transform");
  return transform != extensions->end() && transform->is_object() ? &*transform : nullptr;
}

int FindSet(Json& texture)
{
  Json* const transform = FindTransform(texture);
  const int set = IntegerOf(texture, "texCoord", 0);
  return transform ? IntegerOf(*transform, "texCoord", set) : set;
}

void UseFirstSet(Json& texture)
{
  texture.erase("texCoord");
  if (Json* const transform = FindTransform(texture))
  {
    transform->erase("texCoord");
  }
}

/// Returns the set of texture coordinates of a material, of which other textures are removed.
int ReduceToOneSet(Json& material, bool& isReduced)
{
  int first = -1;
  int base = -1;
  VisitTextures(material, [&](Json& parent, const std::string& name) {
    const int set = FindSet(parent[name]);
    first = first < 0 ? set : first;
    base = name == "baseColorTexture" ? set : base;
  });
  const int kept = base >= 0 ? base : first;
  VisitTextures(material, [&](Json& parent, const std::string& name) {
    if (FindSet(parent[name]) == kept)
    {
      UseFirstSet(parent[name]);
    }
    else
    {
      parent.erase(name);
      isReduced = true;
    }
  });
  return kept;
}

}

std::set<std::size_t> FindQuantizedAccessors(const Json& root)
{
  std::set<std::size_t> found;
  for (const Json& mesh : ListOf(root, "meshes"))
  {
    for (const Json& primitive : ListOf(mesh, "primitives"))
    {
      AddQuantized(root, primitive.value("attributes", Json::object()), found);
      for (const Json& target : ListOf(primitive, "targets"))
      {
        AddQuantized(root, target, found);
      }
    }
  }
  return found;
}

std::vector<float> ToFloats(const std::string& elements, const Json& accessor)
{
  const bool isNormalized = accessor.value("normalized", false);
  std::vector<float> values;
  switch (accessor.at("componentType").get<int>())
  {
    case Int8:
      Append<std::int8_t>(elements, isNormalized ? 127.0 : 1.0, values);
      break;
    case UInt8:
      Append<std::uint8_t>(elements, isNormalized ? 255.0 : 1.0, values);
      break;
    case Int16:
      Append<std::int16_t>(elements, isNormalized ? 32767.0 : 1.0, values);
      break;
    case UInt16:
      Append<std::uint16_t>(elements, isNormalized ? 65535.0 : 1.0, values);
      break;
    case Float32:
      values.resize(elements.size() / sizeof(float));
      std::memcpy(values.data(), elements.data(), sizeof(float) * values.size());
      break;
    default:
      Append<std::uint32_t>(elements, isNormalized ? 4294967295.0 : 1.0, values);
  }
  return values;
}

void AddScene(Json& root)
{
  const Json& nodes = ListOf(root, "nodes");
  if (nodes.empty() || !ListOf(root, "scenes").empty())
  {
    return;
  }
  std::set<std::size_t> children;
  for (const Json& node : nodes)
  {
    for (const Json& child : ListOf(node, "children"))
    {
      children.insert(child.get<std::size_t>());
    }
  }
  Json roots = Json::array();
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    if (children.count(i) == 0)
    {
      roots.push_back(i);
    }
  }
  root["scenes"] = Json::array({ { { "nodes", roots } } });
  root["scene"] = 0;
}

void UseFirstTextureCoordinates(Json& root, std::vector<std::string>& warnings)
{
  std::vector<int> sets;
  bool isReduced = false;
  if (root.contains("materials"))
  {
    for (Json& material : root["materials"])
    {
      sets.push_back(material.is_object() ? ReduceToOneSet(material, isReduced) : 0);
    }
  }
  if (isReduced)
  {
    warnings.emplace_back("textures that do not use the texture coordinates of the base color are "
                          "not drawn");
  }
  for (Json& mesh : root["meshes"])
  {
    for (Json& primitive : mesh["primitives"])
    {
      const std::size_t material = primitive.value("material", sets.size());
      const int set = material < sets.size() ? sets[material] : 0;
      Json& attributes = primitive["attributes"];
      const std::string name = "TEXCOORD_" + std::to_string(set);
      if (set > 0 && attributes.contains(name))
      {
        attributes["TEXCOORD_0"] = attributes[name];
        attributes.erase(name);
      }
    }
  }
}

}
