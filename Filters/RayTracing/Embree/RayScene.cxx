// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RayScene.h"

#include "BoxOverlap.h"
#include "CoincidentSurfaces.h"
#include "EmbreeQuery.h"
#include "InstanceGeometry.h"
#include "PlanarCells.h"
#include "RayTriangle.h"
#include "RoundIntersection.h"
#include "Scene.h"
#include "SliverTree.h"
#include "Surface.h"
#include "SurfaceGeometry.h"

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

namespace penumbra
{

namespace
{

/// Scenes with at least this many triangles use Embree's compact BVH: 10 to 20 % slower, 2.5 times
/// less memory (measured with 10 million triangles).
constexpr std::size_t MinimumCompactTriangles = 2000000;

/// Interpolated normals with a smaller cosine to the geometric normal are ignored.
constexpr double MinimumSmoothCosine = 0.1;
/// Interpolated normals with a larger one are equal to it up to rounding.
constexpr double FlatSmoothCosine = 1.0 - 1e-6;

/// Throws the last error of Embree as an exception.
void CheckDevice(RTCDevice device)
{
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY)
  {
    throw std::bad_alloc();
  }
  if (error != RTC_ERROR_NONE)
  {
    throw std::runtime_error("Embree failed with error " + std::to_string(error));
  }
}

/// Builds the BVH. Embree calls the progress monitor on any of its threads; `progress` is called
/// only on the calling thread.
void Commit(RTCScene tree, RTCDevice device, const ProgressCallback& progress)
{
  struct Monitor
  {
    const ProgressCallback& Progress;
    std::thread::id Caller;
    std::atomic<bool> IsStopped{ false };
  };
  Monitor monitor{ progress, std::this_thread::get_id() };
  if (progress)
  {
    const auto continues = [](void* data, double) {
      auto& self = *static_cast<Monitor*>(data);
      if (!self.IsStopped && std::this_thread::get_id() == self.Caller && self.Progress(0.0))
      {
        self.IsStopped = true;
      }
      return !self.IsStopped;
    };
    rtcSetSceneProgressMonitorFunction(tree, continues, &monitor);
  }
  rtcCommitScene(tree);
  rtcSetSceneProgressMonitorFunction(tree, nullptr, nullptr);
  if (monitor.IsStopped)
  {
    throw Stopped();
  }
  CheckDevice(device);
}

/// Returns the configuration of the Embree device. Tests add settings, such as isa=sse4.2, with the
/// environment variable PENUMBRA_EMBREE.
std::string MakeDeviceConfiguration(int threads)
{
  const char* additional = std::getenv("PENUMBRA_EMBREE");
  return "threads=" + std::to_string(threads) + (additional ? std::string(",") + additional : "");
}

std::size_t CountPrimitives(const std::vector<Surface>& surfaces)
{
  std::size_t count = 0;
  for (const Surface& surface : surfaces)
  {
    count += surface.Whole ? surface.Whole->Primitives : surface.GetNumberOfStoredPrimitives();
  }
  return count;
}

/// Returns an id that is unique in this process, starting at 1.
std::uint64_t NextId()
{
  static std::atomic<std::uint64_t> last(0);
  return ++last;
}

}

