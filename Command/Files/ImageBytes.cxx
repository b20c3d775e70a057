// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageBytes.h"

#include "MappedFile.h"
#include "Processes/MessageLog.h"

#include "vtkNew.h"
#include "vtkZLibDataCompressor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace penumbra
{

namespace
{

std::array<std::uint32_t, 256> MakeCrcTable()
{
  std::array<std::uint32_t, 256> table;
  for (std::uint32_t byte = 0; byte < 256; ++byte)
  {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = crc & 1u ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    table[byte] = crc;
  }
  return table;
}

/// Checksum of a chunk [PNG annex D].
std::uint32_t ComputeCrc(const char* begin, std::size_t size)
{
  static const std::array<std::uint32_t, 256> table = MakeCrcTable();
  std::uint32_t crc = 0xffffffffu;
  for (std::size_t i = 0; i < size; ++i)
  {
    crc = table[(crc ^ static_cast<unsigned char>(begin[i])) & 0xff] ^ (crc >> 8);
  }
  return ~crc;
}

std::uint32_t WordAt(const unsigned char* bytes)
{
  return static_cast<std::uint32_t>(bytes[0]) << 24 | static_cast<std::uint32_t>(bytes[1]) << 16 |
    static_cast<std::uint32_t>(bytes[2]) << 8 | bytes[3];
}

/// Returns the rows of an image and their bytes, without the byte of the filter, for each pass.
std::vector<std::array<std::size_t, 2>> FindPasses(const unsigned char* header)
{
  const std::size_t width = WordAt(header);
  const std::size_t height = WordAt(header + 4);
  static constexpr std::size_t channels[] = { 1, 0, 3, 1, 2, 0, 4 };
  const std::size_t bits = header[9] < 7 ? header[8] * channels[header[9]] : 0;
  const auto rows = [&](std::size_t x, std::size_t y, std::size_t stepX, std::size_t stepY) {
    const std::size_t columns = width > x ? (width - x + stepX - 1) / stepX : 0;
    const std::size_t count = height > y && columns > 0 ? (height - y + stepY - 1) / stepY : 0;
    return std::array<std::size_t, 2>{ count, (columns * bits + 7) / 8 };
  };
  if (header[12] == 0)
  {
    return { rows(0, 0, 1, 1) };
  }
  return { rows(0, 0, 8, 8), rows(4, 0, 8, 8), rows(0, 4, 4, 8), rows(2, 0, 4, 4), rows(0, 2, 2, 4),
    rows(1, 0, 2, 2), rows(0, 1, 1, 2) };
}

/// Returns whether the pixels can be decompressed and all rows have a valid filter.
bool HasIntactPixels(const unsigned char* header, const std::string& compressed)
{
  const std::vector<std::array<std::size_t, 2>> passes = FindPasses(header);
  double size = 0.0; // may overflow integers
  for (const auto& [rows, bytes] : passes)
  {
    size += static_cast<double>(rows) * static_cast<double>(bytes + 1);
  }
  constexpr double MaximumRatio = 1032.0; // of deflate
  if (size == 0.0 || size > MaximumRatio * static_cast<double>(compressed.size()))
  {
    return false;
  }
  std::vector<unsigned char> pixels(static_cast<std::size_t>(size));
  vtkNew<vtkZLibDataCompressor> zlib;
  TakeErrors();
  const std::size_t decompressed =
    zlib->Uncompress(reinterpret_cast<const unsigned char*>(compressed.data()), compressed.size(),
      pixels.data(), pixels.size());
  TakeErrors();
  if (decompressed != pixels.size())
  {
    return false;
  }
  std::size_t at = 0;
  for (const auto& [rows, bytes] : passes)
  {
    for (std::size_t row = 0; row < rows; ++row, at += bytes + 1)
    {
      if (pixels[at] > 4)
      {
        return false;
      }
    }
  }
  return true;
}

std::uint32_t DotsPerMeter(int dotsPerInch)
{
  return static_cast<std::uint32_t>(std::lround(dotsPerInch / 0.0254));
}

std::string BigEndian(std::uint32_t value)
{
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
  {
    bytes += static_cast<char>(value >> shift & 255u);
  }
  return bytes;
}

struct TruncatedTiff
{
};

}

bool IsWholePng(const char* begin, std::size_t size)
{
  constexpr std::size_t Signature = 8;
  constexpr std::size_t Overhead = 12; // length, type and checksum
  const auto* data = reinterpret_cast<const unsigned char*>(begin);
  constexpr std::size_t HeaderSize = 13;
  if (size < Signature + Overhead + HeaderSize ||
    std::memcmp(begin, "\x89PNG\r\n\x1a\n", Signature) != 0 ||
    WordAt(data + Signature) != HeaderSize || std::memcmp(begin + Signature + 4, "IHDR", 4) != 0)
  {
    return false;
  }
  std::string pixels;
  for (std::size_t at = Signature; size - at >= Overhead;)
  {
    const std::size_t length = WordAt(data + at);
    if (length > size - at - Overhead)
    {
      return false;
    }
    const bool isCritical = (data[at + 4] & 0x20) == 0; // libpng skips damaged ancillary chunks
    if (isCritical && WordAt(data + at + 8 + length) != ComputeCrc(begin + at + 4, length + 4))
    {
      return false;
    }
    if (std::memcmp(data + at + 4, "IEND", 4) == 0)
    {
      return HasIntactPixels(data + Signature + 8, pixels);
    }
    if (std::memcmp(data + at + 4, "IDAT", 4) == 0)
    {
      pixels.append(begin + at + 8, length);
    }
    at += Overhead + length;
  }
  return false;
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

void SetDensityOfPng(std::string& bytes, int dotsPerInch)
{
  // Signature of 8 bytes, then the chunk IHDR: length, name, 13 bytes, checksum.
  const std::size_t afterHeader = 8 + 4 + 4 + 13 + 4;
  const std::string density = BigEndian(DotsPerMeter(dotsPerInch));
  const char meters = 1;
  const std::string chunk = "pHYs" + density + density + meters;
  if (bytes.size() > afterHeader)
  {
    bytes.insert(
      afterHeader, BigEndian(9) + chunk + BigEndian(ComputeCrc(chunk.data(), chunk.size())));
  }
}

void SetDensityOfJpeg(std::string& bytes, int dotsPerInch)
{
  // SOI, APP0, its length, "JFIF" with its zero, version; then unit, x and y density.
  const std::size_t unit = 2 + 2 + 2 + 5 + 2;
  const char inches = 1;
  const std::string density = BigEndian(dotsPerInch).substr(2);
  if (bytes.size() > unit + 5 && bytes.compare(6, 4, "JFIF") == 0)
  {
    bytes.replace(unit, 5, inches + density + density);
  }
}

void SetDensityOfBmp(std::string& bytes, int dotsPerInch)
{
  const std::size_t horizontal = 38;
  const std::string bigEndian = BigEndian(DotsPerMeter(dotsPerInch));
  const std::string littleEndian(bigEndian.rbegin(), bigEndian.rend());
  if (bytes.size() > horizontal + 8)
  {
    bytes.replace(horizontal, 8, littleEndian + littleEndian);
  }
}

}
