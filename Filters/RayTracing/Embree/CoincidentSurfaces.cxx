// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CoincidentSurfaces.h"

#include "AxisAlignedBox.h"
#include "PlanarCells.h"
#include "RayTriangle.h"
#include "Scene.h"
#include "SceneBounds.h"
#include "Surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace penumbra
{

namespace
{

/// Bound of the growth of rounding errors along rays at grazing incidence.
constexpr double GrazingFactor = 64.0;

/// Relative distance before the nearest of coincident hits from which a ray finds them again.
constexpr float CoincidenceSlack = 4e-7f;

AxisAlignedBox ComputeBounds(const Surface& surface)
{
  if (surface.Instances)
  {
    return ComputeInstanceBounds(surface);
  }
  AxisAlignedBox box;
  if (!surface.Triangles.empty())
  {
    for (const glm::vec3& position : surface.Positions)
    {
      box.Add(position);
    }
  }
  return box;
}

/// Returns the largest error of hits in a box along a ray, in scene units.
float ComputeDepthTolerance(const AxisAlignedBox& box)
{
  const glm::vec3 farthest = glm::max(glm::abs(box.Low), glm::abs(box.High));
  return static_cast<float>(
    GrazingFactor * MaximumRoundings * HalfUlp * std::max({ farthest.x, farthest.y, farthest.z }));
}

/// Returns true if the boxes, enlarged by `tolerance`, overlap.
bool AreNear(const AxisAlignedBox& a, const AxisAlignedBox& b, float tolerance)
{
  for (int i = 0; i < 3; ++i)
  {
    if (!(a.Low[i] <= b.High[i] + tolerance && b.Low[i] <= a.High[i] + tolerance))
    {
      return false;
    }
  }
  return true;
}

/// Returns the key that orders coincident surfaces, the one in front first, except that surfaces of
/// equal keys are in front of those that are drawn earlier. As with the depth test of VTK,
/// translucent surfaces are drawn over opaque ones.
std::tuple<bool, float, bool> MakeSortKey(const Surface& surface)
{
  return { !surface.IsLineOrPoint, surface.DepthRank, !surface.IsTranslucent() };
}

/// Returns true if several triangles of the surface may be at the same point and differ in color:
/// lines and points, and polygons in one plane.
bool MayCoincideWithItself(const Surface& surface)
{
  if (surface.IsRound() || surface.Instances || surface.Triangles.size() < 2)
  {
    return false;
  }
  const bool isColored = !surface.CellColors.empty() || !surface.PointColors.empty() ||
    surface.ColorTexture || surface.LitTexture;
  if (surface.IsLineOrPoint)
  {
    // Points may have the same position and different normals. Lines then have the same normal.
    const bool isShaded = surface.Front.Lighting && !surface.Normals.empty() &&
      surface.NormalRule == Surface::NormalRules::Unchanged;
    return isColored || isShaded || surface.IsTranslucent();
  }
  return !surface.CellColors.empty() && IsPlanar(surface);
}

/// Returns the error of the hit distance that results from the rounded vertices of the triangle.
double ComputeRoundingError(const Ray& ray, const Surface& surface, std::uint32_t triangle)
{
  const std::array<glm::vec3, 3> points = surface.GetPoints(triangle);
  const glm::dvec3 a(points[0]);
  const glm::dvec3 b(points[1]);
  const glm::dvec3 c(points[2]);
  const glm::dvec3 farthest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double facing = std::abs(glm::dot(normal, glm::dvec3(ray.Direction)));
  return facing > 0.0 ? HalfUlp * glm::length(farthest) * glm::length(normal) / facing : 0.0;
}

}

// Returns the hit of a surface that is drawn first, except the nearest one and, of several that are
// equally near, the one that is drawn last; null if there is no other.
CandidateHit* CandidateHits::FindFirstDrawn(std::uint32_t surface)
{
  const CandidateHit* nearest = nullptr;
  for (const CandidateHit& hit : this->Hits)
  {
    if (!nearest || hit.Distance < nearest->Distance ||
      (hit.Distance == nearest->Distance && hit.Primitive > nearest->Primitive))
    {
      nearest = &hit;
    }
  }
  CandidateHit* first = nullptr;
  for (CandidateHit& hit : this->Hits)
  {
    if (hit.Surface == surface && &hit != nearest && (!first || hit.Primitive < first->Primitive))
    {
      first = &hit;
    }
  }
  return first;
}

float CandidateHits::Add(const CandidateHit& hit, float tolerance, bool isLastInFront)
{
  float nearest = hit.Distance;
  for (int i = 0; i < this->Count; ++i)
  {
    nearest = std::min(nearest, this->Hits[i].Distance);
  }
  const auto isFar = [=](
                       const CandidateHit& other) { return other.Distance > nearest + tolerance; };
  this->Count =
    static_cast<int>(std::remove_if(this->Hits, this->Hits + this->Count, isFar) - this->Hits);
  if (this->Count < Capacity)
  {
    this->Hits[this->Count++] = hit;
    return nearest;
  }
  if (CandidateHit* const first = isLastInFront ? this->FindFirstDrawn(hit.Surface) : nullptr)
  {
    if (hit.Primitive > first->Primitive || hit.Distance == nearest)
    {
      *first = hit;
    }
    return nearest;
  }
  // Rays through a vertex hit many triangles of each surface, of which one is enough.
  const auto isRepeated = [&](const CandidateHit& other) {
    const auto isOfSame = [&](const CandidateHit& each) { return each.Surface == other.Surface; };
    return std::count_if(this->Hits, this->Hits + Capacity, isOfSame) + isOfSame(hit) > 1;
  };
  const auto isKeptRather = [&](const CandidateHit& a, const CandidateHit& b) {
    return std::make_pair(isRepeated(a), a.Distance) < std::make_pair(isRepeated(b), b.Distance);
  };
  CandidateHit* const last = std::max_element(this->Hits, this->Hits + Capacity, isKeptRather);
  if (isKeptRather(hit, *last))
  {
    *last = hit;
  }
  return nearest;
}

CoincidentSurfaces::CoincidentSurfaces(const Scene& scene)
  : TracedScene(scene),
    DepthTolerances(scene.Surfaces.size(), 0.f),
    LastInFront(scene.Surfaces.size(), 0),
    DrawOrder(scene.Surfaces.size(), 0),
    NextInOrder(scene.Surfaces.size(), 0)
{
  std::vector<AxisAlignedBox> boxes(scene.Surfaces.size());
  std::transform(scene.Surfaces.begin(), scene.Surfaces.end(), boxes.begin(), ComputeBounds);
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  order.erase(std::remove_if(order.begin(), order.end(),
                [&](std::uint32_t i) { return scene.Surfaces[i].Triangles.empty(); }),
    order.end());
  std::sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return boxes[a].Low.x < boxes[b].Low.x; });
  float largest = 0.f;
  for (const std::uint32_t i : order)
  {
    largest = std::max(largest, ComputeDepthTolerance(boxes[i]));
  }
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const AxisAlignedBox& a = boxes[order[i]];
    if (MayCoincideWithItself(scene.Surfaces[order[i]]))
    {
      this->Empty = false;
      this->LastInFront[order[i]] = 1;
      this->DepthTolerances[order[i]] =
        std::max(this->DepthTolerances[order[i]], ComputeDepthTolerance(a));
    }
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].Low.x <= a.High.x + largest;
         ++j)
    {
      const AxisAlignedBox& b = boxes[order[j]];
      const float tolerance = std::max(ComputeDepthTolerance(a), ComputeDepthTolerance(b));
      if (AreNear(a, b, tolerance))
      {
        this->Empty = false;
        this->DepthTolerances[order[i]] = std::max(this->DepthTolerances[order[i]], tolerance);
        this->DepthTolerances[order[j]] = std::max(this->DepthTolerances[order[j]], tolerance);
      }
    }
  }
  order.erase(std::remove_if(order.begin(), order.end(),
                [&](std::uint32_t i) { return !(DepthTolerances[i] > 0.f); }),
    order.end());
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto keyOfA = MakeSortKey(scene.Surfaces[a]);
    const auto keyOfB = MakeSortKey(scene.Surfaces[b]);
    return keyOfA != keyOfB ? keyOfA < keyOfB : a > b;
  });
  int next = static_cast<int>(order.size());
  for (int i = next - 1; i >= 0; --i)
  {
    // Translucent surfaces count once where they coincide, as with depth peeling.
    const Surface& surface = scene.Surfaces[order[i]];
    const bool isLast = i + 1 == static_cast<int>(order.size()) ||
      MakeSortKey(surface) != MakeSortKey(scene.Surfaces[order[i + 1]]);
    next = isLast || !surface.IsTranslucent() ? i + 1 : next;
    this->DrawOrder[order[i]] = i;
    this->NextInOrder[order[i]] = next;
  }
}

