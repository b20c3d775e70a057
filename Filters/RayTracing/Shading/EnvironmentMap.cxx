// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentMap.h"

#include "RayTracingConstants.h"
#include "Vectors.h"
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace penumbra
{
namespace
{

constexpr double Pi = glm::pi<double>();

}

EnvironmentMap::EnvironmentMap(
  int width, int height, std::vector<glm::vec3> radiances, glm::dvec3 up, glm::dvec3 right)
  : Width(width),
    Height(height),
    ClampedRadiances(std::move(radiances)),
    Up(up),
    Right(right),
    Forward(glm::cross(right, up))
{
  this->SinesOfLatitude.reserve(static_cast<std::size_t>(height) + 1);
  for (int row = 0; row <= height; ++row)
  {
    this->SinesOfLatitude.push_back(-std::cos(Pi * row / height));
  }
  this->MeanRadiance = this->ComputeClampedMean(std::numeric_limits<double>::infinity());
  const auto threshold = static_cast<float>(this->FindSunThreshold());
  for (int row = 0; row < height; ++row)
  {
    const double solidAngle = 4.0 * Pi * this->ComputeTexelWeight(row);
    SunRow sunRow{ row, this->Suns.size(), this->SunIrradiance };
    double sum = 0.0;
    for (int i = 0; i < width; ++i)
    {
      glm::vec3& radiance = this->ClampedRadiances[static_cast<std::size_t>(row) * width + i];
      const float largest = MaximumComponent(radiance);
      if (largest > threshold)
      {
        this->Suns.push_back({ i, radiance / largest, sum });
        sum += solidAngle * (largest - threshold);
        radiance *= threshold / largest;
      }
      this->LargestRadiance = std::max(this->LargestRadiance, double(MaximumComponent(radiance)));
    }
    if (sum > 0.0)
    {
      this->SunRows.push_back(sunRow);
      this->SunIrradiance += sum;
    }
  }
}

double EnvironmentMap::ComputeTexelWeight(int row) const
{
  return .5 * (this->SinesOfLatitude[row + 1] - this->SinesOfLatitude[row]) / this->Width;
}

double EnvironmentMap::ComputeClampedMean(double limit) const
{
  double mean = 0.0;
  for (int row = 0; row < this->Height; ++row)
  {
    const double weight = this->ComputeTexelWeight(row);
    for (int i = 0; i < this->Width; ++i)
    {
      const glm::vec3 radiance =
        this->ClampedRadiances[static_cast<std::size_t>(row) * this->Width + i];
      mean += weight * std::min(limit, double(MaximumComponent(radiance)));
    }
  }
  return mean;
}

// The mean decreases with the threshold: a sun of 1e5 would otherwise raise the threshold to a
// multiple of what the whole sky emits. Where bright texels are all there is, it approaches 0.
double EnvironmentMap::FindSunThreshold() const
{
  double threshold = SunThreshold * this->MeanRadiance;
  for (;;)
  {
    const double next = SunThreshold * this->ComputeClampedMean(threshold);
    if (!(next < (1.0 - SunThresholdAccuracy) * threshold) ||
      next < SunThresholdAccuracy * this->MeanRadiance)
    {
      return threshold;
    }
    threshold = next;
  }
}

glm::vec3 EnvironmentMap::ComputeDirection(double u, double sine) const
{
  const auto longitude = static_cast<float>(2.0 * Pi * (u - .5));
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  return cosine * double(std::cos(longitude)) * this->Right +
    cosine * double(std::sin(longitude)) * this->Forward + sine * this->Up;
}

glm::vec3 EnvironmentMap::ClampedRadiance(glm::vec3 direction) const
{
  const glm::dvec3 w(direction);
  const auto angle = std::atan2(
    static_cast<float>(glm::dot(w, this->Forward)), static_cast<float>(glm::dot(w, this->Right)));
  const float u = angle / static_cast<float>(2.0 * Pi) + 0.5f;
  const int i =
    std::clamp(static_cast<int>(u * static_cast<float>(this->Width)), 0, this->Width - 1);
  const auto begin = this->SinesOfLatitude.begin() + 1;
  const auto row = std::upper_bound(begin, begin + this->Height - 1, glm::dot(w, this->Up)) - begin;
  return this->ClampedRadiances[static_cast<std::size_t>(row) * this->Width + i];
}

EnvironmentMap::Sun EnvironmentMap::SampleSun(glm::vec2 sample) const
{
  // Of two sorted cumulative sums, finds the last that is at most `target`, and the fraction of the
  // interval up to the next one.
  const auto find = [](auto begin, auto end, double total, double target, double& fraction) {
    const auto after = std::upper_bound(begin + 1, end, target,
      [](double value, const auto& element) { return value < element.Cumulative; });
    const auto found = std::prev(after);
    const double next = after == end ? total : after->Cumulative;
    fraction = std::clamp((target - found->Cumulative) / (next - found->Cumulative), 0.0, 1.0);
    return found;
  };
  double fraction = 0.0;
  const auto row = find(this->SunRows.begin(), this->SunRows.end(), this->SunIrradiance,
    sample.x * this->SunIrradiance, fraction);
  const bool isLast = std::next(row) == this->SunRows.end();
  const double rowTotal =
    (isLast ? this->SunIrradiance : std::next(row)->Cumulative) - row->Cumulative;
  const auto begin = this->Suns.begin() + static_cast<std::ptrdiff_t>(row->First);
  const auto end = isLast ? this->Suns.end()
                          : this->Suns.begin() + static_cast<std::ptrdiff_t>(std::next(row)->First);
  double across = 0.0;
  const auto sun = find(begin, end, rowTotal, sample.y * rowTotal, across);
  const double low = this->SinesOfLatitude[row->Row];
  const double sine = low + fraction * (this->SinesOfLatitude[row->Row + 1] - low);
  return { this->ComputeDirection((sun->Column + across) / this->Width, sine),
    static_cast<float>(this->SunIrradiance) * sun->Color };
}

}
