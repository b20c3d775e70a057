// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the options in Documentation/user/Options.md and Documentation/user/F3D.md with those of
// the program.
#include "Meshes.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

using namespace penumbra_testing;

namespace
{

// Returns the words that begin with two dashes.
std::set<std::string> FindOptions(const std::string& text)
{
  const std::regex pattern("--[a-z][a-z-]+");
  return std::set<std::string>(
    std::sregex_token_iterator(text.begin(), text.end(), pattern), std::sregex_token_iterator());
}

}

TEST(Help, MatchesDocumentedOptions)
{
  const std::string pages = SourceFolder() + "/Documentation/user/";
  const std::set<std::string> documented = FindOptions(ReadText(pages + "Options.md"));
  const std::regex slurm("[^\n]*(sbatch |#SBATCH)[^\n]*"); // lines with options of Slurm
  const std::set<std::string> recipes =
    FindOptions(std::regex_replace(ReadText(pages + "BatchRendering.md"), slurm, ""));
  std::set<std::string> offered = FindOptions(RunProgram({ "--help" }).Output);
  for (const char* command : { "render", "animate", "bake", "chart", "compare", "list", "info" })
  {
    const ProgramResult help = RunProgram({ command, "--help" });
    EXPECT_EQ(help.Status, 0);
    EXPECT_EQ(help.Errors, "");
    offered.merge(FindOptions(help.Output));
  }
  for (const std::string& option : offered)
  {
    EXPECT_TRUE(documented.count(option)) << option << " is not documented";
  }
  for (const std::string& option : documented)
  {
    EXPECT_TRUE(option == "--option" || offered.count(option)) << option << " is not offered";
  }
  for (const std::string& option : recipes)
  {
    EXPECT_TRUE(documented.count(option)) << option << " of a recipe is not documented";
  }
}

// Sections of the page begin with the names of their commands.
TEST(Help, MatchesTheSectionOfEachCommand)
{
  const std::regex row(R"(\| `-([^|\\]|\\\|)*)"); // the first cell; \| is a bar in it
  std::map<std::string, std::set<std::string>> documented;
  std::istringstream page(ReadText(SourceFolder() + "/Documentation/user/Options.md"));
  std::string command;
  for (std::string line; std::getline(page, line);)
  {
    if (line.rfind("## ", 0) == 0)
    {
      command = line.substr(3, line.find_first_of(":,", 3) - 3);
    }
    std::smatch cell;
    if (std::regex_search(line, cell, row, std::regex_constants::match_continuous))
    {
      documented[command].merge(FindOptions(cell.str()));
    }
  }
  documented["animate"].insert(documented["render"].begin(), documented["render"].end());
  for (const char* name : { "render", "animate", "bake", "chart", "compare" })
  {
    std::set<std::string> offered;
    std::istringstream help(RunProgram({ name, "--help" }).Output);
    for (std::string line; std::getline(help, line);)
    {
      const std::set<std::string> names = FindOptions(line.substr(0, line.find("  ", 4)));
      if (line.rfind("  -", 0) == 0)
      {
        offered.insert(names.begin(), names.end());
      }
    }
    offered.erase("--help");
    EXPECT_EQ(documented[name], offered) << name;
  }
}

TEST(Help, NamesEveryFormatOfImages)
{
  const std::string list = RunProgram({ "list" }).Output;
  const std::regex extension("\\.[a-z]+");
  for (const char* title : { "\nImages\n", "\nVector graphics\n" })
  {
    const std::size_t begin = list.find(title) + std::string(title).size();
    const std::string line = list.substr(begin, list.find('\n', begin) - begin);
    EXPECT_NE(line.find('.'), std::string::npos);
    for (const char* command : { "render", "animate" })
    {
      const std::string help = RunProgram({ command, "--help" }).Output;
      for (std::sregex_iterator i(line.begin(), line.end(), extension), end; i != end; ++i)
      {
        EXPECT_NE(help.find(i->str()), std::string::npos) << command << ": " << i->str();
      }
    }
  }
}

