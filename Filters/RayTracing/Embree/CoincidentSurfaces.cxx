// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CoincidentSurfaces.h"

#include "RayTriangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace penumbra
{

namespace
{

/// Half a unit in the last place of a single-precision 1.
constexpr double HalfUlp = 0.5 * std::numeric_limits<float>::epsilon();
/// Roundings between a ray's origin and where it meets a triangle, at most; a ray that grazes the plane
/// lengthens their error by as much again.
constexpr double Roundings = 16.0;
constexpr double Grazing = 64.0;

struct Box
{
  glm::vec3 Low{ std::numeric_limits<float>::infinity() };
  glm::vec3 High{ -std::numeric_limits<float>::infinity() };
};

Box BoundsOf(const Surface& surface)
{
  Box box;
  if (!surface.Triangles.empty())
  {
    for (const glm::vec3& position : surface.Positions)
    {
      box.Low = glm::min(box.Low, position);
      box.High = glm::max(box.High, position);
    }
  }
  return box;
}

float ReachOf(const Box& box)
{
  const glm::vec3 farthest = glm::max(glm::abs(box.Low), glm::abs(box.High));
  return static_cast<float>(
    Grazing * Roundings * HalfUlp * std::max({ farthest.x, farthest.y, farthest.z }));
}

bool ComeNear(const Box& a, const Box& b, float reach)
{
  for (int i = 0; i < 3; ++i)
  {
    if (!(a.Low[i] <= b.High[i] + reach && b.Low[i] <= a.High[i] + reach))
    {
      return false;
    }
  }
  return true;
}

/// What decides between two surfaces as a whole; the less lies over the other.
std::array<float, 16> SortKey(const Surface& surface)
{
  const Material& front = surface.Front;
  const auto brightness = [](glm::vec3 color) { return color.x + color.y + color.z; };
  return { surface.IsLineOrPoint ? 0.f : 1.f, surface.IsTranslucent() ? 1.f : 0.f,
    -brightness(front.Ambient * front.AmbientColor + front.Diffuse * front.DiffuseColor),
    -front.DiffuseColor.x, -front.DiffuseColor.y, -front.DiffuseColor.z, -front.AmbientColor.x,
    -front.AmbientColor.y, -front.AmbientColor.z, -front.Specular, -front.SpecularColor.x,
    -front.SpecularColor.y, -front.SpecularColor.z, -front.SpecularPower, -front.Opacity,
    front.Lighting ? 1.f : 0.f };
}

/// Less than, equal or greater than 0, as colours of the data decide.
int CompareColors(const std::vector<glm::u8vec4>& a, const std::vector<glm::u8vec4>& b)
{
  if (a.size() != b.size())
  {
    return a.size() < b.size() ? -1 : 1;
  }
  const auto [one, other] = std::mismatch(a.begin(), a.end(), b.begin());
  for (int i = 0; one != a.end() && i < 4; ++i)
  {
    if ((*one)[i] != (*other)[i])
    {
      return (*one)[i] > (*other)[i] ? -1 : 1;
    }
  }
  return 0;
}

bool DrawsOver(const Surface& a, const Surface& b)
{
  const auto looksOfA = SortKey(a);
  const auto looksOfB = SortKey(b);
  if (looksOfA != looksOfB)
  {
    return looksOfA < looksOfB;
  }
  const int byPoints = CompareColors(a.PointColors, b.PointColors);
  return byPoints != 0 ? byPoints < 0 : CompareColors(a.CellColors, b.CellColors) < 0;
}

/// How far along the ray rounded corners may move where it meets the triangle.
double RoundingAlong(const Ray& ray, const Surface& surface, std::uint32_t triangle)
{
  const glm::uvec3 corners = surface.Triangles[triangle];
  const glm::dvec3 a(surface.Positions[corners.x]);
  const glm::dvec3 b(surface.Positions[corners.y]);
  const glm::dvec3 c(surface.Positions[corners.z]);
  const glm::dvec3 farthest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double facing = std::abs(glm::dot(normal, glm::dvec3(ray.Direction)));
  return facing > 0.0 ? HalfUlp * glm::length(farthest) * glm::length(normal) / facing : 0.0;
}

}

float CandidateHits::Add(const CandidateHit& met, float reach)
{
  float nearest = met.Distance;
  for (int i = 0; i < this->Count; ++i)
  {
    nearest = std::min(nearest, this->Met[i].Distance);
  }
  const auto isFar = [=](const CandidateHit& other) { return other.Distance > nearest + reach; };
  this->Count =
    static_cast<int>(std::remove_if(this->Met, this->Met + this->Count, isFar) - this->Met);
  if (this->Count < Capacity)
  {
    this->Met[this->Count++] = met;
    return nearest;
  }
  CandidateHit* const farthest = std::max_element(this->Met, this->Met + Capacity,
    [](const CandidateHit& a, const CandidateHit& b) { return a.Distance < b.Distance; });
  if (met.Distance < farthest->Distance)
  {
    *farthest = met;
  }
  return nearest;
}

CoincidentSurfaces::CoincidentSurfaces(const Scene& scene)
  : TracedScene(scene),
    DepthTolerances(scene.Surfaces.size(), 0.f),
    DrawOrder(scene.Surfaces.size(), 0)
{
  std::vector<Box> boxes(scene.Surfaces.size());
  std::transform(scene.Surfaces.begin(), scene.Surfaces.end(), boxes.begin(), BoundsOf);
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
    largest = std::max(largest, ReachOf(boxes[i]));
  }
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const Box& a = boxes[order[i]];
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].Low.x <= a.High.x + largest;
         ++j)
    {
      const Box& b = boxes[order[j]];
      const float reach = std::max(ReachOf(a), ReachOf(b));
      if (ComeNear(a, b, reach))
      {
        this->Empty = false;
        this->DepthTolerances[order[i]] = std::max(this->DepthTolerances[order[i]], reach);
        this->DepthTolerances[order[j]] = std::max(this->DepthTolerances[order[j]], reach);
      }
    }
  }
  order.erase(std::remove_if(order.begin(), order.end(),
                [&](std::uint32_t i) { return !(DepthTolerances[i] > 0.f); }),
    order.end());
  std::sort(order.begin(), order.end());
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return DrawsOver(scene.Surfaces[a], scene.Surfaces[b]);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    this->DrawOrder[order[i]] = static_cast<int>(i);
  }
}

