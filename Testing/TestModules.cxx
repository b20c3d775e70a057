// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads the vtk.module files and the #include lines of the repository and fails on an edge between
// folders that ModuleTable.h does not allow.
#include "ModuleTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using namespace penumbra_testing;

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

/// Maps each header that is generated from a shader to that shader.
std::map<std::string, fs::path> ShaderHeaders()
{
  std::map<std::string, fs::path> headers;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(Root / "Rendering"))
  {
    if (entry.path().extension() == ".glsl")
    {
      headers[entry.path().stem().string() + ".h"] = entry.path();
    }
  }
  return headers;
}

/// The file that `source` includes as `name`, if it belongs to a row of the table; otherwise empty. The
/// include path holds the source folders of all modules, and Filters.
fs::path Included(const fs::path& source, const std::string& name)
{
  static const std::map<std::string, fs::path> shaders = ShaderHeaders();
  const auto shader = shaders.find(name);
  if (shader != shaders.end())
  {
    return shader->second;
  }
  std::vector<fs::path> folders = { source.parent_path(), Root / "Command", Root / "Filters" };
  for (const Row& row : Table)
  {
    if (IsModule(row))
    {
      folders.push_back(Root / row.Folder);
    }
  }
  for (const fs::path& folder : folders)
  {
    const fs::path path = (folder / name).lexically_normal();
    if (fs::exists(path) && RowOf(path.parent_path()))
    {
      return path;
    }
  }
  return {};
}

/// The names of the headers of tests and benchmarks, except those below the folders `but`.
Names HeadersOfTests(const std::vector<std::string>& but)
{
  Names names;
  for (const char* top : { "Testing", "Benchmarks" })
  {
    for (const fs::path& source : Sources(Root / top, true))
    {
      const std::string path = source.lexically_relative(Root).generic_string();
      if (source.extension() == ".h" &&
        std::none_of(but.begin(), but.end(),
          [&path](const std::string& folder) { return path.rfind(folder + "/", 0) == 0; }))
      {
        names.insert(source.filename().string());
      }
    }
  }
  return names;
}

void ExpectAllowed(const Row& row, const fs::path& source)
{
  static const Names tests = HeadersOfTests({ "Testing/Comparison" });
  for (const std::string& name : Includes(source))
  {
    const std::string library = Library(name);
    EXPECT_TRUE(library.empty() || row.Libraries.count(library)) << source << " uses " << name;

    const fs::path included = Included(source, name);
    if (included.empty())
    {
      EXPECT_FALSE(
        tests.count(fs::path(name).filename().string()) && !fs::exists(source.parent_path() / name))
        << source << " uses " << name << " of tests or benchmarks";
      continue;
    }
    const Row* owner = RowOf(included.parent_path());
    if (owner->Folder != row.Folder)
    {
      EXPECT_TRUE(row.Folders.count(owner->Folder) || row.Folders.count(name))
        << source << " uses " << name << " of " << owner->Folder;
    }
    else if (IsModule(row) || ModuleOf(row) != row.Folder)
    {
      EXPECT_EQ(name.find('/'), std::string::npos)
        << source << ": a header of the same folder is included by its bare name, not " << name;
    }
  }
}

/// The sources of a row without its tests, including those of subfolders that have no row.
std::vector<fs::path> SourcesOf(const Row& row)
{
  std::vector<fs::path> sources = Sources(Root / row.Folder, true);
  sources.erase(std::remove_if(sources.begin(), sources.end(),
                  [&row](const fs::path& source) {
                    return RowOf(source.parent_path()) != &row ||
                      source.string().find("/Testing/Test") != std::string::npos ||
                      source.parent_path().filename() == "Testing";
                  }),
    sources.end());
  return sources;
}

TEST(Modules, NameEarlierRowsOnly)
{
  Names before;
  for (const Row& row : Table)
  {
    for (const std::string& folder : row.Folders)
    {
      EXPECT_TRUE(before.count(folder) || IsPublic(folder)) << row.Folder << " names " << folder;
    }
    before.insert(row.Folder);
  }
}

TEST(Modules, DependOnlyOnWhatTheTableAllows)
{
  std::map<std::string, Row> modules;
  for (const Row& row : Table)
  {
    Row& module = modules[ModuleOf(row)];
    module.Libraries.insert(row.Libraries.begin(), row.Libraries.end());
    for (const std::string& folder : row.Folders)
    {
      const Row* used = RowOf(Root / folder);
      module.Folders.insert(used ? ModuleName(ModuleOf(*used)) : folder);
    }
  }
  for (const auto& [folder, module] : modules)
  {
    const fs::path moduleFile = Root / folder / "vtk.module";
    if (!fs::exists(moduleFile))
    {
      continue;
    }
    EXPECT_NE(Text(moduleFile).find(ModuleName(folder)), std::string::npos) << moduleFile;
    for (const std::string& name : Dependencies(moduleFile))
    {
      EXPECT_TRUE(name.rfind("Penumbra::", 0) != 0 || module.Folders.count(name))
        << moduleFile << " uses " << name;
      const std::string library = Library(name);
      EXPECT_TRUE(library.empty() || module.Libraries.count(library))
        << moduleFile << " uses " << name;
    }
  }
}

