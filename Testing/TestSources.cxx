// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Properties of all sources: at most 25 files in a folder, a license, one name for one type, headers that
// stand alone, links that lead to files.
#include "SourceFiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace penumbra_testing;

/// Maximum number of files in a folder, subfolders not counted.
constexpr int MostFiles = 25;
/// Maximum number of lines of private headers and of sources, as in Documentation/dev/Style.md.
constexpr int MostLinesOfHeader = 150;
constexpr int MostLinesOfSource = 500;

TEST(Folders, HoldAtMost25Files)
{
  std::map<fs::path, int> counts;
  for (const char* top : { "Benchmarks", "CMake", "Command", "Examples", "Filters", "Plugin",
         "Python", "Rendering", "Testing" })
  {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(Root / top))
    {
      counts[entry.path().parent_path()] += entry.is_regular_file();
    }
  }
  for (const auto& [folder, count] : counts)
  {
    EXPECT_LE(count, MostFiles) << folder;
  }
}

/// Files that are longer than the style page asks for, with the number of lines that they have at most.
/// A file that becomes shorter leaves the list; none is added.
const std::map<std::string, int> LongFiles = {
  { "Filters/Irradiance/Gathering/IrradianceConstants.h", 387 },
  { "Filters/RayCasting/Edges/OutlineProjector.h", 155 },
  { "Filters/RayCasting/RayCasterInternals.h", 176 },
  { "Filters/RayCasting/Sampling/CameraRayTracer.h", 190 },
  { "Filters/RayCasting/Tiles/ScreenTriangle.h", 199 },
  { "Filters/RayTracing/Embree/RayScene.h", 175 },
  { "Filters/RayTracing/Embree/SliverTree.h", 197 },
  { "Filters/RayTracing/Shading/OwenSobolSequence.h", 203 },
  { "Filters/RayTracing/Shading/RayTracingConstants.h", 204 },
  { "Filters/RayTracing/Shading/Shading.h", 168 },
  { "Filters/Scene/Surface.h", 296 },
  { "Rendering/ScreenSpace/Frame/ScreenSpaceConstants.h", 170 },
};

TEST(Sources, AreNotLongerThanTheStylePageAsksFor)
{
  for (const char* top : { "Filters", "Rendering", "Command" })
  {
    for (const fs::path& source : Sources(Root / top, true))
    {
      const std::string path = source.lexically_relative(Root).generic_string();
      const std::string name = source.filename().string();
      if (path.find("/Testing/") != std::string::npos ||
        (name.rfind("vtkPenumbra", 0) == 0 && source.extension() == ".h"))
      {
        continue;
      }
      const std::string text = Text(source);
      const auto lines = std::count(text.begin(), text.end(), '\n');
      const int limit = source.extension() == ".h" ? MostLinesOfHeader : MostLinesOfSource;
      const auto known = LongFiles.find(path);
      EXPECT_LE(lines, known == LongFiles.end() ? limit : known->second) << path;
      EXPECT_TRUE(known == LongFiles.end() || lines > limit) << path << " may leave LongFiles";
    }
  }
  for (const auto& [path, lines] : LongFiles)
  {
    EXPECT_TRUE(fs::exists(Root / path)) << path;
  }
}

TEST(Sources, HaveLinesOfAtMost120Columns)
{
  for (const char* top : { "Filters", "Rendering", "Testing", "Command", "Examples", "Benchmarks" })
  {
    for (const fs::path& source : Sources(Root / top, true))
    {
      std::stringstream text(Text(source));
      int number = 1;
      for (std::string line; std::getline(text, line); ++number)
      {
        EXPECT_LE(line.size(), 120u) << source << ":" << number;
      }
    }
  }
}

