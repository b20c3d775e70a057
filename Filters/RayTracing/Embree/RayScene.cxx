// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RayScene.h"

#include "CoincidentSurfaces.h"
#include "EmbreeQuery.h"
#include "RayTriangle.h"

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

/// What filters know of a surface.
struct TracedSurface
{
  const Surface* Data;
  float DepthTolerance;
};

namespace
{

/// From so many triangles on memory counts more than the 10 to 20 percent of speed that Embree's
/// compact trees cost: 10 million take 2.5 times less.
constexpr std::size_t CompactFrom = 2000000;

/// Where single and double precision differ by more, relatively, the triangle is an edge-on sliver.
constexpr double SliverError = 1e-3;
/// How far apart, in slacks of single precision, a ray may meet two triangles of one edge: those that
/// it grazes.
constexpr double EdgeHitTolerance = 64.0;

static_assert(RTC_INVALID_GEOMETRY_ID == Hit::None, "a miss of Embree's is a miss of ours");
static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12, "Embree reads our arrays");

/// Drops hits of culled sides, and lets a ray go on as far as what it met may be contested.
void IntersectFilter(const RTCFilterFunctionNArguments* args)
{
  const auto& traced = *static_cast<const TracedSurface*>(args->geometryUserPtr);
  CandidateHits* contending = static_cast<QueryContext*>(args->context)->Contending;
  for (unsigned int i = 0; i < args->N; ++i)
  {
    const glm::vec3 direction(RTCRayN_dir_x(args->ray, args->N, i),
      RTCRayN_dir_y(args->ray, args->N, i), RTCRayN_dir_z(args->ray, args->N, i));
    const glm::vec3 normal(RTCHitN_Ng_x(args->hit, args->N, i), RTCHitN_Ng_y(args->hit, args->N, i),
      RTCHitN_Ng_z(args->hit, args->N, i));
    const float facing = glm::dot(normal, direction);
    if (facing < 0.f ? !traced.Data->Frontfaces : !traced.Data->Backfaces)
    {
      args->valid[i] = 0;
    }
    else if (args->valid[i] != 0 && traced.DepthTolerance > 0.f)
    {
      const CandidateHit hit{ RTCHitN_geomID(args->hit, args->N, i),
        RTCHitN_primID(args->hit, args->N, i), RTCHitN_u(args->hit, args->N, i),
        RTCHitN_v(args->hit, args->N, i), RTCRayN_tfar(args->ray, args->N, i) };
      const float reach = traced.DepthTolerance / glm::length(direction);
      CandidateHits& contenders = contending[RTCRayN_id(args->ray, args->N, i)];
      RTCRayN_tfar(args->ray, args->N, i) =
        std::min(contenders.Add(hit, reach) + reach, contenders.Far);
    }
  }
}

/// Of lines and points: they block no light.
void RejectAllFilter(const RTCFilterFunctionNArguments* args)
{
  std::fill_n(args->valid, args->N, 0);
}

/// Hands `data` to Embree where it may read 16 bytes from the last element on, else a copy.
template <typename T>
void SetBuffer(
  RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& data)
{
  if (data.capacity() > data.size())
  {
    rtcSetSharedGeometryBuffer(geometry, type, 0, format, data.data(), 0, sizeof(T), data.size());
    return;
  }
  void* copy = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), data.size());
  if (!copy)
  {
    throw std::bad_alloc();
  }
  std::copy(data.begin(), data.end(), static_cast<T*>(copy));
}

