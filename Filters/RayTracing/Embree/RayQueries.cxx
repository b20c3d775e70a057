// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The queries of RayScene.
#include "CoincidentSurfaces.h"
#include "EmbreeQuery.h"
#include "InstanceGeometry.h"
#include "PlanarCells.h"
#include "RayScene.h"
#include "RayTriangle.h"
#include "RoundIntersection.h"
#include "SliverTree.h"
#include "Surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace penumbra
{
namespace
{

/// If the hit distances in single and double precision differ by more than this relative error, the
/// triangle is an edge-on sliver, and the distance of Embree is kept.
constexpr double SliverError = 1e-3;

static_assert(
  RTC_INVALID_GEOMETRY_ID == Hit::None, "Hit::None must be Embree's invalid geometry id");

/// Larger coordinates of rays fail an assertion in Embree.
constexpr float LargestCoordinate = 1.8e18f;

inline float SumSizes(glm::vec3 v)
{
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// Returns true if the ray is finite, has a direction and is not empty. Other rays are not passed
/// to Embree.
bool IsTraceable(const Ray& ray)
{
  // The comparisons are false for NaN.
  const float size = SumSizes(ray.Direction);
  return SumSizes(ray.Origin) <= LargestCoordinate && size <= LargestCoordinate && size > 0.f &&
    ray.Near >= 0.f && ray.Near <= ray.Far;
}

/// Slope of a turned ray. It exceeds the rounding errors of Embree, so that the ray does not touch an edge.
constexpr float PlaneSlope = 5e-7f;

bool IsInCoordinatePlane(const Ray& ray)
{
  return ray.Direction.x == 0.f || ray.Direction.y == 0.f || ray.Direction.z == 0.f;
}

/// Returns the direction that is passed to Embree. Whether Embree finds a triangle with an edge in the coordinate
/// plane of a ray depends on the other triangles in its boxes, which may end there. Such a ray is turned toward the
/// center of the scene, so that it meets the outermost triangles.
inline glm::vec3 TurnFromPlanes(const Ray& ray, glm::vec3 center)
{
  glm::vec3 direction = ray.Direction;
  if (IsInCoordinatePlane(ray))
  {
    const float slope = PlaneSlope * SumSizes(direction);
    const glm::vec3 toCenter = center - ray.Origin;
    direction.x = direction.x == 0.f ? std::copysign(slope, toCenter.x) : direction.x;
    direction.y = direction.y == 0.f ? std::copysign(slope, toCenter.y) : direction.y;
    direction.z = direction.z == 0.f ? std::copysign(slope, toCenter.z) : direction.z;
  }
  return direction;
}

/// Copies a ray to the ray `i` of a packet of `size` rays of Embree, which may be 1.
void Fill(void* packet, unsigned int size, unsigned int i, const Ray& ray, glm::vec3 center)
{
  auto* const to = static_cast<RTCRayN*>(packet);
  const glm::vec3 direction = TurnFromPlanes(ray, center);
  RTCRayN_org_x(to, size, i) = ray.Origin.x;
  RTCRayN_org_y(to, size, i) = ray.Origin.y;
  RTCRayN_org_z(to, size, i) = ray.Origin.z;
  RTCRayN_tnear(to, size, i) = ray.Near;
  RTCRayN_dir_x(to, size, i) = direction.x;
  RTCRayN_dir_y(to, size, i) = direction.y;
  RTCRayN_dir_z(to, size, i) = direction.z;
  RTCRayN_time(to, size, i) = 0.f;
  RTCRayN_tfar(to, size, i) = ray.Far;
  RTCRayN_mask(to, size, i) = 0xffffffffu;
  RTCRayN_id(to, size, i) = i;
  RTCRayN_flags(to, size, i) = 0;
}

/// Finds the triangles of a surface that share a hit at an edge or vertex: those with an edge that the ray
/// meets at the same point, or at points that others of them share, whichever of them Embree returns.
class EdgeHits
{
public:
  EdgeHits(const RayScene& rays, const Ray& ray, std::uint32_t surface)
    : Rays(rays),
      Mesh(rays.GetSurfaces()[surface]),
      TracedRay(ray),
      Direction(ray.Direction),
      SquaredLength(glm::dot(this->Direction, this->Direction)),
      Surface(surface)
  {
  }

  /// Returns the lowest triangle that shares the hit `exact` of `triangle`.
  std::uint32_t FindLowest(std::uint32_t triangle, const RayTriangle& exact);

private:
  /// Distance between points that are the same one, and of the triangles near it, in units of
  /// RayTriangle::EdgeTolerance.
  static constexpr double SamePoint = 4.0;
  static constexpr double NearPoint = 6.0;
  /// Further points of a hit are not visited.
  static constexpr int MaximumPoints = 32;

  /// Calls visit(t) with the distance along the ray of each edge that the ray meets.
  template <typename OnEdge>
  void VisitEdges(std::uint32_t triangle, double tolerance, const OnEdge& visit) const;
  /// Adds a point of the ray, unless it was added before.
  void AddPoint(double distance, double tolerance);
  /// Tests the triangles near a point of the ray.
  void Visit(double distance, double tolerance, std::uint32_t triangle);
  /// Includes a triangle if it shares the hit at a point of the ray.
  void Test(std::uint32_t triangle, double distance);

  const RayScene& Rays;
  const penumbra::Surface& Mesh;
  const Ray& TracedRay;
  const glm::dvec3 Direction;
  const double SquaredLength;
  const std::uint32_t Surface;
  std::uint32_t Lowest = 0;
  double Points[MaximumPoints]; ///< distances along the ray
  int Count = 0;
};

template <typename OnEdge>
void EdgeHits::VisitEdges(std::uint32_t triangle, double tolerance, const OnEdge& visit) const
{
  const std::array<glm::vec3, 3> points = this->Mesh.GetPoints(triangle);
  const glm::dvec3 origin(this->TracedRay.Origin);
  glm::dvec3 projected[3];
  double distances[3];
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3 p = glm::dvec3(points[i]) - origin;
    distances[i] = glm::dot(p, this->Direction) / this->SquaredLength;
    projected[i] = p - distances[i] * this->Direction;
  }
  for (int i = 0; i < 3; ++i)
  {
    // In the same order in both triangles of an edge.
    int from = i;
    int to = (i + 1) % 3;
    const glm::vec3& a = points[from];
    const glm::vec3& b = points[to];
    if (std::tie(a.x, a.y, a.z) > std::tie(b.x, b.y, b.z))
    {
      std::swap(from, to);
    }
    const glm::dvec3 edge = projected[to] - projected[from];
    const double square = glm::dot(edge, edge);
    const double at =
      square > 0.0 ? std::clamp(-glm::dot(projected[from], edge) / square, 0.0, 1.0) : 0.0;
    const glm::dvec3 nearest = projected[from] + at * edge;
    if (glm::dot(nearest, nearest) < tolerance * tolerance)
    {
      visit(distances[from] + at * (distances[to] - distances[from]));
    }
  }
}

void EdgeHits::AddPoint(double distance, double tolerance)
{
  const double* const end = this->Points + this->Count;
  const double same = 0.01 * tolerance / std::sqrt(this->SquaredLength);
  if (this->Count < MaximumPoints && std::none_of<const double*>(this->Points, end, [=](double d) {
        return std::abs(d - distance) <= same;
      }))
  {
    this->Points[this->Count++] = distance;
  }
}

void EdgeHits::Test(std::uint32_t triangle, double distance)
{
  const RayTriangle exact(this->Mesh, triangle, this->TracedRay);
  if (!exact.IsValid || !exact.IsOnEdge ||
    !(exact.IsFront ? this->Mesh.Frontfaces : this->Mesh.Backfaces) ||
    !(exact.Distance >= this->TracedRay.Near && exact.Distance <= this->TracedRay.Far))
  {
    return;
  }
  const double same = SamePoint * exact.EdgeTolerance / std::sqrt(this->SquaredLength);
  bool isShared = false;
  this->VisitEdges(triangle, exact.EdgeTolerance,
    [&](double at) { isShared = isShared || std::abs(at - distance) <= same; });
  if (isShared)
  {
    this->Lowest = std::min(this->Lowest, triangle);
    this->VisitEdges(
      triangle, exact.EdgeTolerance, [&](double at) { this->AddPoint(at, exact.EdgeTolerance); });
  }
}

void EdgeHits::Visit(double distance, double tolerance, std::uint32_t triangle)
{
  const glm::vec3 point(glm::dvec3(this->TracedRay.Origin) + distance * this->Direction);
  const double radius = NearPoint * tolerance;
  if (const SliverTree* slivers = this->Rays.GetSlivers(this->Surface))
  {
    slivers->VisitNear(
      glm::dvec3(point), radius, [&](std::uint32_t near) { this->Test(near, distance); });
    return;
  }
  struct Context
  {
    EdgeHits& Hits;
    const double Distance;
    const PlanarCells* Cells;
    std::uint32_t First; ///< triangle of the surface that is the first one of the BVH
  } context{ *this, distance, this->Rays.GetCells(this->Surface), 0 };
  RTCPointQuery query{ point.x, point.y, point.z, 0.f, static_cast<float>(radius) };
  RTCScene tree = this->Rays.GetTree();
  if (this->Mesh.Instances)
  {
    const std::size_t instance = this->Mesh.GetInstance(triangle);
    const InstanceFrame frame(*this->Mesh.Instances, instance);
    const glm::vec3 local(frame.ConvertPoint(glm::dvec3(point)));
    query = { local.x, local.y, local.z, 0.f, static_cast<float>(radius * frame.GetScale()) };
    context.First = static_cast<std::uint32_t>(instance * this->Mesh.Triangles.size());
    tree = this->Rays.GetShape(this->Surface);
  }
  // Called by Embree for each primitive near the point.
  const auto callback = [](RTCPointQueryFunctionArguments* args) {
    const auto& self = *static_cast<Context*>(args->userPtr);
    const auto test = [&](std::uint32_t near) {
      self.Hits.Test(near, self.Distance);
      return false;
    };
    if (self.Hits.Mesh.Instances)
    {
      test(self.First + args->primID);
    }
    else if (args->geomID == self.Hits.Surface && self.Cells)
    {
      self.Cells->VisitTriangles(args->primID, test);
    }
    else if (args->geomID == self.Hits.Surface)
    {
      test(args->primID);
    }
    return false;
  };
  RTCPointQueryContext queryContext;
  rtcInitPointQueryContext(&queryContext);
  rtcPointQuery(tree, &query, &queryContext, callback, &context);
}

std::uint32_t EdgeHits::FindLowest(std::uint32_t triangle, const RayTriangle& exact)
{
  this->Lowest = triangle;
  this->VisitEdges(triangle, exact.EdgeTolerance,
    [&](double distance) { this->AddPoint(distance, exact.EdgeTolerance); });
  for (int i = 0; i < this->Count; ++i)
  {
    this->Visit(this->Points[i], exact.EdgeTolerance, triangle);
  }
  return this->Lowest;
}

/// Computes the hit of a ray again that was turned.
void RecomputeRoundHit(const RoundShape& shape, const Ray& ray, Hit& hit)
{
  const glm::dvec3 origin(ray.Origin);
  const glm::dvec3 direction(ray.Direction);
  if (const RoundIntersection range(shape, origin, direction); range.IsHit)
  {
    const double distance = range.FindNearest(hit.Distance);
    hit.Distance = static_cast<float>(distance);
    hit.U = static_cast<float>(TouchingSphere(shape, origin + distance * direction).U);
  }
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
Hit MakeHit(const RayScene& rays, const Ray& ray, const Hit& embreeHit, CandidateHits* candidates)
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
  const Surface& surface = rays.GetSurfaces()[hit.Surface];
  if (surface.IsRound())
  {
    if (IsInCoordinatePlane(ray))
    {
      RecomputeRoundHit(surface.GetRoundShape(hit.Primitive), ray, hit);
    }
    hit.NextNear = MakeNextNear(hit.Distance, resolved.NextNear);
    return hit;
  }
  RayTriangle exact(surface, hit.Primitive, ray);
  // The recomputed hit of an edge-on sliver is unreliable; the hit of Embree is kept.
  if (exact.IsValid &&
    std::abs(exact.Distance - resolved.Distance) <= SliverError * std::abs(exact.Distance))
  {
    if (exact.IsOnEdge)
    {
      hit.Primitive = EdgeHits(rays, ray, hit.Surface).FindLowest(hit.Primitive, exact);
      exact = RayTriangle(surface, hit.Primitive, ray);
    }
    const double u = std::clamp(exact.U, 0.0, 1.0);
    hit.U = static_cast<float>(u);
    hit.V = static_cast<float>(std::clamp(exact.V, 0.0, 1.0 - u));
    hit.Distance = static_cast<float>(exact.Distance);
  }
  hit.NextNear = MakeNextNear(hit.Distance, resolved.NextNear);
  return hit;
}

/// Copies rays to a packet and marks the valid ones.
template <unsigned int Size>
void Fill(void* packet, int* valid, const Ray* rays, glm::vec3 center)
{
  for (unsigned int i = 0; i < Size; ++i)
  {
    valid[i] = IsTraceable(rays[i]) ? -1 : 0;
    Fill(packet, Size, i, rays[i], center);
  }
}

/// Computes the nearest hits of a packet of rays.
template <typename Packet, int Size>
void IntersectPacket(const RayScene& scene, const Ray* rays, Hit* hits)
{
  CandidateHits candidates[Size];
  CandidateHits* const collected = scene.GetCoincidentSurfaces().IsEmpty() ? nullptr : candidates;
  alignas(64) int valid[Size];
  alignas(64) Packet query;
  Fill<Size>(&query.ray, valid, rays, scene.GetCoincidentSurfaces().GetCenter());
  for (int i = 0; i < Size; ++i)
  {
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    candidates[i].Far = rays[i].Far;
  }
  Query(true, collected).Intersect(scene.GetTree(), valid, query);
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
      hits[i] = MakeHit(scene, rays[i], hits[i], collected ? collected + i : nullptr);
    }
  }
}

