// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentMap.h"

#include "RayTracingConstants.h"
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace penumbra
{
namespace
{

constexpr double Pi = glm::pi<double>();

float LargestChannel(glm::vec3 color)
{
  return std::max({ color.x, color.y, color.z });
}

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
  for (int row = 0; row < height; ++row)
  {
    const double weight =
      .5 * (this->ComputeSineOfLatitude(row + 1) - this->ComputeSineOfLatitude(row)) / width;
    for (int i = 0; i < width; ++i)
    {
      this->MeanRadiance +=
        weight * LargestChannel(this->ClampedRadiances[static_cast<std::size_t>(row) * width + i]);
    }
  }
  const auto threshold = static_cast<float>(SunThreshold * this->MeanRadiance);
  for (int row = 0; row < height; ++row)
  {
    const double solidAngle =
      2.0 * Pi * (this->ComputeSineOfLatitude(row + 1) - this->ComputeSineOfLatitude(row)) / width;
    for (int i = 0; i < width; ++i)
    {
      const int texel = row * width + i;
      glm::vec3& radiance = this->ClampedRadiances[texel];
      const float largest = LargestChannel(radiance);
      if (largest > threshold)
      {
        this->Suns.push_back({ texel, radiance / largest, this->Total });
        this->Total += solidAngle * (largest - threshold);
        radiance *= threshold / largest;
      }
      this->LargestRadiance = std::max(this->LargestRadiance, double(LargestChannel(radiance)));
    }
  }
}

double EnvironmentMap::ComputeSineOfLatitude(int row) const
{
  return -std::cos(Pi * row / this->Height);
}

glm::vec3 EnvironmentMap::ComputeDirection(double u, double sine) const
{
  const double longitude = 2.0 * Pi * (u - .5);
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  return cosine * (std::cos(longitude) * this->Right + std::sin(longitude) * this->Forward) +
    sine * this->Up;
}

glm::vec3 EnvironmentMap::ClampedRadiance(glm::vec3 direction) const
{
  const glm::dvec3 w(direction);
  const double u =
    std::atan2(glm::dot(w, this->Forward), glm::dot(w, this->Right)) / (2.0 * Pi) + .5;
  const double v = std::asin(std::clamp(glm::dot(w, this->Up), -1.0, 1.0)) / Pi + .5;
  const int i = std::clamp(static_cast<int>(u * this->Width), 0, this->Width - 1);
  const int row = std::clamp(static_cast<int>(v * this->Height), 0, this->Height - 1);
  return this->ClampedRadiances[static_cast<std::size_t>(row) * this->Width + i];
}

EnvironmentMap::Sun EnvironmentMap::SampleSun(glm::vec2 sample) const
{
  const double target = sample.x * this->Total;
  const auto after = std::upper_bound(this->Suns.begin(), this->Suns.end(), target,
    [](double value, const SunTexel& texel) { return value < texel.Cumulative; });
  const auto sun = std::prev(after);
  const double end = after == this->Suns.end() ? this->Total : after->Cumulative;
  const double fraction =
    std::clamp((target - sun->Cumulative) / (end - sun->Cumulative), 0.0, 1.0);
  const int row = sun->Texel / this->Width;
  const double low = this->ComputeSineOfLatitude(row);
  const double sine = low + fraction * (this->ComputeSineOfLatitude(row + 1) - low);
  const double u = (sun->Texel % this->Width + static_cast<double>(sample.y)) / this->Width;
  return { this->ComputeDirection(u, sine), static_cast<float>(this->Total) * sun->Color };
}

}
