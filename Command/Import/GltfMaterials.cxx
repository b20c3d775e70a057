// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfMaterials.h"

#include "GltfContainer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace penumbra
{

namespace
{

using Json = nlohmann::json;

constexpr const char* Glossiness = "KHR_materials_pbrSpecularGlossiness";
constexpr const char* StrengthExtension = "KHR_materials_emissive_strength";

double FindStrength(const Json& material)
{
  const auto extensions = material.find("extensions");
  return extensions != material.end() && extensions->contains(StrengthExtension)
    ? extensions->at(StrengthExtension).value("emissiveStrength", 1.0)
    : 1.0;
}

bool Emits(const Json& material)
{
  const Json factor = material.value("emissiveFactor", Json::array());
  return std::any_of(
    factor.begin(), factor.end(), [](const Json& value) { return value.get<double>() > 0.0; });
}

}

void ReplaceSpecularGlossiness(Json& root, std::vector<std::string>& warnings)
{
  bool isReplaced = false;
  for (std::size_t i = 0; i < ListOf(root, "materials").size(); ++i)
  {
    Json& material = root["materials"][i];
    const Json extensions = material.value("extensions", Json::object());
    if (material.contains("pbrMetallicRoughness") || !extensions.contains(Glossiness))
    {
      continue;
    }
    const Json& source = extensions[Glossiness];
    Json colors = { { "metallicFactor", 0.0 },
      { "roughnessFactor", 1.0 - source.value("glossinessFactor", 1.0) } };
    if (source.contains("diffuseFactor"))
    {
      colors["baseColorFactor"] = source["diffuseFactor"];
    }
    if (source.contains("diffuseTexture"))
    {
      colors["baseColorTexture"] = source["diffuseTexture"];
    }
    material["pbrMetallicRoughness"] = colors;
    material["extensions"].erase(Glossiness);
    isReplaced = true;
  }
  if (isReplaced)
  {
    warnings.push_back(std::string("of ") + Glossiness +
      ", the specular color is not drawn; export the file with metallic and roughness");
  }
}

bool HasPlainEmission(const nlohmann::json& root)
{
  const Json& materials = ListOf(root, "materials");
  return std::any_of(materials.begin(), materials.end(), [](const Json& material) {
    return Emits(material) &&
      (!material.contains("emissiveTexture") || FindStrength(material) != 1.0);
  });
}

void AddEmissionCoordinates(nlohmann::json& root)
{
  const Json& materials = ListOf(root, "materials");
  for (Json& mesh : root["meshes"])
  {
    for (Json& primitive : mesh.at("primitives"))
    {
      Json& attributes = primitive.at("attributes");
      if (!primitive.contains("material") || attributes.contains("TEXCOORD_0") ||
        !attributes.contains("POSITION") ||
        !Emits(materials.at(primitive["material"].get<std::size_t>())))
      {
        continue;
      }
      Json& accessors = root.at("accessors");
      const Json& points = accessors.at(attributes["POSITION"].get<std::size_t>());
      attributes["TEXCOORD_0"] = accessors.size();
      accessors.push_back( // of zeros
        { { "componentType", 5126 }, { "count", points.at("count") }, { "type", "VEC2" } });
    }
  }
}

void AddEmissionTextures(nlohmann::json& root, std::size_t view)
{
  Json texture;
  for (Json& material : root["materials"])
  {
    if (!Emits(material))
    {
      continue;
    }
    const double strength = FindStrength(material);
    for (Json& value : material["emissiveFactor"])
    {
      value = strength * value.get<double>();
    }
    if (material.contains("emissiveTexture"))
    {
      continue;
    }
    if (texture.is_null())
    {
      texture = { { "index", root["textures"].size() } };
      root["textures"].push_back({ { "source", root["images"].size() } });
      root["images"].push_back({ { "bufferView", view }, { "mimeType", "image/png" } });
    }
    material["emissiveTexture"] = texture;
  }
}

}
