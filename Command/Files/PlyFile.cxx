// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyFile.h"

#include "MappedFile.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <sstream>
#include <vector>

namespace penumbra
{

namespace
{

struct Property
{
  int CountSize = 0; ///< bytes of the length of a list; 0: a single value
  int Size = 0;      ///< bytes of a value
  std::string Name;
};

struct Element
{
  std::string Name;
  long long Count = 0;
  std::vector<Property> Properties;
};

struct Header
{
  bool Valid = false;
  std::string Format;
  std::vector<Element> Elements;
  std::size_t Size = 0;
};

int SizeOf(const std::string& type)
{
  static const std::map<std::string, int> sizes = { { "char", 1 }, { "uchar", 1 }, { "int8", 1 },
    { "uint8", 1 }, { "short", 2 }, { "ushort", 2 }, { "int16", 2 }, { "uint16", 2 }, { "int", 4 },
    { "uint", 4 }, { "int32", 4 }, { "uint32", 4 }, { "float", 4 }, { "float32", 4 },
    { "double", 8 }, { "float64", 8 } };
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

bool ParseLine(const std::string& line, Header& header)
{
  std::istringstream words(line);
  std::string word;
  words >> word;
  if (word == "format")
  {
    words >> header.Format;
  }
  else if (word == "element")
  {
    Element element;
    words >> element.Name >> element.Count;
    header.Elements.push_back(element);
    return !words.fail() && element.Count >= 0;
  }
  else if (word == "property")
  {
    Property property;
    std::string type;
    words >> type;
    const bool isList = type == "list";
    if (isList)
    {
      words >> type;
      property.CountSize = SizeOf(type);
      words >> type;
    }
    property.Size = SizeOf(type);
    words >> property.Name;
    if (words.fail() || header.Elements.empty() || property.Size == 0 ||
      (isList && property.CountSize == 0))
    {
      return false;
    }
    header.Elements.back().Properties.push_back(property);
  }
  return true;
}

Header ParseHeader(const char* begin, const char* end)
{
  Header header;
  const char* line = begin;
  for (int number = 0; line < end; ++number)
  {
    const char* lineEnd = std::find(line, end, '\n');
    std::string text(line, lineEnd);
    text.erase(text.find_last_not_of(" \t\r") + 1);
    line = lineEnd == end ? end : lineEnd + 1;
    if (text == "end_header")
    {
      header.Valid = !header.Format.empty();
      header.Size = static_cast<std::size_t>(line - begin);
      return header;
    }
    if ((number == 0 && text != "ply") || !ParseLine(text, header))
    {
      return header;
    }
  }
  return header;
}

// Scans the values of the body.
class Body
{
public:
  Body(const char* begin, const char* end, const std::string& format)
    : At(begin),
      End(end),
      Ascii(format == "ascii"),
      BigEndian(format == "binary_big_endian")
  {
  }

  bool Skip(int size, long long count)
  {
    if (!this->Ascii)
    {
      const long long bytes = count * size;
      const bool enough = bytes <= this->End - this->At;
      this->At += enough ? bytes : 0;
      return enough;
    }
    std::string word;
    for (; count > 0; --count)
    {
      if (!this->NextWord(word))
      {
        return false;
      }
    }
    return true;
  }

  bool ReadCount(int size, long long& count)
  {
    std::string bytes;
    if (this->Ascii)
    {
      const bool found = this->NextWord(bytes);
      count = found ? std::atoll(bytes.c_str()) : 0;
      return found && count >= 0;
    }
    bytes.assign(this->At, std::min<const char*>(this->At + size, this->End));
    if (this->BigEndian)
    {
      std::reverse(bytes.begin(), bytes.end());
    }
    count = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
    {
      count |= static_cast<long long>(static_cast<unsigned char>(bytes[i])) << 8 * i;
    }
    return this->Skip(size, 1);
  }

private:
  bool NextWord(std::string& word)
  {
    const auto isSpace = [](char character) {
      return character == ' ' || character == '\n' || character == '\r' || character == '\t';
    };
    const char* begin = std::find_if_not(this->At, this->End, isSpace);
    this->At = std::find_if(begin, this->End, isSpace);
    word.assign(begin, this->At);
    return begin != this->End;
  }

  const char* At;
  const char* End;
  bool Ascii;
  bool BigEndian;
};

bool WalkElement(const Element& element, Body& body, PlyFile& file)
{
  const auto isList = [](const Property& property) { return property.CountSize > 0; };
  if (std::none_of(element.Properties.begin(), element.Properties.end(), isList))
  {
    return std::all_of(element.Properties.begin(), element.Properties.end(),
      [&](const Property& property) { return body.Skip(property.Size, element.Count); });
  }
  for (long long i = 0; i < element.Count; ++i)
  {
    for (const Property& property : element.Properties)
    {
      long long values = 1;
      if (isList(property) && !body.ReadCount(property.CountSize, values))
      {
        return false;
      }
      if (!body.Skip(property.Size, values))
      {
        return false;
      }
      const bool isFace = element.Name == "face" && property.Name.rfind("vertex_ind", 0) == 0;
      file.Polygons += isFace;
      file.Corners += isFace ? values : 0;
    }
  }
  return true;
}

PlyFile Walk(const char* begin, const char* end)
{
  PlyFile file;
  const Header header = ParseHeader(begin, end);
  file.IsPly = header.Valid;
  file.IsWhole = header.Valid;
  Body body(begin + header.Size, end, header.Format);
  for (const Element& element : header.Elements)
  {
    file.IsWhole = file.IsWhole && WalkElement(element, body, file);
  }
  return file;
}

}

PlyFile WalkPlyFile(const std::string& path)
{
  const MappedFile file(path);
  return file.Size() > 0 ? Walk(file.Begin(), file.End()) : PlyFile();
}

}
