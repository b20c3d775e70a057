// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FormatScanners.h"

#include "FileCursor.h"
#include "Files/FileExtension.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>

namespace penumbra
{

namespace
{

// Scanner of legacy VTK files.
class LegacyVTKScanner
{
public:
  explicit LegacyVTKScanner(FileCursor& cursor)
    : File(cursor)
  {
  }

  void Scan()
  {
    const std::string version = this->File.RequireLine("line");
    const std::size_t number = version.find_last_of(' ');
    this->Offsets = number != std::string::npos && std::atof(version.c_str() + number) >= 5.0;
    this->File.RequireLine("line");
    const std::string coding = LowerCase(this->File.Word());
    this->Binary = coding == "binary";
    if (!this->Binary && coding != "ascii")
    {
      this->Stop();
    }
    std::string needed = "dataset";
    while (!this->File.AtEnd())
    {
      const std::string word = LowerCase(this->File.Word());
      this->Section(word, needed);
    }
    if (!needed.empty())
    {
      throw TruncatedFile{ "section" };
    }
  }

private:
  // Throws for an unknown word: it may be truncated, or the structure is unknown.
  [[noreturn]] void Stop()
  {
    if (this->File.Left() == 0)
    {
      throw TruncatedFile{ "section" };
    }
    throw UnknownStructure();
  }

  void Values(long double count, const std::string& type)
  {
    static const std::map<std::string, int> sizes = { { "bit", 0 }, { "char", 1 },
      { "signed_char", 1 }, { "unsigned_char", 1 }, { "short", 2 }, { "unsigned_short", 2 },
      { "int", 4 }, { "unsigned_int", 4 }, { "long", 8 }, { "unsigned_long", 8 },
      { "vtktypeint64", 8 }, { "vtktypeuint64", 8 }, { "vtkidtype", 4 }, { "float", 4 },
      { "double", 8 } };
    const auto size = sizes.find(LowerCase(type));
    if (size == sizes.end())
    {
      this->Stop();
    }
    if (!this->Binary)
    {
      this->File.SkipWords(static_cast<long long>(std::min(count, 9e18L)), "value");
      return;
    }
    std::string rest;
    this->File.Line(rest);
    this->File.SkipBytes(size->second == 0
        ? static_cast<long double>((static_cast<long long>(count) + 7) / 8)
        : count * size->second,
      "value");
  }

  void Cells(long long cells, long long size)
  {
    if (!this->Offsets)
    {
      this->Values(size, "int");
      return;
    }
    for (const auto& [part, count] : { std::pair<const char*, long long>{ "offsets", cells },
           std::pair<const char*, long long>{ "connectivity", size } })
    {
      if (LowerCase(this->File.Word()) != part)
      {
        this->Stop();
      }
      this->Values(count, this->File.Word());
    }
  }

  void Metadata()
  {
    std::string line;
    this->File.Line(line);
    do
    {
      line = this->File.RequireLine("line");
    }
    while (!line.empty());
  }

  void Field()
  {
    this->File.Word();
    long long arrays = this->File.Count("section");
    for (; arrays > 0; --arrays)
    {
      if (this->File.Peek() == "metadata")
      {
        this->File.Word();
        this->Metadata();
      }
      const std::string name = this->File.Word();
      if (LowerCase(name) == "null_array")
      {
        continue;
      }
      const long long components = this->File.Count("array");
      const long long tuples = this->File.Count("array");
      this->Values(static_cast<long double>(components) * tuples, this->File.Word());
    }
  }

  void Scalars()
  {
    this->File.Word();
    const std::string type = this->File.Word();
    std::string rest;
    this->File.Line(rest);
    const int components = std::max(1, std::atoi(rest.c_str()));
    if (LowerCase(this->File.Word()) != "lookup_table")
    {
      this->Stop();
    }
    this->File.Word();
    this->Values(static_cast<long double>(components) * this->Tuples, type);
  }

  void Dataset(std::string& needed)
  {
    static const std::map<std::string, std::string> sections = { { "polydata", "points" },
      { "unstructured_grid", "points" }, { "structured_grid", "points" },
      { "rectilinear_grid", "z_coordinates" }, { "structured_points", "dimensions" } };
    const auto section = sections.find(LowerCase(this->File.Word()));
    if (section == sections.end())
    {
      this->Stop();
    }
    needed = section->second;
  }

  void Section(const std::string& word, std::string& needed)
  {
    static const std::map<std::string, int> words = { { "dimensions", 3 }, { "spacing", 3 },
      { "aspect_ratio", 3 }, { "origin", 3 }, { "extent", 6 } };
    static const std::map<std::string, int> tuples = { { "vectors", 3 }, { "normals", 3 },
      { "tensors", 9 }, { "tensors6", 6 }, { "global_ids", 1 }, { "pedigree_ids", 1 },
      { "edge_flags", 1 } };
    if (word == needed || needed == "array")
    {
      needed.clear();
    }
    if (word == "dataset")
    {
      this->Dataset(needed);
    }
    else if (words.count(word))
    {
      this->File.SkipWords(words.at(word), "line");
    }
    else if (tuples.count(word))
    {
      this->File.Word();
      const long double count = static_cast<long double>(tuples.at(word)) * this->Tuples;
      this->Values(count, this->File.Word());
    }
    else if (word == "points")
    {
      const long double count = 3.0L * this->File.Count("section");
      this->Values(count, this->File.Word());
    }
    else if (word.size() == 13 && word.compare(1, 12, "_coordinates") == 0)
    {
      const long long count = this->File.Count("section");
      this->Values(count, this->File.Word());
    }
    else if (word == "vertices" || word == "lines" || word == "polygons" ||
      word == "triangle_strips" || word == "cells")
    {
      const long long cells = this->File.Count("section");
      this->Cells(cells, this->File.Count("section"));
      needed = word == "cells" ? "cell_types" : needed;
    }
    else if (word == "cell_types")
    {
      this->Values(this->File.Count("section"), "int");
    }
    else if (word == "point_data" || word == "cell_data")
    {
      this->Tuples = this->File.Count("section");
      needed = "array";
    }
    else if (word == "scalars")
    {
      this->Scalars();
    }
    else if (word == "color_scalars")
    {
      this->File.Word();
      const long double components = this->File.Count("section");
      this->Values(components * this->Tuples, "unsigned_char");
    }
    else if (word == "lookup_table")
    {
      this->File.Word();
      this->Values(4.0L * this->File.Count("section"), "unsigned_char");
    }
    else if (word == "texture_coordinates")
    {
      this->File.Word();
      const long double components = this->File.Count("section");
      this->Values(components * this->Tuples, this->File.Word());
    }
    else if (word == "field")
    {
      this->Field();
    }
    else if (word == "metadata")
    {
      this->Metadata();
    }
    else
    {
      this->Stop();
    }
  }

  FileCursor& File;
  bool Binary = false;
  bool Offsets = false;
  long long Tuples = 0;
};

}

void ScanLegacyVTK(FileCursor& file, const std::string&)
{
  LegacyVTKScanner(file).Scan();
}

}
