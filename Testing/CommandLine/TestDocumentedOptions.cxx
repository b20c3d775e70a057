// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the options in Documentation/user/Options.md and Documentation/user/F3D.md with those of
// the program.
#include "Meshes.h"
#include "Program.h"

#include <gtest/gtest.h>

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
  const std::string pages = PENUMBRA_SOURCE_DIR "/Documentation/user/";
  const std::set<std::string> documented = FindOptions(ReadText(pages + "Options.md"));
  const std::set<std::string> recipes = FindOptions(ReadText(pages + "BatchRendering.md"));
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

TEST(F3D, DocumentedOptionsAreAccepted)
{
  const Folder folder("f3d");
  WriteSphereWithArrays(folder / "sphere.vtp");
  std::istringstream page(ReadText(PENUMBRA_SOURCE_DIR "/Documentation/user/F3D.md"));
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
      arguments.push_back(
        word.rfind("--output", 0) == 0 ? "--output=" + folder / "image.png" : word);
    }
    const ProgramResult outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.Status, 0) << line << outcome.Errors;
    EXPECT_EQ(WithoutToleranceWarnings(outcome.Errors), "") << line;
  }
  EXPECT_EQ(rows, 34);
}

TEST(F3D, OtherOptionsAreErrorsThatNameF3D)
{
  const Folder folder("f3d-others");
  WriteSphereWithArrays(folder / "sphere.vtp");
  std::istringstream page(ReadText(PENUMBRA_SOURCE_DIR "/Documentation/user/F3D.md"));
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
  EXPECT_EQ(options, 50);
}

TEST(F3D, ReplacementsAreNamed)
{
  const Folder folder("f3d-named");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const std::vector<std::pair<std::string, std::string>> rows = { { "-o", "--representation" },
    { "--point-sprites=sphere", "--point-radius" }, { "--up=+Z", "--camera-view-up" },
    { "--coloring-mode=scivis", "--scalar-coloring" }, { "--hdri-ambient", "--indirect" },
    { "--raytracing-samples=5", "--tolerance" }, { "--reference=a.png", "penumbra compare" },
    { "--display-depth", ".vti" }, { "-sbv", "--contour" }, { "-n", "--text" } };
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
}
