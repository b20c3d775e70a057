// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TiffFile.h"

#include "MappedFile.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace penumbra
{

namespace
{

struct TruncatedTiff
{
};

}

bool IsWholeTiff(const std::string& path)
try
{
  const MappedFile file(path);
  const char* begin = file.Begin();
  const std::uint64_t size = file.Size();
  const auto number = [&](std::uint64_t at, int bytes) {
    std::uint64_t value = 0;
    if (at > size || size - at < static_cast<std::uint64_t>(bytes))
    {
      throw TruncatedTiff();
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
catch (const TruncatedTiff&)
{
  return false;
}

}
