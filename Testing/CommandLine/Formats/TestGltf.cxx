// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry of glTF files whatever their textures, sparse accessors and mirrored nodes are, and meshes
// of Abaqus input files.
#include "GltfDocument.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

using namespace penumbra_testing;

namespace
{

/// Two triangles that form a wedge open to the right, with flat normals.
struct Wedge
{
  std::vector<float> Points = { 0, 0, 0, 1, 0, .6f, 1, 1, .6f, 0, 0, 0, 1, 1, .6f, 0, 1, 0 };
  std::vector<float> Normals;

  Wedge()
  {
    for (int i = 0; i < 6; ++i)
    {
      this->Normals.insert(this->Normals.end(), { -.5145f, 0.f, .8575f });
    }
  }
};

/// Arguments without files; the image of a file has its name.
std::vector<std::string> Arguments(const Folder& folder)
{
  return { "render", "--output", folder / "{name}.png", "--resolution", "80,60",
    "--camera-position", "0.5,0.5,4", "--camera-focal-point", "0.5,0.5,0" };
}

ProgramResult Render(const Folder& folder, const std::string& name, const Document& root)
{
  std::vector<std::string> arguments = Arguments(folder);
  arguments.push_back(folder / name + ".gltf");
  WriteText(arguments.back(), root.dump());
  return RunProgram(arguments);
}

void ExpectEqualImages(const Folder& folder, const std::string& a, const std::string& b)
{
  EXPECT_LE(Compare(folder / a + ".png", folder / b + ".png"), 1.01 / 255.0) << a << " " << b;
}

TEST(Gltf, MissingTexturesCauseOneWarning)
{
  const Folder folder("textures");
  const Wedge wedge;
  Document plain = MakeGltf(wedge.Points, wedge.Normals);
  plain["materials"] = Document::array({ { { "pbrMetallicRoughness",
    { { "baseColorFactor", { 0.2, 0.5, 0.9, 1.0 } }, { "metallicFactor", 0.0 } } } } });
  plain["meshes"][0]["primitives"][0]["material"] = 0;
  ASSERT_EQ(Render(folder, "plain", plain).Status, 0);
  WriteText(folder / "broken.png", "\x89PNG\r\n\x1a\nxxxx");
  const char* const uris[] = { "missing.png", "with space.png", "C:/me/a.png", "a\\b.png",
    "broken.png", "https://example.org/a.png", "" };
  std::vector<std::string> arguments = Arguments(folder);
  for (std::size_t i = 0; i < std::size(uris); ++i)
  {
    const char* const uri = uris[i];
    Document root = plain;
    root["images"] = Document::array({ *uri ? Document{ { "uri", uri } } : Document::object() });
    root["textures"] = Document::array({ { { "source", 0 } } });
    root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = { { "index", 0 } };
    root["materials"][0]["normalTexture"] = { { "index", 0 } };
    arguments.push_back(folder / std::to_string(i) + ".gltf");
    WriteText(arguments.back(), root.dump());
  }
  const ProgramResult outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(CountLines(outcome.Errors), static_cast<int>(std::size(uris))) << outcome.Errors;
  for (std::size_t i = 0; i < std::size(uris); ++i)
  {
    const std::size_t file = outcome.Errors.find("/" + std::to_string(i) + ".gltf");
    ASSERT_NE(file, std::string::npos) << uris[i] << outcome.Errors;
    EXPECT_EQ(outcome.Errors.find("/" + std::to_string(i) + ".gltf", file + 1), std::string::npos)
      << outcome.Errors;
    const std::string line = outcome.Errors.substr(file, outcome.Errors.find('\n', file) - file);
    EXPECT_NE(line.find("the texture "), std::string::npos) << line;
    ExpectEqualImages(folder, std::to_string(i), "plain");
  }
}

/// Writes an image of 2 x 2 pixels as .png.
void WriteColors(const std::string& path, int type, int channels)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(type, channels);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
  {
    const double value = 40.0 + 15.0 * static_cast<double>(i);
    values->SetComponent(i / channels, static_cast<int>(i % channels),
      type == VTK_UNSIGNED_SHORT ? 257.0 * value + 100.0 : value);
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  writer->Write();
}

// vtkTexture maps numbers of 16 bits through a lookup table, or takes their lower bytes.
TEST(Textures, Of16BitsAreThoseOf8Bits)
{
  const Folder folder("bits");
  Document root = MakeSquare();
  root["images"][0]["uri"] = "color.png";
  root["textures"][0]["source"] = 0;
  Document& material = root["materials"][0]["pbrMetallicRoughness"];
  material["metallicFactor"] = 0.0;
  material["baseColorTexture"]["index"] = 0;
  root["meshes"][0]["primitives"][0]["material"] = 0;
  WriteText(folder / "scene.gltf", root.dump());
  WriteText(folder / "square.mtl", "newmtl a\nKd 1 1 1\nmap_Kd color.png\n");
  WriteText(folder / "square.obj",
    "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
  for (const int channels : { 1, 3 })
  {
    for (const int type : { VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT })
    {
      WriteColors(folder / "color.png", type, channels);
      const std::string image = type == VTK_UNSIGNED_CHAR ? "{name}8.png" : "{name}16.png";
      const ProgramResult outcome = RunProgram({ "render", folder / "scene.gltf",
        folder / "square.obj", "--output", folder / image, "--resolution", "40,30" });
      EXPECT_EQ(outcome.Status, 0);
      EXPECT_EQ(outcome.Errors, "");
    }
    EXPECT_EQ(Compare(folder / "scene8.png", folder / "scene16.png"), 0.0) << channels;
    EXPECT_EQ(Compare(folder / "square8.png", folder / "square16.png"), 0.0) << channels;
  }
}

TEST(Gltf, MissingFoldersOfTemporaryFilesAreReported)
{
  const Folder folder("temporary");
  const Wedge wedge;
  Document root = MakeGltf(wedge.Points, wedge.Normals);
  root["extensionsRequired"] = { "KHR_materials_unlit" };
  WriteText(folder / "a.gltf", root.dump());
  const ProgramResult outcome =
    RunProgram({ "render", folder / "a.gltf", "--output", folder / "a.png" }, "TMPDIR=/nowhere");
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("set TMPDIR to a folder"), std::string::npos) << outcome.Errors;
}

TEST(Gltf, SparseAccessorsAreRead)
{
  const Folder folder("sparse");
  const Wedge wedge;
  ASSERT_EQ(Render(folder, "plain", MakeGltf(wedge.Points, wedge.Normals)).Status, 0);
  // The base has a wrong vertex 2, which a sparse accessor replaces.
  std::vector<float> base = wedge.Points;
  base[6] = 7.f;
  Document root = MakeGltf(base, wedge.Normals);
  const std::uint16_t index = 2;
  std::string bytes(reinterpret_cast<const char*>(&index), sizeof(index));
  bytes += std::string(2, '\0') + Floats({ 1.f, 1.f, .6f });
  root["buffers"].push_back({ { "byteLength", bytes.size() },
    { "uri", "data:application/octet-stream;base64," + Base64(bytes) } });
  root["bufferViews"].push_back({ { "buffer", 1 }, { "byteLength", bytes.size() } });
  root["accessors"][0]["sparse"] = { { "count", 1 },
    { "indices", { { "bufferView", 2 }, { "componentType", 5123 } } },
    { "values", { { "bufferView", 2 }, { "byteOffset", 4 } } } };
  const ProgramResult outcome = Render(folder, "sparse", root);
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  ExpectEqualImages(folder, "sparse", "plain");
}

TEST(Gltf, BuffersWithSpacesInTheirNamesAreRead)
{
  const Folder folder("buffers");
  const Wedge wedge;
  Document root = MakeGltf(wedge.Points, wedge.Normals);
  ASSERT_EQ(Render(folder, "plain", root).Status, 0);
  WriteText(folder / "a buffer.bin", Floats(wedge.Points) + Floats(wedge.Normals));
  root["buffers"][0]["uri"] = "a buffer.bin";
  EXPECT_EQ(Render(folder, "spaces", root).Errors, "");
  ExpectEqualImages(folder, "spaces", "plain");
  root["buffers"][0]["uri"] = "no buffer.bin";
  const ProgramResult outcome = Render(folder, "missing", root);
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 1);
  EXPECT_NE(outcome.Errors.find("'no buffer.bin' is missing"), std::string::npos) << outcome.Errors;
}

