// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RoundOutlines.h"

#include "OutlineProjector.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

bool BoundSphere(
  glm::dvec3 center, double radius, const Camera& camera, glm::dvec2& low, glm::dvec2& high)
{
  const glm::dvec3 d = center - camera.Position;
  const double depth = glm::dot(d, camera.Forward);
  const glm::dvec2 offset(glm::dot(d, camera.Right), glm::dot(d, camera.Up));
  if (camera.Parallel)
  {
    low = camera.Center + (offset - radius) / camera.PixelSize;
    high = camera.Center + (offset + radius) / camera.PixelSize;
    return true;
  }
  if (!(depth > radius * (1.0 + 1e-6)))
  {
    return false;
  }
  const double square = depth * depth - radius * radius;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double root = radius * std::sqrt(offset[axis] * offset[axis] + square);
    low[axis] = camera.Center[axis] + (offset[axis] * depth - root) / (square * camera.PixelSize);
    high[axis] = camera.Center[axis] + (offset[axis] * depth + root) / (square * camera.PixelSize);
  }
  return true;
}

namespace
{

bool BoundShape(const RoundShape& shape, const Camera& camera, glm::dvec2& low, glm::dvec2& high)
{
  glm::dvec2 lowB;
  glm::dvec2 highB;
  if (!BoundSphere(glm::dvec3(shape.A), shape.RadiusA, camera, low, high) ||
    !BoundSphere(glm::dvec3(shape.B), shape.RadiusB, camera, lowB, highB))
  {
    return false;
  }
  low = glm::min(low, lowB);
  high = glm::max(high, highB);
  return true;
}

/// The circle on a sphere that is its outline. Normal(angle) is the normal of the sphere there.
struct OutlineCircle
{
  bool IsVisible = false; ///< false if the camera is inside the sphere
  glm::dvec3 Sphere{ 0.0 };
  double Radius = 0.0;
  double ImageRadius = 0.0;
  glm::dvec3 U{ 0.0 }; ///< unit vectors
  glm::dvec3 V{ 0.0 };
  glm::dvec3 Offset{ 0.0 }; ///< from the center of the sphere to that of the circle, over Radius
  double Scale = 1.0;       ///< radius of the circle over Radius

  OutlineCircle(glm::dvec3 center, double radius, const Camera& camera)
    : Sphere(center),
      Radius(radius)
  {
    glm::dvec3 axis = camera.Forward;
    this->IsVisible = radius > 0.0;
    if (!camera.Parallel)
    {
      const glm::dvec3 d = center - camera.Position;
      const double distance = glm::length(d);
      this->IsVisible = this->IsVisible && distance > radius * (1.0 + 1e-9);
      if (!this->IsVisible)
      {
        return;
      }
      axis = d / distance;
      const double sine = radius / distance;
      this->Offset = -sine * axis;
      this->Scale = std::sqrt(1.0 - sine * sine);
    }
    const glm::dvec3 across = glm::cross(axis, camera.Up);
    const double length = glm::length(across);
    this->U = length > 1e-6 ? across / length : camera.Right;
    this->V = glm::cross(this->U, axis);
    glm::dvec2 low;
    glm::dvec2 high;
    this->ImageRadius = BoundSphere(center, radius, camera, low, high)
      ? 0.5 * glm::distance(low, high)
      : static_cast<double>(camera.Width + camera.Height);
  }

  glm::dvec3 Normal(double angle) const
  {
    return this->Offset + this->Scale * (std::cos(angle) * this->U + std::sin(angle) * this->V);
  }

  Arc MakeArc(double begin, double size) const
  {
    const double r = this->Radius * this->Scale;
    return { this->Sphere + this->Radius * this->Offset, r * this->U, r * this->V, begin, size };
  }
};

/// A range of angles.
struct AngleRange
{
  double Begin = 0.0;
  double Size = FullAngle;
};

/// Returns the angles at which Normal() . direction <= limit.
AngleRange FindAngles(const OutlineCircle& circle, glm::dvec3 direction, double limit)
{
  const double u = glm::dot(circle.U, direction);
  const double v = glm::dot(circle.V, direction);
  const double amplitude = circle.Scale * std::hypot(u, v);
  const double rest = limit - glm::dot(circle.Offset, direction);
  if (rest >= amplitude)
  {
    return {};
  }
  if (rest <= -amplitude)
  {
    return { 0.0, 0.0 };
  }
  const double half = std::acos(rest / amplitude);
  return { std::atan2(v, u) + half, FullAngle - 2.0 * half };
}

/// A tube between two spheres of which neither contains the other.
struct Tube
{
  bool IsTube = false;
  glm::dvec3 Direction{ 0.0 };
  double Sine = 0.0;

