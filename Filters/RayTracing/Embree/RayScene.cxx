// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RayScene.h"

#include "BoxOverlap.h"
#include "CoincidentSurfaces.h"
#include "EmbreeQuery.h"
#include "InstanceGeometry.h"
#include "PlanarCells.h"
#include "RayTriangle.h"
#include "RoundGeometry.h"
#include "RoundIntersection.h"
#include "Scene.h"
#include "SliverTree.h"
#include "Surface.h"
#include "TriangleGeometry.h"

#include <algorithm>
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

/// If the hit distances in single and double precision differ by more than this relative error, the
/// triangle is an edge-on sliver, and the distance of Embree is kept.
constexpr double SliverError = 1e-3;
/// Bound of the distance between the hits of two triangles that share an edge, in units of
/// RayTriangle::EdgeTolerance; large for triangles at grazing incidence.
constexpr double EdgeHitTolerance = 64.0;

/// Interpolated normals with a smaller cosine to the geometric normal are ignored.
constexpr double MinimumSmoothCosine = 0.1;
/// Interpolated normals with a larger one are equal to it up to rounding.
constexpr double FlatSmoothCosine = 1.0 - 1e-6;

static_assert(
  RTC_INVALID_GEOMETRY_ID == Hit::None, "Hit::None must be Embree's invalid geometry id");

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

std::size_t CountPrimitives(const Scene& scene)
{
  std::size_t count = 0;
  for (const Surface& surface : scene.Surfaces)
  {
    count += surface.Instances ? surface.Triangles.size() + surface.Instances->GetCount()
                               : surface.GetNumberOfPrimitives();
  }
  return count;
}

/// Larger coordinates of rays fail an assertion in Embree.
constexpr float LargestCoordinate = 1.8e18f;

/// Returns true if the ray is finite, has a direction and is not empty. Other rays are not passed
/// to Embree.
bool IsTraceable(const Ray& ray)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    // The comparisons are false for NaN.
    if (!(std::abs(ray.Origin[axis]) <= LargestCoordinate &&
          std::abs(ray.Direction[axis]) <= LargestCoordinate))
    {
      return false;
    }
  }
  return ray.Near >= 0.f && ray.Near <= ray.Far && ray.Direction != glm::vec3(0.f);
}

void Fill(RTCRay& to, const Ray& from)
{
  to.org_x = from.Origin.x;
  to.org_y = from.Origin.y;
  to.org_z = from.Origin.z;
  to.tnear = from.Near;
  to.dir_x = from.Direction.x;
  to.dir_y = from.Direction.y;
  to.dir_z = from.Direction.z;
  to.time = 0.f;
  to.tfar = from.Far;
  to.mask = 0xffffffffu;
  to.id = 0;
  to.flags = 0;
}

/// Query for the triangle of a surface with the lowest index among those that share a hit at an
/// edge or vertex.
struct EdgeHitQuery
{
  const Scene& TracedScene;
  const Ray& TracedRay;
  const PlanarCells* Cells;        ///< of the surface, or null
  const RayTriangle& Intersection; ///< the hit
  Hit Lowest;                      ///< surface and lowest primitive so far
  std::uint32_t First = 0;         ///< triangle of the surface that is the first one of the BVH

  /// Tests a triangle near the hit.
  void Test(std::uint32_t triangle);

  /// Called by Embree for each triangle near the hit.
  static bool Callback(RTCPointQueryFunctionArguments* args);
};

void EdgeHitQuery::Test(std::uint32_t triangle)
{
  if (triangle >= this->Lowest.Primitive)
  {
    return;
  }
  const Surface& surface = this->TracedScene.Surfaces[this->Lowest.Surface];
  const RayTriangle other(surface, triangle, this->TracedRay);
  const bool isHit = other.IsValid && other.EdgeDistance > -other.EdgeTolerance &&
    (other.IsFront ? surface.Frontfaces : surface.Backfaces);
  if (isHit && other.Distance >= this->TracedRay.Near && other.Distance <= this->TracedRay.Far &&
    std::abs(other.Distance - this->Intersection.Distance) *
        glm::length(this->TracedRay.Direction) <=
      EdgeHitTolerance * this->Intersection.EdgeTolerance)
  {
    this->Lowest.Primitive = triangle;
  }
}

bool EdgeHitQuery::Callback(RTCPointQueryFunctionArguments* args)
{
  EdgeHitQuery& self = *static_cast<EdgeHitQuery*>(args->userPtr);
  if (self.TracedScene.Surfaces[self.Lowest.Surface].Instances)
  {
    self.Test(self.First + args->primID);
  }
  else if (args->geomID == self.Lowest.Surface && self.Cells)
  {
    self.Cells->VisitTriangles(args->primID, [&](std::uint32_t triangle) {
      self.Test(triangle);
      return false;
    });
  }
  else if (args->geomID == self.Lowest.Surface)
  {
    self.Test(args->primID);
  }
  return false;
}

