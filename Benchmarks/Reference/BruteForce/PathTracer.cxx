// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PathTracer.h"

#include "Surface.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace penumbra
{
namespace
{

constexpr double Pi = glm::pi<double>();
constexpr double Gap = 1e-9;

class Random
{
public:
  explicit Random(std::uint64_t seed)
    : Engine(seed)
  {
  }
  double operator()() { return static_cast<double>(this->Engine() >> 11) * 0x1p-53; }

private:
  std::mt19937_64 Engine;
};

/// Returns the distance along the ray to a panel, or infinity for a miss.
double DistanceTo(const Panel& panel, glm::dvec3 origin, glm::dvec3 direction)
{
  const glm::dvec3 p = glm::cross(direction, panel.Other);
  const double determinant = glm::dot(panel.Side, p);
  const glm::dvec3 from = origin - panel.Corner;
  const double u = glm::dot(from, p) / determinant;
  const glm::dvec3 q = glm::cross(from, panel.Side);
  const double v = glm::dot(direction, q) / determinant;
  const double t = glm::dot(panel.Other, q) / determinant;
  const bool hit = u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0 && t > Gap;
  return hit ? t : std::numeric_limits<double>::infinity();
}

/// Returns the nearest panel within `distance`, or null.
const Panel* First(
  const std::vector<Panel>& panels, glm::dvec3 origin, glm::dvec3 direction, double& distance)
{
  const Panel* first = nullptr;
  for (const Panel& panel : panels)
  {
    const double t = DistanceTo(panel, origin, direction);
    if (t < distance)
    {
      distance = t;
      first = &panel;
    }
  }
  return first;
}

/// Irradiance of a panel's emission from one direction, as multiple importance sampling with the
/// balance heuristic [Veach] weights it. The direction can be sampled by the panel's area and by
/// the cosine. Area sampling alone would be unbounded close to a panel.
glm::dvec3 Balanced(const Panel& panel, glm::dvec3 direction, double distance, double cosine)
{
  const glm::dvec3 area = glm::cross(panel.Side, panel.Other);
  const double byArea = distance * distance / std::abs(glm::dot(area, direction));
  return panel.Emission * (cosine / (byArea + cosine / Pi));
}

/// Irradiance from one sampled point of each emitting panel, with the weight of the balance
/// heuristic.
glm::dvec3 FromLights(
  const std::vector<Panel>& panels, glm::dvec3 point, glm::dvec3 normal, Random& random)
{
  glm::dvec3 sum(0.0);
  for (const Panel& panel : panels)
  {
    if (panel.Emission == glm::dvec3(0.0))
    {
      continue;
    }
    const glm::dvec3 at = panel.Corner + random() * panel.Side + random() * panel.Other;
    const glm::dvec3 to = at - point;
    const double distance = glm::length(to);
    const glm::dvec3 direction = to / distance;
    const double cosine = glm::dot(normal, direction);
    double free = distance * (1.0 - 1e-9);
    if (cosine > 0.0 && !First(panels, point, direction, free))
    {
      sum += Balanced(panel, direction, distance, cosine);
    }
  }
  return sum;
}

glm::dvec3 CosineDirection(glm::dvec3 normal, Random& random)
{
  const glm::dvec3 other = std::abs(normal.x) < .5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 tangent = glm::normalize(glm::cross(normal, other));
  const double angle = 2.0 * Pi * random();
  const double square = random();
  return std::sqrt(square) *
    (std::cos(angle) * tangent + std::sin(angle) * glm::cross(normal, tangent)) +
    std::sqrt(1.0 - square) * normal;
}

}

void AddPanels(std::vector<Panel>& panels, glm::dvec3 low, glm::dvec3 high, glm::dvec3 reflectance)
{
  const glm::dvec3 size = high - low;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 side(0.0);
    glm::dvec3 other(0.0);
    glm::dvec3 across(0.0);
    side[(axis + 1) % 3] = size[(axis + 1) % 3];
    other[(axis + 2) % 3] = size[(axis + 2) % 3];
    across[axis] = size[axis];
    panels.push_back({ low, side, other, reflectance, glm::dvec3(0.0) });
    panels.push_back({ low + across, side, other, reflectance, glm::dvec3(0.0) });
  }
}

