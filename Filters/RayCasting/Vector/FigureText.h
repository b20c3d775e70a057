// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Numbers and colors in the text of SVG and PDF files.
#ifndef penumbra_FigureText_h
#define penumbra_FigureText_h

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace penumbra
{

/// Coordinates of paths are written as integers in this fraction of a pixel.
constexpr double UnitsPerPixel = 100.0;

/// Returns a number with at most three decimals, independent of the locale.
inline std::string ToText(double value)
{
  const long long thousandths = std::llround(std::clamp(value, -1e12, 1e12) * 1000.0);
  const long long magnitude = std::llabs(thousandths);
  std::string text = std::to_string(magnitude / 1000);
  if (magnitude % 1000 != 0)
  {
    std::string decimals = std::to_string(1000 + magnitude % 1000).substr(1);
    decimals.erase(decimals.find_last_not_of('0') + 1);
    text += "." + decimals;
  }
  return thousandths < 0 ? "-" + text : text;
}

/// Returns a color channel as a byte.
inline int ToByte(float channel)
{
  return static_cast<int>(std::lround(255.f * std::clamp(channel, 0.f, 1.f)));
}

/// Returns a point in units of the file.
inline glm::i64vec2 ToUnits(glm::dvec2 x)
{
  const glm::dvec2 units = glm::clamp(x * UnitsPerPixel, -1e9, 1e9);
  return { std::llround(units.x), std::llround(units.y) };
}

}
#endif
