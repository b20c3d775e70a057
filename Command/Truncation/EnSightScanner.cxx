// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FormatScanners.h"

#include "FileCursor.h"
#include "Files/FileExtension.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>

namespace penumbra
{

namespace
{

// Scanner of ASCII EnSight geometries: one value or one cell per line.
class EnSightScanner
{
public:
  EnSightScanner(FileCursor& file, bool gold)
    : File(file),
      Gold(gold)
  {
  }

  void Scan()
  {
    const std::string title = LowerCase(this->File.RequireLine("line"));
    if (title.find("binary") != std::string::npos)
    {
      throw UnknownStructure();
    }
    this->File.RequireLine("line");
    const bool nodeIds = this->HasIds();
    const bool cellIds = this->HasIds();
    int parts = 0;
    std::string line;
    while (!this->File.AtEnd() && this->File.Line(line))
    {
      line = LowerCase(line);
      if (line.rfind("part", 0) == 0)
      {
        ++parts;
        this->File.SkipLines(this->Gold ? 2 : 1, "part");
      }
      else if (line.rfind("extents", 0) == 0)
      {
        this->File.SkipLines(3, "part");
      }
      else if (line.rfind("coordinates", 0) == 0)
      {
        const long long count = this->CountOfLine();
        this->File.SkipLines(this->Gold ? (3 + (nodeIds ? 1 : 0)) * count : count, "coordinate");
      }
      else if (this->IsCell(line))
      {
        const long long count = this->CountOfLine();
        this->File.SkipLines(this->Gold && cellIds ? 2 * count : count, "cell");
      }
      else
      {
        if (this->File.AtEnd())
        {
          throw TruncatedFile{ "part" };
        }
        throw UnknownStructure();
      }
    }
    if (parts == 0)
    {
      throw TruncatedFile{ "part" };
    }
  }

private:
  bool HasIds()
  {
    const std::string line = LowerCase(this->File.RequireLine("line"));
    return line.find("given") != std::string::npos || line.find("ignore") != std::string::npos;
  }

  long long CountOfLine()
  {
    const std::string line = this->File.RequireLine("part");
    if (CountWords(line) != 1)
    {
      throw UnknownStructure();
    }
    return std::atoll(line.c_str());
  }

  static bool IsCell(const std::string& line)
  {
    static const char* types[] = { "point", "bar2", "bar3", "tria3", "tria6", "quad4", "quad8",
      "tetra4", "tetra10", "pyramid5", "pyramid13", "penta6", "penta15", "hexa8", "hexa20" };
    const std::string type = line.rfind("g_", 0) == 0 ? line.substr(2) : line;
    return std::find(std::begin(types), std::end(types), type) != std::end(types);
  }

  FileCursor& File;
  bool Gold;
};

}

void ScanEnSight(FileCursor& file, const std::string& path)
{
  bool gold = false;
  std::string line;
  std::string model;
  while (file.Line(line))
  {
    const std::string lower = LowerCase(line);
    gold = gold || (lower.rfind("type:", 0) == 0 && lower.find("gold") != std::string::npos);
    if (lower.rfind("model:", 0) == 0)
    {
      std::istringstream words(line.substr(6));
      for (std::string word; words >> word;)
      {
        model = word; // Time set and file set numbers precede it.
      }
    }
  }
  const std::string other = (std::filesystem::path(path).parent_path() / model).string();
  if (!model.empty() && std::filesystem::is_regular_file(other))
  {
    FileCursor geometry(other);
    EnSightScanner(geometry, gold).Scan();
  }
}

}
