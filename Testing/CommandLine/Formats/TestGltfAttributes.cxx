// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Integer attributes, texture coordinates and scenes of glTF files. The truth is the image of the same
// scene in the form that VTK reads.
#include "GltfDocument.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"
#include "vtkVersionMacros.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

using namespace penumbra_testing;

namespace
{

const std::vector<float> Points = { 0, 0, 0, 1, 0, 0, 1, 1, 0.3f, 0, 0, 0, 1, 1, 0.3f, 0, 1, 0.3f };
const std::vector<float> Coordinates = { 0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0 };

Document MakeTiltedSquare()
{
  std::vector<float> normals;
  for (int i = 0; i < 6; ++i)
  {
    normals.insert(normals.end(), { 0.f, -0.287348f, 0.957826f });
  }
  return MakeGltf(Points, normals);
}

/// Adds `values` times `scale` as an accessor of integers, each element padded to whole words.
template <typename Integer>
int AddIntegers(Document& root, const std::vector<float>& values, int components, double scale,
  int type, bool isNormalized)
{
  const std::size_t size = (components * sizeof(Integer) + 3) / 4 * 4;
  const std::size_t count = values.size() / components;
  std::string bytes(count * size, '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const auto value = static_cast<Integer>(std::lround(values[i] * scale));
    bytes.replace(i / components * size + i % components * sizeof(Integer), sizeof(Integer),
      reinterpret_cast<const char*>(&value), sizeof(Integer));
  }
  root["accessors"].push_back({ { "bufferView", root["bufferViews"].size() },
    { "componentType", type }, { "count", count }, { "type", components == 2 ? "VEC2" : "VEC3" },
    { "min", std::vector<int>(components, -9) }, { "max", std::vector<int>(components, 9) } });
  if (isNormalized)
  {
    root["accessors"].back()["normalized"] = true;
  }
  root["bufferViews"].push_back({ { "buffer", root["buffers"].size() },
    { "byteLength", bytes.size() }, { "byteStride", size } });
  root["buffers"].push_back({ { "byteLength", bytes.size() },
    { "uri", "data:application/octet-stream;base64," + Base64(bytes) } });
  return static_cast<int>(root["accessors"].size() - 1);
}

ProgramResult Render(const Folder& folder, const std::string& name, const Document& root,
  const std::vector<std::string>& options = {})
{
  WriteText(folder / name + ".gltf", root.dump());
  std::vector<std::string> arguments = { "render", folder / name + ".gltf", "--output",
    folder / name + ".png", "--resolution", "80,60", "--camera-position", "0.5,0.5,4",
    "--camera-focal-point", "0.5,0.5,0" };
  arguments.insert(arguments.end(), options.begin(), options.end());
  return RunProgram(arguments);
}

void ExpectEqual(const Folder& folder, const std::string& name, const Document& root)
{
  const ProgramResult outcome = Render(folder, name, root);
  ASSERT_EQ(outcome.Status, 0) << name << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "") << name;
  EXPECT_LE(Compare(folder / "plain.png", folder / name + ".png"), 2.01 / 255.0) << name;
}

/// Adds a texture of two colors in x.
void AddTexture(const Folder& folder, Document& root)
{
  WriteTwoColors(folder / "colors.png");
  root["images"] = Document::array({ { { "uri", "colors.png" } } });
  root["textures"] = Document::array({ { { "source", 0 } } });
  root["materials"] = Document::array({ { { "pbrMetallicRoughness",
    { { "metallicFactor", 0.0 }, { "baseColorTexture", { { "index", 0 } } } } } } });
  root["meshes"][0]["primitives"][0]["material"] = 0;
}

TEST(GltfAttributes, IntegerPointsAndNormalsAreRead)
{
  const Folder folder("quantized");
  const Document plain = MakeTiltedSquare();
  ASSERT_EQ(Render(folder, "plain", plain).Status, 0);
  std::vector<float> normals;
  for (int i = 0; i < 6; ++i)
  {
    normals.insert(normals.end(), { 0.f, -0.287348f, 0.957826f });
  }
  const auto make = [&](const auto& addPoints, double scale) {
    Document root = plain;
    root["extensionsRequired"] = { "KHR_mesh_quantization" };
    root["extensionsUsed"] = { "KHR_mesh_quantization" };
    root["meshes"][0]["primitives"][0]["attributes"] = { { "POSITION", addPoints(root) },
      { "NORMAL", AddIntegers<std::int8_t>(root, normals, 3, 127.0, 5120, true) } };
    root["nodes"][0]["scale"] = { 1.0 / scale, 1.0 / scale, 1.0 / scale };
    return root;
  };
  ExpectEqual(folder, "signed",
    make(
      [](
        Document& root) { return AddIntegers<std::int16_t>(root, Points, 3, 1000.0, 5122, false); },
      1000.0));
  ExpectEqual(folder, "unsigned",
    make(
      [](Document& root) {
        return AddIntegers<std::uint16_t>(root, Points, 3, 1000.0, 5123, false);
      },
      1000.0));
  ExpectEqual(folder, "bytes",
    make(
      [](Document& root) { return AddIntegers<std::uint8_t>(root, Points, 3, 100.0, 5121, false); },
      100.0));
  ExpectEqual(folder, "normalized",
    make(
      [](Document& root) {
        return AddIntegers<std::uint16_t>(root, Points, 3, 65535.0, 5123, true);
      },
      1.0));
}

