// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentLight.h"

#include "CubeMap.h"
#include "Execution/ParallelFor.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

constexpr float Pi = glm::pi<float>();

/// Rows of the image that stands for the environment where it is blurred.
constexpr int ReducedRows = 128;
/// Largest number of samples along each side of a texel of this image.
constexpr int MaximumReduction = 16;
/// Fewest rows of an image for a roughness.
constexpr int FewestRows = 32;
/// Samples of the distribution of microfacets.
constexpr std::uint32_t PrefilterSamples = 512;
/// Size of the table of reflectances, and samples of each value.
constexpr int ReflectanceSize = 64;
constexpr std::uint32_t ReflectanceSamples = 256;

/// Returns the nearest number in [0, 1], and 0 for NaN.
float ClampToUnit(float number)
{
  return number > 0.f ? std::min(number, 1.f) : 0.f;
}

/// Returns a point of Hammersley's set in the unit square.
glm::vec2 GetHammersleyPoint(std::uint32_t index, std::uint32_t count)
{
  double inverse = 0.0;
  double digit = 0.5;
  for (std::uint32_t rest = index; rest != 0; rest >>= 1, digit *= 0.5)
  {
    inverse += (rest & 1u) != 0 ? digit : 0.0;
  }
  return { static_cast<float>(index) / static_cast<float>(count), static_cast<float>(inverse) };
}

/// Returns a normal of the GGX distribution about the z axis.
glm::vec3 SampleMicrofacet(glm::vec2 point, float roughness)
{
  const float alpha = roughness * roughness;
  const float cosine = std::sqrt((1.f - point.y) / (1.f + (alpha * alpha - 1.f) * point.y));
  const float sine = std::sqrt(std::max(0.f, 1.f - cosine * cosine));
  const float angle = 2.f * Pi * point.x;
  return { std::cos(angle) * sine, std::sin(angle) * sine, cosine };
}

/// Returns the direction of a point of an image of all directions.
glm::vec3 GetDirection(float u, float v)
{
  const float longitude = 2.f * Pi * (u - 0.5f);
  const float latitude = Pi * (v - 0.5f);
  return { std::cos(latitude) * std::cos(longitude), std::sin(latitude),
    std::cos(latitude) * std::sin(longitude) };
}

/// Interpolates texels. An image of all directions continues across its sides and poles; others end
/// at their edges.
glm::vec3 Interpolate(const RadianceImage& image, float u, float v, bool isSphere)
{
  const float x = ClampToUnit(u) * static_cast<float>(image.Width) - 0.5f;
  const float y = ClampToUnit(v) * static_cast<float>(image.Height) - 0.5f;
  const int left = static_cast<int>(std::floor(x));
  const int low = static_cast<int>(std::floor(y));
  const auto texel = [&](int column, int row) {
    const int inside = std::clamp(row, 0, image.Height - 1);
    if (!isSphere)
    {
      return image.At(std::clamp(column, 0, image.Width - 1), inside);
    }
    const int across = row == inside ? 0 : image.Width / 2; // beyond a pole
    return image.At((column + across + image.Width) % image.Width, inside);
  };
  const float s = x - static_cast<float>(left);
  const float t = y - static_cast<float>(low);
  return glm::mix(glm::mix(texel(left, low), texel(left + 1, low), s),
    glm::mix(texel(left, low + 1), texel(left + 1, low + 1), s), t);
}

glm::vec3 SampleDirections(const RadianceImage& image, glm::vec3 direction)
{
  const float u = std::atan2(direction.z, direction.x) / (2.f * Pi) + 0.5f;
  const float v = std::asin(std::clamp(direction.y, -1.f, 1.f)) / Pi + 0.5f;
  return Interpolate(image, u, v, true);
}

/// Polynomials of a unit normal that span the irradiance, orthogonal on the sphere, and the
/// integral of their squares over the sphere.
std::array<float, 9> GetPolynomials(glm::vec3 n)
{
  return { 1.f, n.x, n.y, n.z, n.x * n.y, n.y * n.z, n.x * n.z, 3.f * n.z * n.z - 1.f,
    n.x * n.x - n.y * n.y };
}
constexpr std::array<float, 9> PolynomialNorms = { 4.f * Pi, 4.f * Pi / 3.f, 4.f * Pi / 3.f,
  4.f * Pi / 3.f, 4.f * Pi / 15.f, 4.f * Pi / 15.f, 4.f * Pi / 15.f, 16.f * Pi / 5.f,
  16.f * Pi / 15.f };
