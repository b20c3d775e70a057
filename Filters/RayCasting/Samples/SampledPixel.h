// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A pixel that is sampled until the error of its tile is small enough.
#ifndef penumbra_SampledPixel_h
#define penumbra_SampledPixel_h

#include "Pixels/IntegrationSettings.h"
#include "Rasterization/LinearValues.h"
#include "Sampling/CameraRayTracer.h"
#include "Shading/SurfaceColor.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

struct Surface;

/// Where the samples of a pixel come from.
enum class SampleSource
{
  Rays,
  LitRays,   ///< traced with light of their own, see SampleLight
  Triangles, ///< the nearest triangle at each sample, found without rays
  Layers     ///< all triangles at each sample, found without rays
};

/// Values that are linear in the pixel: of the texture coordinates times the weight, and of the weight,
/// the inverse depth.
struct PixelTexture
{
  const Texture* Image = nullptr;
  LinearValue<glm::dvec3> Coordinates{}; ///< relative to the origin of the pixel

  glm::vec2 At(glm::vec2 point) const
  {
    const glm::dvec3 p = this->Coordinates.Value +
      static_cast<double>(point.x) * this->Coordinates.SlopeX +
      static_cast<double>(point.y) * this->Coordinates.SlopeY;
    return glm::vec2(p.x / p.z, p.y / p.z);
  }
};

/// Color of a triangle that is a layer in one pixel: linear over the pixel, times a texture.
struct PixelLayerColor
{
  static constexpr std::uint32_t NoTexture = 0xffffffffu;
  static constexpr std::uint32_t NotNegated = 0xffffffffu;

  PrimitiveId Id{};
  const Surface* Of = nullptr; ///< null: not yet shaded
  bool IsConstant = true;
  std::uint32_t Texture = NoTexture;  ///< index in SampledPixel::Textures
  std::uint32_t Negated = NotNegated; ///< index in SampledPixel::NegatedLayers
  float Slope = 0.f;                  ///< see EdgeBlending
  glm::vec2 Center{ 0.f };            ///< position in the pixel
  glm::vec4 Color{ 0.f };             ///< at the center; not premultiplied, and opacity
  glm::vec4 Gradient[2] = {};         ///< change of the color along x and y

  /// Returns the color without the texture.
  glm::vec4 At(glm::vec2 point) const
  {
    glm::vec4 color = this->Color;
    if (!this->IsConstant)
    {
      const glm::vec2 d = point - this->Center;
      color = glm::clamp(color + d.x * this->Gradient[0] + d.y * this->Gradient[1], glm::vec4(0.f),
        glm::vec4(glm::vec3(1e30f), 1.f));
    }
    return color;
  }
};

/// Color of a layer in the part of the pixel where its normal points away from the camera and is negated.
struct NegatedLayer
{
  LinearValue<double> Away{}; ///< relative to the origin of the pixel, positive in that part
  PixelLayerColor Color;
};

/// Mean color of a triangle, or of the background, over samples of one pixel.
struct PixelTriangleColor
{
  PrimitiveId Id{};
  glm::vec4 Color{ 0.f };
  std::uint32_t Count = 0; ///< number of samples
};

/// A pixel with the samples that were traced so far. If few edges cross the pixel, its faces have
/// constant colors and exact areas, and samples only estimate the mean difference to them.
struct SampledPixel
{
  int X = 0;
  int Y = 0;
  SampleSource Source = SampleSource::Rays;
  std::vector<glm::vec4> FaceColors;        ///< per face of the arrangement; empty: no faces
  glm::vec4 MeanOfFaces{ 0.f };             ///< sum of areas times FaceColors
  std::vector<glm::vec4> Samples;           ///< differences to the colors of the faces
  std::vector<PixelLayerColor> LayerColors; ///< per layer of a pixel of layers
  std::vector<PixelTexture> Textures;       ///< of some of them
  std::vector<NegatedLayer> NegatedLayers;  ///< of some of them
  /// Colors of the visible triangles of a pixel of SampleSource::Triangles.
  std::vector<PixelTriangleColor> TriangleColors;
  /// Index in TriangleColors of each sample of such a pixel, which has no Samples.
  std::vector<std::uint32_t> SampleColors;
  long long Rays = 0;       ///< number of rays of Samples
  float Floor = 0.f;        ///< minimum estimated error of a single sample, over samples
  float MinimumError = 0.f; ///< minimum estimated error of any number of samples
  float MediumError = 0.f;  ///< estimated error of in-scattered light
  float Occlusion = 0.f;    ///< sum over the lit samples that show a surface
  int Surfaces = 0;         ///< number of these samples
  double Noise = 0.0;       ///< standard error of the colors of its samples
  PixelResult Result;

  /// Returns the color of a layer at a point.
  const PixelLayerColor& GetLayerColor(const PixelLayerColor& layer, glm::vec2 point) const
  {
    const bool mayBeNegated = layer.Negated != PixelLayerColor::NotNegated;
    return mayBeNegated && Evaluate(this->NegatedLayers[layer.Negated].Away, point) > 0.0
      ? this->NegatedLayers[layer.Negated].Color
      : layer;
  }

  /// Returns the seed of its sequence of samples.
  std::uint32_t GetSeed() const
  {
    return static_cast<std::uint32_t>(this->X) * 0x9e3779b1u ^
      static_cast<std::uint32_t>(this->Y) * 0x85ebca77u;
  }

  bool IsTraced() const
  {
    return this->Source == SampleSource::Rays || this->Source == SampleSource::LitRays;
  }

  std::size_t GetNumberOfSamples() const
  {
    return this->Source == SampleSource::Triangles ? this->SampleColors.size()
                                                   : this->Samples.size();
  }
};

}
#endif