void AddSurfaces(Scene& scene, const std::vector<Panel>& panels)
{
  for (const Panel& panel : panels)
  {
    Surface surface;
    const glm::dvec3 corners[] = { panel.Corner, panel.Corner + panel.Side,
      panel.Corner + panel.Side + panel.Other, panel.Corner + panel.Other };
    for (const glm::dvec3& corner : corners)
    {
      surface.Positions.emplace_back(corner - scene.Origin);
    }
    surface.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
    surface.Front.Ambient = 1.f;
    surface.Front.AmbientColor = panel.Emission;
    surface.Front.DiffuseColor = panel.Reflectance;
    scene.Surfaces.push_back(surface);
  }
}

std::vector<Panel> CornellLikeBox()
{
  const glm::dvec3 white(1.0);
  const glm::dvec3 x(1.0, 0.0, 0.0);
  const glm::dvec3 y(0.0, 1.0, 0.0);
  const glm::dvec3 z(0.0, 0.0, 1.0);
  std::vector<Panel> panels = {
    { { 0.0, 0.0, 0.0 }, x, y, white, glm::dvec3(0.0) },
    { { 0.0, 0.0, 1.0 }, x, y, white, glm::dvec3(0.0) },
    { { 0.0, 1.0, 0.0 }, x, z, white, glm::dvec3(0.0) },
    { { 0.0, 0.0, 0.0 }, y, z, { 1.0, .3, .3 }, glm::dvec3(0.0) },
    { { 1.0, 0.0, 0.0 }, y, z, { .3, 1.0, .3 }, glm::dvec3(0.0) },
    { { .35, .35, .999 }, .3 * x, .3 * y, glm::dvec3(0.0), { 12.0, 11.0, 9.0 } },
  };
  AddPanels(panels, { .15, .5, 0.0 }, { .45, .8, .6 }, white);
  AddPanels(panels, { .55, .2, 0.0 }, { .85, .5, .3 }, white);
  return panels;
}

double ComputePanelOcclusion(
  const std::vector<Panel>& panels, glm::dvec3 point, glm::dvec3 normal, double radius, int side)
{
  const glm::dvec3 other =
    std::abs(normal.z) < .9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(other, normal));
  const glm::dvec3 y = glm::cross(normal, x);
  Random random(1);
  int hits = 0;
  for (int i = 0; i < side * side; ++i)
  {
    const double square = (i / side + random()) / side; // of the sine of the angle to the normal
    const double azimuth = 2.0 * Pi * (i % side + random()) / side;
    const glm::dvec3 direction =
      std::sqrt(square) * (std::cos(azimuth) * x + std::sin(azimuth) * y) +
      std::sqrt(1.0 - square) * normal;
    hits += std::any_of(panels.begin(), panels.end(),
      [&](const Panel& panel) { return DistanceTo(panel, point, direction) < radius; });
  }
  return static_cast<double>(hits) / (side * side);
}

glm::dvec3 PathTracer::Irradiance(
  glm::dvec3 point, glm::dvec3 normal, int paths, std::uint64_t seed) const
{
  Random random(seed);
  glm::dvec3 sum(0.0);
  for (int i = 0; i < paths; ++i)
  {
    glm::dvec3 share(1.0);
    glm::dvec3 at = point + 1e-7 * normal;
    glm::dvec3 about = normal;
    for (int bounce = 0; bounce < this->Bounces; ++bounce)
    {
      sum += share * FromLights(this->Panels, at, about, random);
      const glm::dvec3 direction = CosineDirection(about, random);
      double distance = std::numeric_limits<double>::infinity();
      const Panel* met = First(this->Panels, at, direction, distance);
      if (!met)
      {
        sum += share * Pi * this->Environment;
        break;
      }
      sum += share * Balanced(*met, direction, distance, glm::dot(about, direction));
      share *= this->Albedo * met->Reflectance;
      about = glm::normalize(glm::cross(met->Side, met->Other));
      about = glm::dot(about, direction) > 0.0 ? -about : about;
      at += distance * direction + 1e-7 * about;
    }
  }
  return sum / static_cast<double>(paths);
}

}