/// Factors of the cosine lobe, divided by pi, for degrees 0, 1 and 2.
constexpr std::array<float, 9> CosineFactors = { 1.f, 2.f / 3.f, 2.f / 3.f, 2.f / 3.f, 0.25f, 0.25f,
  0.25f, 0.25f, 0.25f };

}

EnvironmentLight::EnvironmentLight(std::vector<RadianceImage> faces, const glm::dmat3& fromScene,
  float exponent, std::uint64_t version)
  : Faces(std::move(faces)),
    FromScene(fromScene),
    Exponent(exponent),
    Version(version)
{
}

void EnvironmentLight::Prepare()
{
  std::call_once(this->Prepared, [this]() {
    const RadianceImage image = this->Reduce(1.f);
    for (int level = 1; level < Levels; ++level)
    {
      this->Prefiltered[static_cast<std::size_t>(level)] = this->Prefilter(image, level);
    }
    this->FitIrradiance(this->Exponent == 1.f ? image : this->Reduce(this->Exponent));
    this->TabulateReflectance();
  });
}

glm::vec3 EnvironmentLight::SampleImages(glm::vec3 direction) const
{
  if (this->Faces.size() < 6)
  {
    return SampleDirections(this->Faces[0], direction);
  }
  const CubeMapPoint<float> point = FindCubeMapPoint(direction);
  return Interpolate(this->Faces[point.Face], point.Position.x, point.Position.y, false);
}

RadianceImage EnvironmentLight::Reduce(float exponent) const
{
  RadianceImage image;
  image.Height = ReducedRows;
  image.Width = 2 * ReducedRows;
  image.Texels.resize(static_cast<std::size_t>(image.Width) * image.Height);
  const int rows = this->Faces[0].Height * (this->Faces.size() < 6 ? 1 : 2);
  const int side = std::clamp((rows + ReducedRows - 1) / ReducedRows, 2, MaximumReduction);
  ParallelFor(0, image.Height, 1, [&](int row) {
    for (int column = 0; column < image.Width; ++column)
    {
      glm::vec3 sum(0.f);
      for (int k = 0; k < side * side; ++k)
      {
        const float u = (static_cast<float>(column) + (static_cast<float>(k % side) + 0.5f) / side);
        const float v = (static_cast<float>(row) + (static_cast<float>(k / side) + 0.5f) / side);
        const glm::vec3 texel = this->SampleImages(GetDirection(u / image.Width, v / image.Height));
        sum += exponent == 1.f ? texel : glm::pow(texel, glm::vec3(exponent));
      }
      image.Texels[static_cast<std::size_t>(row) * image.Width + column] =
        sum / static_cast<float>(side * side);
    }
  });
  return image;
}

RadianceImage EnvironmentLight::Prefilter(const RadianceImage& source, int level)
{
  // VTK's roughness of a level.
  const float roughness = static_cast<float>(level) / static_cast<float>(Levels);
  std::vector<glm::vec4> samples; // reflected directions about the z axis, and their cosine
  for (std::uint32_t i = 0; i < PrefilterSamples; ++i)
  {
    const glm::vec3 half = SampleMicrofacet(GetHammersleyPoint(i, PrefilterSamples), roughness);
    const glm::vec3 light = 2.f * half.z * half - glm::vec3(0.f, 0.f, 1.f);
    if (light.z > 0.f)
    {
      samples.emplace_back(light, light.z);
    }
  }
  RadianceImage image;
  image.Height = std::max(ReducedRows >> level, FewestRows);
  image.Width = 2 * image.Height;
  image.Texels.resize(static_cast<std::size_t>(image.Width) * image.Height);
  ParallelFor(0, image.Height, 1, [&](int row) {
    for (int column = 0; column < image.Width; ++column)
    {
      const glm::vec3 normal = GetDirection((static_cast<float>(column) + 0.5f) / image.Width,
        (static_cast<float>(row) + 0.5f) / image.Height);
      const glm::vec3 other =
        std::abs(normal.y) < 0.9f ? glm::vec3(0.f, 1.f, 0.f) : glm::vec3(1.f, 0.f, 0.f);
      const glm::vec3 tangent = glm::normalize(glm::cross(other, normal));
      const glm::mat3 frame(tangent, glm::cross(normal, tangent), normal);
      glm::vec3 sum(0.f);
      float weight = 0.f;
      for (const glm::vec4& sample : samples)
      {
        sum += sample.w * SampleDirections(source, frame * glm::vec3(sample));
        weight += sample.w;
      }
      image.Texels[static_cast<std::size_t>(row) * image.Width + column] = sum / weight;
    }
  });
  return image;
}

