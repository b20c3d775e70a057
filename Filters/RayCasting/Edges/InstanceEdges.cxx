// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InstanceEdges.h"

#include "RoundOutlines.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Number of tiles from which the edges of an instance are projected once for all of them.
constexpr int MinimumLargeTiles = 5;

/// Sine of the angle between triangle and ray below which the triangle may face both ways.
constexpr double FacingPrecision = 1e-5;

}

InstanceEdges::Shape::Shape(const Surface& surface, const std::vector<MeshEdge>& mesh)
  : Data(&surface)
{
  for (const MeshEdge& e : mesh)
  {
    std::vector<std::uint32_t>& ends = e.IsFeatureEdge ? this->Features : this->Smooth;
    ends.push_back(e.A);
    ends.push_back(e.B);
    const glm::dvec3 a(surface.Positions[e.A]);
    const glm::dvec3 along = glm::dvec3(surface.Positions[e.B]) - a;
    for (int side = 0; side < 2 && !e.IsFeatureEdge; ++side)
    {
      const glm::dvec3 third(surface.Positions[side == 0 ? e.Left : e.Right]);
      const glm::dvec3 normal = glm::cross(along, third - a);
      const double length = glm::length(normal);
      const glm::dvec3 unit = length > 0.0 ? normal / length : normal;
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Planes[4 * side + axis].push_back(static_cast<float>(unit[axis]));
      }
      this->Planes[4 * side + 3].push_back(static_cast<float>(-glm::dot(unit, a)));
    }
  }
}

ShapeBounds InstanceEdges::FindBounds(std::uint32_t instance) const
{
  const Id id = this->Instances[instance];
  const SurfaceInstances& instances = *this->Shapes[id.Shape].Data->Instances;
  const Camera& camera = this->TracedScene.ViewCamera;
  const glm::dmat3 linear = instances.GetLinear(id.Instance);
  const glm::dvec3 center = linear * instances.Center + instances.Transforms[id.Instance][3];
  const glm::dmat3 squares = glm::transpose(linear) * linear;
  double stretch = 0.0; // bound of the square of the norm of the transform
  for (int i = 0; i < 3; ++i)
  {
    stretch =
      std::max(stretch, std::abs(squares[i].x) + std::abs(squares[i].y) + std::abs(squares[i].z));
  }
  const double radius = (1.0 + 1e-6) * instances.Radius * std::sqrt(stretch);
  ShapeBounds bounds;
  bounds.Depth = camera.Depth(center) - radius;
  bounds.IsVisible = camera.Depth(center) + radius >= camera.Near;
  bounds.IsKnown = bounds.IsVisible && BoundSphere(center, radius, camera, bounds.Low, bounds.High);
  if (!bounds.IsKnown)
  {
    return bounds;
  }
  // The box is smaller than the sphere around long shapes. It is in front of the camera if the
  // sphere is, except for its corners.
  glm::dvec2 low(1e300);
  glm::dvec2 high(-1e300);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 sign(
      corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    const glm::dvec3 p = center + linear * (sign * instances.HalfSize);
    if (!camera.Parallel && !(camera.Depth(p) > 0.0))
    {
      return bounds;
    }
    const glm::dvec2 q = camera.Project(p);
    low = glm::min(low, q);
    high = glm::max(high, q);
  }
  // The box does not include the rounding of positions to single precision.
  const glm::dvec2 slack = 1e-3 * (bounds.High - bounds.Low) + 1e-3;
  bounds.Low = glm::max(bounds.Low, low - slack);
  bounds.High = glm::min(bounds.High, high + slack);
  return bounds;
}

InstanceEdges::InstanceEdges(
  const Scene& scene, const std::vector<std::vector<MeshEdge>>& mesh, const TileGrid& tiles)
  : TracedScene(scene)
{
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    const std::shared_ptr<const SurfaceInstances>& instances = scene.Surfaces[i].Instances;
    for (std::size_t k = 0; instances && k < instances->GetCount(); ++k)
    {
      this->Instances.push_back(
        { static_cast<std::uint32_t>(this->Shapes.size()), static_cast<std::uint32_t>(k) });
    }
    if (instances)
    {
      this->Shapes.emplace_back(scene.Surfaces[i], mesh[i]);
    }
  }
  this->SortByTiles(this->Instances.size(), tiles, MinimumLargeTiles, scene.ViewCamera);
}

void InstanceEdges::ProjectShape(
  std::uint32_t instance, glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges) const
{
  const Id id = this->Instances[instance];
  const Shape& shape = this->Shapes[id.Shape];
  const SurfaceInstances& instances = *shape.Data->Instances;
  const Camera& camera = this->TracedScene.ViewCamera;
  const auto project = [&](const std::uint32_t* ends) {
    const auto transform = [&](std::uint32_t i) {
      return glm::dvec3(instances.TransformPoint(id.Instance, shape.Data->Positions[i]));
    };
    ProjectEdge(transform(ends[0]), transform(ends[1]), camera, low, high, edges);
  };
  for (std::size_t i = 0; i < shape.Features.size(); i += 2)
  {
    project(&shape.Features[i]);
  }
  // The camera in homogeneous coordinates of the shape: a position, or a direction.
  const glm::dmat3 inverse = glm::inverse(instances.GetLinear(id.Instance));
  const glm::dvec3 eye = inverse *
    (camera.Parallel ? camera.Forward : camera.Position - instances.Transforms[id.Instance][3]);
  const double extent =
    camera.Parallel ? glm::length(eye) : glm::distance(eye, instances.Center) + instances.Radius;
  const auto doubt = static_cast<float>(
    FacingPrecision * extent + (camera.Parallel ? 0.0 : 1e-6 * glm::length(instances.Center)));
  const glm::vec4 from(glm::vec3(eye), camera.Parallel ? 0.f : 1.f);
  constexpr std::size_t BlockSize = 64;
  std::int32_t isSilhouette[BlockSize];
  const std::size_t count = shape.Smooth.size() / 2;
  for (std::size_t first = 0; first < count; first += BlockSize)
  {
    const std::size_t size = std::min(BlockSize, count - first);
    const float* planes[8];
    for (int k = 0; k < 8; ++k)
    {
      planes[k] = shape.Planes[k].data() + first;
    }
    for (std::size_t i = 0; i < size; ++i)
    {
      const float left = planes[0][i] * from.x + planes[1][i] * from.y + planes[2][i] * from.z +
        planes[3][i] * from.w;
      const float right = planes[4][i] * from.x + planes[5][i] * from.y + planes[6][i] * from.z +
        planes[7][i] * from.w;
      const float nearest = std::min(std::abs(left), std::abs(right));
      isSilhouette[i] = static_cast<int>(left * right >= 0.f) | static_cast<int>(nearest <= doubt);
    }
    for (std::size_t i = 0; i < size; ++i)
    {
      if (isSilhouette[i] != 0)
      {
        project(&shape.Smooth[2 * (first + i)]);
      }
    }
  }
}

}
