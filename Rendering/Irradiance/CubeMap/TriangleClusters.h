// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangles of a scene in bundles that lie together, so that those out of sight are left out by the
// bundle.
#ifndef penumbra_TriangleClusters_h
#define penumbra_TriangleClusters_h

#include "Scene.h"
#include "vtkPenumbraRenderingIrradianceModule.h" // for export macro, which tests need

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra
{

/// A corner as OpenGL gets it: position, and the number of its triangle from 1 on.
struct IdVertex
{
  glm::vec3 Position;
  float Number;
};

/// What is seen from a point: within five planes through it.
struct Frustum
{
  glm::vec3 Eye;
  std::array<glm::vec3, 5> Inwards; ///< normals of the planes
  float Reach;                      ///< nothing further is seen
};

class VTKPENUMBRARENDERINGIRRADIANCE_EXPORT TriangleClusters
{
public:
  /// Lines and points are left out. Throws std::runtime_error when there are too many triangles.
  explicit TriangleClusters(const Scene& scene);

  /// Three a triangle, in the order of the bundles.
  std::vector<IdVertex> MakeCorners(const Scene& scene) const;

  struct Triangle
  {
    std::uint32_t Surface;
    std::uint32_t Triangle;
  };
  /// The triangle of a number from 1 on.
  const Triangle& GetTriangle(std::size_t number) const { return this->Triangles[number - 1]; }
  std::size_t GetNumberOfTriangles() const { return this->Triangles.size(); }

  /// Which sides of triangles are seen.
  enum Sides
  {
    Both,
    FrontOnly,
    BackOnly
  };
  /// Runs of corners that lie next to each other: where they begin, and how long they are.
  struct DrawRanges
  {
    std::vector<int> First;
    std::vector<int> Count;
  };
  /// What may be in sight of the triangles of which `sides` are seen; returns how many.
  long long CullToFrustum(const Frustum& view, Sides sides, DrawRanges& runs) const;

private:
  struct Bundle
  {
    glm::vec3 Middle;
    glm::vec3 Half; ///< of its box
    int First;      ///< triangle
    int Count;
  };

  std::vector<Triangle> Triangles;
  std::array<std::vector<Bundle>, 3> Bundles;
};

}
#endif
