// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfMaterials.h"

#include "GltfAttributes.h"
#include "GltfContainer.h"
#include "GltfImages.h"

#include "vtkVersion.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace penumbra
{

namespace
{

using Json = nlohmann::json;

/// VTK 9.2 encodes linear colors of vertices itself.
constexpr double VertexColorGamma = VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0) ? 1.0 : 2.2;
constexpr const char* ColorsOfMaterial = "pbrMetallicRoughness";
constexpr const char* Glossiness = "KHR_materials_pbrSpecularGlossiness";
constexpr const char* StrengthExtension = "KHR_materials_emissive_strength";

struct BaseColor
{
  std::array<double, 4> Factor = { 1.0, 1.0, 1.0, 1.0 };
  bool IsBlended = false;
  double Cutoff = 0.0; ///< alpha below which MASK is transparent, else 0

  explicit BaseColor(const Json& material)
  {
    const std::string mode = material.value("alphaMode", std::string("OPAQUE"));
    this->IsBlended = mode == "BLEND";
    this->Cutoff = mode == "MASK" ? material.value("alphaCutoff", 0.5) : 0.0;
    const Json factor = material.value(ColorsOfMaterial, Json::object())
                          .value("baseColorFactor", Json(std::vector<double>(4, 1.0)));
    for (std::size_t c = 0; c < std::min(factor.size(), this->Factor.size()); ++c)
    {
      this->Factor[c] = factor[c].get<double>();
    }
  }

  double Mask(double alpha) const
  {
    return this->IsBlended ? alpha : alpha >= this->Cutoff ? 1.0 : 0.0;
  }
};

/// Returns the material of a primitive; an empty one if it has none.
const Json& MaterialOf(const Json& root, const Json& primitive)
{
  static const Json none = Json::object();
  const auto index = primitive.find("material");
  return index == primitive.end() ? none : root.at("materials").at(index->get<std::size_t>());
}

/// Values of colors of `channels`, which are 3 or 4, multiplied and encoded.
std::vector<float> EncodeColors(
  const std::vector<float>& values, std::size_t channels, const BaseColor& base)
{
  std::vector<float> encoded;
  encoded.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const std::size_t channel = i % channels;
    const double value = std::max(0.0, double(values[i]));
    // VTK multiplies by the opacity of the material.
    encoded.push_back(static_cast<float>(channel < 3
        ? std::pow(value * base.Factor[channel], 1.0 / VertexColorGamma)
        : base.IsBlended ? value
                         : base.Mask(value * base.Factor[3])));
  }
  return encoded;
}

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
    if (material.contains(ColorsOfMaterial) || !extensions.contains(Glossiness))
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
    material[ColorsOfMaterial] = colors;
    material["extensions"].erase(Glossiness);
    isReplaced = true;
  }
  if (isReplaced)
  {
    warnings.push_back(std::string("of ") + Glossiness +
      ", the specular color is not drawn; export the file with metallic and roughness");
  }
}

bool HasPlainColors(const Json& root)
{
  const Json& materials = ListOf(root, "materials");
  const Json& meshes = ListOf(root, "meshes");
  return std::any_of(materials.begin(), materials.end(),
           [](const Json& material) {
             const BaseColor base(material);
             return !base.IsBlended && base.Factor[3] != 1.0;
           }) ||
    std::any_of(meshes.begin(), meshes.end(), [](const Json& mesh) {
      const Json& primitives = ListOf(mesh, "primitives");
      return std::any_of(primitives.begin(), primitives.end(), [](const Json& primitive) {
        return primitive.value("attributes", Json::object()).contains("COLOR_0");
      });
    });
}

void MultiplyVertexColors(Json& root, const GltfBuffers& buffers)
{
  for (Json& mesh : root["meshes"])
  {
    for (Json& primitive : mesh.at("primitives"))
    {
      Json& attributes = primitive.at("attributes");
      if (!attributes.contains("COLOR_0"))
      {
        continue;
      }
      const Json accessor = root.at("accessors").at(attributes["COLOR_0"].get<std::size_t>());
      const std::string type = accessor.at("type").get<std::string>();
      const std::vector<float> values =
        EncodeColors(ToFloats(buffers.ReadElements(accessor), accessor), type == "VEC4" ? 4 : 3,
          BaseColor(MaterialOf(root, primitive)));
      const std::size_t view = buffers.AddView(
        std::string(reinterpret_cast<const char*>(values.data()), sizeof(float) * values.size()));
      attributes["COLOR_0"] = root["accessors"].size();
      root["accessors"].push_back({ { "bufferView", view }, { "componentType", 5126 },
        { "count", accessor.at("count") }, { "type", type } });
    }
  }
}

void MaskBaseColors(Json& root, const GltfBuffers& buffers)
{
  std::map<std::array<double, 3>, std::size_t> masked; // textures by texture, factor and cutoff
  for (Json& material : root["materials"])
  {
    const BaseColor base(material);
    if (base.IsBlended)
    {
      continue;
    }
    Json& colors = material[ColorsOfMaterial];
    double alpha = base.Mask(base.Factor[3]);
    if (colors.contains("baseColorTexture"))
    {
      Json& index = colors["baseColorTexture"]["index"];
      const auto source = index.get<std::size_t>();
      const auto [found, isNew] =
        masked.insert({ { double(source), base.Factor[3], base.Cutoff }, source });
      const Json texture = root.at("textures").at(source);
      const std::string png = isNew
        ? MaskAlpha(
            buffers.ReadImage(root.at("images").at(texture.at("source").get<std::size_t>())),
            base.Factor[3], base.Cutoff)
        : std::string();
      if (!png.empty())
      {
        found->second = root["textures"].size();
        root["textures"].push_back(texture);
        root["textures"].back()["source"] = root["images"].size();
        root["images"].push_back(
          { { "bufferView", buffers.AddView(png) }, { "mimeType", "image/png" } });
      }
      index = found->second;
      alpha = found->second == source ? alpha : 1.0;
    }
    colors["baseColorFactor"] = base.Factor;
    colors["baseColorFactor"][3] = alpha;
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