Hit CoincidentSurfaces::Resolve(const Ray& ray, const Hit& last, CandidateHits& contenders) const
{
  if (this->DepthTolerances[last.Surface] <= 0.f)
  {
    contenders.Add({ last.Surface, last.Triangle, last.U, last.V, last.Distance }, 0.f);
  }
  double distances[CandidateHits::Capacity];
  double roundings[CandidateHits::Capacity];
  int nearest = 0;
  for (int i = 0; contenders.Count > 1 && i < contenders.Count; ++i)
  {
    const CandidateHit& met = contenders.Met[i];
    const Surface& surface = this->TracedScene.Surfaces[met.Surface];
    const RayTriangle exact(surface, met.Triangle, ray);
    // Single precision errs by more than the reach only where the triangle is seen edge-on.
    const bool knows = exact.IsValid &&
      std::abs(exact.Distance - met.Distance) * glm::length(ray.Direction) <=
        this->DepthTolerances[met.Surface];
    distances[i] = knows ? exact.Distance : met.Distance;
    roundings[i] = RoundingAlong(ray, surface, met.Triangle);
    nearest = distances[i] < distances[nearest] ? i : nearest;
  }
  int best = nearest;
  float passed = contenders.Met[nearest].Distance;
  for (int i = 0; contenders.Count > 1 && i < contenders.Count; ++i)
  {
    if (distances[i] - distances[nearest] > roundings[i] + roundings[nearest])
    {
      continue;
    }
    const CandidateHit& met = contenders.Met[i];
    passed = std::max({ passed, met.Distance, static_cast<float>(distances[i]) });
    const CandidateHit& over = contenders.Met[best];
    if (std::make_pair(this->DrawOrder[met.Surface], met.Triangle) <
      std::make_pair(this->DrawOrder[over.Surface], over.Triangle))
    {
      best = i;
    }
  }
  const CandidateHit& seen = contenders.Met[best];
  return { seen.Surface, seen.Triangle, seen.U, seen.V, seen.Distance, passed };
}

}
