// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Materials of MTL and VRML files that VTK's importers do not read, or misread. The truth is the number in the file.
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

using namespace penumbra_testing;

namespace
{

/// Renders a square with a material to square.vti.
ProgramResult Render(
  const Folder& folder, const std::string& material, const std::string& head = std::string())
{
  WriteText(folder / "square.mtl", head + "newmtl a\n" + material);
  WriteText(folder / "square.obj",
    "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3 4\n");
  return RunProgram({ "render", folder / "square.obj", "--output", folder / "square.vti",
    "--resolution", "40,30", "--light-intensity", "0" });
}

TEST(Mtl, EmissionIsTheColorWithoutLight)
{
  const Folder folder("emission");
  const ProgramResult outcome = Render(folder, "Kd .1 .2 .3\nKe 2.5 .5 .25\n");
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(outcome.Errors, "");
  const Pixel pixel = PixelAt(ReadImage(folder / "square.vti"), 20, 15);
  EXPECT_NEAR(pixel[0], 2.5, 1e-3);
  EXPECT_NEAR(pixel[1], 0.5, 1e-3);
  EXPECT_NEAR(pixel[2], 0.25, 1e-3);
}

TEST(Mtl, ColorsOfVerticesReplaceEmissionWithOneWarning)
{
  const Folder folder("colored");
  WriteText(folder / "square.mtl", "newmtl a\nKd 1 1 1\nKe 0 .1 0\n");
  WriteText(folder / "square.obj",
    "mtllib square.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 1 0 0\nusemtl a\nf 1 "
    "2 3 4\n");
  const ProgramResult outcome = RunProgram({ "render", folder / "square.obj", "--output",
    folder / "square.vti", "--resolution", "40,30", "--light-intensity", "0" });
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_NE(outcome.Errors.find("(Ke) was left out"), std::string::npos) << outcome.Errors;
  EXPECT_EQ(PixelAt(ReadImage(folder / "square.vti"), 20, 15)[0], 0.0);
}

TEST(Obj, PointsThatAreNotFiniteCauseOneWarning)
{
  const Folder folder("nan");
  WriteText(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv nan 1 0\nf 1 2 3\nf 1 3 4\n");
  const ProgramResult outcome = RunProgram(
    { "render", folder / "a.obj", "--output", folder / "a.png", "--resolution", "40,30" });
  EXPECT_EQ(outcome.Status, 0);
  const std::size_t first = outcome.Errors.find("points are not finite");
  EXPECT_NE(first, std::string::npos) << outcome.Errors;
  EXPECT_EQ(outcome.Errors.find("points are not finite", first + 1), std::string::npos)
    << outcome.Errors;
}

TEST(Mtl, OpacityTexturesCauseOneWarning)
{
  const Folder folder("opacity");
  const ProgramResult outcome =
    Render(folder, "Ke 1 1 1\nmap_d leaf.png\nnewmtl b\nmap_d leaf.png\n");
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("map_d) of 2 materials"), std::string::npos) << outcome.Errors;
  EXPECT_EQ(Render(folder, "Ke 1 1 1\nmap_Kd leaf.png\nmap_d leaf.png\n").Errors.find("map_d"),
    std::string::npos);
}

TEST(Mtl, OpacityOfVtkIsWrittenAsTransparency)
{
  const Folder folder("exporter");
  for (const std::string head :
    { "", "# wavefront mtl file written by the visualization toolkit\n" })
  {
    const ProgramResult outcome = Render(folder, "Kd 0 0 0\nKe 1 1 1\nTr 0.25\n", head);
    EXPECT_EQ(outcome.Errors, "");
    const Pixel pixel = PixelAt(ReadImage(folder / "square.vti"), 20, 15);
    EXPECT_NEAR(pixel[0], head.empty() ? 0.75 : 0.25, 1e-3);
  }
}

TEST(Mtl, MissingMaterialsCauseOneWarning)
{
  const Folder folder("missing");
  const ProgramResult outcome = Render(folder, "Ke 1 1 1\n", "newmtl b\nKd 1 1 1\n#");
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_NE(outcome.Errors.find("its material 'a' is in none of its MTL files"), std::string::npos)
    << outcome.Errors;
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
}

TEST(Vrml, ColorsOfVerticesAreDrawn)
{
  const Folder folder("vrml-colors");
  const auto render = [&folder](const std::string& options) {
    WriteText(folder / "a.wrl",
      "#VRML V2.0 utf8\nShape { geometry IndexedFaceSet {\n"
      "coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }\n"
      "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0 ] }\n" +
        options + "coordIndex [ 0 1 2 3 -1 ] } }\n");
    return RunProgram({ "render", folder / "a.wrl", "--output", folder / "a.vti", "--resolution",
      "101,101", "--unlit", "--camera-orthographic", "--camera-parallel-scale", "0.5" });
  };
  const ProgramResult outcome = render("");
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(outcome.Errors, "");
  const auto image = ReadImage(folder / "a.vti");
  const Pixel expected[] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 0 } };
  const int x[] = { 1, 99, 99, 1 };
  const int y[] = { 1, 1, 99, 99 };
  for (int corner = 0; corner < 4; ++corner)
  {
    const Pixel pixel = PixelAt(image, x[corner], y[corner]);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(pixel[c], expected[corner][c], 0.05) << corner << ' ' << c;
    }
  }
  for (const char* options : { "colorIndex [ 3 2 1 0 -1 ]\n", "colorPerVertex FALSE\n" })
  {
    const ProgramResult warned = render(options);
    EXPECT_EQ(warned.Status, 0);
    EXPECT_EQ(CountLines(warned.Errors), 1) << warned.Errors;
    EXPECT_NE(warned.Errors.find("colorIndex"), std::string::npos) << warned.Errors;
  }
}

}
