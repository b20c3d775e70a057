// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Figures in vector graphics, written by the program.
#include "Meshes.h"
#include "Program.h"

#include <gtest/gtest.h>

using namespace penumbra_testing;

namespace
{

std::string RenderBar(const Folder& folder, const std::vector<std::string>& options)
{
  WriteSphereWithArrays(folder / "sphere.vtp");
  std::vector<std::string> arguments = { "render", folder / "sphere.vtp", "--coloring-scalar-bar",
    "--coloring-array", "Height", "--resolution", "200,150", "--output", folder / "figure.svg" };
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProgramResult outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  const std::string svg = ReadText(folder / "figure.svg");
  const std::size_t title = svg.find(">Height</text>");
  EXPECT_NE(title, std::string::npos);
  return title == std::string::npos ? "" : svg.substr(svg.rfind("<text", title));
}

TEST(Figure, HasDarkTextOnLightBackgrounds)
{
  const Folder folder("bar-text");
  EXPECT_NE(RenderBar(folder, {}).find("fill=\"#fff\""), std::string::npos);
  EXPECT_NE(
    RenderBar(folder, { "--background-color", "1,1,1" }).find("fill=\"#000\""), std::string::npos);
  // Paper is white.
  EXPECT_NE(RenderBar(folder, { "--no-background" }).find("fill=\"#000\""), std::string::npos);
}

TEST(Figure, NamesCharactersThatNoFontHas)
{
  const Folder folder("bar-characters");
  WriteText(folder / "square.vtk",
    "# vtk DataFile Version 3.0\nsquare\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
    "0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\n"
    "SCALARS \xf4\x8f\xbf\xbd float 1\nLOOKUP_TABLE default\n0 1 2\n");
  const auto render = [&](const std::string& name) {
    return RunProgram(
      { "render", folder / "square.vtk", "--coloring-scalar-bar", "--coloring-array",
        "\xf4\x8f\xbf\xbd", "--resolution", "200,150", "--output", folder / name });
  };
  const ProgramResult refused = render("figure.pdf");
  EXPECT_EQ(refused.Status, 2);
  EXPECT_NE(refused.Errors.find("U+10FFFD"), std::string::npos) << refused.Errors;
  EXPECT_EQ(CountLines(refused.Errors), 1) << refused.Errors;
  EXPECT_EQ(render("figure.svg").Status, 0);
}

}