TEST(Modules, IncludeOnlyWhatTheTableAllows)
{
  int sources = 0;
  for (const Row& row : Table)
  {
    for (const fs::path& source : SourcesOf(row))
    {
      ExpectAllowed(row, source);
      ++sources;
    }
  }
  EXPECT_GT(sources, 200);
}

TEST(Modules, UseWhatTheTableAllows)
{
  for (const Row& row : Table)
  {
    Names used;
    for (const fs::path& source : SourcesOf(row))
    {
      for (const std::string& name : Includes(source))
      {
        const fs::path included = Included(source, name);
        used.insert(included.empty() ? name : RowOf(included.parent_path())->Folder);
        used.insert(name);
      }
    }
    const Names dependencies =
      IsModule(row) ? Dependencies(Root / row.Folder / "vtk.module") : Names();
    for (const std::string& folder : row.Folders)
    {
      EXPECT_TRUE(used.count(folder) || dependencies.count(ModuleName(folder)))
        << row.Folder << " names " << folder << ", which it does not use";
    }
  }
}

TEST(Modules, AllStandInTheTable)
{
  for (const char* top : { "Command", "Filters", "Rendering", "Testing" })
  {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(Root / top))
    {
      const fs::path folder = entry.path().parent_path();
      const std::string name = folder.lexically_relative(Root).generic_string();
      const std::string extension = entry.path().extension().string();
      const bool isModule = entry.path().filename() == "vtk.module";
      const bool isRoom = (extension == ".h" || extension == ".cxx") &&
        std::string(top) != "Testing" && folder.filename() != "Testing";
      if (isModule || isRoom)
      {
        const Row* row = RowOf(folder);
        EXPECT_TRUE(row && row->Folder == name) << entry.path();
      }
    }
  }
}

TEST(Modules, LinkNoLibraryOfTestsOrBenchmarks)
{
  static const std::regex library(R"(add_library\((\w+))");
  Names libraries;
  const auto forEachList = [](const std::string& top, const auto& use) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(Root / top))
    {
      if (entry.path().filename() == "CMakeLists.txt" || entry.path().filename() == "vtk.module")
      {
        use(entry.path(), Text(entry.path()));
      }
    }
  };
  for (const char* top : { "Testing", "Benchmarks" })
  {
    forEachList(top, [&libraries](const fs::path& path, const std::string& text) {
      if (path.filename() == "vtk.module")
      {
        libraries.insert(ModuleName(path.parent_path().lexically_relative(Root).generic_string()));
      }
      for (std::sregex_iterator i(text.begin(), text.end(), library), end; i != end; ++i)
      {
        libraries.insert((*i)[1]);
      }
    });
  }
  EXPECT_FALSE(libraries.empty());
  for (const char* top : { "Filters", "Rendering", "Command" })
  {
    forEachList(top, [&libraries](const fs::path& path, const std::string& text) {
      for (const std::string& name : libraries)
      {
        EXPECT_TRUE(path.parent_path().filename() == "Testing" ||
          !std::regex_search(text, std::regex("\\b" + name + "\\b")))
          << path << " links " << name;
      }
    });
  }
}

TEST(Folders, OfModulesHaveAReadme)
{
  for (const Row& row : Table)
  {
    EXPECT_TRUE((row.Folder.rfind("Filters/", 0) != 0 && row.Folder.rfind("Rendering/", 0) != 0) ||
      fs::exists(Root / row.Folder / "README.md"))
      << row.Folder;
  }
}

/// The folders that the README of a room names under "May include", as paths from the root.
Names FoldersOfReadme(const Row& row)
{
  static const std::regex list(R"(May include:?([^;]*?)(\.\n|\.$|;))");
  static const std::regex folder(R"(`([\w/]+)`)");
  const std::string text = Text(Root / row.Folder / "README.md");
  std::smatch found;
  Names names;
  if (std::regex_search(text, found, list))
  {
    const std::string named = found[1];
    for (std::sregex_iterator i(named.begin(), named.end(), folder), end; i != end; ++i)
    {
      std::string name = (*i)[1];
      const bool isRoom = name.back() == '/';
      name.erase(name.size() - (isRoom ? 1 : 0));
      names.insert(
        isRoom && name.find('/') == std::string::npos ? ModuleOf(row) + "/" + name : name);
    }
  }
  return names;
}

