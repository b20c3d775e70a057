// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfValidation.h"

#include "GltfContainer.h"

#include <cstdint>
#include <optional>
#include <set>
#include <utility>

namespace penumbra
{

namespace
{

using Json = nlohmann::json;

/// Returns whether an extension changes the appearance of surfaces, but not their shape.
bool IsOfMaterials(const std::string& name)
{
  return name.find("_materials_") != name.npos || name.find("_texture_") != name.npos ||
    name.find("_lights_") != name.npos;
}

/// Returns whether an extension is drawn, or causes its own warning.
bool IsKnown(const std::string& name)
{
  static const std::set<std::string> known = { "EXT_texture_webp", "EXT_texture_avif",
    "KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit", "KHR_mesh_quantization", "KHR_texture_basisu", "KHR_texture_transform",
    "MSFT_texture_dds" };
  return known.count(name) > 0;
}

class Validator
{
public:
  Validator(const Json& root, const std::vector<std::size_t>& bufferBytes)
    : Root(root),
      BufferBytes(bufferBytes)
  {
  }

  std::string FindFault()
  {
    this->ForEach("bufferViews", "buffer view ", &Validator::CheckView);
    this->ForEach("accessors", "accessor ", &Validator::CheckAccessor);
    this->ForEach("meshes", "mesh ", &Validator::CheckMesh);
    this->ForEach("skins", "skin ", &Validator::CheckSkin);
    this->ForEach("nodes", "node ", &Validator::CheckNode);
    this->CheckDescendants();
    return this->Fault;
  }

private:
  using Check = void (Validator::*)(const std::string& name, const Json& object);

  void ForEach(const char* list, const std::string& name, Check check)
  {
    const Json& objects = ListOf(this->Root, list);
    for (std::size_t i = 0; i < objects.size() && this->Fault.empty(); ++i)
    {
      const std::string numbered = name + std::to_string(i);
      objects[i].is_object() ? (this->*check)(numbered, objects[i])
                             : this->Report(numbered + " is not an object");
    }
  }

  void Report(const std::string& fault) { this->Fault = this->Fault.empty() ? fault : this->Fault; }

  /// Returns the member `key` of an object if it is an integer >= 0; none if it is missing or wrong, which is
  /// reported.
  std::optional<std::size_t> ReadSize(
    const std::string& name, const Json& object, const std::string& key)
  {
    const auto value = object.find(key);
    if (value == object.end())
    {
      return {};
    }
    if (!value->is_number_integer() || *value < 0)
    {
      this->Report(
        name + ": '" + key + "' is " + value->dump().substr(0, 40) + ", not an integer >= 0");
      return {};
    }
    return value->get<std::size_t>();
  }

  /// Reports an index that is wrong or beyond the end of a list.
  void CheckIndex(
    const std::string& name, const Json& object, const std::string& key, const char* list)
  {
    const std::optional<std::size_t> index = this->ReadSize(name, object, key);
    const std::size_t count = ListOf(this->Root, list).size();
    if (index && *index >= count)
    {
      this->Report(name + ": '" + key + "' is " + std::to_string(*index) + ", but the length of '" +
        list + "' is " + std::to_string(count));
    }
  }

  /// Reports indices of a list `key` that are wrong or beyond the end of another list.
  void CheckIndices(const std::string& name, const Json& object, const char* key, const char* list)
  {
    for (const Json& index : ListOf(object, key))
    {
      this->CheckIndex(name, { { key, index } }, key, list);
    }
  }

  void CheckView(const std::string& name, const Json& view)
  {
    this->CheckIndex(name, view, "buffer", "buffers");
    const std::size_t offset = this->ReadSize(name, view, "byteOffset").value_or(0);
    const std::optional<std::size_t> length = this->ReadSize(name, view, "byteLength");
    const std::optional<std::size_t> buffer = this->ReadSize(name, view, "buffer");
    if (!this->Fault.empty() || !length || !buffer)
    {
      return;
    }
    const std::size_t bytes = this->BufferBytes.at(*buffer);
    if (offset > bytes || *length > bytes - offset)
    {
      this->Report(name + " needs " + std::to_string(*length) + " bytes from byte " +
        std::to_string(offset) + " on, but buffer " + std::to_string(*buffer) + " has " +
        std::to_string(bytes));
    }
  }

  void CheckAccessor(const std::string& name, const Json& accessor)
  {
    static const std::set<int> components = { 5120, 5121, 5122, 5123, 5125, 5126 };
    const std::optional<std::size_t> type = this->ReadSize(name, accessor, "componentType");
    if (type && components.count(static_cast<int>(*type)) == 0)
    {
      this->Report(name + ": 'componentType' is " + std::to_string(*type) +
        ", not one of 5120 to 5123, 5125 and 5126");
    }
    this->CheckIndex(name, accessor, "bufferView", "bufferViews");
    const std::size_t offset = this->ReadSize(name, accessor, "byteOffset").value_or(0);
    const std::optional<std::size_t> count = this->ReadSize(name, accessor, "count");
    const std::optional<std::size_t> number = this->ReadSize(name, accessor, "bufferView");
    // VTK's reader reports members that are missing, and types that do not exist.
    if (!this->Fault.empty() || !number || !type || !count || *count == 0 || !HasSize(accessor))
    {
      return;
    }
    const Json& view = ListOf(this->Root, "bufferViews")[*number];
    const std::size_t length = this->ReadSize(name, view, "byteLength").value_or(0);
    const std::size_t size = ElementSize(accessor);
    const std::size_t stride = this->ReadSize(name, view, "byteStride").value_or(size);
    const std::string of = " of buffer view " + std::to_string(*number);
    if (stride < size)
    {
      this->Report(name + ": an element has " + std::to_string(size) +
        " bytes, but the byteStride" + of + " is " + std::to_string(stride));
    }
    else if (offset > length || size > length - offset ||
      *count - 1 > (length - offset - size) / stride)
    {
      this->Report(name + ": " + std::to_string(*count) + " elements from byte " +
        std::to_string(offset) + " on exceed the " + std::to_string(length) + " bytes" + of);
    }
  }

