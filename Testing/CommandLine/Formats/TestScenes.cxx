// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Materials, textures, colors, lights and cameras of files. The reference is VTK's rasterizer with
// the importer's scene, with 16 samples per pixel.
#include "GltfDocument.h"
#include "Meshes.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtk3DSImporter.h"
#include "vtkCamera.h"
#include "vtkGLTFImporter.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVRMLImporter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace penumbra_testing;

namespace
{

constexpr int Width = 80;
constexpr int Height = 60;
constexpr int Samples = 4; // in each direction

/// The camera of CameraOptions.
void PlaceCamera(vtkCamera* camera)
{
  camera->SetPosition(0.5, 0.5, 4.0);
  camera->SetFocalPoint(0.5, 0.5, 0.0);
}

const std::vector<std::string> CameraOptions = { "--camera-position", "0.5,0.5,4",
  "--camera-focal-point", "0.5,0.5,0" };

/// Renders a file with VTK. `cameraIndex`: of the cameras of a glTF file; -1: the camera of
/// CameraOptions. Returns the colors of all pixels, bottom row first.
template <typename Importer>
std::vector<Pixel> RenderWithVTK(const std::string& path, int cameraIndex = -1)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(Width * Samples, Height * Samples);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  vtkNew<Importer> importer;
  importer->SetFileName(path.c_str());
  importer->SetRenderWindow(window);
  importer->Update();
  if (auto* gltf = vtkGLTFImporter::SafeDownCast(importer); gltf && cameraIndex >= 0)
  {
    renderer->SetActiveCamera(gltf->GetCamera(static_cast<unsigned int>(cameraIndex)));
  }
  else
  {
    vtkNew<vtkCamera> camera;
    PlaceCamera(camera);
    renderer->SetActiveCamera(camera);
  }
  renderer->ResetCameraClippingRange();
  window->Render();
  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetPixelData(0, 0, Width * Samples - 1, Height * Samples - 1, 0, bytes);
  std::vector<Pixel> pixels(Width * Height, Pixel{ 0, 0, 0 });
  for (int y = 0; y < Height * Samples; ++y)
  {
    for (int x = 0; x < Width * Samples; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        pixels[y / Samples * Width + x / Samples][c] +=
          bytes->GetComponent(y * Width * Samples + x, c) / (255.0 * Samples * Samples);
      }
    }
  }
  return pixels;
}

ProgramResult Render(const Folder& folder, const std::vector<std::string>& files,
  const std::string& output, const std::vector<std::string>& more)
{
  std::vector<std::string> arguments = { "render", "--output", folder / output, "--resolution",
    std::to_string(Width) + "," + std::to_string(Height) };
  for (const std::string& file : files)
  {
    arguments.push_back(folder / file);
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  return RunProgram(arguments);
}

/// Expects at most 5 % of the pixels to differ by more than 3/255, and some to be lit.
void ExpectReference(const Folder& folder, const std::string& image, std::vector<Pixel> reference)
{
  const auto rendered = ReadImage(folder / image);
  ASSERT_EQ(rendered->GetDimensions()[0], Width);
  int off = 0;
  int lit = 0;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      const Pixel a = PixelAt(rendered, x, y);
      const Pixel& b = reference[y * Width + x];
      off += std::max({ std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]) }) >
        3.0 / 255.0;
      lit += std::max({ b[0], b[1], b[2] }) > 0.1;
    }
  }
  EXPECT_LE(off, Width * Height / 20);
  EXPECT_GT(lit, 100);
}

/// Renders `root` with the program and with VTK and compares the images.
void ExpectReferenceOfGltf(const Folder& folder, const Document& root)
{
  WriteText(folder / "scene.gltf", root.dump());
  const ProgramResult outcome = Render(folder, { "scene.gltf" }, "scene.png", CameraOptions);
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  ExpectReference(folder, "scene.png", RenderWithVTK<vtkGLTFImporter>(folder / "scene.gltf"));
}

Document MakeMaterial(double r, double g, double b)
{
  return { { "pbrMetallicRoughness",
    { { "baseColorFactor", { r, g, b, 1.0 } }, { "metallicFactor", 0.0 },
      { "roughnessFactor", 0.7 } } } };
}

