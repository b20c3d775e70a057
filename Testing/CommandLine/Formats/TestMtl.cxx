// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Materials of MTL files that vtkOBJImporter does not read. The truth is the number in the file.
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

using namespace penumbra_testing;

namespace
{

/// Renders a square with a material to square.vti.
ProgramResult Render(const Folder& folder, const std::string& material)
{
  WriteText(folder / "square.mtl", "newmtl a\n" + material);
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

}
