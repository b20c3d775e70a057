// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelDensity.h"

#include <cmath>
#include <cstdint>

namespace penumbra
{

namespace
{

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

// Computes the CRC of PNG chunks (annex D of the specification), bitwise, because the chunk is short.
std::uint32_t Checksum(const std::string& bytes)
{
  std::uint32_t remainder = 0xffffffffu;
  for (const char byte : bytes)
  {
    remainder ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit)
    {
      remainder = remainder & 1u ? 0xedb88320u ^ remainder >> 1 : remainder >> 1;
    }
  }
  return ~remainder;
}

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
    bytes.insert(afterHeader, BigEndian(9) + chunk + BigEndian(Checksum(chunk)));
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
