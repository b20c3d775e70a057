// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The surfaces that are visible in the pixels of an image, with the rays that estimate their occlusion.
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

/// The part of a surface that is visible in a pixel.
struct LightSite
{
  glm::vec3 Position{ 0.f }; ///< mean of its samples, scene coordinates
  glm::vec3 Normal{ 0.f };   ///< mean of its shading normals (unit), on the side of the camera
  glm::vec3 Colors[Halves] = { glm::vec3(0.f),
    glm::vec3(0.f) };    ///< sums over the samples of the pixel
                         ///< of the color that occlusion removes from it
  float Footprint = 0.f; ///< side of a pixel at this depth
  float Samples = 0.f;
  float Sums[Halves] = {}; ///< of the occlusion along its rays
  std::uint16_t Rays[Halves] = {};
  std::uint16_t Layer = 0; ///< number of the layers in front of it
  std::uint32_t Patch = 0; ///< index of its patch in SiteGrid
};

struct LightPixel
{
  glm::vec3 Colors[Halves] = { glm::vec3(0.f),
    glm::vec3(0.f) };      ///< sums of the unoccluded colors of
                           ///< its samples
  std::uint32_t Begin = 0; ///< index of its first site in SiteGrid
  std::uint16_t Sites = 0;
  std::uint16_t Samples[Halves] = {};            ///< with colors
  bool IsComplex = false;                        ///< has several sites, or also shows others
  std::uint16_t Traced = FirstSiteRays / Halves; ///< samples of each half that are followed by rays
  std::uint16_t Target = FirstSiteRays / Halves; ///< number that there should be

  /// Returns the part of the pixel that a site covers.
  float GetPart(const LightSite& site) const
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

/// Joined estimate of neighboring sites of one surface: a linear function of the features.
struct SitePatch
{
  LightFeatures Mean{};
  float Value = 0.f; ///< at the mean, times 1 - AloneWeight
  float Slopes[LightFeatures::Count] = {};
  float AloneWeight = 0.f;  ///< weight of the rays of the site alone
  float SquaredError = 0.f; ///< of a site
};

/// The sites of the pixels [Low, High), which are multiples of LightTileSide; pixels outside of the
/// image are empty.
struct SiteGrid
{
  glm::ivec2 Low{ 0 };
  glm::ivec2 High{ 0 };
  std::vector<LightSite> Sites;
  std::vector<LightPixel> Pixels; ///< row by row
  std::vector<SitePatch> Patches;

  glm::ivec2 GetSize() const { return this->High - this->Low; }
  std::size_t GetCell(int x, int y) const
  {
    return static_cast<std::size_t>(y - this->Low.y) * (this->High.x - this->Low.x) +
      (x - this->Low.x);
  }
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