  explicit Tube(const RoundShape& shape)
  {
    const glm::dvec3 d = glm::dvec3(shape.B) - glm::dvec3(shape.A);
    const double length = glm::length(d);
    const double growth = static_cast<double>(shape.RadiusB) - shape.RadiusA;
    this->IsTube = length > std::abs(growth);
    if (this->IsTube)
    {
      this->Direction = d / length;
      this->Sine = growth / length;
    }
  }
};

/// Adds the parts of the circle at angles in both ranges.
void AddCommonArcs(
  OutlineProjector& projector, const OutlineCircle& circle, AngleRange a, AngleRange b)
{
  if (a.Size >= FullAngle || b.Size >= FullAngle)
  {
    const AngleRange& smaller = a.Size < b.Size ? a : b;
    if (smaller.Size > 0.0)
    {
      projector.AddArc(circle.MakeArc(smaller.Begin, smaller.Size), circle.ImageRadius);
    }
    return;
  }
  for (int turn = -2; turn <= 2; ++turn)
  {
    const double begin = std::max(a.Begin, b.Begin + turn * FullAngle);
    const double end = std::min(a.Begin + a.Size, b.Begin + turn * FullAngle + b.Size);
    if (end > begin)
    {
      projector.AddArc(circle.MakeArc(begin, end - begin), circle.ImageRadius);
    }
  }
}

void AddTube(const Surface& surface, std::uint32_t primitive, const RoundShape& shape,
  const Tube& tube, const Camera& camera, OutlineProjector& projector)
{
  const OutlineCircle start(glm::dvec3(shape.A), shape.RadiusA, camera);
  const OutlineCircle end(glm::dvec3(shape.B), shape.RadiusB, camera);
  if (!start.IsVisible || !end.IsVisible)
  {
    return;
  }
  const std::vector<glm::uvec2>& segments = surface.Segments;
  const AngleRange startCap = FindAngles(start, tube.Direction, -tube.Sine);
  AngleRange afterPrevious;
  if (primitive > 0 && segments[primitive - 1].y == segments[primitive].x)
  {
    const Tube previous(surface.GetRoundShape(primitive - 1));
    if (previous.IsTube)
    {
      afterPrevious = FindAngles(start, -previous.Direction, previous.Sine);
    }
  }
  AddCommonArcs(projector, start, startCap, afterPrevious);
  if (primitive + 1 == segments.size() || segments[primitive + 1].x != segments[primitive].y)
  {
    AddCommonArcs(projector, end, FindAngles(end, -tube.Direction, tube.Sine), {});
  }
  // The two lines that touch both ends. Their planes contain the camera.
  if (startCap.Size > 0.0 && startCap.Size < FullAngle)
  {
    for (const double angle : { startCap.Begin, startCap.Begin + startCap.Size })
    {
      const glm::dvec3 normal = start.Normal(angle);
      projector.AddLine(start.Sphere + start.Radius * normal, end.Sphere + end.Radius * normal);
    }
  }
}

/// Adds the silhouettes of the side of a cylinder with flat ends, the circles of the ends that face
/// the camera, and the visible parts of the other circles.
void AddFlatTube(const RoundShape& shape, const Camera& camera, OutlineProjector& projector)
{
  const glm::dvec3 ends[2] = { glm::dvec3(shape.A), glm::dvec3(shape.B) };
  const double length = glm::distance(ends[0], ends[1]);
  const double radius = shape.RadiusA;
  if (!(length > 0.0))
  {
    return;
  }
  const glm::dvec3 axis = (ends[1] - ends[0]) / length;
  const glm::dvec3 helper =
    std::abs(axis.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis, helper));
  const glm::dvec3 v = glm::cross(axis, u);
  const auto towardCamera = [&](int end) {
    return camera.Parallel ? -camera.Forward : camera.Position - ends[end];
  };
  // The side faces the camera at the angles at which its normal . towardCamera > limit.
  const double limit = camera.Parallel ? 0.0 : radius;
  const double x = glm::dot(towardCamera(0), u);
  const double y = glm::dot(towardCamera(0), v);
  const double amplitude = std::hypot(x, y);
  const bool hasSide = amplitude > limit;
  const double half = hasSide ? std::acos(limit / amplitude) : 0.0;
  const double begin = std::atan2(y, x) - half;
  Arc arcs[2];
  for (int end = 0; end < 2; ++end)
  {
    arcs[end] = { ends[end], radius * u, radius * v, begin, hasSide ? 2.0 * half : FullAngle };
    const bool isFacing = (end == 0 ? -1.0 : 1.0) * glm::dot(towardCamera(end), axis) > 0.0;
    glm::dvec2 low;
    glm::dvec2 high;
    const double imageRadius = BoundSphere(ends[end], radius, camera, low, high)
      ? 0.5 * glm::distance(low, high)
      : static_cast<double>(camera.Width + camera.Height);
    if (hasSide || isFacing)
    {
      projector.AddArc(arcs[end], imageRadius);
    }
    if (hasSide && isFacing)
    {
      Arc rest = arcs[end];
      rest.Begin = begin + 2.0 * half;
      rest.Size = FullAngle - 2.0 * half;
      projector.AddArc(rest, imageRadius);
    }
  }
  for (int side = 0; hasSide && side < 2; ++side)
  {
    const double angle = begin + 2.0 * half * side;
    projector.AddLine(arcs[0].At(angle), arcs[1].At(angle));
  }
}

}

