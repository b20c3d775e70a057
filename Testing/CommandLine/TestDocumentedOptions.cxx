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
  EXPECT_EQ(rows, 26);
}
