// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangles of a Scene in Embree: nearest hits and occlusion. Embree stays behind this header.
#ifndef penumbra_RayScene_h
#define penumbra_RayScene_h

#include "Execution/ParallelFor.h"
#include "Scene.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace penumbra
{

class CoincidentSurfaces;
struct TracedSurface;

/// A ray; with directions from Camera::RayDirection distances are along the view axis.
struct Ray
{
  glm::vec3 Origin{ 0.f };
  glm::vec3 Direction{ 0.f, 0.f, -1.f };
  float Near = 0.f;
  float Far = std::numeric_limits<float>::infinity();
};

/// Where a ray met a triangle first. U, V and Distance follow from the triangle in double, of surfaces
/// in one place one is chosen by their looks, and on an edge the lowest triangle counts of those of the
/// surface: nothing of it depends on the processor, as Embree's own answers do.
struct Hit
{
  static constexpr std::uint32_t None = 0xffffffffu;
  std::uint32_t Surface = None;  ///< index into Scene::Surfaces; None: a miss
  std::uint32_t Triangle = None; ///< index into Surface::Triangles
  float U = 0.f;                 ///< weight of the triangle's second vertex
  float V = 0.f;                 ///< weight of its third vertex
  float Distance = std::numeric_limits<float>::infinity(); ///< in units of |Ray::Direction|
  float NextNear = std::numeric_limits<float>::infinity(); ///< the Near that passes this triangle

  bool IsHit() const { return this->Surface != None; }
};

class RayScene;

/// The first hit of `ray` that is no line and no point, which block nothing; `hit` is its first one.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT Hit SkipLinesAndPoints(const RayScene& rays, Ray ray, Hit hit);

/// Rays that are none (not finite, without direction, Near < 0 or > Far) meet nothing.
class VTKPENUMBRAFILTERSRAYTRACING_EXPORT RayScene
{
public:
  /// Builds the BVH with at most `threads` threads (0: all). `scene` must outlive this object.
  /// Positions and Triangles with a reserve of one element are traced in place, others are copied.
  /// Throws std::bad_alloc or std::runtime_error.
  /// Stopped where `progress`, asked on the calling thread, says so.
  RayScene(const Scene& scene, int threads, const ProgressCallback& progress = {});
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Nearest hit of one ray; culled sides of surfaces are passed.
  Hit Intersect(const Ray& ray) const;

  /// Nearest hits of 16 rays; those with Near > Far are left out.
  void Intersect16(const Ray* rays, Hit* hits) const;

  /// Is anything met? Surfaces with IsLineOrPoint do not count.
  bool Occluded(const Ray& ray) const;

  /// The same for 16 rays; those with Near > Far are not blocked.
  void Occluded16(const Ray* rays, bool* blocked) const;

  const Scene& GetScene() const { return this->TracedScene; }
  const CoincidentSurfaces& GetContest() const { return *this->Contesting; }

  /// No other scene of this process has the same.
  std::uint64_t GetId() const { return this->Id; }

private:
  void Release();

  const Scene& TracedScene;
  std::unique_ptr<CoincidentSurfaces> Contesting;
  std::vector<TracedSurface> Traced; ///< per surface: what filters know
  std::uint64_t Id;
  RTCDeviceTy* Device = nullptr;
  RTCSceneTy* EmbreeScene = nullptr;
  bool TracesPackets16 = false; ///< this machine traces 16 rays at once, not 8
};

}
#endif
