// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfVersion1.h"

#include "GltfContainer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>

namespace penumbra
{

namespace
{

using Json = nlohmann::json;

constexpr int CullFace = 2884; // OpenGL's constants
constexpr int Blend = 3042;
constexpr std::size_t MaximumCount = std::size_t(1) << 40;
constexpr std::size_t MaximumStride = 255; // that of version 1

class Converter
{
public:
  explicit Converter(const Json& root)
    : Source(root)
  {
  }

  Json Convert()
  {
    this->Target = { { "asset", { { "version", "2.0" } } } };
    this->ConvertList("buffers", [](const std::string& name, const Json& buffer) {
      Json result = { { "byteLength", buffer.value("byteLength", 0) } };
      if (name != "binary_glTF" && buffer.contains("uri"))
      {
        result["uri"] = buffer["uri"];
      }
      return result;
    });
    this->ConvertList("bufferViews", [this](const std::string&, const Json& view) {
      return Json({ { "buffer", this->Index("buffers", view.at("buffer")) },
        { "byteOffset", view.value("byteOffset", 0) },
        { "byteLength", view.value("byteLength", 0) } });
    });
    this->ConvertList("accessors",
      [this](const std::string&, const Json& accessor) { return this->ConvertAccessor(accessor); });
    this->ConvertList("images",
      [this](const std::string&, const Json& image) { return this->ConvertImage(image); });
    this->ConvertList("samplers", [](const std::string&, const Json& sampler) { return sampler; });
    this->ConvertList("textures", [this](const std::string&, const Json& texture) {
      Json result = { { "source", this->Index("images", texture.at("source")) } };
      this->CopyReference(texture, "sampler", "samplers", result);
      return result;
    });
    this->ConvertList("materials",
      [this](const std::string&, const Json& material) { return this->ConvertMaterial(material); });
    this->ConvertList("cameras", [](const std::string&, const Json& camera) { return camera; });
    this->ConvertList("meshes", [this](const std::string&, const Json& mesh) {
      Json primitives = Json::array();
      for (const Json& primitive : mesh.at("primitives"))
      {
        primitives.push_back(this->ConvertPrimitive(primitive));
      }
      return Json({ { "primitives", primitives } });
    });
    this->ConvertList(
      "nodes", [this](const std::string&, const Json& node) { return this->ConvertNode(node); });
    this->AddExtraMeshes();
    this->ConvertList("animations", [this](const std::string&, const Json& animation) {
      return this->ConvertAnimation(animation);
    });
    this->ConvertList("scenes", [this](const std::string&, const Json& scene) {
      return Json({ { "nodes", this->Indices("nodes", scene.value("nodes", Json::array())) } });
    });
    this->CopyReference(this->Source, "scene", "scenes", this->Target);
    return this->Target;
  }

private:
  const Json& Objects(const Json& parent, const char* name) const
  {
    static const Json none = Json::object();
    const auto found = parent.find(name);
    return found != parent.end() && found->is_object() ? *found : none;
  }

  template <typename Function>
  void ConvertList(const char* name, const Function& convert)
  {
    Json list = Json::array();
    for (const auto& [key, value] : this->Objects(this->Source, name).items())
    {
      list.push_back(convert(key, value));
      if (value.contains("name"))
      {
        list.back()["name"] = value["name"];
      }
    }
    if (!list.empty())
    {
      this->Target[name] = list;
    }
  }

  /// Position of a name in a list, which is sorted by name.
  std::size_t Index(const char* list, const Json& name) const
  {
    const Json& objects = this->Objects(this->Source, list);
    objects.at(name.get<std::string>()); // throws if it is missing
    return static_cast<std::size_t>(
      std::distance(objects.begin(), objects.find(name.get<std::string>())));
  }

  Json Indices(const char* list, const Json& names) const
  {
    Json indices = Json::array();
    for (const Json& name : names)
    {
      indices.push_back(this->Index(list, name));
    }
    return indices;
  }

