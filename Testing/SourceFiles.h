// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The sources of the repository as text, for the tests that read them.
#ifndef penumbra_SourceFiles_h
#define penumbra_SourceFiles_h

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace penumbra_testing
{

namespace fs = std::filesystem;
using Names = std::set<std::string>;

inline const fs::path Root = PENUMBRA_SOURCE_DIR;

inline std::string Text(const fs::path& path)
{
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Returns the sources in a folder, with those of its subfolders if `below` is true.
inline std::vector<fs::path> Sources(const fs::path& folder, bool below)
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

inline Names Includes(const fs::path& source)
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

}
#endif
