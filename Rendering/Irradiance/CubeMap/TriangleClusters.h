// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Groups the triangles of a scene into spatially compact clusters for frustum culling.
#ifndef penumbra_TriangleClusters_h
#define penumbra_TriangleClusters_h

#include "vtkPenumbraRenderingIrradianceModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra
{

struct Surface;

/// Vertex for OpenGL: position, and the id of its triangle, starting at 1.
struct IdVertex
{
  glm::vec3 Position;
  float TriangleId;
};

/// View frustum: five planes through the camera and a maximum distance.
struct Frustum
{
  glm::vec3 Eye;
  std::array<glm::vec3, 5> Inwards; ///< inward normals of the planes
  float Far;                        ///< maximum distance
};

class VTKPENUMBRARENDERINGIRRADIANCE_EXPORT TriangleClusters
{
public:
  /// Lines and points are skipped. Throws std::runtime_error if there are too many triangles.
  explicit TriangleClusters(const std::vector<Surface>& surfaces);

  /// Returns three vertices per triangle, in the order of the clusters.
  std::vector<IdVertex> CreateVertices(const std::vector<Surface>& surfaces) const;

  struct Triangle
  {
    std::uint32_t Surface;
    std::uint32_t Triangle;
  };
  /// Returns the triangle with an id, starting at 1.
  const Triangle& GetTriangle(std::size_t id) const { return this->Triangles[id - 1]; }
  std::size_t GetNumberOfTriangles() const { return this->Triangles.size(); }

  /// Visible sides of triangles.
  enum Sides
  {
    Both,
    FrontOnly,
    BackOnly
  };
  /// Ranges of consecutive vertices, for glMultiDrawArrays().
  struct DrawRanges
  {
    std::vector<int> First;
    std::vector<int> Count;
  };
  /// Finds the triangles with the visible `sides` whose cluster intersects the frustum. Returns
  /// their number.
  long long CullToFrustum(const Frustum& view, Sides sides, DrawRanges& ranges) const;

private:
  struct Cluster
  {
    glm::vec3 Center;
    glm::vec3 HalfSize; ///< of the bounding box
    int First;          ///< first triangle
    int Count;
  };

  std::vector<Triangle> Triangles;
  std::array<std::vector<Cluster>, 3> Clusters; ///< indexed by Sides
};

}
#endif
