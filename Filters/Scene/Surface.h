// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangle mesh of a scene, or spheres or tubes, with their material, in scene coordinates.
#ifndef penumbra_Surface_h
#define penumbra_Surface_h

#include "AxisAlignedBox.h"
#include "Material.h"
#include "RoundShape.h"
#include "SurfaceInstances.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace penumbra
{

/// What methods are chosen by, of a surface whose primitives are distributed over several scenes.
struct WholeSurface
{
  AxisAlignedBox PositionBounds; ///< of the positions, if it has triangles; see CoincidentSurfaces
  AxisAlignedBox DrawnBounds;    ///< of the primitives
  std::size_t Primitives = 0;    ///< number of those stored
  bool HasTriangles = false;     ///< not those of Instances without an instance
  bool IsTranslucent = false;    ///< see Surface::IsTranslucent()
  bool MayCoincideWithItself = false; ///< see CoincidentSurfaces
  bool IsDense = false;               ///< see HasSubpixelTriangles()
  bool IsUnsteady = false;            ///< see HasUnsteadyNormals()
};

/// Triangle mesh, spheres or tubes with their material. Positions and Triangles reserve capacity
/// for one more element, because Embree may read 16 bytes starting at the last one (see RayScene).
struct Surface
{
  int ObjectId = 0; ///< index of the actor or data set, as in the array ObjectId
  int Part = 0;     ///< 0: its polygons; others: its points, lines, edges or vertices

  std::vector<glm::vec3> Positions;
  std::vector<glm::uvec3> Triangles; ///< indices into Positions, each in range

  /// If set, the surface consists of instances of its triangles, whose positions, normals and
  /// tangents are in coordinates of their own. "Triangle" then means triangle i % n of instance
  /// i / n in the names of other members, n being the size of Triangles, which is not 0.
  /// CellIds, CellColors and PointColors are empty. There are less than 2^32 - 1 triangles.
  std::shared_ptr<const SurfaceInstances> Instances;

  /// Radius of each position, or one radius for all of them. If not empty, the surface consists of
  /// spheres or tubes, Triangles is empty, and "triangle" means sphere or tube in the names of
  /// other members.
  std::vector<float> Radii;
  /// Axes of tubes: indices into Positions. Consecutive tubes whose axes have a common index are
  /// joined. If empty, each position is the center of a sphere.
  std::vector<glm::uvec2> Segments;
  /// If true, the tubes are cylinders with flat ends, and none are joined.
  bool HasFlatEnds = false;

  /// Cell of the input for each triangle. If empty, it is the index of the triangle.
  std::vector<std::uint32_t> CellIds;

  /// Shading normals. They need not have unit length, because VTK interpolates them without
  /// normalization. If both arrays are empty, each triangle is flat shaded and its normal faces the
  /// camera.
  std::vector<glm::vec3> Normals;         ///< per position
  std::vector<glm::vec3> TriangleNormals; ///< per triangle, used if Normals is empty

  /// Orientation of Normals and TriangleNormals for lighting.
  enum class NormalRules
  {
    ByWinding,    ///< negated if the triangle is seen from its back
    FacingCamera, ///< negated if the normal points away from the camera (lines)
    Unchanged     ///< as stored (points)
  };
  NormalRules NormalRule = NormalRules::ByWinding;

  /// Colors that replace AmbientColor and DiffuseColor; their alpha multiplies Opacity. At most one
  /// of PointColors, CellColors and ColorTexture is set.
  std::vector<glm::u8vec4> PointColors;
  std::vector<glm::u8vec4> CellColors; ///< per triangle
  std::shared_ptr<const Texture> ColorTexture;
  std::vector<glm::vec2> ColorCoordinates; ///< per position, if ColorTexture is set

  std::shared_ptr<const Texture> LitTexture; ///< of the actor; multiplies lit color and opacity
  /// Texture of a physically based material. It multiplies DiffuseColor and the opacity.
  std::shared_ptr<const Texture> BaseColorTexture;
  /// Other textures of a physically based material; null if there are none.
  std::shared_ptr<const MaterialTextures> DetailTextures;
  std::vector<glm::vec3> Tangents;           ///< per position, not unit; empty if not used
  std::vector<glm::vec2> TextureCoordinates; ///< per position, if one of these textures is set
  bool TextureOnBackfaces = true;

  bool HasBackMaterial = false;
  Material Front;
  Material Back;

  bool Backfaces = true;       ///< if false, back faces are culled
  bool Frontfaces = true;      ///< if false, front faces are culled
  bool ScalarColoring = false; ///< colored by scalars; the default ambient occlusion is weaker
  /// If true, the triangles are expanded lines or points, which neither cast nor receive shadows.
  bool IsLineOrPoint = false;
  /// Width of the edges of the surfaces with the same ObjectId, in pixels; 0: this one has no edges. Directly behind
  /// edges, these surfaces show only through them: both together have the opacity of one, as in VTK.
  float EdgeWidth = 0.f;
  /// If true, the surface emits light and hides nothing: its color, multiplied by its opacity, is
  /// added to what is behind it.
  bool IsAdditive = false;
  /// If true, the surface is drawn among the opaque ones in the order of the scene, although it is
  /// translucent: it is blended over what was drawn before, and hides what follows behind it.
  bool ForceOpaque = false;
  /// If true, the surface is invisible and hides the surfaces with HasHiddenLines behind it.
  bool HidesLines = false;
  /// Of coincident surfaces, the one with the smaller rank is in front; see DepthOffset.
  float DepthRank = 0.f;
  bool HasHiddenLines = false; ///< wireframe of which hidden lines are removed

  /// If set, the surface is a part of this one: it has the primitives, in the order of the whole, that
  /// may matter for a part of the image.
  std::shared_ptr<const WholeSurface> Whole;

  bool IsTranslucent() const;

  bool IsRound() const { return !this->Radii.empty(); } ///< spheres or tubes
  std::size_t GetNumberOfPrimitives() const;
  /// Returns the number of primitives in memory: of Instances, that of instances and triangles.
  std::size_t GetNumberOfStoredPrimitives() const
  {
    return this->Instances ? this->Triangles.size() + this->Instances->GetCount()
                           : this->GetNumberOfPrimitives();
  }
  /// Returns the indices of the positions of a triangle and of their attributes. Those of a sphere
  /// or tube are its ends; the second and third are equal.
  glm::uvec3 GetCorners(std::uint32_t primitive) const;
  /// Returns the positions of a triangle in scene coordinates.
  std::array<glm::vec3, 3> GetPoints(std::uint32_t primitive) const;
  /// Returns the normals or tangents of the corners of a triangle, not normalized. `stored` is
  /// Normals or Tangents.
  std::array<glm::vec3, 3> GetNormals(
    std::uint32_t primitive, const std::vector<glm::vec3>& stored) const;
  /// Returns the element of TriangleNormals of a triangle, in scene coordinates.
  glm::vec3 GetTriangleNormal(std::uint32_t primitive) const;
  /// Returns the index of a triangle in Triangles and TriangleNormals.
  std::size_t GetStoredTriangle(std::uint32_t primitive) const;
  std::size_t GetInstance(std::uint32_t primitive) const; ///< 0 without Instances
  std::uint32_t GetCellId(std::uint32_t primitive) const;
  bool HasTriangleColors() const { return this->Instances || !this->CellColors.empty(); }
  glm::u8vec4 GetTriangleColor(std::uint32_t primitive) const;
  float GetRadius(std::size_t position) const; ///< 0 if the surface consists of triangles
  RoundShape GetRoundShape(std::uint32_t primitive) const;

  /// Returns the geometric normal of a triangle (not of a sphere or tube), not normalized. It is
  /// zero only for triangles without area.
  glm::vec3 ComputeNormal(std::uint32_t triangle) const;
};

/// A surface that was replaced.
struct SurfaceChange
{
  std::uint32_t Surface;
  bool IsMoved; ///< rays hit others of its triangles, spheres or tubes, or hit them elsewhere
};

inline std::size_t Surface::GetNumberOfPrimitives() const
{
  return this->Instances     ? this->Triangles.size() * this->Instances->GetCount()
    : !this->IsRound()       ? this->Triangles.size()
    : this->Segments.empty() ? this->Positions.size()
                             : this->Segments.size();
}

inline std::size_t Surface::GetStoredTriangle(std::uint32_t primitive) const
{
  return this->Instances ? primitive % static_cast<std::uint32_t>(this->Triangles.size())
                         : primitive;
}

inline std::size_t Surface::GetInstance(std::uint32_t primitive) const
{
  return this->Instances ? primitive / static_cast<std::uint32_t>(this->Triangles.size()) : 0;
}

inline std::uint32_t Surface::GetCellId(std::uint32_t primitive) const
{
  return this->Instances    ? this->Instances->Ids[this->GetInstance(primitive)]
    : this->CellIds.empty() ? primitive
                            : this->CellIds[primitive];
}

inline glm::u8vec4 Surface::GetTriangleColor(std::uint32_t primitive) const
{
  return this->Instances ? this->Instances->Colors[this->GetInstance(primitive)]
                         : this->CellColors[primitive];
}

inline glm::uvec3 Surface::GetCorners(std::uint32_t primitive) const
{
  if (!this->IsRound())
  {
    return this->Triangles[this->GetStoredTriangle(primitive)];
  }
  return this->Segments.empty()
    ? glm::uvec3(primitive)
    : glm::uvec3(this->Segments[primitive], this->Segments[primitive].y);
}

inline std::array<glm::vec3, 3> Surface::GetPoints(std::uint32_t primitive) const
{
  const glm::uvec3 corners = this->GetCorners(primitive);
  std::array<glm::vec3, 3> points = { this->Positions[corners.x], this->Positions[corners.y],
    this->Positions[corners.z] };
  if (this->Instances)
  {
    const std::size_t instance = this->GetInstance(primitive);
    for (glm::vec3& point : points)
    {
      point = this->Instances->TransformPoint(instance, point);
    }
  }
  return points;
}

inline std::array<glm::vec3, 3> Surface::GetNormals(
  std::uint32_t primitive, const std::vector<glm::vec3>& stored) const
{
  const glm::uvec3 corners = this->GetCorners(primitive);
  std::array<glm::vec3, 3> normals = { stored[corners.x], stored[corners.y], stored[corners.z] };
  if (this->Instances)
  {
    const glm::dmat3 matrix = this->Instances->GetNormalMatrix(this->GetInstance(primitive));
    for (glm::vec3& normal : normals)
    {
      normal = glm::vec3(matrix * glm::dvec3(normal));
    }
  }
  return normals;
}

inline glm::vec3 Surface::GetTriangleNormal(std::uint32_t primitive) const
{
  const glm::vec3 normal = this->TriangleNormals[this->GetStoredTriangle(primitive)];
  return this->Instances
    ? glm::vec3(this->Instances->GetNormalMatrix(this->GetInstance(primitive)) * glm::dvec3(normal))
    : normal;
}

inline float Surface::GetRadius(std::size_t position) const
{
  return this->Radii.empty() ? 0.f : this->Radii[this->Radii.size() == 1 ? 0 : position];
}

inline RoundShape Surface::GetRoundShape(std::uint32_t primitive) const
{
  const glm::uvec3 ends = this->GetCorners(primitive);
  return { this->Positions[ends.x], this->Positions[ends.y], this->GetRadius(ends.x),
    this->GetRadius(ends.y), this->HasFlatEnds };
}

// In single precision, the cross product underflows for triangles of about 1e-20 in size.
inline glm::vec3 Surface::ComputeNormal(std::uint32_t triangle) const
{
  const auto [a, b, c] = this->GetPoints(triangle);
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
  if (this->Whole)
  {
    return this->Whole->IsTranslucent;
  }
  const auto translucent = [](const std::vector<glm::u8vec4>& colors) {
    return std::any_of(colors.begin(), colors.end(), [](glm::u8vec4 c) { return c.a < 255; });
  };
  return this->Front.Opacity < 1.f || (this->HasBackMaterial && this->Back.Opacity < 1.f) ||
    translucent(this->PointColors) || translucent(this->CellColors) ||
    (this->Instances && translucent(this->Instances->Colors)) ||
    (this->ColorTexture && translucent(this->ColorTexture->Texels)) ||
    (this->LitTexture && translucent(this->LitTexture->Texels)) ||
    (this->BaseColorTexture && translucent(this->BaseColorTexture->Texels));
}

}
#endif
