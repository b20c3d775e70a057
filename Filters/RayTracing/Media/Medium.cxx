// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium.h"

#include "InScatteringDistribution.h"
#include "Light.h"
#include "Medium/PhaseFunctions.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

double Medium::PhaseFunction(double cosine) const
{
  return phaseFunctionOf(static_cast<int>(this->Phase), cosine, this->Asymmetry);
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

double Medium::ColumnToLight(glm::dvec3 point, glm::dvec3 direction, double distance) const
{
  const double inside = std::min(this->DistanceToExit(point, direction), distance);
  if (this->Density.IsUniform())
  {
    return std::isfinite(inside) ? inside : 0.0;
  }
  return this->Density.Column(point, direction, inside);
}

bool SpectralMedium::IsGray() const
{
  return std::all_of(this->Channels.begin(), this->Channels.end(), [this](const Medium& channel) {
    const Medium& first = this->Channels.front();
    return channel.Scattering == first.Scattering && channel.Rayleigh == first.Rayleigh &&
      channel.Extinction == first.Extinction;
  });
}

glm::vec3 SpectralMedium::TransmittanceToLight(const Light& light, glm::vec3 point) const
{
  const glm::dvec3 start(point);
  const LightDirection toLight = DirectionToLight(light, start);
  const Medium& medium = this->Channels.front();
  double near = 0.0;
  double far = toLight.Distance;
  if (!medium.Clip(start, toLight.Direction, near, far))
  {
    return glm::vec3(1.f);
  }
  const double column =
    medium.ColumnToLight(start + near * toLight.Direction, toLight.Direction, far - near);
  return { Attenuate(medium.Extinction, column), Attenuate(this->Channels[1].Extinction, column),
    Attenuate(this->Channels[2].Extinction, column) };
}

}