/// Cases that run once must not be left out under the name of one that no longer exists.
TEST(OnceCases, Exist)
{
  std::string tests;
  for (const char* top : { "Benchmarks", "Filters", "Rendering", "Testing" })
  {
    for (const fs::path& source : Sources(Root / top, true))
    {
      if (source.filename().string().rfind("Test", 0) == 0)
      {
        tests += Text(source);
      }
    }
  }
  std::istringstream lines(Text(Root / "Testing/once.txt"));
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t dot = line.find('.');
    if (!line.empty() && line[0] != '#')
    {
      ASSERT_NE(dot, std::string::npos) << line;
      const std::string name = line.substr(dot + 1, line.find('/') - dot - 1);
      const std::string test = "(" + line.substr(0, dot) + ", " + name + ")";
      EXPECT_NE(tests.find(test), std::string::npos) << line;
    }
  }
}

TEST(Plugin, HoldsNoSourcesOfItsOwn)
{
  EXPECT_TRUE(fs::exists(Root / "Plugin"));
  EXPECT_EQ(Sources(Root / "Plugin", true), std::vector<fs::path>());
}

TEST(Sources, StateTheirLicense)
{
  for (const char* top : { "Filters", "Rendering", "Testing", "Command", "Examples", "Benchmarks" })
  {
    for (const fs::path& source : Sources(Root / top, true))
    {
      EXPECT_NE(Text(source).find("SPDX-License-Identifier: BSD-3-Clause"), std::string::npos)
        << source;
    }
  }
}

TEST(Headers, HaveAGuardOfTheirOwn)
{
  static const std::regex guard(R"(#ifndef (\w+_h)\n)");
  std::map<std::string, fs::path> owners;
  for (const char* top : { "Filters", "Rendering", "Testing", "Command", "Examples", "Benchmarks" })
  {
    for (const fs::path& header : Sources(Root / top, true))
    {
      const std::string text = Text(header);
      std::smatch found;
      if (header.extension() == ".h" && std::regex_search(text, found, guard))
      {
        const auto [owner, isNew] = owners.emplace(found[1], header);
        EXPECT_TRUE(isNew) << header << " has the guard of " << owner->second;
      }
    }
  }
  EXPECT_GT(owners.size(), 200u);
}

/// The types that a source defines in namespace penumbra itself; in unnamed namespaces names may repeat.
/// Namespaces are not indented, so whatever begins a line stands in namespaces alone.
Names SharedTypes(const fs::path& source)
{
  static const std::regex type(R"((?:class|struct|enum class) (?:[A-Z_]+_EXPORT )?(\w+)(?: :.*)?)");
  std::stringstream text(Text(source));
  std::vector<std::string> open;
  std::string line;
  std::string before;
  std::smatch found;
  Names names;
  while (std::getline(text, line))
  {
    if (line[0] == '{')
    {
      open.push_back(before);
    }
    else if (line[0] == '}' && !open.empty())
    {
      open.pop_back();
    }
    else if (open == std::vector<std::string>{ "namespace penumbra" } &&
      std::regex_match(line, found, type))
    {
      names.insert(found[1]);
    }
    before = line;
  }
  return names;
}

TEST(Sources, NameEveryTypeOfTheNamespaceOnce)
{
  std::map<std::string, fs::path> definitions;
  for (const char* top : { "Filters", "Rendering", "Plugin", "Command", "Testing", "Benchmarks" })
  {
    for (const fs::path& source : Sources(Root / top, true))
    {
      for (const std::string& name : SharedTypes(source))
      {
        const auto [known, isNew] = definitions.emplace(name, source);
        EXPECT_TRUE(isNew) << name << " stands in " << known->second << " and in " << source;
      }
    }
  }
  EXPECT_GT(definitions.size(), 100u);
}

TEST(Headers, IncludeTheStandardHeadersThatTheyName)
{
  const std::pair<std::regex, std::string> rows[] = {
    { std::regex(R"(std::array\b)"), "array" },
    { std::regex(R"(std::u?int(8|16|32|64)_t\b)"), "cstdint" },
    { std::regex(R"(std::function\b)"), "functional" },
    { std::regex(R"(std::numeric_limits\b)"), "limits" },
    { std::regex(R"(std::map\b)"), "map" },
    { std::regex(R"(std::(unique_ptr|shared_ptr|make_unique|make_shared)\b)"), "memory" },
    { std::regex(R"(std::mutex\b)"), "mutex" },
    { std::regex(R"(std::optional\b)"), "optional" },
    { std::regex(R"(std::set\b)"), "set" },
    { std::regex(R"(std::string\b)"), "string" },
    { std::regex(R"(std::(pair|move)\b)"), "utility" },
    { std::regex(R"(std::vector\b)"), "vector" },
  };
  for (const char* top : { "Filters", "Rendering", "Plugin", "Command", "Testing", "Benchmarks" })
  {
    for (const fs::path& header : Sources(Root / top, true))
    {
      if (header.extension() != ".h")
      {
        continue;
      }
      const std::string text = Text(header);
      const Names included = Includes(header);
      for (const auto& [name, needed] : rows)
      {
        EXPECT_TRUE(included.count(needed) || !std::regex_search(text, name))
          << header << " needs <" << needed << ">";
      }
    }
  }
}

