// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Resolution of coincident surfaces: selects the visible hit if several surfaces are closer to each
// other along a ray than single precision can resolve. Distances are compared in double precision.
// Coplanar surfaces are ordered as VTK draws them, so that the image does not depend on rounding:
// lines and points are in front, then surfaces whose mappers shift them toward the camera, then
// translucent surfaces, then those that are drawn later. Of coincident translucent surfaces, a ray meets
// only the first one. Of lines, points and polygons of one surface that coincide and differ in color,
// the one that is drawn last is in front, because it passes VTK's depth test (GL_LEQUAL).
#ifndef penumbra_CoincidentSurfaces_h
#define penumbra_CoincidentSurfaces_h

#include "AxisAlignedBox.h"
#include "RayScene.h"

#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

namespace penumbra
{

struct Surface;

/// A hit in single precision, as Embree computes it.
struct CandidateHit
{
  std::uint32_t Surface;
  std::uint32_t Primitive;
  float U;
  float V;
  float Distance;
};

/// The hits of a ray that are within the depth tolerance of the nearest one.
struct CandidateHits
{
  static constexpr int Capacity = 8;

  CandidateHit Hits[Capacity];
  int Count = 0;
  float Far = 0.f; ///< Ray::Far

  /// Adds `hit` and removes hits farther than `tolerance` behind the nearest one. If the capacity
  /// is exceeded, the farthest hit of the surfaces that have several is dropped, or else the
  /// farthest one. `isLastInFront`: see CoincidentSurfaces; of such a surface, the triangle that is
  /// drawn first is dropped, except the nearest one. Returns the distance of the nearest hit.
  float Add(const CandidateHit& hit, float tolerance, bool isLastInFront);

private:
  CandidateHit* FindFirstDrawn(std::uint32_t surface);
};

/// Returns the bounds of the positions of a surface with triangles; empty without triangles.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT AxisAlignedBox ComputePositionBounds(const Surface& surface);

/// Returns true if several triangles of the surface may be at the same point and differ in color:
/// lines and points, and polygons in one plane.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT bool MayCoincideWithItself(const Surface& surface);

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT CoincidentSurfaces
{
public:
  /// Finds the surfaces whose bounding boxes are within the depth tolerance of another one. `scene`
  /// must outlive this object.
  explicit CoincidentSurfaces(const std::vector<Surface>& surfaces);

  /// Reads these surfaces of the scene again.
  void Update(const std::vector<std::uint32_t>& surfaces);

  /// Returns the distance along a ray, in scene units, below which single precision may not
  /// separate this surface from another one; 0 if no other surface is near.
  float DepthTolerance(std::uint32_t surface) const { return this->DepthTolerances[surface]; }

  /// Returns true if triangles of this surface may coincide with each other and differ in color. The
  /// one with the highest index, which VTK draws last, is then in front.
  bool IsLastInFront(std::uint32_t surface) const { return this->LastInFront[surface] != 0; }

  /// Returns true if triangle `p` of surface `a` is in front of triangle `q` of surface `b` where
  /// they coincide.
  bool IsInFront(std::uint32_t a, std::uint32_t p, std::uint32_t b, std::uint32_t q) const
  {
    const int first = this->DepthTolerances[a] > 0.f ? this->DrawOrder[a] : NoOrder;
    const int second = this->DepthTolerances[b] > 0.f ? this->DrawOrder[b] : NoOrder;
    return first != second        ? first < second
      : a != b                    ? a < b
      : this->LastInFront[a] != 0 ? p > q
                                  : p < q;
  }

  /// Returns the position of this surface in the order of coplanar surfaces, 0 in front. It is
  /// meaningful if DepthTolerance() is positive.
  int GetDrawOrder(std::uint32_t surface) const { return this->DrawOrder[surface]; }

  /// Returns the first position behind this surface that a ray meets where they coincide.
  int GetNextInOrder(std::uint32_t surface) const { return this->NextInOrder[surface]; }

  /// Returns true if no two surfaces are near each other, and none coincides with itself.
  bool IsEmpty() const { return this->Empty; }

  /// Returns the center of the bounds of all triangles.
  glm::vec3 GetCenter() const { return this->Center; }

  /// Returns the visible hit of the candidates; `embreeHit` is what Embree returned.
  /// Hit::NextNear of the result is the distance of the farthest coincident hit. Returns a miss if
  /// the ray skips all candidates.
  Hit Resolve(const Ray& ray, const Hit& embreeHit, CandidateHits& candidates) const;

private:
  static constexpr int NoOrder = std::numeric_limits<int>::max();

  /// What the order of coincident surfaces depends on.
  struct Traits
  {
    AxisAlignedBox Bounds;
    bool HasTriangles = false;
    bool IsTranslucent = false;
    bool MayCoincideWithItself = false;
    std::tuple<bool, float, bool> SortKey; ///< of the one in front first

    Traits() = default;
    explicit Traits(const Surface& surface);
  };

  void FindNear(const std::vector<std::uint32_t>& sorted);
  void FindOrder(std::vector<std::uint32_t> surfaces);
  void Sort();

  const std::vector<Surface>& Surfaces;
  std::vector<Traits> TraitsBySurface;
  std::vector<float> DepthTolerances; ///< per surface
  std::vector<char> LastInFront;      ///< per surface: see IsLastInFront()
  bool Empty = true;
  glm::vec3 Center{ 0.f };
  std::vector<int> DrawOrder;   ///< per surface; lower values are in front
  std::vector<int> NextInOrder; ///< place in this order of the next one that a ray meets
};

}
#endif
