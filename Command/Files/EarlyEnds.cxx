// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EarlyEnds.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace penumbra
{

namespace
{

std::string Lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char letter) { return std::tolower(letter); });
  return text;
}

bool IsSpace(char character)
{
  return std::isspace(static_cast<unsigned char>(character)) != 0;
}

/// Thrown if the file is truncated, and if its structure is unknown.
struct EarlyEnd
{
  const char* Last;
};
struct Unknown
{
};

/// Forward reader of a memory-mapped file.
class Cursor
{
public:
  explicit Cursor(const std::string& path)
  {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status = {};
    if (file >= 0 && fstat(file, &status) == 0 && status.st_size > 0)
    {
      this->Size = static_cast<std::size_t>(status.st_size);
      this->Map = mmap(nullptr, this->Size, PROT_READ, MAP_PRIVATE, file, 0);
    }
    if (file >= 0)
    {
      close(file);
    }
    if (this->Map == MAP_FAILED)
    {
      throw Unknown();
    }
    this->At = static_cast<const char*>(this->Map);
    this->End = this->At + this->Size;
  }
  ~Cursor() { munmap(this->Map, this->Size); }

  Cursor(const Cursor&) = delete;
  void operator=(const Cursor&) = delete;

  bool AtEnd()
  {
    this->At = std::find_if_not(this->At, this->End, IsSpace);
    return this->At == this->End;
  }

  /// Returns the next word; empty at the end.
  std::string Word()
  {
    this->AtEnd();
    const char* begin = this->At;
    this->At = std::find_if(begin, this->End, IsSpace);
    return std::string(begin, this->At);
  }

  std::string Peek()
  {
    const char* before = this->At;
    const std::string word = Lower(this->Word());
    this->At = before;
    return word;
  }

  /// Gets the rest of the line; returns false at the end of the file.
  bool Line(std::string& line)
  {
    if (this->At == this->End)
    {
      return false;
    }
    const char* end = std::find(this->At, this->End, '\n');
    line.assign(this->At, end);
    this->At = end == this->End ? end : end + 1;
    line.erase(line.find_last_not_of(" \t\r") + 1);
    return true;
  }

  std::string RequireLine(const char* last)
  {
    std::string line;
    if (!this->Line(line))
    {
      throw EarlyEnd{ last };
    }
    return line;
  }

  long long Count(const char* last)
  {
    const std::string word = this->Word();
    if (word.empty())
    {
      throw EarlyEnd{ last };
    }
    char* end = nullptr;
    const long long count = std::strtoll(word.c_str(), &end, 10);
    if (*end || count < 0)
    {
      throw Unknown();
    }
    return count;
  }

  void SkipWords(long long count, const char* last)
  {
    for (; count > 0; --count)
    {
      if (this->AtEnd())
      {
        throw EarlyEnd{ last };
      }
      this->At = std::find_if(this->At, this->End, IsSpace);
    }
  }

  void SkipLines(long long count, const char* last)
  {
    for (; count > 0; --count)
    {
      if (this->At == this->End)
      {
        throw EarlyEnd{ last };
      }
      this->At = std::find(this->At, this->End, '\n');
      this->At += this->At != this->End;
    }
  }

  void SkipBytes(long double count, const char* last)
  {
    if (count > static_cast<long double>(this->End - this->At))
    {
      throw EarlyEnd{ last };
    }
    this->At += static_cast<std::ptrdiff_t>(count);
  }

  const char* Rest() const { return this->At; }
  std::size_t Left() const { return static_cast<std::size_t>(this->End - this->At); }

private:
  void* Map = MAP_FAILED;
  std::size_t Size = 0;
  const char* At = nullptr;
  const char* End = nullptr;
};

// Scanner of legacy VTK files.
class LegacyWalk
{
public:
  explicit LegacyWalk(Cursor& cursor)
    : File(cursor)
  {
  }

