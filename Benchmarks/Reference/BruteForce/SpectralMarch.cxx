// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SpectralMarch.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace penumbra
{

double MarchTransmittance(
  const MarchedMedium& medium, glm::dvec3 origin, glm::dvec3 direction, double length, int steps)
{
  double depth = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    depth += medium.Extinction * medium.Density(origin + (i + 0.5) / steps * length * direction);
  }
  return std::exp(-depth * length / steps);
}

double MarchInScattering(const MarchedMedium& medium, glm::dvec3 origin, glm::dvec3 direction,
  double length, const std::function<bool(glm::dvec3)>& isLit, int steps)
{
  const double step = length / steps;
  double sum = 0.0;
  double depth = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    const glm::dvec3 point = origin + (i + 0.5) * step * direction;
    const double density = medium.Density(point);
    depth += 0.5 * step * medium.Extinction * density;
    const glm::dvec3 offset = medium.IsPositional ? medium.Light - point : medium.Light;
    const double distance = medium.IsPositional ? glm::length(offset) : medium.LightPath;
    const glm::dvec3 toLight = glm::normalize(offset);
    if (density > 0.0 && isLit(point))
    {
      const double cosine = glm::dot(toLight, direction);
      const double g = medium.Asymmetry;
      const double mie = (1.0 - g * g) / std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
      const double scattering =
        medium.Scattering * mie + medium.Rayleigh * 0.75 * (1.0 + cosine * cosine);
      sum += density * scattering / (4.0 * glm::pi<double>()) * std::exp(-depth) *
        MarchTransmittance(medium, point, toLight, distance, steps);
    }
    depth += 0.5 * step * medium.Extinction * density;
  }
  return sum * step;
}

}