void SetMaterial(Document& root, const Document& material)
{
  root["materials"] = Document::array({ material });
  root["meshes"][0]["primitives"][0]["material"] = 0;
}

/// Writes an image of 4 x 2 texels, each of another color.
void WriteTexture(const std::string& path)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int i = 0; i < 8; ++i)
  {
    image->SetScalarComponentFromDouble(i % 4, i / 4, 0, 0, 30.0 * (i + 1));
    image->SetScalarComponentFromDouble(i % 4, i / 4, 0, 1, i % 2 ? 220.0 : 40.0);
    image->SetScalarComponentFromDouble(i % 4, i / 4, 0, 2, i < 4 ? 200.0 : 20.0);
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  writer->Write();
}

TEST(GltfScenes, BaseColorsMatchVTK)
{
  const Folder folder("base-colors");
  Document root = MakeSquare();
  SetMaterial(root, MakeMaterial(0.9, 0.1, 0.2));
  ExpectReferenceOfGltf(folder, root);
  const Pixel center = PixelAt(ReadImage(folder / "scene.png"), Width / 2, Height / 2);
  EXPECT_GT(center[0], 2.0 * center[1]);
}

TEST(GltfScenes, NodesKeepTheirMaterials)
{
  // Three nodes with children, the same geometry and different materials: VTK's reader and importer
  // visit them in different orders.
  const Folder folder("nodes");
  Document root = MakeSquare();
  root["materials"] = Document::array(
    { MakeMaterial(0.9, 0.1, 0.1), MakeMaterial(0.1, 0.9, 0.1), MakeMaterial(0.1, 0.1, 0.9) });
  Document mesh = root["meshes"][0];
  root["meshes"] = Document::array();
  for (int i = 0; i < 3; ++i)
  {
    mesh["primitives"][0]["material"] = i;
    root["meshes"].push_back(mesh);
  }
  root["nodes"] = Document::array({ { { "mesh", 0 }, { "scale", { .4, .4, 1 } } },
    { { "children", { 2, 3 } }, { "translation", { .5, 0, 0 } } },
    { { "mesh", 1 }, { "scale", { .4, .4, 1 } }, { "translation", { 0, .1, 0 } } },
    { { "mesh", 2 }, { "scale", { -.4, .4, 1 } }, { "translation", { 0, .6, 0 } } } });
  root["scenes"][0]["nodes"] = { 0, 1 };
  for (Document& material : root["materials"])
  {
    material["doubleSided"] = true;
  }
  ExpectReferenceOfGltf(folder, root);
}

TEST(GltfScenes, TexturesMatchVTK)
{
  const Folder folder("textures");
  WriteTexture(folder / "colors.png");
  Document root = MakeSquare();
  SetMaterial(root, MakeMaterial(1.0, 1.0, 1.0));
  root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = { { "index", 0 } };
  root["images"] = Document::array({ { { "uri", "colors.png" } } });
  root["samplers"] = Document::array({ { { "magFilter", 9728 }, { "minFilter", 9728 } } });
  root["textures"] = Document::array({ { { "source", 0 }, { "sampler", 0 } } });
  ExpectReferenceOfGltf(folder, root);
}

TEST(GltfScenes, ColorsOfVerticesMatchVTK)
{
  const Folder folder("vertex-colors");
  Document root = MakeSquare();
  AddAttribute(root, "COLOR_0", "VEC3", { 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 0 });
  SetMaterial(root, MakeMaterial(1.0, 1.0, 1.0));
  ExpectReferenceOfGltf(folder, root);
}

