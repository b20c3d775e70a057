// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One drawn thing of a scene, in scene coordinates: triangles and how they look.
#ifndef penumbra_Surface_h
#define penumbra_Surface_h

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace penumbra
{

/// How a surface answers to light: VTK's property, colours in [0, 1], coefficients apart.
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
};

/// A picture on a surface, bottom row first, straight alpha in [0, 1].
struct Texture
{
  int Width = 0;
  int Height = 0;
  std::vector<glm::u8vec4> Texels;
  bool Interpolate = false;
  bool Repeat = true;
};

/// One drawn thing: triangles and how they look. Positions and Triangles keep a reserve of one
/// element, see RayScene.
struct Surface
{
  int ObjectId = 0; ///< index of the actor or data set, as in the array `ObjectId`

  std::vector<glm::vec3> Positions;
  std::vector<glm::uvec3> Triangles; ///< indices into Positions, each in range
  std::vector<std::uint32_t>
    CellIds; ///< per triangle: cell of the input; empty: the triangle's index

  /// Shading normals, not always of length 1: VTK interpolates them as they come.
  std::vector<glm::vec3> Normals;         ///< per position
  std::vector<glm::vec3> TriangleNormals; ///< per triangle, used without Normals
  /// Neither: flat, each triangle its own, facing the eye.

  /// How Normals and TriangleNormals are turned before lighting.
  enum class NormalRules
  {
    ByWinding,  ///< negated where the winding faces away
    TowardsEye, ///< negated where they point away from the eye (lines)
    AsTheyAre   ///< (points)
  };
  NormalRules NormalRule = NormalRules::ByWinding;

  /// Colours that replace AmbientColor and DiffuseColor, alpha multiplies Opacity. At most one of
  /// the three is filled.
  std::vector<glm::u8vec4> PointColors;
  std::vector<glm::u8vec4> CellColors; ///< per triangle
  std::shared_ptr<const Texture> ColorTexture;
  std::vector<glm::vec2> ColorCoordinates; ///< per position, with ColorTexture

  /// An actor's texture: multiplies what lighting made of the surface, opacity included.
  std::shared_ptr<const Texture> LitTexture;
  std::vector<glm::vec2> TextureCoordinates; ///< per position, with LitTexture
  bool TextureOnBackfaces = true;

  bool HasBackMaterial = false;
  Material Front;
  Material Back;

  bool Backfaces = true;       ///< false: culled
  bool Frontfaces = true;      ///< false: culled
  bool ScalarColoring = false; ///< coloured by data: weaker ambient occlusion by default
  bool IsLineOrPoint =
    false; ///< a line or a point, widened towards the eye: casts and takes no shadow

  bool IsTranslucent() const;

  /// Normal of a triangle, of any length: 0 only where it has no area, see below.
  glm::vec3 NormalOf(std::uint32_t triangle) const;
};

/// In single precision where that leaves a length, else of length 1: triangles of 1e-20 have one, too.
inline glm::vec3 Surface::NormalOf(std::uint32_t triangle) const
{
  const glm::uvec3 corners = this->Triangles[triangle];
  const glm::vec3 a = this->Positions[corners.x];
  const glm::vec3 b = this->Positions[corners.y];
  const glm::vec3 c = this->Positions[corners.z];
  const glm::vec3 normal = glm::cross(b - a, c - a);
  if (glm::dot(normal, normal) >= std::numeric_limits<float>::min())
  {
    return normal;
  }
  const glm::dvec3 from(a);
  const glm::dvec3 exact = glm::cross(glm::dvec3(b) - from, glm::dvec3(c) - from);
  const double length = glm::length(exact);
  return length > 0.0 ? glm::vec3(exact / length) : glm::vec3(0.f);
}

inline bool Surface::IsTranslucent() const
{
  const auto translucent = [](const std::vector<glm::u8vec4>& colors) {
    return std::any_of(colors.begin(), colors.end(), [](glm::u8vec4 c) { return c.a < 255; });
  };
  return this->Front.Opacity < 1.f || (this->HasBackMaterial && this->Back.Opacity < 1.f) ||
    translucent(this->PointColors) || translucent(this->CellColors) ||
    (this->ColorTexture && translucent(this->ColorTexture->Texels)) ||
    (this->LitTexture && translucent(this->LitTexture->Texels));
}

}
#endif
