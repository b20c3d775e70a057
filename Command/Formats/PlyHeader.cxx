// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyHeader.h"

#include "TextScanner.h"

#include <map>

namespace penumbra
{

namespace
{

/// Returns a VTK type; VTK_VOID: unknown.
int TypeOf(std::string_view name)
{
  static const std::map<std::string_view, int> types = { { "char", VTK_SIGNED_CHAR },
    { "int8", VTK_SIGNED_CHAR }, { "uchar", VTK_UNSIGNED_CHAR }, { "uint8", VTK_UNSIGNED_CHAR },
    { "short", VTK_SHORT }, { "int16", VTK_SHORT }, { "ushort", VTK_UNSIGNED_SHORT },
    { "uint16", VTK_UNSIGNED_SHORT }, { "int", VTK_INT }, { "int32", VTK_INT },
    { "uint", VTK_UNSIGNED_INT }, { "uint32", VTK_UNSIGNED_INT }, { "int64", VTK_LONG_LONG },
    { "long", VTK_LONG_LONG }, { "uint64", VTK_UNSIGNED_LONG_LONG },
    { "ulong", VTK_UNSIGNED_LONG_LONG }, { "float", VTK_FLOAT }, { "float32", VTK_FLOAT },
    { "double", VTK_DOUBLE }, { "float64", VTK_DOUBLE } };
  const auto found = types.find(name);
  return found == types.end() ? VTK_VOID : found->second;
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
  if (property.Name.empty() || header.Elements.empty() || property.Type == VTK_VOID ||
    (isList && property.Count == VTK_VOID) || property.Count == VTK_FLOAT ||
    property.Count == VTK_DOUBLE)
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
