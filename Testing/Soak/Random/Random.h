// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Random numbers that are the same with every standard library.
#ifndef penumbra_soak_Random_h
#define penumbra_soak_Random_h

#include <glm/glm.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace penumbra_soak
{

/// SplitMix64. Seeds and streams are independent: a part of a scene with a stream of its own can be
/// left out without changing the others.
class Random
{
public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
    : State(Mix(Mix(seed + 0x9e3779b97f4a7c15ull) + stream))
  {
  }

  std::uint64_t Next()
  {
    this->State += 0x9e3779b97f4a7c15ull;
    return Mix(this->State);
  }

  /// Uniform in [0, 1).
  double Unit() { return static_cast<double>(this->Next() >> 11) * 0x1p-53; }

  double Between(double low, double high) { return low + (high - low) * this->Unit(); }

  /// Uniform logarithm.
  double Scale(double low, double high)
  {
    return std::exp(this->Between(std::log(low), std::log(high)));
  }

  /// Uniform in [0, bound).
  int Below(int bound) { return static_cast<int>(this->Next() % static_cast<unsigned>(bound)); }

  bool Chance(double probability) { return this->Unit() < probability; }

  template <typename T>
  T Pick(std::initializer_list<T> values)
  {
    return values.begin()[this->Below(static_cast<int>(values.size()))];
  }

  /// Uniform in [-1, 1]^3.
  glm::dvec3 Vector()
  {
    const double x = this->Between(-1.0, 1.0);
    const double y = this->Between(-1.0, 1.0);
    return { x, y, this->Between(-1.0, 1.0) };
  }

  /// A direction of length 1.
  glm::dvec3 Direction()
  {
    const double z = this->Between(-1.0, 1.0);
    const double turn = this->Between(0.0, 6.283185307179586);
    const double side = std::sqrt(1.0 - z * z);
    return { side * std::cos(turn), side * std::sin(turn), z };
  }

  glm::dvec3 Color()
  {
    const double r = this->Unit();
    const double g = this->Unit();
    return { r, g, this->Unit() };
  }

private:
  static std::uint64_t Mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }

  std::uint64_t State;
};

}
#endif