  void CopyReference(const Json& from, const char* member, const char* list, Json& to) const
  {
    if (from.contains(member))
    {
      to[member] = this->Index(list, from[member]);
    }
  }

  /// The stride becomes that of a view of its own.
  Json ConvertAccessor(const Json& accessor)
  {
    Json result = { { "componentType", accessor.at("componentType") },
      { "count", accessor.at("count") }, { "type", accessor.at("type") } };
    for (const char* member : { "min", "max" })
    {
      if (accessor.contains(member))
      {
        result[member] = accessor[member];
      }
    }
    Json& views = this->Target.at("bufferViews");
    Json view = views.at(this->Index("bufferViews", accessor.at("bufferView")));
    const std::size_t size = ElementSize(accessor);
    const std::size_t given = accessor.value("byteStride", std::size_t(0));
    const std::size_t stride = given == 0 ? size : given;
    const std::size_t count = accessor.at("count").get<std::size_t>();
    view["byteOffset"] =
      view["byteOffset"].get<std::size_t>() + accessor.value("byteOffset", std::size_t(0));
    const bool isTooLong = count > MaximumCount || stride > MaximumStride; // no buffer is as long
    view["byteLength"] = isTooLong ? ~std::size_t(0) : count == 0 ? 0 : (count - 1) * stride + size;
    if (stride != size)
    {
      view["byteStride"] = stride;
    }
    result["bufferView"] = views.size();
    views.push_back(view);
    return result;
  }

  Json ConvertImage(const Json& image) const
  {
    const Json binary = this->Objects(image, "extensions").value("KHR_binary_glTF", Json::object());
    if (binary.contains("bufferView"))
    {
      return { { "bufferView", this->Index("bufferViews", binary["bufferView"]) },
        { "mimeType", binary.value("mimeType", "image/png") } };
    }
    return { { "uri", image.value("uri", "") } };
  }

  /// Returns a value of a material, or the default of its technique.
  static Json Value(const Json& values, const Json& parameters, const std::string& name)
  {
    if (values.contains(name))
    {
      return values[name];
    }
    return parameters.value(name, Json::object()).value("value", Json());
  }

  Json ConvertMaterial(const Json& material) const
  {
    const Json common =
      this->Objects(material, "extensions").value("KHR_materials_common", Json::object());
    const Json technique = this->Objects(this->Source, "techniques")
                             .value(material.value("technique", std::string()), Json::object());
    const Json parameters = technique.value("parameters", Json::object());
    const Json values =
      common.contains("values") ? common["values"] : material.value("values", Json::object());
    const Json enabled = technique.value("states", Json::object()).value("enable", Json::array());
    const auto isEnabled = [&enabled](int state) {
      return std::find(enabled.begin(), enabled.end(), state) != enabled.end();
    };

    Json physical = { { "metallicFactor", 0.0 } };
    Json result;
    std::array<double, 4> color = { 1.0, 1.0, 1.0, 1.0 };
    const Json diffuse = Value(values, parameters, "diffuse");
    if (diffuse.is_string())
    {
      physical["baseColorTexture"] = { { "index", this->Index("textures", diffuse) } };
    }
    else if (diffuse.is_array())
    {
      std::copy_n(diffuse.begin(), std::min<std::size_t>(diffuse.size(), 4), color.begin());
    }
    const Json transparency = Value(values, parameters, "transparency");
    color[3] *= transparency.is_number() ? transparency.get<double>() : 1.0;
    physical["baseColorFactor"] = color;
    result["pbrMetallicRoughness"] = physical;

    const Json emission = Value(values, parameters, "emission");
    if (emission.is_string())
    {
      result["emissiveTexture"] = { { "index", this->Index("textures", emission) } };
      result["emissiveFactor"] = { 1.0, 1.0, 1.0 };
    }
    else if (emission.is_array() && emission.size() >= 3)
    {
      result["emissiveFactor"] = { emission[0], emission[1], emission[2] };
    }
    const bool isBlended =
      isEnabled(Blend) || Value(common, values, "transparent") == Json(true) || color[3] < 1.0;
    if (isBlended)
    {
      result["alphaMode"] = "BLEND";
    }
    const bool isTwoSided = common.empty() ? !enabled.empty() && !isEnabled(CullFace)
                                           : Value(common, values, "doubleSided") == Json(true);
    if (isTwoSided)
    {
      result["doubleSided"] = true;
    }
    return result;
  }

