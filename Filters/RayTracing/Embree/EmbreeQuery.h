// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Common interface of Embree 3.13 and Embree 4, which differ in the header, in the flags of a query
// and in the context that a query passes to filter functions.
#ifndef penumbra_EmbreeQuery_h
#define penumbra_EmbreeQuery_h

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstdint>

namespace penumbra
{

struct CandidateHits;

/// The instance in whose coordinates a query of the BVH of a shape is, and its ray.
struct InstanceQuery
{
  std::uint32_t Surface = 0; ///< index into Scene::Surfaces
  std::uint32_t First = 0;   ///< index of the first triangle of the instance
  bool IsMirrored = false;   ///< triangles have their front sides on the other side
  double Start = 0.0;        ///< distance along the ray in the scene of the origin of the query
  float Length = 0.f;        ///< of the direction of the ray in scene coordinates
};

#if RTC_VERSION_MAJOR >= 4
/// Query context that is passed to filter functions.
struct QueryContext : RTCRayQueryContext
{
  CandidateHits* Candidates;               ///< indexed by the id of the ray
  const InstanceQuery* Instance = nullptr; ///< null: the query is in scene coordinates
};

struct Query
{
  QueryContext Context;
  RTCIntersectArguments Intersection;
  RTCOccludedArguments Occlusion;
  explicit Query(bool coherent, CandidateHits* candidates = nullptr)
  {
    rtcInitRayQueryContext(&this->Context);
    this->Context.Candidates = candidates;
    rtcInitIntersectArguments(&this->Intersection);
    this->Intersection.context = &this->Context;
    rtcInitOccludedArguments(&this->Occlusion);
    const auto flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_NONE;
    this->Intersection.flags = flags;
    this->Occlusion.flags = flags;
  }
  void Intersect(RTCScene tree, RTCRayHit& ray) { rtcIntersect1(tree, &ray, &this->Intersection); }
  void Intersect(RTCScene tree, const int* valid, RTCRayHit8& rays)
  {
    rtcIntersect8(valid, tree, &rays, &this->Intersection);
  }
  void Intersect(RTCScene tree, const int* valid, RTCRayHit16& rays)
  {
    rtcIntersect16(valid, tree, &rays, &this->Intersection);
  }
  void Occluded(RTCScene tree, RTCRay& ray) { rtcOccluded1(tree, &ray, &this->Occlusion); }
  void Occluded(RTCScene tree, const int* valid, RTCRay8& rays)
  {
    rtcOccluded8(valid, tree, &rays, &this->Occlusion);
  }
  void Occluded(RTCScene tree, const int* valid, RTCRay16& rays)
  {
    rtcOccluded16(valid, tree, &rays, &this->Occlusion);
  }
};
#else
struct QueryContext : RTCIntersectContext
{
  CandidateHits* Candidates;               ///< indexed by the id of the ray
  const InstanceQuery* Instance = nullptr; ///< null: the query is in scene coordinates
};

struct Query
{
  QueryContext Context;
  explicit Query(bool coherent, CandidateHits* candidates = nullptr)
  {
    rtcInitIntersectContext(&this->Context);
    this->Context.Candidates = candidates;
    this->Context.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_NONE;
  }
  void Intersect(RTCScene tree, RTCRayHit& ray) { rtcIntersect1(tree, &this->Context, &ray); }
  void Intersect(RTCScene tree, const int* valid, RTCRayHit8& rays)
  {
    rtcIntersect8(valid, tree, &this->Context, &rays);
  }
  void Intersect(RTCScene tree, const int* valid, RTCRayHit16& rays)
  {
    rtcIntersect16(valid, tree, &this->Context, &rays);
  }
  void Occluded(RTCScene tree, RTCRay& ray) { rtcOccluded1(tree, &this->Context, &ray); }
  void Occluded(RTCScene tree, const int* valid, RTCRay8& rays)
  {
    rtcOccluded8(valid, tree, &this->Context, &rays);
  }
  void Occluded(RTCScene tree, const int* valid, RTCRay16& rays)
  {
    rtcOccluded16(valid, tree, &this->Context, &rays);
  }
};
#endif

}
#endif