/// Computes the occlusion of a packet of rays; Embree sets tfar of occluded rays to -infinity.
template <typename Packet, int Size>
void OccludedPacket(const RayScene& scene, const Ray* rays, bool* occluded)
{
  alignas(64) int valid[Size];
  alignas(64) Packet query;
  Fill<Size>(&query, valid, rays, scene.GetCoincidentSurfaces().GetCenter());
  Query(false).Occluded(scene.GetTree(), valid, query);
  for (int i = 0; i < Size; ++i)
  {
    occluded[i] = valid[i] != 0 && query.tfar[i] < 0.f;
  }
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
  Fill(&query.ray, 1, 0, ray, this->Coincident->GetCenter());
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
    hit = MakeHit(*this, ray, hit, collected);
    return hit.IsHit();
  }
  return true;
}

void RayScene::Intersect16(const Ray* rays, Hit* hits) const
{
  if (this->TracesPackets16)
  {
    IntersectPacket<RTCRayHit16, 16>(*this, rays, hits);
    return;
  }
  // Without native support for 16 rays, Embree would trace them one by one.
  IntersectPacket<RTCRayHit8, 8>(*this, rays, hits);
  IntersectPacket<RTCRayHit8, 8>(*this, rays + 8, hits + 8);
}

void RayScene::Intersect8(const Ray* rays, Hit* hits) const
{
  IntersectPacket<RTCRayHit8, 8>(*this, rays, hits);
}

void RayScene::Occluded16(const Ray* rays, bool* occluded) const
{
  if (this->TracesPackets16)
  {
    OccludedPacket<RTCRay16, 16>(*this, rays, occluded);
    return;
  }
  OccludedPacket<RTCRay8, 8>(*this, rays, occluded);
  OccludedPacket<RTCRay8, 8>(*this, rays + 8, occluded + 8);
}

void RayScene::Occluded8(const Ray* rays, bool* occluded) const
{
  OccludedPacket<RTCRay8, 8>(*this, rays, occluded);
}

bool RayScene::Occluded(const Ray& ray) const
{
  if (!IsTraceable(ray))
  {
    return false;
  }
  RTCRay query;
  Fill(&query, 1, 0, ray, this->Coincident->GetCenter());
  Query(false).Occluded(this->EmbreeScene, query);
  return query.tfar < 0.f;
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
  while (hit.IsHit() && rays.GetSurfaces()[hit.Surface].IsLineOrPoint)
  {
    ray = ContinueBehind(ray, hit);
    hit = rays.Intersect(ray);
  }
  return hit;
}

}
