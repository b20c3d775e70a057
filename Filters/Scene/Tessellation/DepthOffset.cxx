// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DepthOffset.h"

#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace penumbra
{
namespace
{

/// The same as MaximumPolygonSlope for lines and points, which cast no shadows.
constexpr double MaximumLineSlope = 64.0;
/// Maximum slope for which rounding is taken into account; the order of coincident surfaces does
/// not depend on it.
constexpr double MaximumRoundedSlope = 1e4;
/// Shift of vertices in multiples of the rounding of a coordinate, so that hits of a ray on the
/// surface and its copy differ by more than the rounding errors of both.
constexpr double SeparationRoundings = 8.0;
/// Range of the change of 1 / depth, relative to it, by a shift toward the camera.
constexpr double MinimumChange = -0.5;
constexpr double MaximumChange = 1.0;

/// Moves x toward the camera. In perspective, 1 / depth changes by the same amount at all points of
/// a plane if `pixels` is proportional to the depth, so that the plane remains one.
glm::dvec3 MoveTowardCamera(const Camera& camera, glm::dvec3 x, double pixels)
{
  if (camera.Parallel)
  {
    return x - pixels * camera.PixelSize * camera.Forward;
  }
  const double change = std::copysign(1.0, camera.Depth(x)) * pixels * camera.PixelSize;
  return camera.Position +
    (x - camera.Position) / (1.0 + std::clamp(change, MinimumChange, MaximumChange));
}

}

double ComputePixelSize(const Camera& camera, glm::dvec3 x)
{
  return camera.PixelSize * (camera.Parallel ? 1.0 : std::abs(camera.Depth(x)));
}

double ComputeSlopeOfPlane(const Camera& camera, glm::dvec3 x, glm::dvec3 n)
{
  const double across = std::hypot(glm::dot(n, camera.Right), glm::dot(n, camera.Up));
  const double facing =
    std::abs(camera.Parallel ? glm::dot(n, camera.Forward)
                             : glm::dot(n, x - camera.Position) / camera.Depth(x));
  return facing * MaximumRoundedSlope > across ? across / facing : MaximumRoundedSlope;
}

double ComputeShift(const Camera& camera, glm::dvec3 x, DepthOffset offset, double slope)
{
  const double unit =
    camera.DepthUnit * (camera.Parallel ? 1.0 : std::abs(camera.Depth(x))) / camera.PixelSize;
  return -offset.Factor * std::min(slope, MaximumLineSlope) - offset.Units * unit;
}

double ComputeSlope(const Camera& camera, glm::dvec3 a, glm::dvec3 b)
{
  const double pixels = glm::distance(camera.Project(a), camera.Project(b));
  const double depth = std::abs(camera.Depth(b) - camera.Depth(a));
  const double size = 0.5 * (ComputePixelSize(camera, a) + ComputePixelSize(camera, b));
  return depth < MaximumRoundedSlope * pixels * size ? depth / (pixels * size)
                                                     : MaximumRoundedSlope;
}

void OffsetSurface(const Camera& camera, DepthOffset offset, Surface& surface)
{
  if (surface.Normals.empty() && surface.TriangleNormals.empty())
  {
    surface.NormalRule = Surface::NormalRules::FacingCamera;
    for (std::uint32_t i = 0; i < surface.Triangles.size(); ++i)
    {
      surface.TriangleNormals.push_back(surface.ComputeNormal(i));
    }
  }
  std::vector<double> slopes(surface.Positions.size(), 0.0);
  glm::vec3 farthest(0.f);
  for (std::uint32_t i = 0; i < surface.Triangles.size(); ++i)
  {
    const glm::dvec3 normal(surface.ComputeNormal(i));
    for (int k = 0; k < 3; ++k)
    {
      const std::uint32_t corner = surface.Triangles[i][k];
      const glm::vec3 x = surface.Positions[corner];
      slopes[corner] = std::max(slopes[corner], ComputeSlopeOfPlane(camera, glm::dvec3(x), normal));
      farthest = glm::max(farthest, glm::abs(x));
    }
  }
  const double rounding = 0.5 * std::numeric_limits<float>::epsilon() * SeparationRoundings *
    std::max({ farthest.x, farthest.y, farthest.z });
  for (std::size_t i = 0; i < surface.Positions.size(); ++i)
  {
    const glm::dvec3 x(surface.Positions[i]);
    const double shift = ComputeShift(camera, x, offset, std::min(slopes[i], MaximumPolygonSlope));
    const double smallest = rounding * std::hypot(1.0, slopes[i]) / ComputePixelSize(camera, x);
    const double direction = shift != 0.0 ? shift : -offset.GetRank();
    surface.Positions[i] = glm::vec3(
      MoveTowardCamera(camera, x, std::copysign(std::max(std::abs(shift), smallest), direction)));
  }
}

}