void EnvironmentLight::FitIrradiance(const RadianceImage& image)
{
  std::array<glm::dvec3, 9> sums{};
  double sphere = 0.0;
  for (int row = 0; row < image.Height; ++row)
  {
    for (int column = 0; column < image.Width; ++column)
    {
      const float v = (static_cast<float>(row) + 0.5f) / image.Height;
      const double weight = std::cos(Pi * (v - 0.5f));
      sphere += weight;
      const std::array<float, 9> values =
        GetPolynomials(GetDirection((static_cast<float>(column) + 0.5f) / image.Width, v));
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        sums[i] += weight * values[i] * glm::dvec3(image.At(column, row));
      }
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    const double factor = 4.0 * Pi / sphere * CosineFactors[i] / PolynomialNorms[i];
    this->Irradiance[i] = factor * sums[i];
  }
}

// The terms of a microfacet surface with Smith's shadowing, as in VTK's table.
void EnvironmentLight::TabulateReflectance()
{
  this->Reflectances.resize(static_cast<std::size_t>(ReflectanceSize) * ReflectanceSize);
  ParallelFor(0, ReflectanceSize, 1, [&](int row) {
    const float roughness = (static_cast<float>(row) + 0.5f) / ReflectanceSize;
    const float k = 0.5f * roughness * roughness;
    const auto shadowing = [k](float cosine) { return cosine / (cosine * (1.f - k) + k); };
    for (int column = 0; column < ReflectanceSize; ++column)
    {
      const float nv = (static_cast<float>(column) + 0.5f) / ReflectanceSize;
      const glm::vec3 view(std::sqrt(1.f - nv * nv), 0.f, nv);
      glm::vec2 sum(0.f);
      for (std::uint32_t i = 0; i < ReflectanceSamples; ++i)
      {
        const glm::vec3 half =
          SampleMicrofacet(GetHammersleyPoint(i, ReflectanceSamples), roughness);
        const float vh = std::max(glm::dot(view, half), 0.f);
        const float nl = 2.f * vh * half.z - nv;
        if (nl > 0.f)
        {
          const float visible = shadowing(nv) * shadowing(nl) * vh / (half.z * nv);
          const float fresnel = std::pow(1.f - vh, 5.f);
          sum += visible * glm::vec2(1.f - fresnel, fresnel);
        }
      }
      this->Reflectances[static_cast<std::size_t>(row) * ReflectanceSize + column] =
        sum / static_cast<float>(ReflectanceSamples);
    }
  });
}

glm::vec3 EnvironmentLight::ComputeIrradiance(glm::vec3 normal) const
{
  const std::array<float, 9> values = GetPolynomials(glm::mat3(this->FromScene) * normal);
  glm::vec3 sum(0.f);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    sum += values[i] * this->Irradiance[i];
  }
  return glm::max(sum, glm::vec3(0.f));
}

glm::vec3 EnvironmentLight::ComputeReflection(glm::vec3 direction, float roughness) const
{
  const glm::vec3 d = glm::normalize(glm::mat3(this->FromScene) * direction);
  const auto sample = [&](int level) {
    return level == 0 ? this->SampleImages(d)
                      : SampleDirections(this->Prefiltered[static_cast<std::size_t>(level)], d);
  };
  const float level = ClampToUnit(roughness) * (Levels - 1);
  const int low = std::min(static_cast<int>(level), Levels - 2);
  return glm::mix(sample(low), sample(low + 1), level - static_cast<float>(low));
}

glm::vec2 EnvironmentLight::ComputeReflectance(float cosine, float roughness) const
{
  const float x =
    std::clamp(ClampToUnit(cosine) * ReflectanceSize - 0.5f, 0.f, ReflectanceSize - 1.f);
  const float y =
    std::clamp(ClampToUnit(roughness) * ReflectanceSize - 0.5f, 0.f, ReflectanceSize - 1.f);
  const int i = std::min(static_cast<int>(x), ReflectanceSize - 2);
  const int j = std::min(static_cast<int>(y), ReflectanceSize - 2);
  const auto at = [&](int column, int row) {
    return this->Reflectances[static_cast<std::size_t>(row) * ReflectanceSize + column];
  };
  const float s = x - static_cast<float>(i);
  return glm::mix(glm::mix(at(i, j), at(i + 1, j), s), glm::mix(at(i, j + 1), at(i + 1, j + 1), s),
    y - static_cast<float>(j));
}

}