  void Walk()
  {
    const std::string version = this->File.RequireLine("line");
    const std::size_t number = version.find_last_of(' ');
    this->Offsets = number != std::string::npos && std::atof(version.c_str() + number) >= 5.0;
    this->File.RequireLine("line");
    const std::string coding = Lower(this->File.Word());
    this->Binary = coding == "binary";
    if (!this->Binary && coding != "ascii")
    {
      this->Stop();
    }
    std::string needed = "dataset";
    while (!this->File.AtEnd())
    {
      const std::string word = Lower(this->File.Word());
      this->Section(word, needed);
    }
    if (!needed.empty())
    {
      throw EarlyEnd{ "section" };
    }
  }

private:
  // Throws for an unknown word: it may be truncated, or the structure is unknown.
  [[noreturn]] void Stop()
  {
    if (this->File.Left() == 0)
    {
      throw EarlyEnd{ "section" };
    }
    throw Unknown();
  }

  void Values(long double count, const std::string& type)
  {
    static const std::map<std::string, int> sizes = { { "bit", 0 }, { "char", 1 },
      { "signed_char", 1 }, { "unsigned_char", 1 }, { "short", 2 }, { "unsigned_short", 2 },
      { "int", 4 }, { "unsigned_int", 4 }, { "long", 8 }, { "unsigned_long", 8 },
      { "vtktypeint64", 8 }, { "vtktypeuint64", 8 }, { "vtkidtype", 4 }, { "float", 4 },
      { "double", 8 } };
    const auto size = sizes.find(Lower(type));
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
      if (Lower(this->File.Word()) != part)
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
      if (Lower(name) == "null_array")
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
    if (Lower(this->File.Word()) != "lookup_table")
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
    const auto section = sections.find(Lower(this->File.Word()));
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

  Cursor& File;
  bool Binary = false;
  bool Offsets = false;
  long long Tuples = 0;
};

int CountWords(const std::string& line)
{
  std::istringstream words(line);
  int count = 0;
  for (std::string word; words >> word;)
  {
    ++count;
  }
  return count;
}

// PTS: an optional line with the number of points, then one point per line.
void WalkPts(Cursor& file)
{
  std::string line;
  long long announced = -1;
  long long lines = 0;
  int columns = 0;
  while (file.Line(line))
  {
    const int words = CountWords(line);
    if (words == 0 || line[0] == '#')
    {
      continue;
    }
    if (words == 1 && lines == 0 && announced < 0)
    {
      announced = std::atoll(line.c_str());
      continue;
    }
    columns = lines == 0 ? words : columns;
    if (words < columns && file.AtEnd())
    {
      throw EarlyEnd{ "point" };
    }
    ++lines;
  }
  if (lines < announced || lines == 0)
  {
    throw EarlyEnd{ "point" };
  }
}

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
    throw Unknown();
  }
  return size->second;
}

void WalkNrrd(Cursor& file, const std::string& path)
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
      std::string name = Lower(line.substr(0, colon));
      name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
      fields[name] = line.substr(colon + 2);
    }
  }
  const std::string data = fields["datafile"];
  if (!ended && data.empty())
  {
    throw EarlyEnd{ "line of the header" };
  }
  for (const char* needed : { "type", "dimension", "sizes", "encoding" })
  {
    if (fields[needed].empty())
    {
      throw EarlyEnd{ "line of the header" };
    }
  }
  long double values = 1.0;
  std::istringstream sizes(fields["sizes"]);
  for (long double size = 0.0; sizes >> size;)
  {
    values *= size;
  }
  const std::string encoding = Lower(fields["encoding"]);
  const bool text = encoding == "text" || encoding == "txt" || encoding == "ascii";
  if ((!text && encoding != "raw") || values > 1e18L)
  {
    throw Unknown();
  }
  const auto walk = [&](Cursor& body) {
    if (text)
    {
      body.SkipWords(static_cast<long long>(values), "value");
    }
    else
    {
      body.SkipBytes(values * SizeOfNrrdType(Lower(fields["type"])), "value");
    }
  };
  if (data.empty())
  {
    walk(file);
    return;
  }
  const std::string other = (std::filesystem::path(path).parent_path() / data).string();
  if (std::filesystem::is_regular_file(other))
  {
    Cursor body(other);
    walk(body);
  }
}

