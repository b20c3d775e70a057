// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VisibleLight.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{
constexpr double Pi = 3.14159265358979323846;

double ClampedAcos(double cosine)
{
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}
}

double DiskBeyondLine(double offset)
{
  const double x = std::clamp(offset, -1.0, 1.0);
  return (std::acos(x) - x * std::sqrt(1.0 - x * x)) / Pi;
}

double CommonAreaOfCircles(double radius, double otherRadius, double distance)
{
  const double smaller = std::min(radius, otherRadius);
  if (distance >= radius + otherRadius)
  {
    return 0.0;
  }
  if (distance <= std::abs(radius - otherRadius))
  {
    return Pi * smaller * smaller;
  }
  const auto segment = [](double r, double chord) {
    return r * r * ClampedAcos(chord / r) - chord * std::sqrt(std::max(r * r - chord * chord, 0.0));
  };
  const double chord =
    (distance * distance + radius * radius - otherRadius * otherRadius) / (2.0 * distance);
  return segment(radius, chord) + segment(otherRadius, distance - chord);
}

// The area of a spherical cap on one side of a great circle, by the Gauss-Bonnet theorem.
double ConeInHemisphere(double radius, double angle)
{
  if (angle <= 0.5 * Pi - radius)
  {
    return 1.0;
  }
  if (angle >= 0.5 * Pi + radius)
  {
    return 0.0;
  }
  const double area = 2.0 *
    (Pi - ClampedAcos(std::cos(angle) / std::sin(radius)) -
      ClampedAcos(-std::cos(angle) / std::sin(angle) / std::tan(radius)) * std::cos(radius));
  const double whole = 2.0 * Pi * (1.0 - std::cos(radius));
  return std::clamp((area - 0.0) / whole, 0.0, 1.0);
}

}
