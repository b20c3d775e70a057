// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyHeader.h"

#include "TextScanner.h"

#include <map>

namespace penumbra
{

namespace
{

PlyType TypeOf(std::string_view name)
{
  static const std::map<std::string_view, PlyType> types = { { "char", { 1, false, true } },
    { "int8", { 1, false, true } }, { "uchar", { 1, false, false } },
    { "uint8", { 1, false, false } }, { "short", { 2, false, true } },
    { "int16", { 2, false, true } }, { "ushort", { 2, false, false } },
    { "uint16", { 2, false, false } }, { "int", { 4, false, true } },
    { "int32", { 4, false, true } }, { "uint", { 4, false, false } },
    { "uint32", { 4, false, false } }, { "int64", { 8, false, true } },
    { "long", { 8, false, true } }, { "uint64", { 8, false, false } },
    { "ulong", { 8, false, false } }, { "float", { 4, true, true } },
    { "float32", { 4, true, true } }, { "double", { 8, true, true } },
    { "float64", { 8, true, true } } };
  const auto found = types.find(name);
  return found == types.end() ? PlyType() : found->second;
}

bool ParseElement(TextScanner& line, PlyHeader& header)
{
  PlyElement element;
  element.Name = line.WordInLine();
  header.Elements.push_back(element);
  long long& count = header.Elements.back().Count;
  return ParseInteger(line.WordInLine(), count) && count >= 0;
}

bool ParseProperty(TextScanner& line, PlyHeader& header)
{
  PlyProperty property;
  std::string_view type = line.WordInLine();
  const bool isList = type == "list";
  if (isList)
  {
    property.Count = TypeOf(line.WordInLine());
    type = line.WordInLine();
  }
  property.Type = TypeOf(type);
  property.Name = line.WordInLine();
  if (property.Name.empty() || header.Elements.empty() || property.Type.Size == 0 ||
    (isList && property.Count.Size == 0) || property.Count.IsFloat)
  {
    return false;
  }
  header.Elements.back().Properties.push_back(property);
  return true;
}

bool ParseFormat(TextScanner& line, PlyHeader& header)
{
  const std::string_view format = line.WordInLine();
  header.IsAscii = format == "ascii";
  header.IsBigEndian = format == "binary_big_endian";
  return header.IsAscii || header.IsBigEndian || format == "binary_little_endian";
}

}

bool ParsePlyHeader(const char* begin, const char* end, PlyHeader& header)
{
  TextScanner text(begin, end);
  if (text.WordInLine() != "ply")
  {
    return false;
  }
  text.Line();
  bool valid = false;
  while (!text.AtEnd())
  {
    const std::string_view keyword = text.WordInLine();
    if (keyword == "end_header")
    {
      text.Line();
      header.Size = static_cast<std::size_t>(text.Rest() - begin);
      return valid;
    }
    if (keyword == "format")
    {
      valid = ParseFormat(text, header);
    }
    if ((keyword == "element" && !ParseElement(text, header)) ||
      (keyword == "property" && !ParseProperty(text, header)))
    {
      return false;
    }
    text.Line();
  }
  return false;
}

}