  static bool HasSize(const Json& accessor)
  {
    static const std::set<std::string> types = { "SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3",
      "MAT4" };
    const auto type = accessor.find("type");
    return type != accessor.end() && type->is_string() && types.count(type->get<std::string>()) > 0;
  }

  void CheckMesh(const std::string& name, const Json& mesh)
  {
    constexpr std::size_t modes = 7;
    for (const Json& primitive : ListOf(mesh, "primitives"))
    {
      if (!primitive.is_object())
      {
        this->Report(name + ": a primitive is not an object");
        return;
      }
      const std::optional<std::size_t> mode = this->ReadSize(name, primitive, "mode");
      if (mode && *mode >= modes)
      {
        this->Report(
          name + ": the 'mode' of a primitive is " + std::to_string(*mode) + ", not one of 0 to 6");
      }
      this->CheckIndex(name, primitive, "indices", "accessors");
      this->CheckIndex(name, primitive, "material", "materials");
      this->CheckAttributes(name, primitive.value("attributes", Json::object()));
      for (const Json& target : ListOf(primitive, "targets"))
      {
        this->CheckAttributes(name, target);
      }
    }
  }

  void CheckAttributes(const std::string& name, const Json& attributes)
  {
    if (!attributes.is_object())
    {
      this->Report(name + ": the attributes of a primitive are not an object");
      return;
    }
    for (const auto& attribute : attributes.items())
    {
      this->CheckIndex(name, attributes, attribute.key(), "accessors");
    }
  }

  void CheckSkin(const std::string& name, const Json& skin)
  {
    this->CheckIndex(name, skin, "inverseBindMatrices", "accessors");
    this->CheckIndices(name, skin, "joints", "nodes");
  }

  void CheckNode(const std::string& name, const Json& node)
  {
    this->CheckIndex(name, node, "mesh", "meshes");
    this->CheckIndex(name, node, "skin", "skins");
    this->CheckIndices(name, node, "children", "nodes");
  }

  /// Reports cycles of nodes. Visits them without recursion, whose depth the file would decide.
  void CheckDescendants()
  {
    enum class States : std::uint8_t
    {
      New,
      Open, ///< an ancestor of the current node
      Done
    };
    const Json& nodes = ListOf(this->Root, "nodes");
    std::vector<States> states(nodes.size(), States::New);
    std::vector<std::pair<std::size_t, std::size_t>> path; // of nodes and their next children
    for (std::size_t start = 0; start < nodes.size() && this->Fault.empty(); ++start)
    {
      if (states[start] == States::New)
      {
        path.emplace_back(start, 0);
      }
      while (!path.empty() && this->Fault.empty())
      {
        auto& [node, next] = path.back();
        const Json& children = ListOf(nodes[node], "children");
        states[node] = next < children.size() ? States::Open : States::Done;
        if (next == children.size())
        {
          path.pop_back();
          continue;
        }
        const std::size_t child = children[next++].get<std::size_t>();
        if (states[child] == States::Open)
        {
          this->Report("node " + std::to_string(child) + " is its own descendant");
        }
        else if (path.size() > MaximumDepth)
        {
          this->Report("node " + std::to_string(child) + " has more than " +
            std::to_string(MaximumDepth) + " ancestors");
        }
        else if (states[child] == States::New)
        {
          path.emplace_back(child, 0);
        }
      }
    }
  }

  /// VTK's reader needs 2 s for 3000 nested nodes, and its stack overflows at 10,000.
  static constexpr std::size_t MaximumDepth = 4000;

  const Json& Root;
  const std::vector<std::size_t>& BufferBytes;
  std::string Fault;
};

}

std::string FindGltfFault(const Json& root, const std::vector<std::size_t>& bufferBytes)
{
  return Validator(root, bufferBytes).FindFault();
}

std::string FindCompression(const Json& root)
{
  for (const Json& extension : ListOf(root, "extensionsRequired"))
  {
    const std::string name = extension.get<std::string>();
    if (name.find("compression") != name.npos)
    {
      return name;
    }
  }
  return {};
}

void WarnOfExtensions(const Json& root, bool materials, std::vector<std::string>& warnings)
{
  std::set<std::string> names;
  for (const Json& extension : ListOf(root, "extensionsRequired"))
  {
    const std::string name = extension.get<std::string>();
    if (!IsKnown(name) && (materials || !IsOfMaterials(name)))
    {
      names.insert(name);
    }
  }
  for (const Json& node : ListOf(root, "nodes"))
  {
    for (const char* name : { "EXT_mesh_gpu_instancing", "KHR_node_visibility" })
    {
      if (node.value("extensions", Json::object()).contains(name))
      {
        names.insert(name);
      }
    }
  }
  std::string list;
  for (const std::string& name : names)
  {
    list += (list.empty() ? "" : ", ") + name;
  }
  if (!list.empty())
  {
    warnings.push_back(
      "what these extensions describe is not drawn: " + list + "; export the file without them");
  }
}

void RemoveExtensions(Json& root)
{
  root.erase("extensionsRequired");
  for (Json& mesh : root["meshes"])
  {
    for (Json& primitive : mesh["primitives"])
    {
      primitive.erase("extensions");
    }
  }
}

}
