// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Material of a surface and its textures.
#ifndef penumbra_Material_h
#define penumbra_Material_h

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace penumbra
{

/// Phong material, as in vtkProperty. Colors are in [0, 1] and are not multiplied by the
/// coefficients.
struct Material
{
  glm::vec3 AmbientColor{ 1.f };
  glm::vec3 DiffuseColor{ 1.f };
  glm::vec3 SpecularColor{ 1.f };
  float Ambient = 0.f;
  float Diffuse = 1.f;
  float Specular = 0.f;
  float SpecularPower = 1.f;
  float Opacity = 1.f;
  bool Lighting = true;
  /// Physically based material, as VTK_PBR: DiffuseColor is the linear albedo.
  bool PhysicallyBased = false;
  float Metallic = 0.f;
  float Roughness = 0.5f;
  float BaseReflectance = 0.04f; ///< at normal incidence, of the dielectric part
  glm::vec3 EdgeTint{ 1.f };     ///< reflectance at grazing incidence, of the metallic part
  float Anisotropy = 0.f;
  float AnisotropyRotation = 0.f; ///< of the tangent, in full turns
  float NormalScale = 1.f;        ///< factor of the slopes in MaterialTextures::Normal
  float OcclusionStrength = 1.f;  ///< of the occlusion in MaterialTextures
  glm::vec3 EmissiveFactor{ 1.f };
  float CoatStrength = 0.f; ///< 0: no clear coat
  float CoatRoughness = 0.f;
  float CoatReflectance = 0.04f; ///< at normal incidence
  glm::vec3 CoatColor{ 1.f };
  float CoatNormalScale = 1.f; ///< factor of the slopes in MaterialTextures::CoatNormal
};

/// Texture image: bottom row first, 8-bit RGBA with straight alpha.
struct Texture
{
  int Width = 0;
  int Height = 0;
  std::vector<glm::u8vec4> Texels;
  /// If true, the colors of texels are sRGB. Decode() makes them linear, as OpenGL does before it interpolates.
  bool IsSRGB = false;
  bool Interpolate = false;
  /// Wrap modes of vtkTexture: the color at coordinates outside [0, 1].
  enum class WrapModes
  {
    ClampToEdge,
    Repeat,
    MirroredRepeat,
    ClampToBorder
  };
  WrapModes Wrap = WrapModes::Repeat;
  glm::vec4 BorderColor{ 0.f }; ///< used by ClampToBorder

  /// Returns a texel, from 0 to 1, with linear colors.
  glm::vec4 Decode(glm::u8vec4 texel) const;
};

inline glm::vec4 Texture::Decode(glm::u8vec4 texel) const
{
  if (!this->IsSRGB)
  {
    return glm::vec4(texel) * (1.f / 255.f);
  }
  static const std::array<float, 256> linear = []() {
    std::array<float, 256> table;
    for (int i = 0; i < 256; ++i)
    {
      const double c = i / 255.0;
      table[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
  }();
  return { linear[texel.r], linear[texel.g], linear[texel.b], texel.a / 255.f };
}

/// Textures of a physically based material besides its base color. Each may be null.
struct MaterialTextures
{
  std::shared_ptr<const Texture> Normal; ///< in the frame of the tangent
  std::shared_ptr<const Texture> OcclusionRoughnessMetallic;
  std::shared_ptr<const Texture> Emission;
  std::shared_ptr<const Texture> Anisotropy; ///< anisotropy and rotation
  std::shared_ptr<const Texture> CoatNormal;
};

}
#endif
