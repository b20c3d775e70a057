// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SpectralDistribution.h"

#include "Shading/RayTracingConstants.h"
#include <algorithm>

namespace penumbra
{

SpectralDistribution::SpectralDistribution(const SpectralMedium& medium, const Light& light,
  glm::dvec3 origin, glm::dvec3 direction, double from, double to)
  : Gray(medium.IsGray()),
    Color(light.DiffuseColor)
{
  if (this->Gray)
  {
    this->Channels[0].emplace(medium.Channels[0], light, origin, direction, from, to);
    this->Brightness = std::max(this->Color.r, std::max(this->Color.g, this->Color.b));
    this->Sum = this->Channels[0]->Integral();
    return;
  }
  for (int i = 0; i < 3; ++i)
  {
    if (this->Color[i] > 0.f)
    {
      this->Channels[i].emplace(medium.Channels[i], light, origin, direction, from, to);
      this->Integrals[i] = this->Color[i] * this->Channels[i]->Integral();
      if (!(this->Integrals[i] > 0.0))
      {
        this->Channels[i].reset();
      }
    }
  }
  this->Sum = this->Integrals.r + this->Integrals.g + this->Integrals.b;
}

glm::vec3 SpectralDistribution::ComputeLight(glm::dvec3 lit) const
{
  return this->Gray ? static_cast<float>(lit.x * this->Sum) * this->Color
                    : glm::vec3(lit * this->Integrals);
}

glm::dvec3 SpectralDistribution::ChannelCDF(double t) const
{
  glm::dvec3 fractions(0.0);
  for (int i = 0; i < 3; ++i)
  {
    fractions[i] = this->Channels[i] ? this->Channels[i]->CDF(t) : 0.0;
  }
  return fractions;
}

double SpectralDistribution::CDF(double t) const
{
  if (this->Gray)
  {
    return this->Channels[0]->CDF(t);
  }
  return this->Sum > 0.0 ? glm::dot(this->Integrals, this->ChannelCDF(t)) / this->Sum : 0.0;
}

// The quantiles of the channels bracket that of their mean. Regula falsi with the Illinois rule.
double SpectralDistribution::InvertCDF(double fraction) const
{
  if (this->Gray)
  {
    return this->Channels[0]->InvertCDF(fraction);
  }
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  for (const std::optional<InScatteringDistribution>& channel : this->Channels)
  {
    if (channel)
    {
      const double quantile = channel->InvertCDF(fraction);
      low = std::min(low, quantile);
      high = std::max(high, quantile);
    }
  }
  if (!(low < high))
  {
    return low;
  }
  double atLow = this->CDF(low) - fraction;
  double atHigh = this->CDF(high) - fraction;
  for (int i = 0; i < MaximumInversionSteps && atLow < 0.0 && atHigh > 0.0; ++i)
  {
    const double middle = low + (high - low) * (atLow / (atLow - atHigh));
    const double atMiddle = this->CDF(middle) - fraction;
    if (std::abs(atMiddle) < InversionTolerance)
    {
      return middle;
    }
    if (atMiddle < 0.0)
    {
      low = middle;
      atLow = atMiddle;
      atHigh *= 0.5;
    }
    else
    {
      high = middle;
      atHigh = atMiddle;
      atLow *= 0.5;
    }
  }
  return atLow >= 0.0 ? low : atHigh <= 0.0 ? high : 0.5 * (low + high);
}

glm::dvec3 SpectralDistribution::Between(double low, double high) const
{
  return this->Gray
    ? glm::dvec3(high - low)
    : this->ChannelCDF(this->InvertCDF(high)) - this->ChannelCDF(this->InvertCDF(low));
}

}
