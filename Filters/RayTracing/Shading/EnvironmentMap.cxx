// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentMap.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace penumbra
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// The glow's bound over the mean of the greatest channel: a sky whose radiance is the height above the
/// horizon has its zenith at 4.
constexpr double SunThreshold = 8.0;

float Greatest(glm::vec3 color)
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
    Ahead(glm::cross(right, up))
{
  double sum = 0.0;
  for (int row = 0; row < height; ++row)
  {
    const double share = .5 * (this->SineOfRow(row + 1) - this->SineOfRow(row)) / width;
    for (int i = 0; i < width; ++i)
    {
      sum += share * Greatest(this->ClampedRadiances[static_cast<std::size_t>(row) * width + i]);
    }
  }
  const auto bound = static_cast<float>(SunThreshold * sum);
  for (int row = 0; row < height; ++row)
  {
    const double angle = 2.0 * Pi * (this->SineOfRow(row + 1) - this->SineOfRow(row)) / width;
    for (int i = 0; i < width; ++i)
    {
      const int texel = row * width + i;
      glm::vec3& glow = this->ClampedRadiances[texel];
      const float greatest = Greatest(glow);
      if (greatest > bound)
      {
        this->Suns.push_back({ texel, glow / greatest, this->Total });
        this->Total += angle * (greatest - bound);
        glow *= bound / greatest;
      }
    }
  }
}

double EnvironmentMap::SineOfRow(int row) const
{
  return -std::cos(Pi * row / this->Height);
}

glm::vec3 EnvironmentMap::DirectionOf(double across, double sine) const
{
  const double longitude = 2.0 * Pi * (across - .5);
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  return cosine * (std::cos(longitude) * this->Right + std::sin(longitude) * this->Ahead) +
    sine * this->Up;
}

glm::vec3 EnvironmentMap::ClampedRadiance(glm::vec3 direction) const
{
  const glm::dvec3 w(direction);
  const double across =
    std::atan2(glm::dot(w, this->Ahead), glm::dot(w, this->Right)) / (2.0 * Pi) + .5;
  const double upwards = std::asin(std::clamp(glm::dot(w, this->Up), -1.0, 1.0)) / Pi + .5;
  const int i = std::clamp(static_cast<int>(across * this->Width), 0, this->Width - 1);
  const int row = std::clamp(static_cast<int>(upwards * this->Height), 0, this->Height - 1);
  return this->ClampedRadiances[static_cast<std::size_t>(row) * this->Width + i];
}

EnvironmentMap::Sun EnvironmentMap::SampleSun(glm::vec2 at) const
{
  const double sought = at.x * this->Total;
  const auto after = std::upper_bound(this->Suns.begin(), this->Suns.end(), sought,
    [](double value, const SunTexel& sun) { return value < sun.Cumulative; });
  const auto found = std::prev(after);
  const double end = after == this->Suns.end() ? this->Total : after->Cumulative;
  const double within =
    std::clamp((sought - found->Cumulative) / (end - found->Cumulative), 0.0, 1.0);
  const int row = found->Texel / this->Width;
  const double low = this->SineOfRow(row);
  const double sine = low + within * (this->SineOfRow(row + 1) - low);
  const double across = (found->Texel % this->Width + static_cast<double>(at.y)) / this->Width;
  return { this->DirectionOf(across, sine), static_cast<float>(this->Total) * found->Color };
}

}