TEST(Gltf, MirroredNodesAreLit)
{
  const Folder folder("mirrored");
  const Wedge wedge;
  for (const bool hasNormals : { true, false })
  {
    SCOPED_TRACE(hasNormals);
    Document root = MakeGltf(wedge.Points, wedge.Normals);
    // A material hides the back faces of polygons.
    root["materials"] =
      Document::array({ { { "pbrMetallicRoughness", { { "metallicFactor", 0.0 } } } } });
    root["meshes"][0]["primitives"][0]["material"] = 0;
    if (!hasNormals)
    {
      root["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    }
    ASSERT_EQ(Render(folder, "plain", root).Status, 0);
    // Mirrors in x by the matrix of a parent, then by a scale.
    root["nodes"] =
      Document::array({ { { "children", { 1 } },
                          { "matrix", { -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1 } } },
        { { "mesh", 0 } } });
    ASSERT_EQ(Render(folder, "matrix", root).Status, 0);
    root["nodes"] = Document::array(
      { { { "mesh", 0 }, { "scale", { -1, 1, 1 } }, { "translation", { 1, 0, 0 } } } });
    ASSERT_EQ(Render(folder, "scale", root).Status, 0);
    ExpectEqualImages(folder, "matrix", "scale");
    const auto plain = ReadImage(folder / "plain.png");
    const auto mirrored = ReadImage(folder / "scale.png");
    double largest = 0.0;
    for (int y = 0; y < 60; ++y)
    {
      for (int x = 0; x < 80; ++x)
      {
        largest =
          std::max(largest, std::abs(PixelAt(plain, x, y)[0] - PixelAt(mirrored, 79 - x, y)[0]));
      }
    }
    EXPECT_LE(largest, 2.01 / 255.0);
    EXPECT_GT(PixelAt(mirrored, 40, 30)[0], 0.2);
  }
}

TEST(Abaqus, MeshesAreRead)
{
  const Folder folder("abaqus");
  const std::string nodes =
    "1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 1, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n"
    "7, 0, 1, 1\n8, 1, 1, 1\n";
  const std::string flat = "*Heading\n cube\n** comment\n*Node, nset=all\n" + nodes +
    "*ELEMENT, TYPE=C3D8R, elset=e\n1, 1, 2, 4, 3,\n 5, 6, 8, 7\n*Solid section\n1.\n";
  const std::string parts = "*Part, name=a\n*Node\n" + nodes +
    "*Element, type=C3D8\n1, 1, 2, 4, 3, 5, 6, 8, 7\n*End Part\n*Assembly\n"
    "*Instance, name=b, part=A\n-1, 0, 0\n0, 0, 0, 0, 0, 1, 90\n*End Instance\n*End Assembly\n";
  std::string ucd = "8 1 0 0 0\n" + nodes + "1 1 hex 1 2 4 3 5 6 8 7\n";
  ucd.erase(std::remove(ucd.begin(), ucd.end(), ','), ucd.end());
  WriteText(folder / "flat.inp", flat);
  WriteText(folder / "ucd.inp", ucd);
  WriteText(folder / "parts.inp", parts);
  for (const char* name : { "flat", "ucd", "parts" })
  {
    const ProgramResult outcome =
      RunProgram({ "render", folder / name + ".inp", "--output", folder / name + ".png",
        "--resolution", "60,60", "--camera-position", "4,3,5", "--camera-focal-point", "0,0,0" });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  }
  ExpectEqualImages(folder, "flat", "ucd");
  // The unit cube moved by -1 in x and turned about z by 90 degrees is in [-1, 0] x [-1, 0].
  std::string moved = nodes;
  const auto replace = [&moved](const std::string& from, const std::string& to) {
    moved.replace(moved.find(from), from.size(), to);
  };
  replace("1, 0, 0, 0", "1, 0, -1, 0");
  replace("2, 1, 0, 0", "2, 0, 0, 0");
  replace("3, 0, 1, 0", "3, -1, -1, 0");
  replace("4, 1, 1, 0", "4, -1, 0, 0");
  replace("5, 0, 0, 1", "5, 0, -1, 1");
  replace("6, 1, 0, 1", "6, 0, 0, 1");
  replace("7, 0, 1, 1", "7, -1, -1, 1");
  replace("8, 1, 1, 1", "8, -1, 0, 1");
  WriteText(
    folder / "moved.inp", "*Node\n" + moved + "*Element, type=C3D8\n1, 1, 2, 4, 3, 5, 6, 8, 7\n");
  ASSERT_EQ(
    RunProgram({ "render", folder / "moved.inp", "--output", folder / "moved.png", "--resolution",
                 "60,60", "--camera-position", "4,3,5", "--camera-focal-point", "0,0,0" })
      .Status,
    0);
  ExpectEqualImages(folder, "parts", "moved");
}

/// Renders `text` as `name`.inp to `name`.png.
void RenderAbaqus(const Folder& folder, const std::string& name, const std::string& text)
{
  WriteText(folder / name + ".inp", text);
  const ProgramResult outcome =
    RunProgram({ "render", folder / name + ".inp", "--output", folder / name + ".png",
      "--resolution", "60,60", "--camera-position", "4,3,5", "--camera-focal-point", "0,0,0" });
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
}

TEST(Abaqus, VariantsGiveTheSameImage)
{
  const Folder folder("abaqus-variants");
  const std::string nodes = "1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 1, 1, 0\n5, 0, 0, 1\n"
                            "6, 1, 0, 1\n7, 0, 1, 1\n8, 1, 1, 1\n";
  const std::string element = "1, 1, 2, 4, 3, 5, 6, 8, 7\n";
  RenderAbaqus(folder, "plain", "*Node\n" + nodes + "*Element, type=C3D8\n" + element);

  std::string indented;
  for (const char c : "*Node\n" + nodes + "*Element, type=C3D8\n" + element)
  {
    indented += c == '\n' ? "\r\n     " : std::string(1, c);
  }
  RenderAbaqus(folder, "indented", indented);
  RenderAbaqus(folder, "continued",
    "*Node,\nnset=all\n" + nodes + "*Element,\n  type=C3D8,\n elset=e\n" + element);
  RenderAbaqus(folder, "instance",
    "*Part, name=a\n*End Part\n*Assembly\n*Instance, name=a-1, part=a\n*Node\n" + nodes +
      "*Element, type=C3D8\n" + element + "*End Instance\n*End Assembly\n");
  WriteText(folder / "Nodes of the part.txt", nodes);
  WriteText(folder / "elements.inc", "*Element, type=C3D8\n" + element);
  RenderAbaqus(folder, "include",
    "*Node\n*Include, input=\"Nodes of the part.txt\"\n*INCLUDE,INPUT=elements.inc\n");
  // (1, 1) is at the radius sqrt(2) and 45 degrees.
  RenderAbaqus(folder, "cylindrical",
    "*Node, system=C\n1\n2, 1\n3, 1, 90\n4, 1.4142135623730951, 45\n5, , , 1\n6, 1, 0, 1\n"
    "7, 1, 90, 1\n8, 1.4142135623730951, 45, 1\n*Element, type=C3D8\n" +
      element);
  for (const char* name : { "indented", "continued", "instance", "include", "cylindrical" })
  {
    SCOPED_TRACE(name);
    ExpectEqualImages(folder, "plain", name);
  }
}

TEST(Abaqus, MiddleNodesOfBeamsAreSecondOrLast)
{
  const Folder folder("abaqus-beams");
  RenderAbaqus(folder, "second", "*Node\n1, -1\n2, 0, .6\n3, 1\n*Element, type=B32\n1, 1, 2, 3\n");
  RenderAbaqus(folder, "last", "*Node\n1, -1\n2, 1\n3, 0, .6\n*Element, type=T3D3\n1, 1, 2, 3\n");
  ExpectEqualImages(folder, "second", "last");
}

TEST(Abaqus, MissingAndGeneratedPartsAreErrors)
{
  const Folder folder("abaqus-errors");
  const auto errors = [&folder](const std::string& text) {
    WriteText(folder / "a.inp", text);
    const ProgramResult outcome =
      RunProgram({ "render", folder / "a.inp", "--output", folder / "a.png" });
    EXPECT_EQ(outcome.Status, 2);
    return outcome.Errors;
  };
  EXPECT_NE(errors("*Include, input=b.inp\n").find("'b.inp' is missing"), std::string::npos);
  EXPECT_NE(errors("*Include, input=a.inp\n").find("include each other"), std::string::npos);
  EXPECT_NE(errors("*Node\n1, 0, 0\n5, 1, 0\n*NGEN\n1, 5, 1\n").find("*ngen"), std::string::npos);
}

}