TEST(GltfScenes, LightsMatchVTK)
{
  const Folder folder("lights");
  Document root = MakeSquare();
  SetMaterial(root, MakeMaterial(0.8, 0.8, 0.8));
  root["extensionsUsed"] = { "KHR_lights_punctual" };
  root["extensions"]["KHR_lights_punctual"]["lights"] = Document::array(
    { { { "type", "directional" }, { "color", { 1.0, 0.2, 0.1 } }, { "intensity", 0.8 } } });
  root["nodes"].push_back({ { "rotation", { 0.0, 0.38268343, 0.0, 0.92387953 } },
    { "extensions", { { "KHR_lights_punctual", { { "light", 0 } } } } } });
  root["scenes"][0]["nodes"] = { 0, 1 };
  ExpectReferenceOfGltf(folder, root);
  const Pixel center = PixelAt(ReadImage(folder / "scene.png"), Width / 2, Height / 2);
  EXPECT_GT(center[0], 2.0 * center[2]);
  // Lights of options replace those of files.
  std::vector<std::string> options = CameraOptions;
  options.insert(options.end(), { "--light-position", "0,0,1,0" });
  ASSERT_EQ(Render(folder, { "scene.gltf" }, "white.png", options).Status, 0);
  const Pixel white = PixelAt(ReadImage(folder / "white.png"), Width / 2, Height / 2);
  EXPECT_NEAR(white[0], white[2], 2.0 / 255.0);
}

TEST(GltfScenes, CamerasAreThoseOfTheFile)
{
  const Folder folder("cameras");
  Document root = MakeSquare();
  SetMaterial(root, MakeMaterial(0.9, 0.9, 0.3));
  root["cameras"] = Document::array(
    { { { "type", "perspective" }, { "perspective", { { "yfov", 0.7 }, { "znear", 0.1 } } } },
      { { "type", "orthographic" },
        { "orthographic",
          { { "xmag", 0.8 }, { "ymag", 0.8 }, { "znear", 0.1 }, { "zfar", 10.0 } } } } });
  root["nodes"].push_back({ { "camera", 0 }, { "translation", { 0.2, 0.5, 2.5 } } });
  root["nodes"].push_back({ { "camera", 1 }, { "translation", { 0.7, 0.5, 2.0 } } });
  root["scenes"][0]["nodes"] = { 0, 1, 2 };
  WriteText(folder / "scene.gltf", root.dump());
  for (int index = 0; index < 2; ++index)
  {
    const ProgramResult outcome =
      Render(folder, { "scene.gltf" }, "scene.png", { "--camera-index", std::to_string(index) });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
    ExpectReference(
      folder, "scene.png", RenderWithVTK<vtkGLTFImporter>(folder / "scene.gltf", index));
  }
  const ProgramResult outcome =
    Render(folder, { "scene.gltf" }, "none.png", { "--camera-index", "2" });
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_NE(outcome.Errors.find("cameras 0 to 1"), std::string::npos) << outcome.Errors;
}

TEST(GltfScenes, WithoutMaterialsOnlyGeometryIsRendered)
{
  const Folder folder("no-materials");
  Document root = MakeSquare();
  WriteText(folder / "plain.gltf", root.dump());
  SetMaterial(root, MakeMaterial(0.9, 0.1, 0.1));
  WriteText(folder / "red.gltf", root.dump());
  ASSERT_EQ(Render(folder, { "plain.gltf" }, "plain.png", {}).Status, 0);
  ASSERT_EQ(Render(folder, { "red.gltf" }, "red.png", { "--no-materials" }).Status, 0);
  EXPECT_EQ(ReadText(folder / "plain.png"), ReadText(folder / "red.png"));
  ASSERT_EQ(Render(folder, { "red.gltf" }, "red.png", {}).Status, 0);
  EXPECT_NE(ReadText(folder / "plain.png"), ReadText(folder / "red.png"));
}

TEST(GltfScenes, FilesWithAndWithoutMaterialsFormOneScene)
{
  const Folder folder("mixed");
  Document root = MakeSquare();
  SetMaterial(root, MakeMaterial(0.9, 0.1, 0.1));
  root["nodes"][0]["translation"] = { 0.6, 0, 0 };
  WriteText(folder / "red.gltf", root.dump());
  WriteText(folder / "white.obj", "v -0.6 0 0\nv 0.4 0 0\nv 0.4 1 0\nv -0.6 1 0\nf 1 2 3 4\n");
  const ProgramResult outcome =
    Render(folder, { "white.obj", "red.gltf" }, "mixed.png", CameraOptions);
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  const auto image = ReadImage(folder / "mixed.png");
  const Pixel left = PixelAt(image, 26, 30);
  const Pixel right = PixelAt(image, 56, 30);
  EXPECT_NEAR(left[0], left[1], 1e-6);
  EXPECT_GT(left[0], 0.9);
  EXPECT_GT(right[0], 2.0 * right[1]);
}

