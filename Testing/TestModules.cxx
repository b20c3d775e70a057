// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The table of Documentation/dev/Architecture.md, enforced: reads the vtk.module files and the #include
// lines of the repository and fails on an edge between folders that the table does not allow. Beside it
// what else holds for all sources: their licence, one name for one type, headers that stand alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path Root = PENUMBRA_SOURCE_DIR;

/// A row of the table: the folder, the folders that it may use, and the libraries beside VTK's data
/// and RenderingCore.
struct Row
{
  std::string Folder;
  Names Folders;
  Names Libraries;
};

const std::vector<Row> Table = {
  { "Filters/RayCasting", {}, { "Embree", "GLM" } },
  { "Filters/Irradiance", { "Filters/RayCasting" }, { "GLM" } },
  { "Filters/Parallel", { "Filters/RayCasting", "Filters/Irradiance" }, {} },
  { "Rendering/ScreenSpace", {}, { "OpenGL" } },
  { "Rendering/Irradiance", { "Filters/RayCasting", "Filters/Irradiance", "Rendering/ScreenSpace" },
    { "OpenGL", "GLM" } },
  { "Testing/Comparison", {}, { "GoogleTest" } },
  { "Rendering/ParaView",
    { "Filters/RayCasting", "Filters/Irradiance", "Rendering/ScreenSpace", "Rendering/Irradiance" },
    { "OpenGL", "ParaView" } },
  { "Command",
    { "Filters/RayCasting", "Filters/Irradiance", "Rendering/ScreenSpace", "Rendering/Irradiance",
      "Testing/Comparison" },
    { "OpenGL", "CLI11", "JSON" } },
};

/// The library that a header or a VTK module belongs to; empty: VTK's data or the language's own.
std::string Library(const std::string& name)
{
  static const std::vector<std::pair<std::regex, std::string>> libraries = {
    { std::regex("embree[34]/.*"), "Embree" },
    { std::regex("glm/.*"), "GLM" },
    { std::regex("(vtkOpenGL|vtk_gl|vtkEGL|vtkOSOpenGL|vtkXOpenGL).*"), "OpenGL" },
    { std::regex("VTK::Rendering.*OpenGL2?"), "OpenGL" },
    { std::regex("CLI/.*"), "CLI11" },
    { std::regex("nlohmann/.*"), "JSON" },
    { std::regex("gtest/.*"), "GoogleTest" },
    { std::regex("ParaView::.*"), "ParaView" },
  };
  for (const auto& [pattern, library] : libraries)
  {
    if (std::regex_match(name, pattern))
    {
      return library;
    }
  }
  return {};
}

