// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{

double Medium::PhaseFunction(double cosine) const
{
  constexpr double sphere = 4.0 * glm::pi<double>();
  switch (this->Phase)
  {
    case Phases::Rayleigh:
      return 0.75 * (1.0 + cosine * cosine) / sphere;
    case Phases::HenyeyGreenstein:
    {
      const double g = this->Asymmetry;
      const double root = std::sqrt(std::max(1.0 + g * g - 2.0 * g * cosine, 1e-12));
      return (1.0 - g * g) / (sphere * root * root * root);
    }
    case Phases::Isotropic:
      break;
  }
  return 1.0 / sphere;
}

bool Medium::Clip(glm::dvec3 origin, glm::dvec3 direction, double& near, double& far) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (direction[axis] == 0.0)
    {
      if (origin[axis] < this->Low[axis] || origin[axis] > this->High[axis])
      {
        return false;
      }
      continue;
    }
    const double a = (this->Low[axis] - origin[axis]) / direction[axis];
    const double b = (this->High[axis] - origin[axis]) / direction[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near < far;
}

double Medium::DistanceToExit(glm::dvec3 point, glm::dvec3 direction) const
{
  double distance = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (direction[axis] != 0.0)
    {
      const double face = direction[axis] > 0.0 ? this->High[axis] : this->Low[axis];
      distance = std::min(distance, (face - point[axis]) / direction[axis]);
    }
  }
  return std::max(distance, 0.0);
}

}