void WriteObj(const Folder& folder)
{
  WriteText(folder / "two.obj",
    "mtllib two colors.mtl\nv 0 0 0\nv .5 0 0\nv .5 1 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl Red one\nf 1/1 2/2 3/3 4/4\nusemtl textured\nf 2/1 5/2 6/3 3/4\n");
  WriteText(folder / "two colors.mtl",
    "newmtl Red one\nKd .8 .2 .1\nKa 1 1 1\nillum 1\n"
    "newmtl textured\nKd 1 1 1\nmap_Kd -s 1 1 1 .\\colors.png\n");
}

TEST(ObjScenes, MaterialsAndTexturesAreRead)
{
  const Folder folder("obj");
  WriteObj(folder);
  WriteTexture(folder / "colors.png");
  ASSERT_EQ(Render(folder, { "two.obj" }, "two.vti", CameraOptions).Errors, "");
  const auto image = ReadImage(folder / "two.vti");
  // The light is at the camera, 4 from the square.
  const Pixel red = PixelAt(image, 34, 30);
  EXPECT_NEAR(red[0], 0.8, 0.01);
  EXPECT_NEAR(red[1], 0.2, 0.01);
  EXPECT_NEAR(red[2], 0.1, 0.01);
  // Texel (1, 0) from x = .625 to .75 and y = 0 to .5: its center.
  const double perUnit = Height / (2.0 * 4.0 * std::tan(15.0 * 3.14159265358979 / 180.0));
  const Pixel texel = PixelAt(image, static_cast<int>(Width / 2 + (0.6875 - 0.5) * perUnit),
    static_cast<int>(Height / 2 - 0.25 * perUnit));
  EXPECT_NEAR(texel[0], 60.0 / 255.0, 0.1);
  EXPECT_NEAR(texel[1], 220.0 / 255.0, 0.1);
  EXPECT_NEAR(texel[2], 200.0 / 255.0, 0.1);
  vtkDataArray* cells = image->GetPointData()->GetArray("CellId");
  // The reader of VTK 9.2 has the materials in another order.
  EXPECT_EQ(cells->GetComponent(30 * Width + 34, 0) + cells->GetComponent(30 * Width + 46, 0), 1.0);
}

TEST(ObjScenes, ScalesAndOffsetsOfTexturesAreApplied)
{
  const Folder folder("texture-options");
  WriteTwoColors(folder / "two.png"); // 40, 80, 120 to the left and 160, 200, 240 to the right
  WriteText(folder / "square.obj",
    "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl textured\nf 1/1 2/2 3/3 4/4\n");
  const std::vector<std::string> options = { "--unlit", "--resolution", "80,80",
    "--camera-orthographic", "--camera-position", "0.5,0.5,1", "--camera-focal-point", "0.5,0.5,0",
    "--camera-parallel-scale", "0.5" };
  // Red at the centers of the quarters of the square, at u = 1/8 ... 7/8: texels have their centers at 1/4 and 3/4.
  const auto expectReds = [&](const std::string& texture, const std::array<double, 4>& expected) {
    WriteText(folder / "square.mtl", "newmtl textured\nKd 1 1 1\nmap_Kd " + texture + "two.png\n");
    ASSERT_EQ(Render(folder, { "square.obj" }, "square.vti", options).Errors, "");
    const auto image = ReadImage(folder / "square.vti");
    for (int i = 0; i < 4; ++i)
    {
      EXPECT_NEAR(255.0 * PixelAt(image, 10 + 20 * i, 40)[0], expected[i], 6.0) << texture << i;
    }
  };
  expectReds("", { 70, 70, 130, 130 });
  expectReds("-o 0.5 0 0 ", { 130, 130, 70, 70 });
  expectReds("-s 2 1 1 ", { 40, 160, 40, 160 });
}