std::string Text(const fs::path& path)
{
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// The sources that lie directly in a folder, or below it where that is asked.
std::vector<fs::path> Sources(const fs::path& folder, bool below)
{
  std::vector<fs::path> found;
  if (fs::exists(folder))
  {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    {
      const fs::path& path = entry.path();
      if ((path.extension() == ".h" || path.extension() == ".cxx") &&
        (below || path.parent_path() == folder))
      {
        found.push_back(path);
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

Names Includes(const fs::path& source)
{
  static const std::regex include(R"(#\s*include\s*[<"]([^>"]+)[>"])");
  const std::string text = Text(source);
  Names names;
  for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end; ++match)
  {
    names.insert((*match)[1]);
  }
  return names;
}

/// The modules that a vtk.module file names under DEPENDS and PRIVATE_DEPENDS.
Names Dependencies(const fs::path& moduleFile)
{
  std::stringstream text(Text(moduleFile));
  std::string word;
  bool depends = false;
  Names names;
  while (text >> word)
  {
    if (word.find("::") == std::string::npos)
    {
      depends = word == "DEPENDS" || word == "PRIVATE_DEPENDS";
    }
    else if (depends)
    {
      names.insert(word);
    }
  }
  return names;
}

std::string ModuleName(const std::string& folder)
{
  std::string name = "Penumbra::" + folder;
  name.erase(std::remove(name.begin(), name.end(), '/'), name.end());
  return name;
}

/// Header or module name -> the folder of the table that owns it.
std::map<std::string, std::string> Owners()
{
  std::map<std::string, std::string> owners;
  for (const Row& row : Table)
  {
    owners[ModuleName(row.Folder)] = row.Folder;
    for (const fs::path& source : Sources(Root / row.Folder, false))
    {
      owners[source.filename().string()] = row.Folder;
    }
  }
  return owners;
}

void ExpectAllowed(const Row& row, const fs::path& user, const Names& used)
{
  static const std::map<std::string, std::string> owners = Owners();
  for (const std::string& name : used)
  {
    const auto owner = owners.find(fs::path(name).filename().string());
    if (owner != owners.end() && owner->second != row.Folder)
    {
      EXPECT_TRUE(row.Folders.count(owner->second)) << user << " uses " << name;
    }
    const std::string library = Library(name);
    EXPECT_TRUE(library.empty() || row.Libraries.count(library)) << user << " uses " << name;
  }
}

TEST(Modules, DependOnlyOnWhatTheTableAllows)
{
  for (const Row& row : Table)
  {
    const fs::path moduleFile = Root / row.Folder / "vtk.module";
    if (fs::exists(moduleFile))
    {
      EXPECT_NE(Text(moduleFile).find(ModuleName(row.Folder)), std::string::npos) << moduleFile;
      ExpectAllowed(row, moduleFile, Dependencies(moduleFile));
    }
  }
}

TEST(Modules, IncludeOnlyWhatTheTableAllows)
{
  int sources = 0;
  for (const Row& row : Table)
  {
    for (const fs::path& source : Sources(Root / row.Folder, false))
    {
      ExpectAllowed(row, source, Includes(source));
      ++sources;
    }
  }
  EXPECT_GT(sources, 0);
}

TEST(Modules, AllStandInTheTable)
{
  for (const char* top : { "Filters", "Rendering", "Testing" })
  {
    if (!fs::exists(Root / top))
    {
      continue;
    }
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(Root / top))
    {
      if (entry.path().filename() == "vtk.module")
      {
        const std::string folder = entry.path().parent_path().lexically_relative(Root).string();
        EXPECT_TRUE(std::any_of(
          Table.begin(), Table.end(), [&folder](const Row& row) { return row.Folder == folder; }))
          << folder;
      }
    }
  }
}

TEST(Plugin, HoldsNoSourcesOfItsOwn)
{
  EXPECT_TRUE(fs::exists(Root / "Plugin"));
  EXPECT_EQ(Sources(Root / "Plugin", true), std::vector<fs::path>());
}

TEST(PublicHeaders, ShowNeitherPrivateHeadersNorLibraries)
{
  for (const Row& row : Table)
  {
    for (const fs::path& header : Sources(Root / row.Folder, false))
    {
      const std::string name = header.filename().string();
      if (header.extension() != ".h" || name.rfind("vtkPenumbra", 0) != 0)
      {
        continue;
      }
      for (const std::string& include : Includes(header))
      {
        EXPECT_TRUE(Library(include).empty()) << name << " includes " << include;
        EXPECT_TRUE(include.rfind("vtk", 0) == 0 || include.find('.') == std::string::npos)
          << name << " includes " << include;
      }
    }
  }
}

TEST(ModuleTests, UseTheirOwnModuleAndTheFixturesOnly)
{
  const std::map<std::string, std::string> owners = Owners();
  for (const Row& row : Table)
  {
    for (const fs::path& source : Sources(Root / row.Folder / "Testing", true))
    {
      for (const std::string& include : Includes(source))
      {
        const auto owner = owners.find(fs::path(include).filename().string());
        EXPECT_TRUE(owner == owners.end() || owner->second == row.Folder ||
          row.Folders.count(owner->second) || owner->second == "Testing/Comparison")
          << source << " includes " << include;
      }
    }
  }
}

TEST(Sources, SayUnderWhichLicenceTheyAre)
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

TEST(Documentation, LinksLeadToFiles)
{
  const std::regex link(R"(\]\(([^)#:]+)[^):]*\))");
  std::vector<fs::path> pages = { Root / "README.md", Root / "CHANGELOG.md",
    Root / "CONTRIBUTING.md", Root / "Examples/README.md" };
  for (const char* top : { "Documentation", "Benchmarks" })
  {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(Root / top))
    {
      pages.push_back(entry.path());
    }
  }
  for (const fs::path& page : pages)
  {
    const std::string text = page.extension() == ".md" ? Text(page) : "";
    for (std::sregex_iterator i(text.begin(), text.end(), link); i != std::sregex_iterator(); ++i)
    {
      EXPECT_TRUE(fs::exists(page.parent_path() / (*i)[1].str())) << page << ": " << (*i)[1];
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