// AVS: a header of five counts, nodes, cells, values of nodes, values of cells.
void WalkUcd(Cursor& file)
{
  if (*file.Rest() == 7)
  {
    std::uint32_t counts[6];
    if (file.Left() < 1 + sizeof(counts))
    {
      throw EarlyEnd{ "value" };
    }
    std::memcpy(counts, file.Rest() + 1, sizeof(counts));
    if (counts[0] > 0x00ffffffu || counts[1] > 0x00ffffffu)
    {
      for (std::uint32_t& count : counts)
      {
        count = __builtin_bswap32(count);
      }
    }
    file.SkipBytes(1.0L + sizeof(counts) + 16.0L * counts[1] + 4.0L * counts[5] +
        12.0L * counts[0] + 4.0L * counts[0] * counts[2] + 4.0L * counts[1] * counts[3],
      "value");
    return;
  }
  while (file.Peek().rfind('#', 0) == 0)
  {
    file.SkipLines(1, "line");
  }
  const long long nodes = file.Count("line");
  const long long cells = file.Count("line");
  const long long values[2] = { file.Count("line"), file.Count("line") };
  file.Count("line");
  file.SkipWords(4 * nodes, "node");
  static const std::map<std::string, int> corners = { { "pt", 1 }, { "line", 2 }, { "tri", 3 },
    { "quad", 4 }, { "tet", 4 }, { "pyr", 5 }, { "prism", 6 }, { "hex", 8 } };
  for (long long cell = 0; cell < cells; ++cell)
  {
    file.SkipWords(2, "cell");
    const std::string type = Lower(file.Word());
    if (!corners.count(type))
    {
      if (file.AtEnd())
      {
        throw EarlyEnd{ "cell" };
      }
      throw Unknown();
    }
    file.SkipWords(corners.at(type), "cell");
  }
  for (const int kind : { 0, 1 })
  {
    if (values[kind] == 0)
    {
      continue;
    }
    const long long components = file.Count("value");
    long long width = 0;
    for (long long i = 0; i < components; ++i)
    {
      width += file.Count("value");
    }
    file.SkipLines(1 + components, "value");
    file.SkipWords((kind == 0 ? nodes : cells) * (1 + width), "value");
  }
}

// SLC: counts and sizes as text, the compression, an icon with three channels, then slices.
void WalkSlc(Cursor& file)
{
  file.Count("line of the header");
  long double plane = static_cast<long double>(file.Count("line of the header"));
  plane *= file.Count("line of the header");
  const long long slices = file.Count("line of the header");
  file.SkipWords(7, "line of the header");
  const long long coding = file.Count("line of the header");
  long double icon = static_cast<long double>(file.Count("line of the header"));
  // The letter X may touch the count before it.
  const auto countBeforeX = [&file]() {
    std::string digits;
    file.AtEnd();
    while (file.Left() > 0 && std::isdigit(static_cast<unsigned char>(*file.Rest())))
    {
      digits += *file.Rest();
      file.SkipBytes(1, "slice");
    }
    if (file.AtEnd())
    {
      throw EarlyEnd{ "slice" };
    }
    if (digits.empty() || *file.Rest() != 'X')
    {
      throw Unknown();
    }
    file.SkipBytes(1, "slice");
    return std::strtold(digits.c_str(), nullptr);
  };
  icon *= countBeforeX();
  file.SkipBytes(3 * icon, "slice");
  if (coding == 0)
  {
    file.SkipBytes(plane * slices, "slice");
  }
  for (long long slice = 0; coding == 1 && slice < slices; ++slice)
  {
    const long double bytes = countBeforeX();
    file.SkipBytes(bytes, "slice");
  }
}

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
    throw Unknown();
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

void WalkTecplot(Cursor& file)
{
  std::string header;
  std::string line;
  while (file.Line(line) && !BeginsNumber(line))
  {
    header += line[0] == '#' ? "\n" : Lower(line) + "\n";
  }
  if (!BeginsNumber(line))
  {
    throw EarlyEnd{ "value" };
  }
  if (header.find("varsharelist") != std::string::npos ||
    header.find("connectivitysharezone") != std::string::npos ||
    header.find("cellcentered") != std::string::npos || header.find("zone") == std::string::npos)
  {
    throw Unknown();
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
    throw EarlyEnd{ "value" };
  }
}

// Scanner of ASCII EnSight geometries: one value or one cell per line.
class EnSightWalk
{
public:
  EnSightWalk(Cursor& file, bool gold)
    : File(file),
      Gold(gold)
  {
  }