TEST(ObjScenes, ColoringByDataReplacesMaterials)
{
  const Folder folder("obj-data");
  WriteObj(folder);
  WriteTexture(folder / "colors.png");
  std::vector<std::string> options = CameraOptions;
  options.insert(options.end(),
    { "--coloring-array", "MaterialIds", "--coloring-by-cells", "--colormap", "gray" });
  const ProgramResult outcome = Render(folder, { "two.obj" }, "data.png", options);
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  const auto image = ReadImage(folder / "data.png");
  EXPECT_LT(PixelAt(image, 34, 30)[0], 0.02);
  EXPECT_GT(PixelAt(image, 46, 30)[0], 0.9);
  EXPECT_NEAR(PixelAt(image, 46, 30)[2], PixelAt(image, 46, 30)[0], 0.01);
}

TEST(ObjScenes, MissingFilesCauseOneWarning)
{
  const Folder folder("obj-missing");
  WriteObj(folder);
  ProgramResult outcome = Render(folder, { "two.obj" }, "two.png", CameraOptions);
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(CountLines(outcome.Errors), 1);
  EXPECT_NE(outcome.Errors.find("colors.png' is missing"), std::string::npos) << outcome.Errors;
  WriteText(folder / "none.obj", "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  outcome = Render(folder, { "none.obj" }, "none.png", CameraOptions);
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(CountLines(outcome.Errors), 1);
  EXPECT_NE(outcome.Errors.find("'none.mtl' are missing"), std::string::npos) << outcome.Errors;
}

std::string DecodeHexadecimal(const std::string& text)
{
  std::string bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2)
  {
    bytes += static_cast<char>(std::stoi(text.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

TEST(ObjScenes, DamagedTexturesCauseOneWarning)
{
  const Folder folder("obj-damaged");
  WriteObj(folder);
  WriteTexture(folder / "colors.png");
  const std::string whole = ReadText(folder / "colors.png");
  std::string flipped = whole;
  flipped[whole.find("IDAT") + 8] ^= 0x55;
  // 2 x 2 pixels with valid checksums: they cannot be decompressed, and a row has the filter 9.
  const std::string undecodable = DecodeHexadecimal(
    "89504e470d0a1a0a0000000d4948445200000002000000020802000000fdd49a7300000010494441"
    "54787878787878787878787878787878785da279380000000049454e44ae426082");
  const std::string badFilter = DecodeHexadecimal(
    "89504e470d0a1a0a0000000d4948445200000002000000020802000000fdd49a730000000e494441"
    "54789ce36400034e08050000cb00137833ab970000000049454e44ae426082");
  const std::string plain = "newmtl Red one\nKd .8 .2 .1\nillum 1\nnewmtl textured\nKd 1 1 1\n";
  WriteText(folder / "two colors.mtl", plain);
  ASSERT_EQ(Render(folder, { "two.obj" }, "plain.png", CameraOptions).Errors, "");
  WriteText(folder / "two colors.mtl", plain + "map_Kd colors.png\n");
  for (const std::string& bytes : { whole.substr(0, whole.size() / 2), whole.substr(0, 40), flipped,
         std::string("This is not an image."), std::string(1, '\0'), undecodable, badFilter })
  {
    WriteText(folder / "colors.png", bytes);
    const ProgramResult outcome = Render(folder, { "two.obj" }, "two.png", CameraOptions);
    EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find("colors.png' cannot be read"), std::string::npos)
      << outcome.Errors;
    EXPECT_EQ(Compare(folder / "plain.png", folder / "two.png"), 0.0);
  }
}

TEST(ObjScenes, ColorsOfVerticesAreShown)
{
  const Folder folder("obj-colors");
  WriteText(folder / "colors.obj",
    "v 0 0 0 .2 .6 .4\nv 1 0 0 .2 .6 .4\nv 1 1 0 .2 .6 .4\nv 0 1 0 .2 .6 .4\nf 1 2 3 4\n");
  ASSERT_EQ(Render(folder, { "colors.obj" }, "colors.vti", CameraOptions).Errors, "");
  const Pixel color = PixelAt(ReadImage(folder / "colors.vti"), 40, 30);
  EXPECT_NEAR(color[0], 0.2, 0.01);
  EXPECT_NEAR(color[1], 0.6, 0.01);
  EXPECT_NEAR(color[2], 0.4, 0.01);
}

TEST(OtherScenes, Materials3dsMatchVTK)
{
  const Folder folder("3ds");
  WriteText(folder / "red.3ds", Make3ds());
  const ProgramResult outcome = Render(folder, { "red.3ds" }, "red.png", CameraOptions);
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  ExpectReference(folder, "red.png", RenderWithVTK<vtk3DSImporter>(folder / "red.3ds"));
  const Pixel center = PixelAt(ReadImage(folder / "red.png"), Width / 2, Height / 2);
  EXPECT_GT(center[0], 3.0 * center[1]);
  EXPECT_EQ(Render(folder, { "red.3ds" }, "camera.png", { "--camera-index", "0" }).Errors, "");
  EXPECT_EQ(Render(folder, { "red.3ds" }, "none.png", { "--camera-index", "1" }).Status, 2);
}

TEST(OtherScenes, MaterialsOfVrmlMatchVTK)
{
  const Folder folder("vrml");
  WriteText(folder / "scene.wrl",
    "#VRML V2.0 utf8\nTransform { translation 0.5 0.5 0 children [ Shape {\n"
    "appearance Appearance { material Material { diffuseColor 0.1 0.3 0.9 } }\n"
    "geometry Box { size 1 1 1 } } ] }\n");
  const ProgramResult outcome = Render(folder, { "scene.wrl" }, "scene.png", CameraOptions);
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  ExpectReference(folder, "scene.png", RenderWithVTK<vtkVRMLImporter>(folder / "scene.wrl"));
}

TEST(OtherScenes, NormalsOfVrmlPolygonsAreNotThoseOfPoints)
{
  const Folder folder("vrml-normals");
  const std::string square = "#VRML V2.0 utf8\nShape { geometry IndexedFaceSet {\n"
                             "coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }\n";
  WriteText(folder / "without.wrl", square + "coordIndex [ 0 1 2 3 -1 ] } }\n");
  WriteText(folder / "polygon.wrl",
    square +
      "normal Normal { vector [ 0 0 1 ] } normalPerVertex FALSE coordIndex [ 0 1 2 3 -1 ] } }\n");
  WriteText(folder / "corners.wrl",
    square +
      "normal Normal { vector [ 0 0 1 ] } normalIndex [ 0 0 0 0 -1 ] coordIndex [ 0 1 2 3 -1 ] } "
      "}\n");
  for (const std::string name : { "without", "polygon", "corners" })
  {
    const ProgramResult outcome = Render(folder, { name + ".wrl" }, name + ".png", CameraOptions);
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
    EXPECT_EQ(Compare(folder / "without.png", folder / name + ".png"), 0.0) << name;
  }
}

TEST(OtherScenes, DamagedFilesAreRefusedInOneLine)
{
  const Folder folder("damaged");
  const std::string whole = Make3ds();
  std::string broken = whole;
  broken[2] = 1; // The main chunk ends before its first part.
  broken[3] = broken[4] = broken[5] = 0;
  WriteText(folder / "cut.3ds", whole.substr(0, whole.size() / 2));
  WriteText(folder / "broken.3ds", broken);
  WriteText(folder / "text.3ds", "This is not a mesh.\n");
  WriteText(folder / "text.wrl", "This is not a scene.\n");
  WriteText(folder / "cut.wrl",
    "#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0");
  for (const char* name : { "cut.3ds", "broken.3ds", "text.3ds", "text.wrl", "cut.wrl" })
  {
    const ProgramResult outcome = Render(folder, { name }, "image.png", {});
    EXPECT_EQ(outcome.Status, 2) << name << outcome.Errors;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << name << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(name), std::string::npos) << outcome.Errors;
  }
  const std::vector<std::string> files = folder.List();
  EXPECT_EQ(std::count(files.begin(), files.end(), "image.png"), 0);
}

}