TEST(Folders, HaveReadmesThatNameWhatTheTableAllows)
{
  const auto contains = [](const std::string& outer, const std::string& inner) {
    return inner == outer || inner.rfind(outer + "/", 0) == 0;
  };
  int rooms = 0;
  for (const Row& row : Table)
  {
    if (ModuleOf(row) == row.Folder || !fs::exists(Root / row.Folder / "README.md"))
    {
      continue;
    }
    ++rooms;
    const Names named = FoldersOfReadme(row);
    for (const std::string& folder : row.Folders)
    {
      EXPECT_TRUE(IsPublic(folder) ||
        std::any_of(named.begin(), named.end(),
          [&](const std::string& name) { return contains(name, folder); }))
        << "the README of " << row.Folder << " lacks " << folder;
    }
    for (const std::string& name : named)
    {
      EXPECT_TRUE(std::any_of(row.Folders.begin(), row.Folders.end(),
        [&](const std::string& folder) { return contains(name, folder); }))
        << "the README of " << row.Folder << " names " << name;
    }
  }
  EXPECT_GT(rooms, 30);
}

TEST(PublicHeaders, ShowNeitherPrivateHeadersNorLibraries)
{
  for (const Row& row : Table)
  {
    for (const fs::path& header : SourcesOf(row))
    {
      if (!IsPublic(header))
      {
        continue;
      }
      EXPECT_EQ(ModuleOf(row), row.Folder) << header << " lies in a room";
      for (const std::string& include : Includes(header))
      {
        EXPECT_TRUE(Library(include).empty()) << header << " includes " << include;
        EXPECT_TRUE(include.rfind("vtk", 0) == 0 || include.find('.') == std::string::npos)
          << header << " includes " << include;
      }
    }
  }
}

/// A room may include a public header of its module only if that class includes no room itself.
TEST(PublicHeaders, ThatRoomsUseIncludeNoRoom)
{
  for (const Row& row : Table)
  {
    for (const std::string& header : row.Folders)
    {
      if (!IsPublic(header))
      {
        continue;
      }
      const std::string module = ModuleOf(row);
      for (const char* extension : { ".h", ".cxx" })
      {
        const fs::path source = (Root / module / header).replace_extension(extension);
        for (const std::string& include : Includes(source))
        {
          const fs::path included = Included(source, include);
          EXPECT_TRUE(included.empty() || included.parent_path() == Root / module ||
            included.string().rfind((Root / module).string() + "/", 0) != 0)
            << source << " includes " << include;
        }
      }
    }
  }
}

/// The modules whose private headers the tests of a module may include: those that the module may use.
Names ModulesOfTests(const std::string& module)
{
  Names modules = { module, "Testing/Comparison" };
  for (const Row& row : Table)
  {
    if (ModuleOf(row) != module)
    {
      continue;
    }
    for (const std::string& folder : row.Folders)
    {
      const Row* used = RowOf(Root / folder);
      modules.insert(used ? ModuleOf(*used) : module);
    }
  }
  return modules;
}

TEST(ModuleTests, IncludeTheirModuleAndReferencesOnly)
{
  const Names tests = HeadersOfTests({ "Testing/Comparison", "Benchmarks/Reference" });
  for (const Row& row : Table)
  {
    const fs::path folder = Root / row.Folder / "Testing";
    if (row.Folder == "Testing/Comparison" || !IsModule(row))
    {
      continue;
    }
    const Names allowed = ModulesOfTests(row.Folder);
    for (const fs::path& source : Sources(folder, true))
    {
      for (const std::string& include : Includes(source))
      {
        const fs::path included = Included(source, include);
        const Row* owner = included.empty() ? nullptr : RowOf(included.parent_path());
        EXPECT_TRUE(!owner || IsPublic(included) || allowed.count(ModuleOf(*owner)))
          << source << " includes " << include;
        EXPECT_TRUE(owner || !tests.count(fs::path(include).filename().string()) ||
          fs::exists(source.parent_path() / include))
          << source << " includes " << include;
      }
    }
  }
}

TEST(References, IncludeModulesOnly)
{
  const Names tests = HeadersOfTests({ "Testing/Comparison", "Benchmarks/Reference" });
  for (const fs::path& source : Sources(Root / "Benchmarks/Reference", true))
  {
    for (const std::string& include : Includes(source))
    {
      EXPECT_TRUE(!Included(source, include).empty() || !tests.count(include) ||
        fs::exists(source.parent_path() / include))
        << source << " includes " << include;
    }
  }
}

}
