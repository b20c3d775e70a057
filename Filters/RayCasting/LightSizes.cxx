// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LightSizes.h"

#include "vtkLight.h"

#include <algorithm>
#include <stdexcept>

namespace penumbra
{

void RequireLightSize(double radius, double angle)
{
  if (!(radius >= 0.0 && std::isfinite(radius)))
  {
    throw std::runtime_error("LightRadius must be finite and not negative.");
  }
  if (!(angle >= 0.0 && angle <= 180.0))
  {
    throw std::runtime_error("LightAngle must be between 0 and 180 degrees.");
  }
}

const LightSizes::SizedLight* LightSizes::Find(vtkLight* light) const
{
  const auto found = std::find_if(this->Lights.begin(), this->Lights.end(),
    [light](const SizedLight& sized) { return sized.Source == light; });
  return light && found != this->Lights.end() ? &*found : nullptr;
}

LightSizes::SizedLight& LightSizes::GetOrAdd(vtkLight* light)
{
  if (const SizedLight* found = this->Find(light))
  {
    return const_cast<SizedLight&>(*found);
  }
  this->Lights.emplace_back();
  this->Lights.back().Source = light;
  return this->Lights.back();
}

void LightSizes::SetRadius(vtkLight* light, double radius)
{
  // NaN means that no radius is set, so it is replaced by another invalid one.
  this->GetOrAdd(light).Radius = std::isnan(radius) ? -1.0 : radius;
}

void LightSizes::SetAngle(vtkLight* light, double angle)
{
  this->GetOrAdd(light).Angle = std::isnan(angle) ? -1.0 : angle;
}

double LightSizes::GetRadius(vtkLight* light, double all) const
{
  const SizedLight* sized = this->Find(light);
  return sized && !std::isnan(sized->Radius) ? sized->Radius : all;
}

double LightSizes::GetAngle(vtkLight* light, double all) const
{
  const SizedLight* sized = this->Find(light);
  return sized && !std::isnan(sized->Angle) ? sized->Angle : all;
}

void LightSizes::Require() const
{
  for (const SizedLight& light : this->Lights)
  {
    RequireLightSize(
      std::isnan(light.Radius) ? 0.0 : light.Radius, std::isnan(light.Angle) ? 0.0 : light.Angle);
  }
}

}
