// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TiffCodecs.h"

#include "Processes/MessageLog.h"

#include "vtkNew.h"
#include "vtkZLibDataCompressor.h"

#include <algorithm>
#include <cstdint>

namespace penumbra
{

namespace
{

using Bytes = std::vector<unsigned char>;

}

std::vector<unsigned char> DecodeTiffPackBits(
  const unsigned char* in, std::size_t size, std::size_t expected)
{
  Bytes out;
  out.reserve(expected);
  for (std::size_t at = 0; at < size && out.size() < expected;)
  {
    const int header = static_cast<signed char>(in[at++]);
    if (header >= 0)
    {
      const std::size_t count = std::min<std::size_t>(header + 1, size - at);
      out.insert(out.end(), in + at, in + at + count);
      at += count;
    }
    else if (header != -128 && at < size)
    {
      out.insert(out.end(), 1 - header, in[at++]);
    }
  }
  return out;
}

std::vector<unsigned char> DecodeTiffLzw(
  const unsigned char* in, std::size_t size, std::size_t expected)
{
  constexpr int Clear = 256;
  constexpr int End = 257;
  constexpr int MaximumCodes = 4096;
  std::vector<int> prefix(MaximumCodes, -1);
  Bytes last(MaximumCodes);
  std::vector<std::size_t> lengths(MaximumCodes, 1);
  for (int i = 0; i < Clear; ++i)
  {
    last[i] = static_cast<unsigned char>(i);
  }
  Bytes out;
  out.reserve(expected);
  int next = End + 1;
  int bits = 9;
  int previous = -1;
  std::uint32_t buffer = 0;
  int available = 0;
  for (std::size_t at = 0; out.size() < expected;)
  {
    for (; available < bits && at < size; available += 8)
    {
      buffer = buffer << 8 | in[at++];
    }
    if (available < bits)
    {
      break;
    }
    available -= bits;
    const int code = static_cast<int>(buffer >> available & ((1u << bits) - 1));
    if (code == End)
    {
      break;
    }
    if (code == Clear)
    {
      next = End + 1;
      bits = 9;
      previous = -1;
      continue;
    }
    if (code > next || (code == next && previous < 0) || (previous < 0 && code > Clear))
    {
      return Bytes();
    }
    // A code that is not yet in the table is the previous string and its first byte.
    const int known = code == next ? previous : code;
    const std::size_t begin = out.size();
    out.resize(begin + lengths[known]);
    int walk = known;
    for (std::size_t i = lengths[known]; i-- > 0; walk = prefix[walk])
    {
      out[begin + i] = last[walk];
    }
    const unsigned char first = out[begin];
    if (code == next)
    {
      out.push_back(first);
    }
    if (previous >= 0 && next < MaximumCodes)
    {
      prefix[next] = previous;
      last[next] = first;
      lengths[next] = lengths[previous] + 1;
      ++next;
      bits = std::min(next >= (1 << bits) - 1 ? bits + 1 : bits, 12);
    }
    previous = code;
  }
  return out;
}

std::vector<unsigned char> InflateTiff(
  const unsigned char* in, std::size_t size, std::size_t expected)
{
  Bytes out(expected);
  vtkNew<vtkZLibDataCompressor> zlib;
  TakeErrors();
  out.resize(std::min(zlib->Uncompress(in, size, out.data(), out.size()), expected));
  TakeErrors();
  return out;
}

}
