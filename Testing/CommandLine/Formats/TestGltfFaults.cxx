// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Faults of glTF files at which VTK's reader crashes or reads beyond the end of a buffer, and what it leaves out.
// The message names the object and the fault.
#include "GltfDocument.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using namespace penumbra_testing;

namespace
{

struct Fault
{
  const char* Name;
  std::vector<std::pair<const char*, Document>>
    Values; ///< by JSON pointer, replaced in a valid file
  const char* Message;
};

/// A path of nodes, each the parent of the next one.
Document MakeChain(int length)
{
  Document nodes = Document::array({ { { "mesh", 0 } } });
  for (int i = 1; i < length; ++i)
  {
    nodes[i - 1]["children"] = { i };
    nodes.push_back(Document::object());
  }
  return nodes;
}

std::vector<Fault> MakeFaults()
{
  const Document object = Document::object();
  return {
    { "self", { { "/nodes/0/children", { 0 } } }, "node 0 is its own descendant" },
    { "cycle",
      { { "/nodes/0/children", { 1 } }, { "/nodes/1", object }, { "/nodes/1/children", { 2 } },
        { "/nodes/2", object }, { "/nodes/2/children", { 1 } } },
      "node 1 is its own descendant" },
    { "depth", { { "/nodes", MakeChain(10000) } }, "node 4001 has more than 4000 ancestors" },
    { "child", { { "/nodes/0/children", { -1 } } },
      "node 0: 'children' is -1, not an integer >= 0" },
    { "skin", { { "/nodes/0/skin", 9 } }, "node 0: 'skin' is 9, but the length of 'skins' is 0" },
    { "joint",
      { { "/skins", Document::array({ { { "joints", { 7 } } } }) }, { "/nodes/0/skin", 0 } },
      "skin 0: 'joints' is 7, but the length of 'nodes' is 1" },
    { "material", { { "/meshes/0/primitives/0/material", 3 } },
      "mesh 0: 'material' is 3, but the length of 'materials' is 0" },
    { "mode", { { "/meshes/0/primitives/0/mode", 99 } },
      "mesh 0: the 'mode' of a primitive is 99, not one of 0 to 6" },
    { "negative", { { "/meshes/0/primitives/0/mode", -1 } },
      "mesh 0: 'mode' is -1, not an integer >= 0" },
    { "view", { { "/accessors/0/bufferView", 5 } },
      "accessor 0: 'bufferView' is 5, but the length of 'bufferViews' is 2" },
    { "buffer", { { "/bufferViews/1/buffer", 3 } },
      "buffer view 1: 'buffer' is 3, but the length of 'buffers' is 1" },
    { "component", { { "/accessors/0/componentType", 9999 } },
      "accessor 0: 'componentType' is 9999" },
    { "count", { { "/accessors/0/count", 1000000 } },
      "accessor 0: 1000000 elements from byte 0 on exceed the 36 bytes of buffer view 0" },
    { "offset", { { "/accessors/0/byteOffset", 4 } },
      "accessor 0: 3 elements from byte 4 on exceed the 36 bytes of buffer view 0" },
    { "stride", { { "/bufferViews/0/byteStride", 4 } },
      "accessor 0: an element has 12 bytes, but the byteStride of buffer view 0 is 4" },
    { "length", { { "/bufferViews/1/byteLength", 40 } },
      "buffer view 1 needs 40 bytes from byte 36 on, but buffer 0 has 72" },
    { "bytes", { { "/buffers/0/byteLength", 1000000 } },
      "buffer 0 has 72 instead of 1000000 bytes" },
  };
}

TEST(GltfFaults, AreNamed)
{
  const Folder folder("faults");
  std::vector<std::string> arguments = { "render", "--output", folder / "{name}.png",
    "--resolution", "8,8" };
  const std::vector<Fault> faults = MakeFaults();
  for (const Fault& fault : faults)
  {
    Document root = MakeGltf({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    for (const auto& [pointer, value] : fault.Values)
    {
      root[Document::json_pointer(pointer)] = value;
    }
    arguments.push_back(folder / fault.Name + ".gltf");
    WriteText(arguments.back(), root.dump());
  }
  const ProgramResult outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), static_cast<int>(faults.size())) << outcome.Errors;
  for (const Fault& fault : faults)
  {
    const std::string message =
      std::string(fault.Name) + ".gltf: the file is damaged: " + fault.Message;
    EXPECT_NE(outcome.Errors.find(message), std::string::npos) << message << " in\n"
                                                               << outcome.Errors;
  }
}

/// Renders a square with a value replaced in its file; returns the messages.
std::string RenderSquare(const Folder& folder, const std::string& pointer, const Document& value,
  const std::vector<std::string>& options = {})
{
  Document root = MakeSquare();
  root["materials"] = Document::array({ Document::object() });
  root["meshes"][0]["primitives"][0]["material"] = 0;
  root[Document::json_pointer(pointer)] = value;
  WriteText(folder / "square.gltf", root.dump());
  std::vector<std::string> arguments = { "render", folder / "square.gltf", "--output",
    folder / "square.png", "--resolution", "8,8", "--unlit" };
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProgramResult outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  return outcome.Errors;
}

TEST(GltfExtensions, ThatAreNotSupportedAreNamed)
{
  const Folder folder("extensions");
  const Document instancing = { { "EXT_mesh_gpu_instancing",
    { { "attributes", { { "TRANSLATION", 0 } } } } } };
  const std::string instances = RenderSquare(folder, "/nodes/0/extensions", instancing);
  EXPECT_EQ(CountLines(instances), 1) << instances;
  EXPECT_NE(instances.find("is not drawn: EXT_mesh_gpu_instancing;"), std::string::npos)
    << instances;
  const std::string unknown =
    RenderSquare(folder, "/extensionsRequired", { "ACME_rooms", "KHR_mesh_quantization" });
  EXPECT_EQ(CountLines(unknown), 1) << unknown;
  EXPECT_NE(unknown.find("is not drawn: ACME_rooms;"), std::string::npos) << unknown;
}

TEST(GltfExtensions, OfMaterialsAreNotNamedIfOnlySurfacesAreRead)
{
  const Folder folder("surfaces");
  const Document required = { "KHR_materials_transmission", "ACME_rooms" };
  const std::string all = RenderSquare(folder, "/extensionsRequired", required);
  EXPECT_NE(all.find("is not drawn: ACME_rooms, KHR_materials_transmission;"), std::string::npos)
    << all;
  const std::string surfaces =
    RenderSquare(folder, "/extensionsRequired", required, { "--no-materials" });
  EXPECT_NE(surfaces.find("is not drawn: ACME_rooms;"), std::string::npos) << surfaces;
}

TEST(GltfTextures, ThatDoNotExistAreNamed)
{
  const Folder folder("textures");
  const char* const pointer = "/materials/0/pbrMetallicRoughness/baseColorTexture/index";
  const std::string missing = RenderSquare(folder, pointer, 7);
  EXPECT_EQ(CountLines(missing), 1) << missing;
  EXPECT_NE(missing.find("the texture 7 is missing"), std::string::npos) << missing;
  Document materials = Document::array({ Document::object() });
  materials[0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  Document root = MakeSquare();
  root["textures"] = Document::array({ { { "source", 3 } } });
  root["materials"] = materials;
  root["meshes"][0]["primitives"][0]["material"] = 0;
  WriteText(folder / "image.gltf", root.dump());
  const ProgramResult outcome =
    RunProgram({ "render", folder / "image.gltf", "--output", folder / "image.png" });
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("the image of the texture 0 is missing"), std::string::npos)
    << outcome.Errors;
}

TEST(GltfMaterials, OfSpecularAndGlossinessHaveTheirDiffuseColor)
{
  const Folder folder("glossiness");
  const Document extension = { { "KHR_materials_pbrSpecularGlossiness",
    { { "diffuseFactor", { 0.2, 0.5, 0.05, 1.0 } }, { "glossinessFactor", 0.0 } } } };
  const std::string errors = RenderSquare(folder, "/materials/0/extensions", extension);
  EXPECT_EQ(CountLines(errors), 1) << errors;
  EXPECT_NE(errors.find("the specular color is not drawn"), std::string::npos) << errors;
  const Pixel color = PixelAt(ReadImage(folder / "square.png"), 4, 4);
  // Factors are linear; VTK encodes colors with an exponent of 2.2.
  EXPECT_NEAR(color[0], std::pow(0.2, 1.0 / 2.2), 0.005);
  EXPECT_NEAR(color[1], std::pow(0.5, 1.0 / 2.2), 0.005);
  EXPECT_NEAR(color[2], std::pow(0.05, 1.0 / 2.2), 0.005);
}

}