/// Returns the files in folders of the repository, and the script of the commands.
std::vector<fs::path> FilesBelow(const Names& folders)
{
  std::vector<fs::path> found = { Root / "penumbra" };
  for (const std::string& top : folders)
  {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(Root / top))
    {
      found.push_back(entry.path());
    }
  }
  return found;
}

/// Returns the anchors of the headings of a page, as hosts of repositories make them.
Names FindAnchors(const std::string& page)
{
  static const std::regex heading("\n#+ ([^\n]*)"), target(R"(\]\([^)]*\))"), mark(R"([^\w\- ])");
  Names anchors;
  for (std::sregex_iterator i(page.begin(), page.end(), heading), end; i != end; ++i)
  {
    std::string anchor = std::regex_replace((*i)[1].str(), target, "");
    anchor = std::regex_replace(anchor, mark, "");
    for (char& c : anchor)
    {
      c = c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    anchors.insert(anchor);
  }
  return anchors;
}

TEST(Documentation, LinksLeadToFilesAndHeadings)
{
  const std::regex link(R"(\]\(([^)#:]*)(?:#([^):]*))?\))");
  std::vector<fs::path> pages = FilesBelow({ "Benchmarks", "Command", "Data", "Documentation",
    "Examples", "Filters", "Plugin", "Python", "Rendering", "Testing" });
  for (const char* name : { "README.md", "CHANGELOG.md", "CONTRIBUTING.md" })
  {
    pages.push_back(Root / name);
  }
  for (const fs::path& page : pages)
  {
    const std::string text = page.extension() == ".md" ? Text(page) : "";
    for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i)
    {
      const std::string path = (*i)[1];
      const fs::path linked = path.empty() ? page : page.parent_path() / path;
      EXPECT_TRUE(fs::exists(linked)) << page << ": " << path;
      if ((*i)[2].matched && linked.extension() == ".md")
      {
        EXPECT_TRUE(FindAnchors(Text(linked)).count((*i)[2])) << page << ": " << (*i)[0];
      }
    }
  }
}

TEST(Documentation, ListsEveryEnvironmentVariable)
{
  const std::string page = Text(Root / "Documentation/reference/EnvironmentVariables.md");
  const std::regex read(
    R"re((?:getenv\("|environ(?:\.get\(|\.setdefault\(|\[)"|\$\{)((?:PENUMBRA|PYVISTA)\w*)(?=["):-]))re");
  const Names scripts = { "penumbra", "run-suites" };
  for (const fs::path& source : FilesBelow({ "Benchmarks", "Command", "Examples", "Filters",
         "Plugin", "Python", "Rendering", "Testing" }))
  {
    const std::string kind = source.extension().string();
    if (kind == ".cxx" || kind == ".h" || kind == ".py" ||
      scripts.count(source.filename().string()))
    {
      const std::string text = Text(source);
      for (std::sregex_iterator i(text.begin(), text.end(), read), end; i != end; ++i)
      {
        EXPECT_NE(page.find("`" + (*i)[1].str() + "`"), std::string::npos)
          << source << ": " << (*i)[1];
      }
    }
  }
}

TEST(Data, HasAnOriginForEveryFile)
{
  const std::string origins = Text(Root / "Data/README.md");
  for (const fs::directory_entry& entry : fs::directory_iterator(Root / "Data"))
  {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name == "README.md" || origins.find(name) != std::string::npos) << name;
  }
}
}
