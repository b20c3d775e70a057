// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A point of the wall seen at the angle a from the wall's normal is at the distance t = d / cos a.
// The points at one angle cover the fraction 2 / pi sin^2 a da of the cosine-weighted hemisphere. A
// point of the ceiling seen at the cosine c is at the distance t = h / c and covers the fraction 2
// c dc.
#include "FalloffOcclusion.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

constexpr double Pi = glm::pi<double>();
constexpr int Steps = 1000;

/// Integrates with Simpson's rule.
template <typename Function>
double Integrate(double from, double to, const Function& f)
{
  const double h = (to - from) / (2 * Steps);
  double sum = f(from) + f(to);
  for (int i = 1; i < 2 * Steps; ++i)
  {
    sum += (i % 2 == 1 ? 4.0 : 2.0) * f(from + i * h);
  }
  return sum * h / 3.0;
}

}

double FadingOcclusion::At(double distance) const
{
  const double share = std::min(distance / this->Radius, 1.0);
  return this->Power == 0.0 ? 1.0 : 1.0 - std::pow(share, this->Power);
}

double FadingOcclusion::BeforeWall(double distance) const
{
  const double widest = distance < this->Radius ? std::acos(distance / this->Radius) : 0.0;
  return 2.0 / Pi * Integrate(0.0, widest, [&](double a) {
    return this->At(distance / std::cos(a)) * std::pow(std::sin(a), 2.0);
  });
}

double FadingOcclusion::UnderCeiling(double height) const
{
  const double least = std::min(height / this->Radius, 1.0);
  return Integrate(least, 1.0, [&](double c) { return this->At(height / c) * 2.0 * c; });
}

}
