// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FormatScanners.h"

#include "FileCursor.h"
#include "Files/FileExtension.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>

namespace penumbra
{

namespace
{

// Returns the value after "key=" in a Tecplot header; empty if the key is missing.
std::string TecplotValue(const std::string& header, const std::string& key)
{
  for (std::size_t at = 0; (at = header.find(key, at)) != std::string::npos; ++at)
  {
    const bool begins = at == 0 || !std::isalpha(static_cast<unsigned char>(header[at - 1]));
    std::size_t after = header.find_first_not_of(' ', at + key.size());
    if (begins && after != std::string::npos && header[after] == '=')
    {
      after = header.find_first_not_of(' ', after + 1);
      return after == std::string::npos
        ? std::string()
        : header.substr(after, header.find_first_of(" ,\t\n", after) - after);
    }
  }
  return std::string();
}

long long TecplotCount(const std::string& header, const char* key, const char* other)
{
  std::string text = TecplotValue(header, key);
  text = text.empty() ? TecplotValue(header, other) : text;
  return text.empty() ? -1 : std::atoll(text.c_str());
}

bool BeginsNumber(const std::string& line)
{
  const std::size_t at = line.find_first_not_of(" \t+-.");
  return at != std::string::npos && std::isdigit(static_cast<unsigned char>(line[at]));
}

long long TecplotVariables(const std::string& header)
{
  const std::size_t at = header.find("variables");
  const std::size_t end =
    std::min({ header.find("zone", at), header.find("datasetauxdata", at), header.size() });
  if (at == std::string::npos)
  {
    throw UnknownStructure();
  }
  const std::string names = header.substr(at, end - at);
  const long long quotes = std::count(names.begin(), names.end(), '"');
  if (quotes > 0)
  {
    return quotes / 2;
  }
  std::string bare = names.substr(std::min(names.find('=') + 1, names.size()));
  std::replace(bare.begin(), bare.end(), ',', ' ');
  return CountWords(bare);
}

}

void ScanTecplot(FileCursor& file, const std::string&)
{
  std::string header;
  std::string line;
  while (file.Line(line) && !BeginsNumber(line))
  {
    header += line[0] == '#' ? "\n" : LowerCase(line) + "\n";
  }
  if (!BeginsNumber(line))
  {
    throw TruncatedFile{ "value" };
  }
  if (header.find("varsharelist") != std::string::npos ||
    header.find("connectivitysharezone") != std::string::npos ||
    header.find("cellcentered") != std::string::npos || header.find("zone") == std::string::npos)
  {
    throw UnknownStructure();
  }
  const long long variables = TecplotVariables(header);
  const std::string zone = header.substr(header.find("zone"));
  long long points = TecplotCount(zone, "nodes", "n");
  const long long elements = TecplotCount(zone, "elements", "e");
  long long corners = 0;
  if (points < 0)
  {
    points = std::max(1LL, TecplotCount(zone, "i", "imax")) *
      std::max(1LL, TecplotCount(zone, "j", "jmax")) *
      std::max(1LL, TecplotCount(zone, "k", "kmax"));
  }
  else
  {
    std::string type = TecplotValue(zone, "zonetype");
    type = type.empty() ? TecplotValue(zone, "et") : type;
    for (const auto& [name, count] : { std::pair<const char*, int>{ "triangle", 3 }, { "quad", 4 },
           { "tetra", 4 }, { "brick", 8 }, { "lineseg", 2 } })
    {
      corners = type.find(name) != std::string::npos ? count : corners;
    }
  }
  long long expected = variables * points + corners * std::max(0LL, elements);
  // "3*1.5" represents three values. Further zones are not checked.
  do
  {
    std::replace(line.begin(), line.end(), ',', ' ');
    if (!line.empty() && !BeginsNumber(line) && std::isalpha(static_cast<unsigned char>(line[0])))
    {
      return;
    }
    std::istringstream words(line);
    for (std::string word; words >> word;)
    {
      expected -= word.find('*') != std::string::npos ? std::atoll(word.c_str()) : 1;
    }
  }
  while (expected > 0 && file.Line(line));
  if (expected > 0)
  {
    throw TruncatedFile{ "value" };
  }
}

}
