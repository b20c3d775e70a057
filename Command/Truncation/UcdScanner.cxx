// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FormatScanners.h"

#include "FileCursor.h"
#include "Files/FileExtension.h"

#include <cstdint>
#include <cstring>
#include <map>
#include <string>

namespace penumbra
{

// AVS: a header of five counts, nodes, cells, values of nodes, values of cells.
void ScanUcd(FileCursor& file, const std::string&)
{
  if (*file.Rest() == 7)
  {
    std::uint32_t counts[6];
    if (file.Left() < 1 + sizeof(counts))
    {
      throw TruncatedFile{ "value" };
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
    const std::string type = LowerCase(file.Word());
    if (!corners.count(type))
    {
      if (file.AtEnd())
      {
        throw TruncatedFile{ "cell" };
      }
      throw UnknownStructure();
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

}
