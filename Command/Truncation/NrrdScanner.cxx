// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FormatScanners.h"

#include "FileCursor.h"
#include "Files/FileExtension.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

namespace penumbra
{

namespace
{

// More values than any file has, and few enough for the number of their bytes not to overflow.
constexpr long double MaximumValues = 1e18L;

int SizeOfNrrdType(std::string type)
{
  type.erase(std::remove(type.begin(), type.end(), ' '), type.end());
  for (const char* part : { "unsigned", "signed", "_t", "int" })
  {
    const std::size_t at = type.find(part);
    if (at != std::string::npos && type != "int")
    {
      type.erase(at, std::strlen(part));
    }
  }
  static const std::map<std::string, int> sizes = { { "char", 1 }, { "uchar", 1 }, { "8", 1 },
    { "u8", 1 }, { "short", 2 }, { "ushort", 2 }, { "16", 2 }, { "u16", 2 }, { "", 4 },
    { "int", 4 }, { "u", 4 }, { "32", 4 }, { "u32", 4 }, { "longlong", 8 }, { "ulonglong", 8 },
    { "64", 8 }, { "u64", 8 }, { "float", 4 }, { "double", 8 } };
  const auto size = sizes.find(type);
  if (size == sizes.end())
  {
    throw UnknownStructure();
  }
  return size->second;
}

}

void ScanNrrd(FileCursor& file, const std::string& path)
{
  std::map<std::string, std::string> fields;
  std::string line;
  bool ended = false;
  while (!ended && file.Line(line))
  {
    ended = line.empty();
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos && line[0] != '#')
    {
      std::string name = LowerCase(line.substr(0, colon));
      name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
      fields[name] = line.substr(colon + 2);
    }
  }
  const std::string data = fields["datafile"];
  if (!ended && data.empty())
  {
    throw TruncatedFile{ "line of the header" };
  }
  for (const char* needed : { "type", "dimension", "sizes", "encoding" })
  {
    if (fields[needed].empty())
    {
      throw TruncatedFile{ "line of the header" };
    }
  }
  long double values = 1.0;
  std::istringstream sizes(fields["sizes"]);
  for (long double size = 0.0; sizes >> size;)
  {
    values *= size;
  }
  const std::string encoding = LowerCase(fields["encoding"]);
  const bool text = encoding == "text" || encoding == "txt" || encoding == "ascii";
  if ((!text && encoding != "raw") || values < 0.0L)
  {
    throw UnknownStructure();
  }
  if (values > MaximumValues)
  {
    throw TruncatedFile{ "value" };
  }
  const auto scan = [&](FileCursor& body) {
    if (text)
    {
      body.SkipWords(static_cast<long long>(values), "value");
    }
    else
    {
      body.SkipBytes(values * SizeOfNrrdType(LowerCase(fields["type"])), "value");
    }
  };
  if (data.empty())
  {
    scan(file);
    return;
  }
  const std::string other = (std::filesystem::path(path).parent_path() / data).string();
  if (std::filesystem::is_regular_file(other))
  {
    FileCursor body(other);
    scan(body);
  }
}

}
