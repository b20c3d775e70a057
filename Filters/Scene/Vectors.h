// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Functions of numbers and vectors that GLM lacks.
#ifndef penumbra_Vectors_h
#define penumbra_Vectors_h

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>

namespace penumbra
{

template <typename T>
T Square(const T& x)
{
  return x * x;
}

template <glm::length_t N, typename T>
T MaximumComponent(const glm::vec<N, T>& v)
{
  T maximum = v[0];
  for (glm::length_t i = 1; i < N; ++i)
  {
    maximum = std::max(maximum, v[i]);
  }
  return maximum;
}

/// Returns twice the signed area of the triangle between the origin, `a` and `b`.
inline double Cross(glm::dvec2 a, glm::dvec2 b)
{
  return a.x * b.y - a.y * b.x;
}

/// Inserts two zero bits between the lower 21 bits of a number, as for Morton codes.
inline std::uint64_t SpreadBits(std::uint64_t x)
{
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

}
#endif
