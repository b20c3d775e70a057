// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LightOverlap.h"

#include "vtkLine.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkTriangle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace penumbra
{
namespace
{

/// Returns true if the bounding box of three points, enlarged by `radius`, contains `center`.
bool IsNearBox(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 center, float radius)
{
  const glm::vec3 low = glm::min(a, glm::min(b, c)) - radius;
  const glm::vec3 high = glm::max(a, glm::max(b, c)) + radius;
  return glm::all(glm::lessThanEqual(low, center)) && glm::all(glm::lessThanEqual(center, high));
}

/// Returns the distance of a point from a triangle with corners a, b and c.
double DistanceToTriangle(
  vtkTriangle* triangle, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 point)
{
  triangle->GetPoints()->SetPoint(0, a.x, a.y, a.z);
  triangle->GetPoints()->SetPoint(1, b.x, b.y, b.z);
  triangle->GetPoints()->SetPoint(2, c.x, c.y, c.z);
  const double x[3] = { point.x, point.y, point.z };
  double closest[3];
  double coordinates[3];
  double weights[3];
  double square = 0.0;
  int subId = 0;
  if (triangle->EvaluatePosition(x, closest, subId, coordinates, square, weights) >= 0)
  {
    return std::sqrt(square);
  }
  // The triangle has no area.
  return std::min({ glm::distance(point, a), glm::distance(point, b), glm::distance(point, c) });
}

/// Returns the distance of a point from the segment between a and b.
double DistanceToSegment(glm::vec3 a, glm::vec3 b, glm::vec3 point)
{
  const double x[3] = { point.x, point.y, point.z };
  const double p[3] = { a.x, a.y, a.z };
  const double q[3] = { b.x, b.y, b.z };
  double t = 0.0;
  double closest[3];
  return std::sqrt(vtkLine::DistanceToLine(x, p, q, t, closest));
}

bool Overlaps(const Surface& surface, const Light& light)
{
  if (surface.IsLineOrPoint)
  {
    return false;
  }
  vtkNew<vtkTriangle> triangle;
  for (std::size_t i = 0; i < surface.GetNumberOfPrimitives(); ++i)
  {
    if (surface.Instances && i % surface.Triangles.size() == 0)
    {
      const AxisAlignedBox box = surface.Instances->GetBox(i / surface.Triangles.size());
      if (!IsNearBox(box.Low, box.High, box.High, light.Position, light.Radius))
      {
        i += surface.Triangles.size() - 1;
        continue;
      }
    }
    const glm::uvec3 corners = surface.GetCorners(static_cast<std::uint32_t>(i));
    const auto [a, b, c] = surface.GetPoints(static_cast<std::uint32_t>(i));
    const float thickness = std::max(surface.GetRadius(corners.x), surface.GetRadius(corners.y));
    const float radius = light.Radius + thickness;
    if (!IsNearBox(a, b, c, light.Position, radius))
    {
      continue;
    }
    const double distance = surface.IsRound()
      ? DistanceToSegment(a, b, light.Position)
      : DistanceToTriangle(triangle, a, b, c, light.Position);
    if (distance <= radius)
    {
      return true;
    }
  }
  return false;
}

}

std::vector<std::string> DescribeLightOverlaps(const Scene& scene)
{
  std::vector<std::string> sentences;
  for (const Light& light : scene.Lights)
  {
    if (light.Kind == Light::Kinds::Positional && light.HasSize() && light.CastsShadow &&
      std::any_of(scene.Surfaces.begin(), scene.Surfaces.end(),
        [&light](const Surface& surface) { return Overlaps(surface, light); }))
    {
      const glm::dvec3 center = scene.ToWorld(light.Position);
      std::ostringstream text;
      text << "The light at (" << center.x << ", " << center.y << ", " << center.z
           << ") with a radius of " << light.Radius / scene.Scale
           << " contains or touches a surface. Inside the light, surfaces are fully lit and cast "
              "no shadow. Reduce the radius or move the light.";
      sentences.push_back(text.str());
    }
  }
  return sentences;
}

}
