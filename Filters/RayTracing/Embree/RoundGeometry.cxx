// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceGeometry.h"

#include "RoundIntersection.h"
#include "Surface.h"
#include "Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace penumbra
{

namespace
{

/// A point is inside a joined tube if it is deeper than this fraction of the radius.
constexpr double JointDepth = 1e-6;

/// Surfaces of at least this number of spheres are grouped, as scenes of many triangles use Embree's
/// compact BVH.
constexpr std::size_t MinimumGroupedSpheres = 500000;
/// Number of spheres in a group (*measured* with a million random spheres and ambient occlusion: 2
/// take 37 bytes per sphere less than 1 and 10 % more time; 3 take 52 bytes less and 35 % more).
constexpr std::size_t SpheresPerGroup = 2;

/// Calls `function` with the index of each shape of a primitive of Embree.
template <typename Function>
void ForEachShape(const TracedSurface& traced, unsigned int primitive, const Function& function)
{
  if (traced.Order.empty())
  {
    function(primitive);
    return;
  }
  const std::size_t first = SpheresPerGroup * primitive;
  const std::size_t last = std::min(first + SpheresPerGroup, traced.Order.size());
  for (std::size_t i = first; i < last; ++i)
  {
    function(traced.Order[i]);
  }
}

/// Embree callback: bounds of the shapes of one primitive, rounded outwards.
void ComputeBounds(const RTCBoundsFunctionArguments* args)
{
  const TracedSurface& traced = GetTraced(args->geometryUserPtr);
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  glm::vec3 lowest(Infinity);
  glm::vec3 highest(-Infinity);
  ForEachShape(traced, args->primID, [&](std::uint32_t i) {
    const RoundShape shape = traced.Data->GetRoundShape(i);
    lowest = glm::min(lowest, glm::min(shape.A - shape.RadiusA, shape.B - shape.RadiusB));
    highest = glm::max(highest, glm::max(shape.A + shape.RadiusA, shape.B + shape.RadiusB));
  });
  float* const low = &args->bounds_o->lower_x;
  float* const high = &args->bounds_o->upper_x;
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = std::nextafter(lowest[axis], -Infinity);
    high[axis] = std::nextafter(highest[axis], Infinity);
  }
}

/// Returns the indices of points in the order of their Morton codes, so that consecutive ones are
/// near each other.
std::vector<std::uint32_t> SortByMortonCode(const std::vector<glm::vec3>& points)
{
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-low);
  for (const glm::vec3& p : points)
  {
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  const glm::dvec3 extent = high - low;
  const double size = std::max({ extent.x, extent.y, extent.z });
  const double scale = size > 0.0 ? 0x1fffff / size : 0.0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> codes;
  codes.reserve(points.size());
  for (const glm::vec3& p : points)
  {
    const glm::dvec3 cell = scale * (glm::dvec3(p) - low);
    codes.emplace_back(SpreadBits(static_cast<std::uint64_t>(cell.x)) |
        SpreadBits(static_cast<std::uint64_t>(cell.y)) << 1 |
        SpreadBits(static_cast<std::uint64_t>(cell.z)) << 2,
      static_cast<std::uint32_t>(codes.size()));
  }
  std::sort(codes.begin(), codes.end());
  std::vector<std::uint32_t> order;
  order.reserve(codes.size());
  for (const auto& code : codes)
  {
    order.push_back(code.second);
  }
  return order;
}

/// Returns true if `point` is inside the tube that is joined to tube `primitive` at one of its
/// ends.
bool IsInsideJoinedTube(const Surface& surface, std::uint32_t primitive, glm::dvec3 point)
{
  const auto isInside = [&](std::uint32_t other) {
    const TouchingSphere sphere(surface.GetRoundShape(other), point);
    return glm::distance(point, sphere.Center) < (1.0 - JointDepth) * sphere.Radius;
  };
  const std::vector<glm::uvec2>& segments = surface.Segments;
  return (primitive > 0 && segments[primitive - 1].y == segments[primitive].x &&
           isInside(primitive - 1)) ||
    (primitive + 1 < segments.size() && segments[primitive + 1].x == segments[primitive].y &&
      isInside(primitive + 1));
}

/// The rays of a part of a packet that may hit a shape, computed in single precision with bounds of
/// the rounding errors. This rejects most shapes whose bounds a ray hits.
class Candidates
{
public:
  static constexpr unsigned int MaximumSize = 16;

  Candidates(
    const RoundShape& shape, const int* valid, RTCRayN* rays, unsigned int size, unsigned int first)
    : Valid(valid + first),
      Count(std::min(size - first, MaximumSize)),
      X(&RTCRayN_org_x(rays, size, first)),
      Y(&RTCRayN_org_y(rays, size, first)),
      Z(&RTCRayN_org_z(rays, size, first)),
      DX(&RTCRayN_dir_x(rays, size, first)),
      DY(&RTCRayN_dir_y(rays, size, first)),
      DZ(&RTCRayN_dir_z(rays, size, first))
  {
    this->TestSphere(shape);
    if (shape.A != shape.B)
    {
      this->TestAxis(shape);
    }
  }

  bool operator[](unsigned int i) const { return this->Values[i] != 0; }

private:
  // The slack exceeds the errors of each cross product, scalar product, and difference.
  static constexpr float Slack = 4e-6f;
  static constexpr float Growth = 1.f + 1e-5f;

  static float ComputeExtent(glm::vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

  /// Compares the distance of each ray to the center of a sphere around the shape.
  void TestSphere(const RoundShape& shape)
  {
    const glm::vec3 axis = shape.B - shape.A;
    const glm::vec3 half = 0.5f * axis;
    const float radius =
      Growth * (std::max(shape.RadiusA, shape.RadiusB) + 0.5f * glm::length(axis)) +
      Slack * ComputeExtent(axis);
    for (unsigned int i = 0; i < this->Count; ++i)
    {
      const float x = shape.A.x - this->X[i];
      const float y = shape.A.y - this->Y[i];
      const float z = shape.A.z - this->Z[i];
      const float limit = radius + Slack * (std::abs(x) + std::abs(y) + std::abs(z));
      const float cx = x + half.x;
      const float cy = y + half.y;
      const float cz = z + half.z;
      const float dx = this->DX[i];
      const float dy = this->DY[i];
      const float dz = this->DZ[i];
      const float mx = cy * dz - cz * dy;
      const float my = cz * dx - cx * dz;
      const float mz = cx * dy - cy * dx;
      const int misses =
        mx * mx + my * my + mz * mz > Growth * limit * limit * (dx * dx + dy * dy + dz * dz);
      this->Values[i] = this->Valid[i] & (misses - 1);
    }
  }

  /// Compares the distance of each ray to the line through both ends of a tube.
  void TestAxis(const RoundShape& shape)
  {
    const glm::vec3 axis = shape.B - shape.A;
    const float extent = ComputeExtent(axis);
    const float radius = std::max(shape.RadiusA, shape.RadiusB);
    for (unsigned int i = 0; i < this->Count; ++i)
    {
      const float x = shape.A.x - this->X[i];
      const float y = shape.A.y - this->Y[i];
      const float z = shape.A.z - this->Z[i];
      const float dx = this->DX[i];
      const float dy = this->DY[i];
      const float dz = this->DZ[i];
      const float nx = dy * axis.z - dz * axis.y;
      const float ny = dz * axis.x - dx * axis.z;
      const float nz = dx * axis.y - dy * axis.x;
      const float slack = Slack * extent *
        (std::abs(x) + std::abs(y) + std::abs(z) + extent + radius) *
        (std::abs(dx) + std::abs(dy) + std::abs(dz));
      const float volume = std::max(std::abs(x * nx + y * ny + z * nz) - slack, 0.f);
      const int misses = volume * volume > Growth * radius * radius * (nx * nx + ny * ny + nz * nz);
      this->Values[i] &= misses - 1;
    }
  }

  const int* Valid; ///< -1: the ray is active
  unsigned int Count;
  const float* X;
  const float* Y;
  const float* Z;
  const float* DX;
  const float* DY;
  const float* DZ;
  int Values[MaximumSize];
};

/// Computes the distance of the hit of the ray i of a packet in the range of the ray. Returns false
/// if there is none.
bool FindHit(const TracedSurface& traced, std::uint32_t primitive, const RoundShape& shape,
  RTCRayN* rays, unsigned int size, unsigned int i, double& distance)
{
  const Surface& surface = *traced.Data;
  const glm::dvec3 origin(
    RTCRayN_org_x(rays, size, i), RTCRayN_org_y(rays, size, i), RTCRayN_org_z(rays, size, i));
  const glm::dvec3 direction(
    RTCRayN_dir_x(rays, size, i), RTCRayN_dir_y(rays, size, i), RTCRayN_dir_z(rays, size, i));
  const float nearest = RTCRayN_tnear(rays, size, i);
  const float farthest = RTCRayN_tfar(rays, size, i);
  const RoundIntersection range(shape, origin, direction);
  if (!range.IsHit)
  {
    return false;
  }
  const auto enter = static_cast<float>(range.Enter);
  const auto leave = static_cast<float>(range.Leave);
  distance = range.Enter;
  if (enter < nearest || !surface.Frontfaces)
  {
    if (leave < nearest || !surface.Backfaces || (traced.IsTranslucent && range.Enter >= 0.0))
    {
      return false;
    }
    distance = range.Leave;
  }
  return static_cast<float>(distance) <= farthest &&
    !(traced.IsTranslucent && !surface.Segments.empty() &&
      IsInsideJoinedTube(surface, primitive, origin + distance * direction));
}

/// Calls `function` with the shape, the index of the ray, and the distance of each hit of the rays of
/// a packet with one shape.
template <typename Function>
void ForEachHitOfShape(const TracedSurface& traced, std::uint32_t primitive, const int* valid,
  RTCRayN* rays, unsigned int size, const Function& function)
{
  const RoundShape shape = traced.Data->GetRoundShape(primitive);
  for (unsigned int first = 0; first < size; first += Candidates::MaximumSize)
  {
    const Candidates candidates(shape, valid, rays, size, first);
    for (unsigned int i = first; i < std::min(first + Candidates::MaximumSize, size); ++i)
    {
      double distance = 0.0;
      if (candidates[i - first] && FindHit(traced, primitive, shape, rays, size, i, distance))
      {
        function(shape, primitive, i, distance);
      }
    }
  }
}

/// The same for the shapes of a primitive of Embree.
template <typename Function>
void ForEachHit(const TracedSurface& traced, unsigned int primitive, const int* valid,
  RTCRayN* rays, unsigned int size, const Function& function)
{
  ForEachShape(traced, primitive,
    [&](std::uint32_t shape) { ForEachHitOfShape(traced, shape, valid, rays, size, function); });
}

/// Embree callback: nearest hit. Of equally distant shapes, the last one is hit, so that the result does not depend on
/// the order of the traversal. VTK draws it over the others, too, unless it is opaque and one of them is translucent.
void Intersect(const RTCIntersectFunctionNArguments* args)
{
  RTCRayN* const rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* const hits = RTCRayHitN_HitN(args->rayhit, args->N);
  const unsigned int size = args->N;
  const auto store = [&](const RoundShape& shape, std::uint32_t primitive, unsigned int i,
                       double distance) {
    const auto rounded = static_cast<float>(distance);
    const unsigned int geometry = RTCHitN_geomID(hits, size, i);
    if (rounded == RTCRayN_tfar(rays, size, i) && geometry != RTC_INVALID_GEOMETRY_ID &&
      (geometry > args->geomID ||
        (geometry == args->geomID && RTCHitN_primID(hits, size, i) > primitive)))
    {
      return;
    }
    const glm::dvec3 origin(
      RTCRayN_org_x(rays, size, i), RTCRayN_org_y(rays, size, i), RTCRayN_org_z(rays, size, i));
    const glm::dvec3 direction(
      RTCRayN_dir_x(rays, size, i), RTCRayN_dir_y(rays, size, i), RTCRayN_dir_z(rays, size, i));
    RTCRayN_tfar(rays, size, i) = rounded;
    RTCHitN_u(hits, size, i) =
      static_cast<float>(TouchingSphere(shape, origin + distance * direction).U);
    RTCHitN_v(hits, size, i) = 0.f;
    RTCHitN_geomID(hits, size, i) = args->geomID;
    RTCHitN_primID(hits, size, i) = primitive;
    RTCHitN_instID(hits, size, i, 0) = RTC_INVALID_GEOMETRY_ID;
  };
  ForEachHit(GetTraced(args->geometryUserPtr), args->primID, args->valid, rays, size, store);
}

/// Embree callback: occlusion.
void Occlude(const RTCOccludedFunctionNArguments* args)
{
  ForEachHit(GetTraced(args->geometryUserPtr), args->primID, args->valid, args->ray, args->N,
    [&](const RoundShape&, std::uint32_t, unsigned int i, double) {
      RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
    });
}

}

RTCGeometry MakeRoundGeometry(RTCDevice device, TracedSurface& traced)
{
  const std::size_t count = traced.Data->GetNumberOfPrimitives();
  const bool isGrouped = traced.Data->Segments.empty() && count >= MinimumGroupedSpheres;
  traced.Order =
    isGrouped ? SortByMortonCode(traced.Data->Positions) : std::vector<std::uint32_t>();
  const std::size_t primitives =
    isGrouped ? (count + SpheresPerGroup - 1) / SpheresPerGroup : count;
  return MakeUserGeometry(device, traced, primitives, { ComputeBounds, Intersect, Occlude });
}

}