TEST(GltfAttributes, OtherSetsOfTextureCoordinatesAreUsed)
{
  const Folder folder("sets");
  Document root = MakeTiltedSquare();
  AddTexture(folder, root);
  Document plain = root;
  AddAttribute(plain, "TEXCOORD_0", "VEC2", Coordinates);
  ASSERT_EQ(Render(folder, "plain", plain).Status, 0);

  AddAttribute(root, "TEXCOORD_0", "VEC2", std::vector<float>(12, 0.f));
  AddAttribute(root, "TEXCOORD_1", "VEC2", Coordinates);
  Document& texture = root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture["texCoord"] = 1;
  ExpectEqual(folder, "second", root);
  texture["extensions"]["KHR_texture_transform"] = "not an object";
  ExpectEqual(folder, "wrong", root);
  texture.erase("extensions");

  // The texture of the first set is not drawn.
  root["materials"][0]["occlusionTexture"] = { { "index", 0 } };
  const ProgramResult outcome = Render(folder, "both", root);
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("texture coordinates"), std::string::npos) << outcome.Errors;
  EXPECT_LE(Compare(folder / "plain.png", folder / "both.png"), 2.01 / 255.0);
}

TEST(GltfAttributes, ImagesOfExtensionsWithAlternativesAreNotNeeded)
{
  const Folder folder("alternatives");
  Document root = MakeTiltedSquare();
  AddAttribute(root, "TEXCOORD_0", "VEC2", Coordinates);
  AddTexture(folder, root);
  ASSERT_EQ(Render(folder, "plain", root).Status, 0);
  root["extensionsUsed"] = { "EXT_texture_webp" };
  root["images"].push_back({ { "uri", "colors.webp" } });
  root["textures"][0]["extensions"]["EXT_texture_webp"] = { { "source", 1 } };
  ExpectEqual(folder, "webp", root);
}

TEST(GltfAttributes, ImagesOfExtensionsWithoutAlternativesCauseOneWarning)
{
  const Folder folder("webp");
  Document root = MakeTiltedSquare();
  AddAttribute(root, "TEXCOORD_0", "VEC2", Coordinates);
  AddTexture(folder, root);
  root["textures"][0].erase("source");
  root["textures"][0]["extensions"]["EXT_texture_webp"] = { { "source", 0 } };
  const ProgramResult outcome = Render(folder, "webp", root);
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("EXT_texture_webp"), std::string::npos) << outcome.Errors;
}

TEST(GltfAttributes, EmissionNeedsNoTexture)
{
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
  GTEST_SKIP() << "VTK 9.2 shows no emission without a texture.";
#endif
  const Folder folder("emission");
  const double factor[] = { 0.4, 0.2, 0.05 };
  for (const double strength : { 1.0, 2.0 })
  {
    Document root = MakeTiltedSquare();
    root["materials"] = Document::array({ { { "emissiveFactor", factor } } });
    if (strength != 1.0)
    {
      root["materials"][0]["extensions"]["KHR_materials_emissive_strength"] = {
        { "emissiveStrength", strength }
      };
    }
    root["meshes"][0]["primitives"][0]["material"] = 0;
    const ProgramResult outcome = Render(folder, "emission", root, { "--light-intensity", "0" });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
    const Pixel pixel = PixelAt(ReadImage(folder / "emission.png"), 40, 30);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(pixel[c], std::pow(strength * factor[c], 1.0 / 2.2), 1.01 / 255.0) << c;
    }
  }
}

TEST(GltfAttributes, FilesWithoutScenesShowAllNodes)
{
  const Folder folder("scenes");
  Document root = MakeTiltedSquare();
  root["nodes"] = Document::array({ { { "mesh", 0 }, { "scale", { 0.5, 1, 1 } } },
    { { "children", { 2 } }, { "translation", { 0.5, 0, 0 } } },
    { { "mesh", 0 }, { "scale", { 0.4, 0.4, 1 } } } });
  root["scenes"][0]["nodes"] = { 0, 1 };
  ASSERT_EQ(Render(folder, "plain", root).Status, 0);
  root.erase("scenes");
  root.erase("scene");
  ExpectEqual(folder, "without", root);
}

}