RayScene::RayScene(
  const Scene& scene, int threads, const ProgressCallback& progress, bool isDynamic)
  : TracedScene(scene),
    Surfaces(scene.Surfaces),
    Coincident(std::make_unique<CoincidentSurfaces>(scene.Surfaces)),
    Traced(scene.Surfaces.size()),
    Id(NextId())
{
  const auto count = static_cast<std::uint32_t>(scene.Surfaces.size());
  for (std::uint32_t i = 0; i < count; ++i)
  {
    this->Inspect(i, true);
    this->SetCoincidence(i);
  }
  this->Device = rtcNewDevice(MakeDeviceConfiguration(threads).c_str());
  CheckDevice(this->Device);
  this->TracesPackets16 =
    rtcGetDeviceProperty(this->Device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  try
  {
    this->EmbreeScene = rtcNewScene(this->Device);
    int flags = RTC_SCENE_FLAG_ROBUST;
    flags |= CountPrimitives(scene.Surfaces) < MinimumCompactTriangles ? 0 : RTC_SCENE_FLAG_COMPACT;
    if (isDynamic)
    {
      // A BVH of the BVHs of the geometries, which have a quality of their own.
      flags |= RTC_SCENE_FLAG_DYNAMIC;
      rtcSetSceneBuildQuality(this->EmbreeScene, RTC_BUILD_QUALITY_LOW);
    }
    rtcSetSceneFlags(this->EmbreeScene, static_cast<RTCSceneFlags>(flags));
    for (std::uint32_t i = 0; i < count; ++i)
    {
      this->Attach(i, progress);
    }
    Commit(this->EmbreeScene, this->Device, progress);
  }
  catch (...)
  {
    this->Release();
    throw;
  }
}

void RayScene::Inspect(std::uint32_t surface, bool isMoved)
{
  TracedSurface& traced = this->Traced[surface];
  traced.Data = &this->Surfaces[surface];
  traced.IsTranslucent = traced.Data->IsRound() && traced.Data->IsTranslucent();
  if (isMoved)
  {
    const BoxOverlap overlap(*traced.Data);
    const bool hasInstances = traced.Data->Instances != nullptr;
    traced.MayHaveCopies = overlap.IsLarge();
    traced.Slivers = hasInstances ? nullptr : SliverTree::MakeIfUseful(*traced.Data, overlap);
    traced.Cells =
      hasInstances || traced.Slivers ? nullptr : PlanarCells::MakeIfUseful(*traced.Data, overlap);
  }
}

bool RayScene::SetCoincidence(std::uint32_t surface)
{
  TracedSurface& traced = this->Traced[surface];
  const float tolerance = this->Coincident->DepthTolerance(surface);
  const bool isLastInFront = this->Coincident->IsLastInFront(surface);
  // The geometry has a filter if there is a tolerance.
  const bool changes =
    (tolerance > 0.f) != (traced.DepthTolerance > 0.f) || isLastInFront != traced.IsLastInFront;
  traced.DepthTolerance = tolerance;
  traced.IsLastInFront = isLastInFront;
  return changes;
}

void RayScene::Attach(std::uint32_t surface, const ProgressCallback& progress)
{
  TracedSurface& traced = this->Traced[surface];
  if (traced.IsAttached)
  {
    rtcDetachGeometry(this->EmbreeScene, surface);
    traced.IsAttached = false;
  }
  if (traced.Shape)
  {
    rtcReleaseScene(traced.Shape);
    traced.Shape = nullptr;
  }
  if (traced.Data->GetNumberOfPrimitives() == 0)
  {
    return;
  }
  if (traced.Data->Instances)
  {
    this->BuildShape(traced, progress);
  }
  RTCGeometry geometry = traced.Data->IsRound() ? MakeRoundGeometry(this->Device, traced)
    : traced.Shape                              ? MakeInstanceGeometry(this->Device, traced)
    : traced.Slivers || traced.Cells            ? MakeSliverGeometry(this->Device, traced)
                                                : MakeTriangleGeometry(this->Device, traced);
  rtcAttachGeometryByID(this->EmbreeScene, geometry, surface);
  rtcReleaseGeometry(geometry);
  traced.IsAttached = true;
}

void RayScene::Update(const std::vector<SurfaceChange>& changes, const ProgressCallback& progress)
{
  this->Id = NextId();
  if (changes.empty())
  {
    return;
  }
  std::vector<std::uint32_t> changed;
  std::vector<char> isMoved(this->Traced.size(), 0);
  for (const SurfaceChange& change : changes)
  {
    changed.push_back(change.Surface);
    isMoved[change.Surface] = change.IsMoved;
    this->Inspect(change.Surface, change.IsMoved);
  }
  this->Coincident->Update(changed);
  bool isCommitted = true;
  for (std::uint32_t i = 0; i < this->Traced.size(); ++i)
  {
    if (this->SetCoincidence(i) || isMoved[i])
    {
      this->Attach(i, progress);
      isCommitted = false;
    }
  }
  if (!isCommitted)
  {
    Commit(this->EmbreeScene, this->Device, progress);
  }
}

void RayScene::BuildShape(TracedSurface& traced, const ProgressCallback& progress)
{
  traced.Shape = rtcNewScene(this->Device);
  rtcSetSceneFlags(traced.Shape, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = MakeTriangleGeometry(this->Device, traced);
  rtcAttachGeometryByID(traced.Shape, geometry, 0);
  rtcReleaseGeometry(geometry);
  Commit(traced.Shape, this->Device, progress);
}

const SceneCoordinates& RayScene::GetCoordinates() const
{
  return this->TracedScene;
}

RayScene::~RayScene()
{
  this->Release();
}

void RayScene::Release()
{
  if (this->EmbreeScene)
  {
    rtcReleaseScene(this->EmbreeScene);
  }
  for (const TracedSurface& traced : this->Traced)
  {
    if (traced.Shape)
    {
      rtcReleaseScene(traced.Shape);
    }
  }
  if (this->Device)
  {
    rtcReleaseDevice(this->Device);
  }
}

const SliverTree* RayScene::GetSlivers(std::uint32_t surface) const
{
  return this->Traced[surface].Slivers.get();
}

RTCSceneTy* RayScene::GetShape(std::uint32_t surface) const
{
  return this->Traced[surface].Shape;
}

const PlanarCells* RayScene::GetCells(std::uint32_t surface) const
{
  return this->Traced[surface].Cells.get();
}

glm::vec3 RayScene::GetNormal(const Ray& ray, const Hit& hit) const
{
  const Surface& surface = this->Surfaces[hit.Surface];
  if (!surface.IsRound())
  {
    return surface.ComputeNormal(hit.Primitive);
  }
  const glm::dvec3 point =
    glm::dvec3(ray.Origin) + static_cast<double>(hit.Distance) * glm::dvec3(ray.Direction);
  const TouchingSphere sphere(surface.GetRoundShape(hit.Primitive), point);
  const glm::dvec3 normal = point - sphere.Center;
  const double length = glm::length(normal);
  return length > 0.0 ? glm::vec3(normal / length) : -ray.Direction;
}

glm::dvec3 RayScene::GetSmoothNormal(const Hit& hit, glm::dvec3 geometric) const
{
  const Surface& surface = this->Surfaces[hit.Surface];
  if (surface.Normals.empty() || surface.IsRound())
  {
    return geometric;
  }
  const std::array<glm::vec3, 3> normals = surface.GetNormals(hit.Primitive, surface.Normals);
  const glm::dvec3 sum = (1.0 - hit.U - hit.V) * glm::dvec3(normals[0]) +
    double(hit.U) * glm::dvec3(normals[1]) + double(hit.V) * glm::dvec3(normals[2]);
  const double length = glm::length(sum);
  const double cosine = glm::dot(sum, geometric) / length;
  const bool isTangential = !(std::abs(cosine) > MinimumSmoothCosine);
  return isTangential || std::abs(cosine) > FlatSmoothCosine
    ? geometric
    : std::copysign(1.0 / length, cosine) * sum;
}

}
