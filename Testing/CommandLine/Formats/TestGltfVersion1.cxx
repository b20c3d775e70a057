// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Files of glTF 1. The truth is the image of the same scene in a file of glTF 2.
#include "GltfDocument.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

using namespace penumbra_testing;

namespace
{

/// A green square in two nodes.
Document MakeGreenSquares()
{
  Document root = MakeSquare();
  root["materials"] = Document::array({ { { "pbrMetallicRoughness",
    { { "baseColorFactor", { 0.2, 0.9, 0.4, 1.0 } }, { "metallicFactor", 0.0 } } } } });
  root["meshes"][0]["primitives"][0]["material"] = 0;
  root["nodes"] = Document::array({ { { "mesh", 0 }, { "scale", { 0.5, 1, 1 } } },
    { { "children", { 2 } }, { "translation", { 0.5, 0, 0 } } },
    { { "mesh", 0 }, { "scale", { 0.4, 0.4, 1 } } } });
  root["scenes"][0]["nodes"] = { 0, 1 };
  return root;
}

std::string Name(const std::string& list, const Document& index)
{
  return list + std::to_string(index.get<int>());
}

void NameReference(Document& object, const char* member, const std::string& list)
{
  if (object.contains(member))
  {
    object[member] = Name(list, object[member]);
  }
}

void NameReferences(Document& names, const std::string& list)
{
  for (Document& name : names)
  {
    name = Name(list, name);
  }
}

/// The document of MakeGreenSquares() in version 1: `values` are those of its material.
Document ToVersion1(Document root, const Document& values)
{
  root["asset"]["version"] = "1.0";
  for (Document& accessor : root["accessors"])
  {
    NameReference(accessor, "bufferView", "bufferViews");
    accessor["byteOffset"] = 0;
    accessor["byteStride"] = accessor["type"] == "VEC2" ? 8 : 12;
  }
  for (Document& view : root["bufferViews"])
  {
    NameReference(view, "buffer", "buffers");
  }
  for (Document& texture : root["textures"])
  {
    NameReference(texture, "source", "images");
    NameReference(texture, "sampler", "samplers");
  }
  root["materials"] = Document::array({ { { "values", values } } });
  for (Document& primitive : root["meshes"][0]["primitives"])
  {
    NameReferences(primitive["attributes"], "accessors");
    NameReference(primitive, "material", "materials");
  }
  for (Document& node : root["nodes"])
  {
    if (node.contains("mesh"))
    {
      node["meshes"] = { Name("meshes", node["mesh"]) };
      node.erase("mesh");
    }
    NameReferences(node["children"], "nodes");
    if (node["children"].is_null())
    {
      node.erase("children");
    }
  }
  NameReferences(root["scenes"][0]["nodes"], "nodes");
  NameReference(root, "scene", "scenes");
  for (const char* list : { "accessors", "buffers", "bufferViews", "images", "materials", "meshes",
         "nodes", "samplers", "scenes", "textures" })
  {
    Document objects = Document::object();
    for (std::size_t i = 0; i < root[list].size(); ++i)
    {
      objects[list + std::to_string(i)] = root[list][i];
    }
    root[list] = objects;
  }
  return root;
}

/// Renders `name`.gltf to `name`.png; text that is no JSON is a binary file.
void Render(const Folder& folder, const std::string& name, const std::string& text)
{
  const std::string file = folder / name + (text[0] == '{' ? ".gltf" : ".glb");
  WriteText(file, text);
  const ProgramResult outcome =
    RunProgram({ "render", file, "--output", folder / name + ".png", "--resolution", "80,60",
      "--camera-position", "0.5,0.5,4", "--camera-focal-point", "0.5,0.5,0" });
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
}

void ExpectEqualImages(const Folder& folder, const std::string& a, const std::string& b)
{
  EXPECT_EQ(Compare(folder / a + ".png", folder / b + ".png"), 0.0) << b;
  const Pixel center = PixelAt(ReadImage(folder / a + ".png"), 30, 30);
  EXPECT_GT(center[0] + center[1] + center[2], 0.3);
}

TEST(GltfVersion1, ColorsAndNodesAreThoseOfVersion2)
{
  const Folder folder("gltf1");
  const Document root = MakeGreenSquares();
  Render(folder, "second", root.dump());
  const Document values = { { "diffuse", { 0.2, 0.9, 0.4, 1.0 } } };
  Document first = ToVersion1(root, values);
  Render(folder, "first", first.dump());
  ExpectEqualImages(folder, "second", "first");

  first["materials"]["materials0"] = { { "extensions",
    { { "KHR_materials_common", { { "technique", "LAMBERT" }, { "values", values } } } } } };
  Render(folder, "common", first.dump());
  ExpectEqualImages(folder, "second", "common");

  first["materials"]["materials0"] = { { "technique", "t" } };
  first["techniques"]["t"]["parameters"]["diffuse"] = { { "type", 35666 },
    { "value", values["diffuse"] } };
  Render(folder, "technique", first.dump());
  ExpectEqualImages(folder, "second", "technique");
}

TEST(GltfVersion1, TexturesAreThoseOfVersion2)
{
  const Folder folder("gltf1-textures");
  WriteTwoColors(folder / "colors.png");
  Document root = MakeGreenSquares();
  root["images"] = Document::array({ { { "uri", "colors.png" } } });
  root["samplers"] = Document::array({ { { "magFilter", 9728 }, { "minFilter", 9728 } } });
  root["textures"] = Document::array({ { { "source", 0 }, { "sampler", 0 } } });
  Document second = root;
  second["materials"][0]["pbrMetallicRoughness"] = { { "baseColorTexture", { { "index", 0 } } },
    { "metallicFactor", 0.0 } };
  Render(folder, "second", second.dump());
  Render(folder, "first", ToVersion1(root, { { "diffuse", "textures0" } }).dump());
  ExpectEqualImages(folder, "second", "first");
}

TEST(GltfVersion1, BinaryFilesAreRead)
{
  const Folder folder("gltf1-binary");
  const std::vector<float> points = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
  const std::vector<float> normals = { 0, 0, 1, 0, 0, 1, 0, 0, 1 };
  Document root = MakeGltf(points, normals);
  // The reader of VTK 9.2 crashes if a material has no factors.
  root["materials"] = Document::array({ { { "pbrMetallicRoughness", Document::object() } } });
  Render(folder, "second", root.dump());
  Document first = ToVersion1(root, Document::object());
  first["buffers"] = { { "binary_glTF", { { "byteLength", 72 }, { "uri", "data:," } } } };
  for (Document& view : first["bufferViews"])
  {
    view["buffer"] = "binary_glTF";
  }
  std::string text = first.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string bytes = Floats(points) + Floats(normals);
  const std::uint32_t header[] = { 0x46546c67, 1,
    static_cast<std::uint32_t>(20 + text.size() + bytes.size()),
    static_cast<std::uint32_t>(text.size()), 0 };
  std::string file(sizeof(header), '\0');
  std::memcpy(&file[0], header, sizeof(header));
  Render(folder, "first", file + text + bytes);
  ExpectEqualImages(folder, "second", "first");
}

}