void ProjectOutline(const Surface& surface, std::uint32_t primitive, const Camera& camera,
  glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges)
{
  OutlineProjector projector(camera, low, high, edges);
  const RoundShape shape = surface.GetRoundShape(primitive);
  if (shape.HasFlatEnds)
  {
    AddFlatTube(shape, camera, projector);
    return;
  }
  const Tube tube(shape);
  if (tube.IsTube)
  {
    AddTube(surface, primitive, shape, tube, camera, projector);
    return;
  }
  const bool largerIsB = shape.RadiusB > shape.RadiusA;
  const OutlineCircle circle(
    glm::dvec3(largerIsB ? shape.B : shape.A), largerIsB ? shape.RadiusB : shape.RadiusA, camera);
  if (circle.IsVisible)
  {
    projector.AddArc(circle.MakeArc(0.0, FullAngle), circle.ImageRadius);
  }
}

RoundOutlines::RoundOutlines(const Scene& scene, const TileGrid& tiles)
  : OutlinedScene(scene),
    FirstShape(1, 0)
{
  for (std::uint32_t i = 0; i < scene.Surfaces.size(); ++i)
  {
    if (scene.Surfaces[i].IsRound())
    {
      this->Surfaces.push_back(i);
      this->FirstShape.push_back(this->FirstShape.back() +
        static_cast<std::uint32_t>(scene.Surfaces[i].GetNumberOfPrimitives()));
    }
  }
  this->SortByTiles(
    this->FirstShape.back(), tiles, std::numeric_limits<int>::max(), scene.ViewCamera);
}

PrimitiveId RoundOutlines::FindPrimitive(std::uint32_t shape) const
{
  const std::size_t k = std::upper_bound(this->FirstShape.begin(), this->FirstShape.end(), shape) -
    this->FirstShape.begin() - 1;
  return { this->Surfaces[k], shape - this->FirstShape[k] };
}

ShapeBounds RoundOutlines::FindBounds(std::uint32_t shape) const
{
  const PrimitiveId id = this->FindPrimitive(shape);
  const Camera& camera = this->OutlinedScene.ViewCamera;
  const RoundShape round = this->OutlinedScene.Surfaces[id.Surface].GetRoundShape(id.Primitive);
  const double radius = std::max(round.RadiusA, round.RadiusB);
  const double depths[] = { camera.Depth(glm::dvec3(round.A)), camera.Depth(glm::dvec3(round.B)) };
  ShapeBounds bounds;
  bounds.Depth = std::min(depths[0], depths[1]) - radius;
  bounds.IsVisible = !(std::max(depths[0], depths[1]) + radius < camera.Near);
  bounds.IsKnown = bounds.IsVisible && BoundShape(round, camera, bounds.Low, bounds.High);
  return bounds;
}

void RoundOutlines::ProjectShape(
  std::uint32_t shape, glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges) const
{
  const PrimitiveId id = this->FindPrimitive(shape);
  std::size_t first = edges.size();
  ProjectOutline(this->OutlinedScene.Surfaces[id.Surface], id.Primitive,
    this->OutlinedScene.ViewCamera, low, high, edges);
  for (; first < edges.size(); ++first)
  {
    edges[first].RoundSurface = id.Surface;
    edges[first].RoundPrimitive = id.Primitive;
  }
}

void ProjectCircle(glm::dvec3 center, double radius, glm::dvec3 normal, const Camera& camera,
  glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges)
{
  const glm::dvec3 helper =
    std::abs(normal.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(normal, helper));
  const glm::dvec3 v = glm::cross(normal, u);
  glm::dvec2 lowest;
  glm::dvec2 highest;
  if (!BoundSphere(center, radius, camera, lowest, highest))
  {
    return;
  }
  OutlineProjector projector(camera, low, high, edges);
  projector.AddArc(
    { center, radius * u, radius * v, 0.0, FullAngle }, 0.5 * glm::distance(lowest, highest));
}

}
