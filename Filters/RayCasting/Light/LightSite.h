// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The surfaces that are visible in the pixels of an image, with the rays that estimate their light. The
// light has N values: 1: ambient occlusion; 3: indirect light; 4: occlusion, then indirect light. Both are in
// units of the color of a white surface.
#ifndef penumbra_LightSite_h
#define penumbra_LightSite_h

#include "LightConstants.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

/// Number of parts of the rays and samples that are estimated independently.
constexpr int Halves = 2;

/// The values of light.
template <int N>
struct LightTerms
{
  using Value = glm::vec<N, float>;
  static constexpr bool HasOcclusion = N != 3; ///< the first value
  static constexpr bool HasRadiance = N >= 3;  ///< three values, from FirstRadiance on
  static constexpr int FirstRadiance = HasOcclusion ? 1 : 0;
  /// Number of them, and indices of their colors in LightSite.
  static constexpr int Count = HasOcclusion && HasRadiance ? 2 : 1;
  static constexpr int OcclusionTerm = 0;
  static constexpr int RadianceTerm = Count - 1;

  /// Returns the largest error of a color with these errors on a white surface; both may be squared.
  static float Combine(const Value& errors)
  {
    float largest = 0.f;
    for (int i = FirstRadiance; i < N; ++i)
    {
      largest = i == FirstRadiance || errors[i] > largest ? errors[i] : largest;
    }
    return HasOcclusion ? errors[0] + largest : largest;
  }

  /// Returns the change of a color under `uniformLight`, without occlusion. `occluded` is what complete
  /// occlusion removes from it, `reflectance` what light 1 adds.
  static glm::vec3 ComputeChange(
    const Value& light, float uniformLight, glm::vec3 occluded, glm::vec3 reflectance)
  {
    glm::vec3 change(0.f);
    if constexpr (HasOcclusion)
    {
      change -= light[0] * occluded;
    }
    if constexpr (HasRadiance)
    {
      for (int c = 0; c < 3; ++c)
      {
        change[c] += (light[FirstRadiance + c] - uniformLight) * reflectance[c];
      }
    }
    return change;
  }
};

/// The part of a surface that is visible in a pixel.
template <int N>
struct LightSite
{
  glm::vec3 Position{ 0.f }; ///< mean of its samples, scene coordinates
  glm::vec3 Normal{ 0.f };   ///< mean of its shading normals (unit), on the side of the camera
  /// Sums over the samples of the pixel of the color that complete occlusion removes from it, and of the color
  /// that indirect light 1 adds.
  glm::vec3 Colors[LightTerms<N>::Count][Halves] = {};
  /// Sums of the products of these colors and those of the samples.
  glm::vec3 Products[LightTerms<N>::Count] = {};
  float Footprint = 0.f; ///< side of a pixel at this depth
  float Samples = 0.f;
  typename LightTerms<N>::Value Sums[Halves] = {}; ///< of the values along its rays
  std::uint16_t Rays[Halves] = {};
  std::uint16_t Layer = 0; ///< number of the layers in front of it
  std::uint32_t Patch = 0; ///< index of its patch in SiteGrid
};

struct LightPixel
{
  glm::vec3 Colors[Halves] = { glm::vec3(0.f),
    glm::vec3(0.f) };       ///< sums of the colors of its samples
                            ///< without occlusion, under uniform light
  glm::vec3 Squares{ 0.f }; ///< sums of their squares
  std::uint32_t Begin = 0;  ///< index of its first site in SiteGrid
  std::uint16_t Sites = 0;
  std::uint16_t Samples[Halves] = {};            ///< with colors
  bool IsComplex = false;                        ///< has several sites, or also shows others
  std::uint16_t Traced = FirstSiteRays / Halves; ///< samples of each half that are followed by rays
  std::uint16_t Target = FirstSiteRays / Halves; ///< number that there should be

  /// Returns the part of the pixel that a site covers.
  template <int N>
  float GetPart(const LightSite<N>& site) const
  {
    const auto samples = static_cast<float>(this->Samples[0] + this->Samples[1]);
    return this->IsComplex ? std::min(site.Samples / samples, 1.f) : 1.f;
  }
};

/// Position and normal of a site.
struct LightFeatures
{
  static constexpr int Count = 6;
  float At[Count];

  LightFeatures() = default;
  LightFeatures(glm::vec3 position, glm::vec3 normal)
    : At{ position.x, position.y, position.z, normal.x, normal.y, normal.z }
  {
  }
  glm::vec3 GetPosition() const { return { this->At[0], this->At[1], this->At[2] }; }
  glm::vec3 GetNormal() const { return { this->At[3], this->At[4], this->At[5] }; }
};

/// Returns true if two surfaces may be one: `offset` is the vector between their points, `height` and
/// `slope` bound its distance from the plane of `normal`, absolutely and relative to its length.
inline bool IsNearPlane(glm::vec3 offset, glm::vec3 normal, float height, float slope)
{
  const float distance = glm::dot(offset, normal);
  const float lateral = glm::dot(offset, offset) - distance * distance;
  const float excess = (distance < 0.f ? -distance : distance) - height;
  return excess <= 0.f || excess * excess <= slope * slope * lateral;
}

}
#endif
