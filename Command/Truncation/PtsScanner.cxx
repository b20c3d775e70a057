// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FormatScanners.h"

#include "FileCursor.h"

#include <cstdlib>
#include <string>

namespace penumbra
{

// PTS: an optional line with the number of points, then one point per line.
void ScanPts(FileCursor& file)
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
      throw TruncatedFile{ "point" };
    }
    ++lines;
  }
  if (lines < announced || lines == 0)
  {
    throw TruncatedFile{ "point" };
  }
}

}