TEST(F3D, DocumentedOptionsAreAccepted)
{
  const Folder folder("f3d");
  WriteSphereWithArrays(folder / "sphere.vtp");
  ASSERT_EQ(RunProgram({ "render", folder / "sphere.vtp", "--output", folder / "sky.bmp",
                         "--resolution", "8,4", "--background-color", "white" })
              .Status,
    0);
  std::istringstream page(ReadText(SourceFolder() + "/Documentation/user/F3D.md"));
  int rows = 0;
  bool understood = false;
  for (std::string line; std::getline(page, line);)
  {
    if (line.rfind("## ", 0) == 0)
    {
      understood = line == "## Understood as they are";
    }
    if (!understood || line.rfind("| `--", 0) != 0)
    {
      continue;
    }
    ++rows;
    std::istringstream words(line.substr(3, line.find('`', 3) - 3));
    std::vector<std::string> arguments = { "render", folder / "sphere.vtp", "--resolution", "80,60",
      "--output", folder / "p.png" };
    for (std::string word; words >> word;)
    {
      arguments.push_back(word.rfind("--output", 0) == 0 ? "--output=" + folder / "image.png"
          : word.rfind("--hdri-file", 0) == 0            ? "--hdri-file=" + folder / "sky.bmp"
                                                         : word);
    }
    const ProgramResult outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.Status, 0) << line << outcome.Errors;
    EXPECT_EQ(WithoutToleranceWarnings(outcome.Errors), "") << line;
  }
  EXPECT_EQ(rows, 39);
}

TEST(F3D, OtherOptionsAreErrorsThatNameF3D)
{
  const Folder folder("f3d-others");
  WriteSphereWithArrays(folder / "sphere.vtp");
  std::istringstream page(ReadText(SourceFolder() + "/Documentation/user/F3D.md"));
  const std::regex option("`(-[^` ]+)`");
  int options = 0;
  std::string section;
  for (std::string line; std::getline(page, line);)
  {
    section = line.rfind("## ", 0) == 0 ? line : section;
    if (section != "## Not offered" || line.rfind("| `-", 0) != 0)
    {
      continue;
    }
    const std::string names = line.substr(0, line.find('|', 2));
    for (auto i = std::sregex_iterator(names.begin(), names.end(), option);
         i != std::sregex_iterator(); ++i)
    {
      ++options;
      const std::string name = (*i)[1].str();
      const ProgramResult outcome =
        RunProgram({ "render", folder / "sphere.vtp", "--output", folder / "a.png", name });
      EXPECT_EQ(outcome.Status, 2) << name;
      EXPECT_EQ(CountLines(outcome.Errors), 1) << name << outcome.Errors;
      EXPECT_NE(outcome.Errors.find(name.substr(0, name.find('=')) + ": an option of F3D; "),
        std::string::npos)
        << name << outcome.Errors;
    }
  }
  EXPECT_EQ(options, 60);
}

TEST(F3D, ReplacementsAreNamed)
{
  const Folder folder("f3d-named");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const std::vector<std::pair<std::string, std::string>> rows = { { "-o", "--representation" },
    { "--point-sprites=sphere", "--point-radius" },
    { "--coloring-mode=scivis", "--scalar-coloring" }, { "--reference=a.png", "penumbra compare" },
    { "--display-depth", ".vti" }, { "-sbv", "--contour" },
    { "--font-file=a.ttf", "PENUMBRA_FONT" } };
  for (const auto& [name, replacement] : rows)
  {
    const ProgramResult outcome =
      RunProgram({ "render", folder / "sphere.vtp", "--output", folder / "a.png", name });
    EXPECT_EQ(outcome.Status, 2) << name;
    EXPECT_NE(outcome.Errors.find("an option of F3D"), std::string::npos) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(replacement), std::string::npos) << outcome.Errors;
  }
  // The rest of an error line stays.
  const ProgramResult unknown =
    RunProgram({ "render", folder / "sphere.vtp", "--output", folder / "a.png", "--nonsense" });
  EXPECT_NE(unknown.Errors.find("--nonsense: unknown option"), std::string::npos);
}

TEST(F3D, ShortOptionsHaveTheirMeaning)
{
  const Folder folder("f3d-short");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const auto render = [&folder](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(),
      { "render", folder / "sphere.vtp", "--output", folder / name, "--resolution", "60,40" });
    const ProgramResult outcome = RunProgram(options);
    EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
    return ReadText(folder / name);
  };
  const std::string cells =
    render("a.png", { "--coloring-by-cells", "--coloring-array", "Number" });
  EXPECT_EQ(render("b.png", { "-c", "--coloring-array", "Number" }), cells);
  EXPECT_EQ(render("c.png", { "-scap", "--coloring-array=Number", "-r" }), cells);
  const std::string colors =
    render("d.png", { "--coloring-array", "Direction", "--coloring-component", "-2" });
  EXPECT_EQ(render("e.png", { "-y", "--coloring-array", "Direction" }), colors);
  EXPECT_EQ(render("f.png", { "--camera-direction=-x-y+z" }),
    render("g.png", { "--camera-direction=-1,-1,1" }));
  EXPECT_EQ(render("h.png", { "-n" }), render("i.png", { "--text", "sphere.vtp" }));
  EXPECT_EQ(render("j.png", { "-s", "--colormap-file=magma.png" }),
    render("k.png", { "-s", "--colormap", "magma" }));
}

