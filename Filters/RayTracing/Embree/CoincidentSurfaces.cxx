// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CoincidentSurfaces.h"

#include "AxisAlignedBox.h"
#include "PlanarCells.h"
#include "RayTriangle.h"
#include "SceneBounds.h"
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

/// Bound of the growth of rounding errors along rays at grazing incidence.
constexpr double GrazingFactor = 64.0;

/// Relative distance before the nearest of coincident hits from which a ray finds them again.
constexpr float CoincidenceSlack = 4e-7f;

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

AxisAlignedBox ComputePositionBounds(const Surface& surface)
{
  if (surface.Whole)
  {
    return surface.Whole->PositionBounds;
  }
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

bool MayCoincideWithItself(const Surface& surface)
{
  if (surface.Whole)
  {
    return surface.Whole->MayCoincideWithItself;
  }
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

CoincidentSurfaces::Traits::Traits(const Surface& surface)
  : Bounds(ComputePositionBounds(surface)),
    HasTriangles(surface.Whole ? surface.Whole->HasTriangles : !surface.Triangles.empty()),
    IsTranslucent(surface.IsTranslucent()),
    MayCoincideWithItself(penumbra::MayCoincideWithItself(surface)),
    SortKey(MakeSortKey(surface))
{
}

CoincidentSurfaces::CoincidentSurfaces(const std::vector<Surface>& surfaces)
  : Surfaces(surfaces)
{
  for (const Surface& surface : surfaces)
  {
    this->TraitsBySurface.emplace_back(surface);
  }
  this->Sort();
}

void CoincidentSurfaces::Update(const std::vector<std::uint32_t>& surfaces)
{
  for (const std::uint32_t i : surfaces)
  {
    this->TraitsBySurface[i] = Traits(this->Surfaces[i]);
  }
  this->Sort();
}

void CoincidentSurfaces::Sort()
{
  const std::size_t count = this->TraitsBySurface.size();
  this->DepthTolerances.assign(count, 0.f);
  this->LastInFront.assign(count, 0);
  this->DrawOrder.assign(count, 0);
  this->NextInOrder.assign(count, 0);
  this->Empty = true;
  std::vector<std::uint32_t> order;
  AxisAlignedBox bounds;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    if (this->TraitsBySurface[i].HasTriangles)
    {
      order.push_back(i);
      bounds.Add(this->TraitsBySurface[i].Bounds);
    }
  }
  this->Center = order.empty() ? glm::vec3(0.f) : 0.5f * bounds.Low + 0.5f * bounds.High;
  std::sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
    return this->TraitsBySurface[a].Bounds.Low.x < this->TraitsBySurface[b].Bounds.Low.x;
  });
  this->FindNear(order);
  order.erase(std::remove_if(order.begin(), order.end(),
                [&](std::uint32_t i) { return !(DepthTolerances[i] > 0.f); }),
    order.end());
  this->FindOrder(std::move(order));
}

// `sorted` are the surfaces with triangles in the order of their lowest x.
void CoincidentSurfaces::FindNear(const std::vector<std::uint32_t>& sorted)
{
  std::vector<float> tolerances;
  for (const std::uint32_t i : sorted)
  {
    tolerances.push_back(ComputeDepthTolerance(this->TraitsBySurface[i].Bounds));
  }
  const float largest =
    tolerances.empty() ? 0.f : *std::max_element(tolerances.begin(), tolerances.end());
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    const Traits& a = this->TraitsBySurface[sorted[i]];
    float& toleranceOfA = this->DepthTolerances[sorted[i]];
    if (a.MayCoincideWithItself)
    {
      this->Empty = false;
      this->LastInFront[sorted[i]] = 1;
      toleranceOfA = std::max(toleranceOfA, tolerances[i]);
    }
    const float end = a.Bounds.High.x + largest;
    for (std::size_t j = i + 1;
         j < sorted.size() && this->TraitsBySurface[sorted[j]].Bounds.Low.x <= end; ++j)
    {
      const float tolerance = std::max(tolerances[i], tolerances[j]);
      if (AreNear(a.Bounds, this->TraitsBySurface[sorted[j]].Bounds, tolerance))
      {
        this->Empty = false;
        float& toleranceOfB = this->DepthTolerances[sorted[j]];
        toleranceOfA = std::max(toleranceOfA, tolerance);
        toleranceOfB = std::max(toleranceOfB, tolerance);
      }
    }
  }
}

void CoincidentSurfaces::FindOrder(std::vector<std::uint32_t> surfaces)
{
  const std::vector<Traits>& traits = this->TraitsBySurface;
  std::sort(surfaces.begin(), surfaces.end(), [&](std::uint32_t a, std::uint32_t b) {
    return traits[a].SortKey != traits[b].SortKey ? traits[a].SortKey < traits[b].SortKey : a > b;
  });
  const int count = static_cast<int>(surfaces.size());
  int next = count;
  for (int i = count - 1; i >= 0; --i)
  {
    // Translucent surfaces count once where they coincide, as with depth peeling.
    const Traits& surface = traits[surfaces[i]];
    const bool isLast = i + 1 == count || surface.SortKey != traits[surfaces[i + 1]].SortKey;
    next = isLast || !surface.IsTranslucent ? i + 1 : next;
    this->DrawOrder[surfaces[i]] = i;
    this->NextInOrder[surfaces[i]] = next;
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
    const Surface& surface = this->Surfaces[hit.Surface];
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
