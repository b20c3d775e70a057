// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Files of points.
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

using namespace penumbra_testing;

namespace
{

/// Renders a file with points of 6 x 6 pixels and returns the number of pixels that are lit.
int CountLit(const Folder& folder, const std::string& file, std::vector<std::string> options)
{
  options.insert(options.begin(),
    { "render", folder / file, "--output", folder / "points.png", "--resolution", "60,60",
      "--point-size", "6", "--unlit" });
  const ProgramResult outcome = RunProgram(options);
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  const auto image = ReadImage(folder / "points.png");
  int lit = 0;
  for (int y = 0; y < 60; ++y)
  {
    for (int x = 0; x < 60; ++x)
    {
      lit += PixelAt(image, x, y)[0] > 0.5;
    }
  }
  return lit;
}

TEST(Points, OnePointIsDrawn)
{
  const Folder folder("point");
  WriteText(folder / "point.obj", "v 0 1 0\np 1\n");
  WriteText(folder / "far.obj", "v 500000 5400000 300\np 1\n");
  EXPECT_EQ(CountLit(folder, "point.obj", {}), 36);
  EXPECT_EQ(CountLit(folder, "point.obj", { "--camera-orthographic" }), 36);
  EXPECT_EQ(CountLit(folder, "far.obj", {}), 36);
}

TEST(Points, AllPointsOfPtsFilesAreDrawn)
{
  const Folder folder("pts");
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  WriteText(folder / "plain.pts", corners);
  WriteText(folder / "count.pts", "4\n" + corners);
  WriteText(folder / "blocks.pts", "# a survey\n2\n0 0 0\n1 0 0\n2\n0 1 0\n1 1 0\n");
  WriteText(folder / "crlf.pts", "4\r\n0\t0 0\r\n1\t0 0\r\n0\t1 0\r\n1\t1 0\r\n");
  WriteText(folder / "intensity.pts", "4\n0 0 0 5\n1 0 0 6\n0 1 0 7\n1 1 0 8\n");
  WriteText(
    folder / "all.pts", "4\n0 0 0 5 255 0 0\n1 0 0 6 255 0 0\n0 1 0 7 255 0 0\n1 1 0 8 0 255 0\n");
  WriteText(folder / "colors.pts", "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 255 0\n1 1 0 0 255 0\n");
  for (const char* name : { "plain.pts", "count.pts", "blocks.pts", "crlf.pts", "intensity.pts",
         "all.pts", "colors.pts" })
  {
    EXPECT_NEAR(CountLit(folder, name, {}), 4 * 36, 8) << name;
  }
  EXPECT_NEAR(CountLit(folder, "all.pts", { "--scalar-coloring" }), 3 * 36, 6);
  EXPECT_NEAR(CountLit(folder, "colors.pts", { "--scalar-coloring" }), 36, 2);
  EXPECT_GT(
    CountLit(folder, "intensity.pts",
      { "--coloring-array", "Intensities", "--colormap", "gray", "--coloring-range", "0,5" }),
    4 * 30);
}

}