TEST(F3D, FileNamesAreThoseOfTheImage)
{
  const Folder folder("f3d-names");
  WriteText(folder / "a.stl", SquareStl());
  WriteText(folder / "b.stl", SquareStl());
  ASSERT_EQ(RunProgram({ "animate", folder / "a.stl", folder / "b.stl", "--time-series", "--output",
                         folder / "{frame}.png", "--filename", "--resolution", "90,60" })
              .Status,
    0);
  ASSERT_EQ(RunProgram({ "render", folder / "b.stl", "--output", folder / "text.png", "--text",
                         "b.stl", "--resolution", "90,60" })
              .Status,
    0);
  EXPECT_EQ(Compare(folder / "0001.png", folder / "text.png"), 0.0);
}

TEST(F3D, UpGivesTheViewOfF3D)
{
  // Positions of F3D's camera: -up x right, with right = +X, or +Y if up is along X.
  const Folder folder("f3d-up");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const auto render = [&folder](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(),
      { "render", folder / "sphere.vtp", "--output", folder / name, "--resolution", "60,40",
        "--coloring-array", "Direction", "--coloring-component", "-2" });
    EXPECT_EQ(RunProgram(options).Status, 0);
    return ReadText(folder / name);
  };
  const std::pair<std::string, std::string> rows[] = { { "+Y", "-Z" }, { "+Z", "+Y" },
    { "+X", "+Z" }, { "-Y", "+Z" }, { "-Z", "-Y" }, { "0,1,1", "0,1,-1" } };
  for (const auto& [up, direction] : rows)
  {
    EXPECT_EQ(render("a.png", { "--up=" + up }),
      render("b.png", { "--camera-view-up=" + up, "--camera-direction=" + direction }))
      << up;
  }
  EXPECT_EQ(render("c.png", { "--up=+Z", "--camera-direction=-X" }),
    render("d.png", { "--camera-view-up=+Z", "--camera-direction=-X" }));
}

TEST(F3D, ColormapsOfImagesAreThoseOfTheirLowestRow)
{
  // 3 x 2 pixels, rows from the bottom: red, green, blue; black.
  const Folder folder("f3d-colormap");
  const std::string header(
    "BM\x4e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\3\0\0\0\2\0\0\0\1\0\x18\0", 30);
  WriteText(folder / "map.bmp",
    header + std::string(24, '\0') + std::string("\0\0\xff\0\xff\0\xff\0\0\0\0\0", 12) +
      std::string(12, '\0'));
  WriteText(folder / "bar.vtk",
    "# vtk DataFile Version 3.0\nbar\nASCII\nDATASET POLYDATA\nPOINTS 6 float\n"
    "-1 -1 0 0 -1 0 1 -1 0 -1 1 0 0 1 0 1 1 0\nPOLYGONS 2 10\n4 0 1 4 3\n4 1 2 5 4\n"
    "POINT_DATA 6\nSCALARS s float 1\nLOOKUP_TABLE default\n0 1 2 0 1 2\n");
  const ProgramResult outcome =
    RunProgram({ "render", folder / "bar.vtk", "--output", folder / "bar.vti", "--resolution",
      "80,80", "--camera-orthographic", "--camera-parallel-scale", "1", "--camera-position",
      "0,0,3", "--coloring-array", "s", "--colormap", folder / "map.bmp", "--no-lighting" });
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  const auto image = ReadImage(folder / "bar.vti");
  for (int x = 0; x < 80; ++x)
  {
    const double value = 2.0 * (x + 0.5) / 80.0;
    const Pixel color = PixelAt(image, x, 40);
    EXPECT_NEAR(color[0], std::max(1.0 - value, 0.0), 0.01) << x;
    EXPECT_NEAR(color[1], 1.0 - std::abs(value - 1.0), 0.01) << x;
    EXPECT_NEAR(color[2], std::max(value - 1.0, 0.0), 0.01) << x;
  }
}
