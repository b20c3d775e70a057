// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FormatScanners.h"

#include "FileCursor.h"

#include <cctype>
#include <cstdlib>
#include <string>

namespace penumbra
{

// SLC: counts and sizes as text, the compression, an icon with three channels, then slices.
void ScanSlc(FileCursor& file, const std::string&)
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
      throw TruncatedFile{ "slice" };
    }
    if (digits.empty() || *file.Rest() != 'X')
    {
      throw UnknownStructure();
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

}