/// Returns the lowest triangle that shares the hit `exact` at an edge or vertex.
std::uint32_t FindLowestTriangle(
  const RayScene& rays, RTCScene tree, const Ray& ray, const RayTriangle& exact, const Hit& hit)
{
  EdgeHitQuery edge{ rays.GetScene(), ray, rays.GetCells(hit.Surface), exact, hit };
  const glm::vec3 point(glm::dvec3(ray.Origin) + exact.Distance * glm::dvec3(ray.Direction));
  const double radius = 4.0 * exact.EdgeTolerance;
  if (const SliverTree* slivers = rays.GetSlivers(hit.Surface))
  {
    slivers->VisitNear(
      glm::dvec3(point), radius, [&](std::uint32_t triangle) { edge.Test(triangle); });
    return edge.Lowest.Primitive;
  }
  RTCPointQuery query{ point.x, point.y, point.z, 0.f, static_cast<float>(radius) };
  const Surface& surface = rays.GetScene().Surfaces[hit.Surface];
  if (surface.Instances)
  {
    const std::size_t instance = surface.GetInstance(hit.Primitive);
    const InstanceFrame frame(*surface.Instances, instance);
    const glm::vec3 local(frame.ConvertPoint(glm::dvec3(point)));
    query = { local.x, local.y, local.z, 0.f, static_cast<float>(radius * frame.GetScale()) };
    edge.First = static_cast<std::uint32_t>(instance * surface.Triangles.size());
    tree = rays.GetShape(hit.Surface);
  }
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(tree, &query, &context, EdgeHitQuery::Callback, &edge);
  return edge.Lowest.Primitive;
}

/// Returns a distance a few units in the last place behind both arguments.
float MakeNextNear(float distance, float farthestCoincident)
{
  const float farther = std::max(distance, farthestCoincident);
  return farther + std::max(std::abs(farther) * 4e-7f, 1e-30f);
}

/// Converts a hit of Embree to a hit that does not depend on the instruction set: resolves
/// coincident surfaces, recomputes the hit in double precision, and selects the lowest triangle at
/// an edge.
Hit MakeHit(const RayScene& rays, RTCScene tree, const Ray& ray, const Hit& embreeHit,
  CandidateHits* candidates)
{
  Hit resolved = embreeHit;
  resolved.NextNear = resolved.Distance;
  if (candidates && candidates->Count > 0)
  {
    resolved = rays.GetCoincidentSurfaces().Resolve(ray, embreeHit, *candidates);
    if (!resolved.IsHit())
    {
      return resolved;
    }
  }
  Hit hit = resolved;
  const Scene& scene = rays.GetScene();
  if (scene.Surfaces[hit.Surface].IsRound())
  {
    hit.NextNear = MakeNextNear(hit.Distance, resolved.NextNear);
    return hit;
  }
  RayTriangle exact(scene.Surfaces[hit.Surface], hit.Primitive, ray);
  // The recomputed hit of an edge-on sliver is unreliable; the hit of Embree is kept.
  if (exact.IsValid &&
    std::abs(exact.Distance - resolved.Distance) <= SliverError * std::abs(exact.Distance))
  {
    if (exact.IsOnEdge())
    {
      hit.Primitive = FindLowestTriangle(rays, tree, ray, exact, hit);
      exact = RayTriangle(scene.Surfaces[hit.Surface], hit.Primitive, ray);
    }
    const double u = std::clamp(exact.U, 0.0, 1.0);
    hit.U = static_cast<float>(u);
    hit.V = static_cast<float>(std::clamp(exact.V, 0.0, 1.0 - u));
    hit.Distance = static_cast<float>(exact.Distance);
  }
  hit.NextNear = MakeNextNear(hit.Distance, resolved.NextNear);
  return hit;
}

/// Copies rays to an Embree packet of `Size` rays and marks the valid ones.
template <int Size, typename Packet>
void Fill(Packet& to, int* valid, const Ray* rays)
{
  for (int i = 0; i < Size; ++i)
  {
    const Ray& ray = rays[i];
    valid[i] = IsTraceable(ray) ? -1 : 0;
    to.org_x[i] = ray.Origin.x;
    to.org_y[i] = ray.Origin.y;
    to.org_z[i] = ray.Origin.z;
    to.tnear[i] = ray.Near;
    to.dir_x[i] = ray.Direction.x;
    to.dir_y[i] = ray.Direction.y;
    to.dir_z[i] = ray.Direction.z;
    to.time[i] = 0.f;
    to.tfar[i] = ray.Far;
    to.mask[i] = 0xffffffffu;
    to.id[i] = static_cast<unsigned int>(i);
    to.flags[i] = 0;
  }
}