RTCGeometry MakeGeometry(RTCDevice device, TracedSurface& traced)
{
  const Surface& surface = *traced.Data;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  SetBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, surface.Positions);
  SetBuffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, surface.Triangles);
  rtcSetGeometryUserData(geometry, &traced);
  if (!surface.Frontfaces || !surface.Backfaces || traced.DepthTolerance > 0.f)
  {
    rtcSetGeometryIntersectFilterFunction(geometry, IntersectFilter);
  }
  if (surface.IsLineOrPoint)
  {
    rtcSetGeometryOccludedFilterFunction(geometry, RejectAllFilter);
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

/// Embree's errors as exceptions.
void Check(RTCDevice device)
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

/// Builds the tree; Embree asks now and then, on any of its threads, whether to go on.
void Commit(RTCScene tree, RTCDevice device, const ProgressCallback& progress)
{
  struct Watch
  {
    const ProgressCallback& Progress;
    std::thread::id Caller;
    std::atomic<bool> Stops{ false };
  };
  Watch watch{ progress, std::this_thread::get_id() };
  if (progress)
  {
    const auto goesOn = [](void* data, double) {
      auto& self = *static_cast<Watch*>(data);
      if (!self.Stops && std::this_thread::get_id() == self.Caller && self.Progress(0.0))
      {
        self.Stops = true;
      }
      return !self.Stops;
    };
    rtcSetSceneProgressMonitorFunction(tree, goesOn, &watch);
  }
  rtcCommitScene(tree);
  rtcSetSceneProgressMonitorFunction(tree, nullptr, nullptr);
  if (watch.Stops)
  {
    throw Stopped();
  }
  Check(device);
}

/// $PENUMBRA_EMBREE adds settings of Embree's own, such as isa=sse4.2: for tests.
std::string DeviceSettings(int threads)
{
  const char* more = std::getenv("PENUMBRA_EMBREE");
  return "threads=" + std::to_string(threads) + (more ? std::string(",") + more : "");
}

std::size_t CountTriangles(const Scene& scene)
{
  std::size_t count = 0;
  for (const Surface& surface : scene.Surfaces)
  {
    count += surface.Triangles.size();
  }
  return count;
}

/// Coordinates of rays from here on end Embree by an assertion.
constexpr float LargestCoordinate = 1.8e18f;

/// All that reaches Embree: what is no ray (not finite, without direction, or empty) meets nothing.
bool IsTraceable(const Ray& ray)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    // Comparisons with NaN are false.
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

/// The lowest triangle of a surface, by number, of those that meet a ray in the same place.
struct EdgeHitQuery
{
  const Scene& TracedScene;
  const Ray& TracedRay;
  const RayTriangle& Met; ///< the place
  Hit Lowest;             ///< its Surface and Triangle

  /// Embree's call for a triangle near the place.
  static bool Callback(RTCPointQueryFunctionArguments* args);
};

bool EdgeHitQuery::Callback(RTCPointQueryFunctionArguments* args)
{
  EdgeHitQuery& self = *static_cast<EdgeHitQuery*>(args->userPtr);
  if (args->geomID != self.Lowest.Surface || args->primID >= self.Lowest.Triangle)
  {
    return false;
  }
  const Surface& surface = self.TracedScene.Surfaces[args->geomID];
  const RayTriangle other(surface, args->primID, self.TracedRay);
  const bool isMet = other.IsValid && other.EdgeDistance > -other.EdgeTolerance &&
    (other.IsFront ? surface.Frontfaces : surface.Backfaces);
  if (isMet && other.Distance >= self.TracedRay.Near && other.Distance <= self.TracedRay.Far &&
    std::abs(other.Distance - self.Met.Distance) * glm::length(self.TracedRay.Direction) <=
      EdgeHitTolerance * self.Met.EdgeTolerance)
  {
    self.Lowest.Triangle = args->primID;
  }
  return false;
}

/// What Embree found, made independent of the instructions that it chose: surfaces near each other
/// contend, the numbers follow from the triangle, and at an edge the triangle is chosen by rule.
Hit MakeHit(
  const RayScene& rays, RTCScene tree, const Ray& ray, const Hit& met, CandidateHits* contenders)
{
  Hit found = met;
  found.NextNear = found.Distance;
  if (contenders && contenders->Count > 0)
  {
    found = rays.GetContest().Resolve(ray, met, *contenders);
  }
  Hit hit = found;
  const Scene& scene = rays.GetScene();
  RayTriangle exact(scene.Surfaces[hit.Surface], hit.Triangle, ray);
  // Edge-on slivers say nothing: Embree's answer stands.
  if (exact.IsValid &&
    std::abs(exact.Distance - found.Distance) <= SliverError * std::abs(exact.Distance))
  {
    if (exact.IsOnEdge())
    {
      EdgeHitQuery tie{ scene, ray, exact, hit };
      const glm::vec3 place(glm::dvec3(ray.Origin) + exact.Distance * glm::dvec3(ray.Direction));
      RTCPointQuery query{ place.x, place.y, place.z, 0.f,
        static_cast<float>(4.0 * exact.EdgeTolerance) };
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      rtcPointQuery(tree, &query, &context, EdgeHitQuery::Callback, &tie);
      hit.Triangle = tie.Lowest.Triangle;
      exact = RayTriangle(scene.Surfaces[hit.Surface], hit.Triangle, ray);
    }
    const double u = std::clamp(exact.U, 0.0, 1.0);
    hit.U = static_cast<float>(u);
    hit.V = static_cast<float>(std::clamp(exact.V, 0.0, 1.0 - u));
    hit.Distance = static_cast<float>(exact.Distance);
  }
  const float farther = std::max(hit.Distance, found.NextNear);
  hit.NextNear = farther + std::max(std::abs(farther) * 4e-7f, 1e-30f);
  return hit;
}

/// Fills as many rays as Packet, one of Embree's structures, holds, and which of them to trace.
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

/// Nearest hits of a packet of rays.
template <typename Packet, int Size>
void IntersectPacket(const RayScene& scene, RTCScene tree, const Ray* rays, Hit* hits)
{
  CandidateHits contending[Size];
  CandidateHits* const asked = scene.GetContest().IsEmpty() ? nullptr : contending;
  alignas(64) int valid[Size];
  alignas(64) Packet query;
  Fill<Size>(query.ray, valid, rays);
  for (int i = 0; i < Size; ++i)
  {
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    contending[i].Far = rays[i].Far;
  }
  Query(true, asked).Intersect(tree, valid, query);
  for (int i = 0; i < Size; ++i)
  {
    hits[i] = Hit();
    if (query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
    {
      hits[i].Surface = query.hit.geomID[i];
      hits[i].Triangle = query.hit.primID[i];
      hits[i].U = query.hit.u[i];
      hits[i].V = query.hit.v[i];
      hits[i].Distance = query.ray.tfar[i];
      hits[i] = MakeHit(scene, tree, rays[i], hits[i], asked ? asked + i : nullptr);
    }
  }
}

/// Which rays of a packet meet anything: Embree answers with a negative end.
template <typename Packet, int Size>
void OccludedPacket(RTCScene tree, const Ray* rays, bool* blocked)
{
  alignas(64) int valid[Size];
  alignas(64) Packet query;
  Fill<Size>(query, valid, rays);
  Query(false).Occluded(tree, valid, query);
  for (int i = 0; i < Size; ++i)
  {
    blocked[i] = valid[i] != 0 && query.tfar[i] < 0.f;
  }
}

/// From 1 on.
std::uint64_t NextId()
{
  static std::atomic<std::uint64_t> last(0);
  return ++last;
}

}

RayScene::RayScene(const Scene& scene, int threads, const ProgressCallback& progress)
  : TracedScene(scene),
    Contesting(std::make_unique<CoincidentSurfaces>(scene)),
    Id(NextId())
{
  for (std::uint32_t i = 0; i < scene.Surfaces.size(); ++i)
  {
    this->Traced.push_back({ &scene.Surfaces[i], this->Contesting->DepthTolerance(i) });
  }
  this->Device = rtcNewDevice(DeviceSettings(threads).c_str());
  Check(this->Device);
  this->TracesPackets16 =
    rtcGetDeviceProperty(this->Device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  try
  {
    this->EmbreeScene = rtcNewScene(this->Device);
    rtcSetSceneFlags(this->EmbreeScene,
      CountTriangles(scene) < CompactFrom
        ? RTC_SCENE_FLAG_ROBUST
        : static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT));
    for (std::size_t i = 0; i < scene.Surfaces.size(); ++i)
    {
      if (!scene.Surfaces[i].Triangles.empty())
      {
        RTCGeometry geometry = MakeGeometry(this->Device, this->Traced[i]);
        rtcAttachGeometryByID(this->EmbreeScene, geometry, static_cast<unsigned int>(i));
        rtcReleaseGeometry(geometry);
      }
    }
    Commit(this->EmbreeScene, this->Device, progress);
  }
  catch (...)
  {
    this->Release();
    throw;
  }
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
  if (this->Device)
  {
    rtcReleaseDevice(this->Device);
  }
}

Hit RayScene::Intersect(const Ray& ray) const
{
  if (!IsTraceable(ray))
  {
    return {};
  }
  RTCRayHit query;
  Fill(query.ray, ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  CandidateHits contending;
  contending.Far = ray.Far;
  CandidateHits* const asked = this->Contesting->IsEmpty() ? nullptr : &contending;
  Query(false, asked).Intersect(this->EmbreeScene, query);
  Hit hit;
  if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID)
  {
    hit.Surface = query.hit.geomID;
    hit.Triangle = query.hit.primID;
    hit.U = query.hit.u;
    hit.V = query.hit.v;
    hit.Distance = query.ray.tfar;
    hit = MakeHit(*this, this->EmbreeScene, ray, hit, asked);
  }
  return hit;
}

void RayScene::Intersect16(const Ray* rays, Hit* hits) const
{
  if (this->TracesPackets16)
  {
    IntersectPacket<RTCRayHit16, 16>(*this, this->EmbreeScene, rays, hits);
    return;
  }
  // Without instructions for 16 Embree would trace one ray after the other.
  IntersectPacket<RTCRayHit8, 8>(*this, this->EmbreeScene, rays, hits);
  IntersectPacket<RTCRayHit8, 8>(*this, this->EmbreeScene, rays + 8, hits + 8);
}

void RayScene::Occluded16(const Ray* rays, bool* blocked) const
{
  if (this->TracesPackets16)
  {
    OccludedPacket<RTCRay16, 16>(this->EmbreeScene, rays, blocked);
    return;
  }
  OccludedPacket<RTCRay8, 8>(this->EmbreeScene, rays, blocked);
  OccludedPacket<RTCRay8, 8>(this->EmbreeScene, rays + 8, blocked + 8);
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

Hit SkipLinesAndPoints(const RayScene& rays, Ray ray, Hit hit)
{
  while (hit.IsHit() && rays.GetScene().Surfaces[hit.Surface].IsLineOrPoint)
  {
    ray.Near = hit.NextNear;
    hit = rays.Intersect(ray);
  }
  return hit;
}

}