  Json ConvertPrimitive(const Json& primitive) const
  {
    static const std::map<std::string, std::string> names = { { "TEXCOORD", "TEXCOORD_0" },
      { "COLOR", "COLOR_0" } };
    Json attributes = Json::object();
    for (const auto& [name, accessor] : primitive.at("attributes").items())
    {
      if (name.compare(0, 5, "JOINT") != 0 && name.compare(0, 6, "WEIGHT") != 0)
      {
        const auto found = names.find(name);
        attributes[found == names.end() ? name : found->second] =
          this->Index("accessors", accessor);
      }
    }
    Json result = { { "attributes", attributes }, { "mode", primitive.value("mode", 4) } };
    this->CopyReference(primitive, "indices", "accessors", result);
    this->CopyReference(primitive, "material", "materials", result);
    return result;
  }

  Json ConvertNode(const Json& node) const
  {
    Json result = Json::object();
    for (const char* member : { "matrix", "translation", "rotation", "scale" })
    {
      if (node.contains(member))
      {
        result[member] = node[member];
      }
    }
    this->CopyReference(node, "camera", "cameras", result);
    const Json children = this->Indices("nodes", node.value("children", Json::array()));
    if (!children.empty())
    {
      result["children"] = children;
    }
    const Json meshes = this->Indices("meshes", node.value("meshes", Json::array()));
    if (!meshes.empty())
    {
      result["mesh"] = meshes[0];
    }
    return result;
  }

  /// Nodes of version 2 have one mesh: further ones become nodes.
  void AddExtraMeshes()
  {
    std::size_t index = 0;
    for (const auto& entry : this->Objects(this->Source, "nodes").items())
    {
      const Json meshes = this->Indices("meshes", entry.value().value("meshes", Json::array()));
      for (std::size_t i = 1; i < meshes.size(); ++i)
      {
        Json& nodes = this->Target["nodes"];
        nodes[index]["children"].push_back(nodes.size());
        nodes.push_back({ { "mesh", meshes[i] } });
      }
      ++index;
    }
  }

  Json ConvertAnimation(const Json& animation) const
  {
    const Json& parameters = this->Objects(animation, "parameters");
    const Json& sources = this->Objects(animation, "samplers");
    Json samplers = Json::array();
    for (const auto& entry : sources.items())
    {
      const Json& sampler = entry.value();
      const auto accessor = [&](const char* member) {
        return this->Index("accessors", parameters.at(sampler.at(member).get<std::string>()));
      };
      samplers.push_back({ { "input", accessor("input") }, { "output", accessor("output") },
        { "interpolation", sampler.value("interpolation", "LINEAR") } });
    }
    Json channels = Json::array();
    for (const Json& channel : animation.at("channels"))
    {
      const Json& target = channel.at("target");
      const std::string name = channel.at("sampler").get<std::string>();
      sources.at(name); // throws if it is missing
      channels.push_back({ { "sampler", std::distance(sources.begin(), sources.find(name)) },
        { "target",
          { { "node", this->Index("nodes", target.at("id")) }, { "path", target.at("path") } } } });
    }
    return { { "samplers", samplers }, { "channels", channels } };
  }

  const Json& Source;
  Json Target;
};

}

bool IsVersion1(const Json& root)
{
  return root.is_object() && root.contains("meshes") && root["meshes"].is_object();
}

Json ConvertVersion1(const Json& root)
{
  return Converter(root).Convert();
}

}
