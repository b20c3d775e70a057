// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Colors of vertices and alpha modes of glTF files, compared with values computed from the specification of glTF.
#include "GltfDocument.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkVersion.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra_testing;

namespace
{

/// A square whose material has a base color and a mode; `cutoff` < 0: the default.
Document MakeColored(const std::vector<double>& base, const std::string& mode, double cutoff = -1.0)
{
  Document root = MakeSquare();
  Document material = { { "alphaMode", mode },
    { "pbrMetallicRoughness", { { "baseColorFactor", base }, { "metallicFactor", 0.0 } } } };
  if (cutoff >= 0.0)
  {
    material["alphaCutoff"] = cutoff;
  }
  root["materials"] = Document::array({ material });
  root["meshes"][0]["primitives"][0]["material"] = 0;
  return root;
}

/// Renders without light in front of a green background; returns the color of a point of the square.
Pixel RenderColor(const Folder& folder, const Document& root, int x = 20)
{
  WriteText(folder / "square.gltf", root.dump());
  const ProgramResult outcome = RunProgram(
    { "render", folder / "square.gltf", "--output", folder / "square.png", "--resolution", "40,40",
      "--unlit", "--background-color", "0,1,0", "--camera-orthographic", "--camera-position",
      "0.5,0.5,1", "--camera-focal-point", "0.5,0.5,0", "--camera-parallel-scale", "0.5" });
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  return PixelAt(ReadImage(folder / "square.png"), x, 20);
}

void ExpectColor(const Pixel& color, const Pixel& expected, const std::string& name)
{
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(color[c], expected[c], 1.01 / 255.0) << name << " channel " << c;
  }
}

constexpr Pixel Background = { 0.0, 1.0, 0.0 };
constexpr Pixel Red = { 1.0, 0.0, 0.0 };

TEST(GltfColors, OfVerticesMultiplyTheBaseColor)
{
  const Folder folder("vertex-colors");
  const auto encode = [](double linear) { return std::pow(linear, 1.0 / 2.2); };
  for (const std::size_t channels : { 3, 4 })
  {
    Document root = MakeColored({ 0.8, 0.5, 0.5, 1.0 }, "OPAQUE");
    std::vector<float> colors;
    for (int i = 0; i < 6; ++i)
    {
      const float color[] = { 0.5f, 0.25f, 1.0f, 1.0f };
      colors.insert(colors.end(), color, color + channels);
    }
    AddAttribute(root, "COLOR_0", channels == 3 ? "VEC3" : "VEC4", colors);
    ExpectColor(RenderColor(folder, root), { encode(0.4), encode(0.125), encode(0.5) },
      std::to_string(channels));
  }
}

TEST(GltfColors, OfOpaqueMaterialsIgnoreAlpha)
{
  const Folder folder("opaque");
  ExpectColor(RenderColor(folder, MakeColored({ 1, 0, 0, 0.3 }, "OPAQUE")), Red, "factor");
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0) // before, the alpha of factors is not imported
  ExpectColor(
    RenderColor(folder, MakeColored({ 1, 0, 0, 0.5 }, "BLEND")), { 0.5, 0.5, 0.0 }, "blended");
#endif
  Document vertices = MakeColored({ 1, 0, 0, 1 }, "OPAQUE");
  std::vector<float> colors;
  for (int i = 0; i < 6; ++i)
  {
    colors.insert(colors.end(), { 1.f, 1.f, 1.f, 0.25f });
  }
  AddAttribute(vertices, "COLOR_0", "VEC4", colors);
  ExpectColor(RenderColor(folder, vertices), Red, "vertices");
}

TEST(GltfColors, OfMasksAreOpaqueFromTheCutoffOn)
{
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
  GTEST_SKIP() << "VTK 9.2 does not import the alpha of factors.";
#endif
  const Folder folder("mask");
  ExpectColor(RenderColor(folder, MakeColored({ 1, 0, 0, 0.6 }, "MASK")), Red, "above");
  ExpectColor(RenderColor(folder, MakeColored({ 1, 0, 0, 0.4 }, "MASK")), Background, "below");
  ExpectColor(RenderColor(folder, MakeColored({ 1, 0, 0, 0.3 }, "MASK", 0.2)), Red, "low");
  ExpectColor(RenderColor(folder, MakeColored({ 1, 0, 0, 0.8 }, "MASK", 0.9)), Background, "high");
}

TEST(GltfColors, OfTexturesHaveTheAlphaOfTheMode)
{
  const Folder folder("textures");
  vtkNew<vtkImageData> image; // Red, with an alpha of 0.3 to the left and of 0.7 to the right.
  image->SetDimensions(2, 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (int x = 0; x < 2; ++x)
  {
    const double color[] = { 255.0, 0.0, 0.0, x == 0 ? 76.5 : 178.5 };
    for (int c = 0; c < 4; ++c)
    {
      image->SetScalarComponentFromDouble(x, 0, 0, c, color[c]);
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName((folder / "half.png").c_str());
  writer->SetInputData(image);
  writer->Write();
  const auto render = [&folder](const std::string& mode, double factor, int x) {
    Document root = MakeColored({ 1, 1, 1, factor }, mode);
    root["images"] = Document::array({ { { "uri", "half.png" } } });
    root["textures"] = Document::array({ { { "source", 0 }, { "sampler", 0 } } });
    root["samplers"] = Document::array({ { { "wrapS", 33071 }, { "wrapT", 33071 } } }); // clamped
    root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = { { "index", 0 } };
    return RenderColor(folder, root, x);
  };
  // Columns in the outer quarters, where the texture is not interpolated.
  ExpectColor(render("OPAQUE", 1.0, 4), Red, "opaque left");
  ExpectColor(render("OPAQUE", 1.0, 35), Red, "opaque right");
  ExpectColor(render("MASK", 1.0, 4), Background, "mask left");
  ExpectColor(render("MASK", 1.0, 35), Red, "mask right");
  ExpectColor(render("MASK", 0.6, 35), Background, "mask with a factor");
  ExpectColor(render("BLEND", 1.0, 35), { 178.0 / 255.0, 77.0 / 255.0, 0.0 }, "blended");
}

}
