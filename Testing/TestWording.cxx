// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Rejects words that Documentation/dev/Style.md replaces: reads Testing/wording.txt and searches sources,
// shaders, scripts and documentation.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;

const fs::path Root = PENUMBRA_SOURCE_DIR;

struct Rule
{
  std::string Words;
  std::string Suggestion;
};

std::regex WholeWords(const std::string& words)
{
  return std::regex("\\b(" + words + ")\\b", std::regex::icase | std::regex::optimize);
}

/// One expression for all rules, because most lines match none.
std::regex AnyOf(const std::vector<Rule>& rules)
{
  std::string words;
  for (const Rule& rule : rules)
  {
    words += (words.empty() ? "" : "|") + rule.Words;
  }
  return WholeWords(words);
}

std::vector<Rule> ReadRules()
{
  std::vector<Rule> rules;
  std::ifstream file(Root / "Testing/wording.txt");
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t tab = line.find('\t');
    if (line.rfind("#", 0) != 0 && tab != std::string::npos)
    {
      rules.push_back({ line.substr(0, tab), line.substr(tab + 1) });
    }
  }
  return rules;
}

/// If true, the file is searched. The style page and the changelog quote the words; results and data
/// are not prose.
bool IsSearched(const fs::path& file)
{
  static const std::set<std::string> extensions = { ".cmake", ".cxx", ".glsl", ".h", ".md", ".py",
    ".xml" };
  const std::string path = file.lexically_relative(Root).generic_string();
  return (extensions.count(file.extension().string()) || file.filename() == "CMakeLists.txt" ||
           path == "penumbra" || path == "Testing/run-suites") &&
    path != "Documentation/dev/Style.md" && path != "CHANGELOG.md" &&
    path.rfind("Benchmarks/results/", 0) != 0;
}

std::vector<fs::path> SearchedFiles()
{
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(Root))
  {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && IsSearched(entry.path()))
    {
      files.push_back(entry.path());
    }
    else if (entry.is_directory() && name != "build" && name != "Data" && name.front() != '.')
    {
      for (const fs::directory_entry& below : fs::recursive_directory_iterator(entry.path()))
      {
        if (below.is_regular_file() && IsSearched(below.path()))
        {
          files.push_back(below.path());
        }
      }
    }
  }
  return files;
}

TEST(Wording, UsesTheTermsOfTheStylePage)
{
  const std::vector<Rule> rules = ReadRules();
  ASSERT_FALSE(rules.empty());
  const std::regex any = AnyOf(rules);
  int searched = 0;
  for (const fs::path& path : SearchedFiles())
  {
    std::ifstream file(path);
    int number = 0;
    for (std::string line; std::getline(file, line);)
    {
      ++number;
      if (!std::regex_search(line, any))
      {
        continue;
      }
      for (const Rule& rule : rules)
      {
        std::smatch match;
        EXPECT_FALSE(std::regex_search(line, match, WholeWords(rule.Words)))
          << path.lexically_relative(Root).generic_string() << ":" << number << ": \""
          << match.str() << "\"; write: " << rule.Suggestion;
      }
    }
    ++searched;
  }
  EXPECT_GT(searched, 500);
}

}
