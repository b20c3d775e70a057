// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Embree BVH of the triangles of a Scene: nearest hits and occlusion. Users of this header do not
// need Embree's headers.
#ifndef penumbra_RayScene_h
#define penumbra_RayScene_h

#include "Execution/ParallelFor.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace penumbra
{

struct Scene;
struct SceneCoordinates;
struct Surface;
struct SurfaceChange;

class CoincidentSurfaces;
class PlanarCells;
class SliverTree;
struct TracedSurface;

/// A ray. If the direction is from Camera::RayDirection(), distances are measured along the view axis.
struct Ray
{
  glm::vec3 Origin{ 0.f };
  glm::vec3 Direction{ 0.f, 0.f, -1.f };
  float Near = 0.f;
  float Far = std::numeric_limits<float>::infinity();
  /// Up to this distance, surfaces before FirstInOrder in the order of coincident surfaces are
  /// skipped, see ContinueBehind().
  float CoincidentFar = 0.f;
  int FirstInOrder = 0;
};

/// First hit of a ray, the same on every processor, unlike the hits that Embree returns. U, V and Distance are
/// computed from the triangle in double precision. Of coincident surfaces, one is selected by CoincidentSurfaces. On
/// an edge, the triangle of the surface with the lowest index is selected.
struct Hit
{
  static constexpr std::uint32_t None = 0xffffffffu;
  std::uint32_t Surface = None;   ///< index into Scene::Surfaces; None if the ray misses
  std::uint32_t Primitive = None; ///< index of the triangle, sphere or tube of the surface
  float U = 0.f;                  ///< weight of the triangle's second vertex or of the tube's end
  float V = 0.f;                  ///< weight of its third vertex
  float Distance = std::numeric_limits<float>::infinity(); ///< in units of |Ray::Direction|
  float NextNear =
    std::numeric_limits<float>::infinity(); ///< value of Ray::Near that continues behind this hit
  float CoincidentNear = 0.f; ///< distance of the nearest coincident hit, if NextInOrder is not 0
  int NextInOrder = 0; ///< place of the next coincident surface in their order; 0: there is none

  bool IsHit() const { return this->Surface != None; }
};

class RayScene;

/// Returns `ray` from the hit on, so that its next hit is on the next surface that VTK draws behind
/// this one: a coincident surface, or one behind all of them.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT Ray ContinueBehind(Ray ray, const Hit& hit);

/// Returns the first hit of `ray` on a surface with area, skipping lines and points, which do not
/// occlude. `hit` is the first hit of `ray`.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT Hit SkipLinesAndPoints(const RayScene& rays, Ray ray, Hit hit);

/// Embree BVH of a Scene. Invalid rays (not finite, zero direction, Near < 0 or Near > Far) miss.
class VTKPENUMBRAFILTERSRAYTRACING_EXPORT RayScene
{
public:
  /// Builds the BVH with at most `threads` threads (0: all). `scene` must outlive this object. Positions and
  /// Triangles with spare capacity for one element are shared, others are copied. Throws std::bad_alloc or
  /// std::runtime_error, and Stopped if `progress`, which is called on the calling thread, returns true. If
  /// `isDynamic` is true, each surface has a BVH of its own below a common one, so that the time of Update() is that
  /// of what changes; rays take up to 6 % longer (of 1,000 spheres).
  RayScene(
    const Scene& scene, int threads, const ProgressCallback& progress = {}, bool isDynamic = false);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Returns the nearest hit of a ray; culled sides of surfaces are skipped.
  Hit Intersect(const Ray& ray) const;

  /// Computes the nearest hits of 16 or 8 rays. Rays with Near > Far are inactive and miss.
  void Intersect16(const Ray* rays, Hit* hits) const;
  void Intersect8(const Ray* rays, Hit* hits) const;

  /// Returns true if the ray hits a surface. Surfaces with IsLineOrPoint do not occlude.
  bool Occluded(const Ray& ray) const;

  /// Computes the occlusion of 16 or 8 rays. Rays with Near > Far are inactive and unoccluded.
  void Occluded16(const Ray* rays, bool* occluded) const;
  void Occluded8(const Ray* rays, bool* occluded) const;

  /// Returns the geometric normal at a hit of `ray`, not normalized. It points to the front side of
  /// triangles and to the outside of spheres and tubes.
  glm::vec3 GetNormal(const Ray& ray, const Hit& hit) const;

  /// Returns the oriented boxes that replace Embree's BVH of a surface of slivers, or null.
  const SliverTree* GetSlivers(std::uint32_t surface) const;

  /// Returns the cells that are Embree's primitives of a surface of overlapping triangles in one plane, or null.
  const PlanarCells* GetCells(std::uint32_t surface) const;

  /// Returns Embree's BVH of all surfaces.
  RTCSceneTy* GetTree() const { return this->EmbreeScene; }

  /// Returns the BVH of the triangles of a surface with Instances, in their own coordinates, or null.
  RTCSceneTy* GetShape(std::uint32_t surface) const;

  /// Returns the interpolated normal at `hit`, on the side of the unit vector `geometric`, the
  /// normal of the triangle. Returns `geometric` if the surface has no point normals, or if they are
  /// almost tangential to the triangle.
  glm::dvec3 GetSmoothNormal(const Hit& hit, glm::dvec3 geometric) const;

  const Scene& GetScene() const { return this->TracedScene; }
  const SceneCoordinates& GetCoordinates() const;
  const std::vector<Surface>& GetSurfaces() const { return this->Surfaces; }
  const CoincidentSurfaces& GetCoincidentSurfaces() const { return *this->Coincident; }

  /// Returns an id that is unique in this process.
  std::uint64_t GetId() const { return this->Id; }

  /// Updates the BVH after surfaces of the scene were replaced, so that all hits are those of a new object.
  /// The id changes, also if only other parts of the scene have changed, so that results that were
  /// computed from the former scene are not used again.
  void Update(const std::vector<SurfaceChange>& changes, const ProgressCallback& progress = {});

private:
  /// Returns false if all hits of the ray that were found are to be skipped.
  bool IntersectOnce(const Ray& ray, Hit& hit) const;
  /// Finds what the traversal of a surface depends on, beside its coincidence with others.
  void Inspect(std::uint32_t surface, bool isMoved);
  /// Sets how a surface coincides with others. Returns true if its geometry depends on what changes.
  bool SetCoincidence(std::uint32_t surface);
  /// Makes the geometry of a surface, instead of a former one.
  void Attach(std::uint32_t surface, const ProgressCallback& progress);
  void BuildShape(TracedSurface& traced, const ProgressCallback& progress);
  void Release();

  const Scene& TracedScene;
  const std::vector<Surface>& Surfaces;
  std::unique_ptr<CoincidentSurfaces> Coincident;
  std::vector<TracedSurface> Traced; ///< per surface: data of the filter functions
  std::uint64_t Id;
  RTCDeviceTy* Device = nullptr;
  RTCSceneTy* EmbreeScene = nullptr;
  bool TracesPackets16 = false; ///< the processor traces packets of 16 rays, not 8
};

/// Calls visit(surface, triangle) for triangles within `radius` of `point` until it returns true, in
/// arbitrary order and some several times. Spheres, tubes and instances are not visited.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT void VisitTrianglesNear(const RayScene& rays, glm::vec3 point,
  float radius, const std::function<bool(std::uint32_t, std::uint32_t)>& visit);

/// Returns the distance of the nearest triangle, sphere or tube, not instance, that accept(surface,
/// primitive) accepts; infinity if there is none within `radius`.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT float FindNearest(const RayScene& rays, glm::vec3 point,
  float radius, const std::function<bool(std::uint32_t, std::uint32_t)>& accept);

}
#endif
