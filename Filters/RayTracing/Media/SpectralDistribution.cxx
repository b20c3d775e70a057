// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SpectralDistribution.h"

#include "Light.h"
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

SpectralDistribution::Point SpectralDistribution::PointAt(double t) const
{
  Point point{ t, 0.0 };
  if (this->Gray)
  {
    point.CDF = this->Channels[0]->CDF(t);
    return point;
  }
  for (int i = 0; i < 3; ++i)
  {
    point.Fractions[i] = this->Channels[i] ? this->Channels[i]->CDF(t) : 0.0;
  }
  point.CDF = this->Sum > 0.0 ? glm::dot(this->Integrals, point.Fractions) / this->Sum : 0.0;
  return point;
}

SpectralDistribution::Point SpectralDistribution::End() const
{
  double end = -std::numeric_limits<double>::infinity();
  for (const std::optional<InScatteringDistribution>& channel : this->Channels)
  {
    end = channel ? std::max(end, channel->InvertCDF(1.0)) : end;
  }
  return this->PointAt(end);
}

// In a gray medium the inverse is a closed form. Otherwise the quantiles of the channels bracket
// that of their mean, and regula falsi with the Illinois rule narrows the bracket.
SpectralDistribution::Point SpectralDistribution::Find(
  const Point& low, const Point& high, double cdf, double accuracy) const
{
  if (this->Gray)
  {
    return { this->Channels[0]->InvertCDF(cdf), cdf };
  }
  double begin = std::numeric_limits<double>::infinity();
  double end = -std::numeric_limits<double>::infinity();
  for (const std::optional<InScatteringDistribution>& channel : this->Channels)
  {
    if (channel)
    {
      const double quantile = channel->InvertCDF(cdf);
      begin = std::min(begin, quantile);
      end = std::max(end, quantile);
    }
  }
  begin = std::max(begin, low.Parameter);
  end = std::min(end, high.Parameter);
  Point first = begin > low.Parameter ? this->PointAt(begin) : low;
  Point last = end < high.Parameter ? this->PointAt(end) : high;
  double atFirst = first.CDF - cdf;
  double atLast = last.CDF - cdf;
  for (int i = 0; i < MaximumInversionSteps && atFirst < -accuracy && atLast > accuracy; ++i)
  {
    const double t =
      first.Parameter + (last.Parameter - first.Parameter) * (atFirst / (atFirst - atLast));
    const Point point = this->PointAt(t);
    const double difference = point.CDF - cdf;
    if (difference < 0.0)
    {
      first = point;
      atFirst = difference;
      atLast *= 0.5;
    }
    else
    {
      last = point;
      atLast = difference;
      atFirst *= 0.5;
    }
  }
  return std::abs(first.CDF - cdf) < std::abs(last.CDF - cdf) ? first : last;
}

SpectralDistribution::Point SpectralDistribution::Middle(const Point& low, const Point& high) const
{
  if (this->Gray)
  {
    const double cdf = 0.5 * (low.CDF + high.CDF);
    return this->Find(low, high, cdf, 0.0);
  }
  return this->PointAt(0.5 * (low.Parameter + high.Parameter));
}

glm::dvec3 SpectralDistribution::Between(const Point& low, const Point& high) const
{
  return this->Gray ? glm::dvec3(high.CDF - low.CDF) : high.Fractions - low.Fractions;
}

}