Hit CoincidentSurfaces::Resolve(
  const Ray& ray, const Hit& embreeHit, CandidateHits& candidates) const
{
  if (this->DepthTolerances[embreeHit.Surface] <= 0.f)
  {
    candidates.Add(
      { embreeHit.Surface, embreeHit.Primitive, embreeHit.U, embreeHit.V, embreeHit.Distance }, 0.f,
      false);
  }
  if (ray.FirstInOrder > 0)
  {
    const auto isSkipped = [&](const CandidateHit& hit) {
      return hit.Distance <= ray.CoincidentFar && this->DrawOrder[hit.Surface] < ray.FirstInOrder;
    };
    candidates.Count = static_cast<int>(
      std::remove_if(candidates.Hits, candidates.Hits + candidates.Count, isSkipped) -
      candidates.Hits);
  }
  if (candidates.Count == 0)
  {
    return {};
  }
  double distances[CandidateHits::Capacity];
  double roundings[CandidateHits::Capacity];
  int nearest = 0;
  for (int i = 0; candidates.Count > 1 && i < candidates.Count; ++i)
  {
    const CandidateHit& hit = candidates.Hits[i];
    const Surface& surface = this->TracedScene.Surfaces[hit.Surface];
    if (surface.IsRound())
    {
      distances[i] = hit.Distance;
      roundings[i] = 0.0;
      nearest = distances[i] < distances[nearest] ? i : nearest;
      continue;
    }
    const RayTriangle exact(surface, hit.Primitive, ray);
    // The error of single precision exceeds the tolerance only for triangles seen edge-on.
    const bool isAccurate = exact.IsValid &&
      std::abs(exact.Distance - hit.Distance) * glm::length(ray.Direction) <=
        this->DepthTolerances[hit.Surface];
    distances[i] = isAccurate ? exact.Distance : hit.Distance;
    roundings[i] = ComputeRoundingError(ray, surface, hit.Primitive);
    nearest = distances[i] < distances[nearest] ? i : nearest;
  }
  int best = nearest;
  float begin = candidates.Hits[nearest].Distance;
  float farthest = begin;
  int last = 0; // in the order of those that coincide
  for (int i = 0; candidates.Count > 1 && i < candidates.Count; ++i)
  {
    if (distances[i] - distances[nearest] > roundings[i] + roundings[nearest])
    {
      continue;
    }
    const CandidateHit& hit = candidates.Hits[i];
    const CandidateHit& front = candidates.Hits[best];
    begin = std::min(begin, hit.Distance);
    farthest = std::max({ farthest, hit.Distance, static_cast<float>(distances[i]) });
    last = std::max(last, this->DrawOrder[hit.Surface]);
    if (this->IsInFront(hit.Surface, hit.Primitive, front.Surface, front.Primitive))
    {
      best = i;
    }
  }
  const CandidateHit& visible = candidates.Hits[best];
  if (ray.FirstInOrder > 0 && begin <= ray.CoincidentFar)
  {
    farthest = std::max(farthest, ray.CoincidentFar); // of those that were skipped
  }
  Hit hit{ visible.Surface, visible.Primitive, visible.U, visible.V, visible.Distance, farthest };
  if (last >= this->NextInOrder[visible.Surface])
  {
    hit.CoincidentNear = std::max(ray.Near, begin - CoincidenceSlack * std::abs(begin));
    hit.NextInOrder = this->NextInOrder[visible.Surface];
  }
  return hit;
}

}
