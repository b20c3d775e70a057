// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "NaturalOrder.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace penumbra
{

namespace
{

bool IsDigit(char character)
{
  return std::isdigit(static_cast<unsigned char>(character)) != 0;
}

// Returns the digits at `at` without leading zeros, and moves `at` behind them.
std::string TakeNumber(const std::string& text, std::size_t& at)
{
  const std::size_t begin = at;
  while (at < text.size() && IsDigit(text[at]))
  {
    ++at;
  }
  const std::size_t first = std::min(text.find_first_not_of('0', begin), at);
  return text.substr(first, at - first);
}

}

bool PrecedesNaturally(const std::string& a, const std::string& b)
{
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size())
  {
    if (IsDigit(a[i]) && IsDigit(b[j]))
    {
      const std::string first = TakeNumber(a, i);
      const std::string second = TakeNumber(b, j);
      if (first != second)
      {
        return first.size() != second.size() ? first.size() < second.size() : first < second;
      }
    }
    else if (a[i] != b[j])
    {
      return a[i] < b[j];
    }
    else
    {
      ++i;
      ++j;
    }
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

void SortNaturally(std::vector<std::string>& files)
{
  // Shells sort by the rules of the language, which this program does not load, or by bytes.
  const auto ignoresCase = [](const std::string& a, const std::string& b) {
    return strcasecmp(a.c_str(), b.c_str()) < 0;
  };
  if (std::is_sorted(files.begin(), files.end()) ||
    std::is_sorted(files.begin(), files.end(), ignoresCase))
  {
    std::stable_sort(files.begin(), files.end(), PrecedesNaturally);
  }
}

}