/// Computes the nearest hits of a packet of rays.
template <typename Packet, int Size>
void IntersectPacket(const RayScene& scene, RTCScene tree, const Ray* rays, Hit* hits)
{
  CandidateHits candidates[Size];
  CandidateHits* const collected = scene.GetCoincidentSurfaces().IsEmpty() ? nullptr : candidates;
  alignas(64) int valid[Size];
  alignas(64) Packet query;
  Fill<Size>(query.ray, valid, rays);
  for (int i = 0; i < Size; ++i)
  {
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    candidates[i].Far = rays[i].Far;
  }
  Query(true, collected).Intersect(tree, valid, query);
  for (int i = 0; i < Size; ++i)
  {
    hits[i] = Hit();
    if (query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
    {
      hits[i].Surface = query.hit.geomID[i];
      hits[i].Primitive = query.hit.primID[i];
      hits[i].U = query.hit.u[i];
      hits[i].V = query.hit.v[i];
      hits[i].Distance = query.ray.tfar[i];
      hits[i] = MakeHit(scene, tree, rays[i], hits[i], collected ? collected + i : nullptr);
    }
  }
}

/// Computes the occlusion of a packet of rays; Embree sets tfar of occluded rays to -infinity.
template <typename Packet, int Size>
void OccludedPacket(RTCScene tree, const Ray* rays, bool* occluded)
{
  alignas(64) int valid[Size];
  alignas(64) Packet query;
  Fill<Size>(query, valid, rays);
  Query(false).Occluded(tree, valid, query);
  for (int i = 0; i < Size; ++i)
  {
    occluded[i] = valid[i] != 0 && query.tfar[i] < 0.f;
  }
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
    Coincident(std::make_unique<CoincidentSurfaces>(scene)),
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
    flags |= CountPrimitives(scene) < MinimumCompactTriangles ? 0 : RTC_SCENE_FLAG_COMPACT;
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
  traced.Data = &this->TracedScene.Surfaces[surface];
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

Hit RayScene::Intersect(const Ray& ray) const
{
  Ray rest = ray;
  Hit hit;
  while (IsTraceable(rest) && !this->IntersectOnce(rest, hit))
  {
    // All surfaces up to CoincidentFar are to be skipped.
    rest.Near = MakeNextNear(rest.CoincidentFar, rest.Near);
    rest.FirstInOrder = 0;
  }
  return hit;
}

bool RayScene::IntersectOnce(const Ray& ray, Hit& hit) const
{
  hit = Hit();
  RTCRayHit query;
  Fill(query.ray, ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  CandidateHits candidates;
  candidates.Far = ray.Far;
  CandidateHits* const collected = this->Coincident->IsEmpty() ? nullptr : &candidates;
  Query(false, collected).Intersect(this->EmbreeScene, query);
  if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID)
  {
    hit.Surface = query.hit.geomID;
    hit.Primitive = query.hit.primID;
    hit.U = query.hit.u;
    hit.V = query.hit.v;
    hit.Distance = query.ray.tfar;
    hit = MakeHit(*this, this->EmbreeScene, ray, hit, collected);
    return hit.IsHit();
  }
  return true;
}

void RayScene::Intersect16(const Ray* rays, Hit* hits) const
{
  if (this->TracesPackets16)
  {
    IntersectPacket<RTCRayHit16, 16>(*this, this->EmbreeScene, rays, hits);
    return;
  }
  // Without native support for 16 rays, Embree would trace them one by one.
  IntersectPacket<RTCRayHit8, 8>(*this, this->EmbreeScene, rays, hits);
  IntersectPacket<RTCRayHit8, 8>(*this, this->EmbreeScene, rays + 8, hits + 8);
}

void RayScene::Intersect8(const Ray* rays, Hit* hits) const
{
  IntersectPacket<RTCRayHit8, 8>(*this, this->EmbreeScene, rays, hits);
}

void RayScene::Occluded16(const Ray* rays, bool* occluded) const
{
  if (this->TracesPackets16)
  {
    OccludedPacket<RTCRay16, 16>(this->EmbreeScene, rays, occluded);
    return;
  }
  OccludedPacket<RTCRay8, 8>(this->EmbreeScene, rays, occluded);
  OccludedPacket<RTCRay8, 8>(this->EmbreeScene, rays + 8, occluded + 8);
}

bool RayScene::Occluded(const Ray& ray) const
{
  if (!IsTraceable(ray))
  {
    return false;
  }
  RTCRay query;
  Fill(query, ray);
  Query(false).Occluded(this->EmbreeScene, query);
  return query.tfar < 0.f;
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
  const Surface& surface = this->TracedScene.Surfaces[hit.Surface];
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
  const Surface& surface = this->TracedScene.Surfaces[hit.Surface];
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

Ray ContinueBehind(Ray ray, const Hit& hit)
{
  ray.FirstInOrder = hit.NextInOrder;
  ray.CoincidentFar = hit.NextNear;
  ray.Near = hit.NextInOrder > 0 ? hit.CoincidentNear : hit.NextNear;
  return ray;
}

Hit SkipLinesAndPoints(const RayScene& rays, Ray ray, Hit hit)
{
  while (hit.IsHit() && rays.GetScene().Surfaces[hit.Surface].IsLineOrPoint)
  {
    ray = ContinueBehind(ray, hit);
    hit = rays.Intersect(ray);
  }
  return hit;
}

}