  void Walk()
  {
    const std::string title = Lower(this->File.RequireLine("line"));
    if (title.find("binary") != std::string::npos)
    {
      throw Unknown();
    }
    this->File.RequireLine("line");
    const bool nodeIds = this->HasIds();
    const bool cellIds = this->HasIds();
    int parts = 0;
    std::string line;
    while (!this->File.AtEnd() && this->File.Line(line))
    {
      line = Lower(line);
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
          throw EarlyEnd{ "part" };
        }
        throw Unknown();
      }
    }
    if (parts == 0)
    {
      throw EarlyEnd{ "part" };
    }
  }

private:
  bool HasIds()
  {
    const std::string line = Lower(this->File.RequireLine("line"));
    return line.find("given") != std::string::npos || line.find("ignore") != std::string::npos;
  }

  long long CountOfLine()
  {
    const std::string line = this->File.RequireLine("part");
    if (CountWords(line) != 1)
    {
      throw Unknown();
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

  Cursor& File;
  bool Gold;
};

void WalkCase(Cursor& file, const std::string& path)
{
  bool gold = false;
  std::string line;
  std::string model;
  while (file.Line(line))
  {
    const std::string lower = Lower(line);
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
    Cursor geometry(other);
    EnSightWalk(geometry, gold).Walk();
  }
}

void Walk(const std::string& path)
{
  const std::string extension = Lower(std::filesystem::path(path).extension().string());
  const char* known[] = { ".vtk", ".pts", ".nrrd", ".nhdr", ".inp", ".slc", ".tec", ".tp", ".case",
    ".encas" };
  if (std::find(std::begin(known), std::end(known), extension) == std::end(known))
  {
    return;
  }
  Cursor file(path);
  if (extension == ".vtk")
  {
    LegacyWalk(file).Walk();
  }
  else if (extension == ".pts")
  {
    WalkPts(file);
  }
  else if (extension == ".nrrd" || extension == ".nhdr")
  {
    WalkNrrd(file, path);
  }
  else if (extension == ".inp")
  {
    WalkUcd(file);
  }
  else if (extension == ".slc")
  {
    WalkSlc(file);
  }
  else if (extension == ".tec" || extension == ".tp")
  {
    WalkTecplot(file);
  }
  else
  {
    WalkCase(file, path);
  }
}

}

bool IsWholeTiff(const std::string& path)
try
{
  Cursor file(path);
  const char* begin = file.Rest();
  const std::uint64_t size = file.Left();
  const auto number = [&](std::uint64_t at, int bytes) {
    std::uint64_t value = 0;
    if (at > size || size - at < static_cast<std::uint64_t>(bytes))
    {
      throw EarlyEnd{ "strip" };
    }
    std::memcpy(&value, begin + at, bytes);
    return value;
  };
  const std::uint64_t directory = number(4, 4);
  const std::uint64_t entries = directory < 8 ? 0 : number(directory, 2);
  std::vector<std::uint64_t> starts;
  std::vector<std::uint64_t> lengths;
  static const int sizes[] = { 1, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8 };
  for (std::uint64_t i = 0; i < entries; ++i)
  {
    const std::uint64_t entry = directory + 2 + 12 * i;
    const std::uint64_t tag = number(entry, 2);
    const int width = sizes[std::min<std::uint64_t>(number(entry + 2, 2), 12)];
    const std::uint64_t count = number(entry + 4, 4);
    const std::uint64_t values = count * width <= 4 ? entry + 8 : number(entry + 8, 4);
    number(values + count * width - width, width);
    for (std::uint64_t k = 0; (tag == 273 || tag == 279) && k < count; ++k)
    {
      (tag == 273 ? starts : lengths).push_back(number(values + k * width, width));
    }
  }
  for (std::size_t i = 0; i < starts.size() && i < lengths.size(); ++i)
  {
    if (starts[i] < 8 || lengths[i] == 0 || starts[i] + lengths[i] > size)
    {
      return false;
    }
  }
  return !starts.empty() && starts.size() == lengths.size();
}
catch (const EarlyEnd&)
{
  return false;
}
catch (const Unknown&)
{
  return false;
}

std::string FindEarlyEnd(const std::string& path)
{
  try
  {
    Walk(path);
  }
  catch (const EarlyEnd& end)
  {
    return end.Last;
  }
  catch (const Unknown&)
  {
    // The reader reports errors of unknown structures.
  }
  return std::string();
}

}
