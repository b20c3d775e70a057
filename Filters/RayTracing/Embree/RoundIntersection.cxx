// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RoundIntersection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

/// Fraction of the radius by which the caps and the side of a tube overlap, so that no ray passes
/// between them.
constexpr double Overlap = 1e-9;

/// Axis of a tube whose ends are two spheres, neither inside the other.
struct TubeAxis
{
  bool IsTube = false;
  glm::dvec3 Direction{ 0.0 }; ///< unit vector from A to B
  double Length = 0.0;
  double Sine = 0.0; ///< of the angle between the side and the axis; positive if B is larger
  double Cosine = 1.0;

  explicit TubeAxis(const RoundShape& shape)
  {
    const glm::dvec3 d = glm::dvec3(shape.B) - glm::dvec3(shape.A);
    this->Length = glm::length(d);
    const double growth = static_cast<double>(shape.RadiusB) - shape.RadiusA;
    this->IsTube = this->Length > std::abs(growth);
    if (this->IsTube)
    {
      this->Direction = d / this->Length;
      this->Sine = growth / this->Length;
      this->Cosine = std::sqrt(1.0 - this->Sine * this->Sine);
    }
  }
};

/// Returns true if the line is farther from the line through both ends than the larger radius. This
/// rejects most shapes whose bounds a ray hits at little cost.
bool IsFar(const RoundShape& shape, glm::dvec3 origin, glm::dvec3 direction)
{
  const glm::dvec3 a(shape.A);
  const glm::dvec3 normal = glm::cross(direction, glm::dvec3(shape.B) - a);
  const double volume = glm::dot(a - origin, normal);
  const double radius = (1.0 + Overlap) * std::max(shape.RadiusA, shape.RadiusB);
  return volume * volume > radius * radius * glm::dot(normal, normal);
}

/// Axis of a cylinder with flat ends.
struct FlatAxis
{
  glm::dvec3 Direction{ 0.0 }; ///< unit vector from A to B
  double Length = 0.0;

  explicit FlatAxis(const RoundShape& shape)
  {
    const glm::dvec3 d = glm::dvec3(shape.B) - glm::dvec3(shape.A);
    this->Length = glm::length(d);
    this->Direction = this->Length > 0.0 ? d / this->Length : d;
  }
};

/// Intersects a line with a cylinder with flat ends: the common part of the ranges in the infinite
/// cylinder and between the planes of its ends.
void IntersectFlat(
  const RoundShape& shape, glm::dvec3 origin, glm::dvec3 direction, RoundIntersection& result)
{
  const FlatAxis axis(shape);
  if (!(axis.Length > 0.0))
  {
    return;
  }
  const glm::dvec3 end(shape.A);
  const double shift = glm::dot(end - origin, direction) / glm::dot(direction, direction);
  const glm::dvec3 x = origin + shift * direction - end;
  const double height = glm::dot(x, axis.Direction);
  const double rise = glm::dot(direction, axis.Direction);
  const glm::dvec3 across = x - height * axis.Direction;
  const glm::dvec3 slope = direction - rise * axis.Direction;
  const double a = glm::dot(slope, slope);
  const double b = glm::dot(across, slope);
  const double c = glm::dot(across, across) - static_cast<double>(shape.RadiusA) * shape.RadiusA;
  const double discriminant = b * b - a * c;
  const bool isAlongAxis = a == 0.0;
  if (isAlongAxis ? c > 0.0 : !(discriminant >= 0.0))
  {
    return;
  }
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  if (!isAlongAxis)
  {
    // The stable form of the two solutions of a t^2 + 2 b t + c = 0.
    const double q = b >= 0.0 ? -b - std::sqrt(discriminant) : -b + std::sqrt(discriminant);
    const double first = q / a;
    const double second = q != 0.0 ? c / q : first;
    enter = std::min(first, second);
    leave = std::max(first, second);
  }
  if (rise != 0.0)
  {
    const double bottom = -height / rise;
    const double top = (axis.Length - height) / rise;
    enter = std::max(enter, std::min(bottom, top));
    leave = std::min(leave, std::max(bottom, top));
  }
  else if (height < 0.0 || height > axis.Length)
  {
    return;
  }
  result.IsHit = enter <= leave;
  result.Enter = shift + enter;
  result.Leave = shift + leave;
}

/// Extends the range of `result` by the parameter t.
void Extend(RoundIntersection& result, double t)
{
  result.Enter = result.IsHit ? std::min(result.Enter, t) : t;
  result.Leave = result.IsHit ? std::max(result.Leave, t) : t;
  result.IsHit = true;
}

}

// All parameters are relative to the point of the line that is nearest to an end of the shape, so
// that the precision does not depend on the distance of the ray's origin.
RoundIntersection::RoundIntersection(
  const RoundShape& shape, glm::dvec3 origin, glm::dvec3 direction)
{
  if (shape.HasFlatEnds)
  {
    if (!IsFar(shape, origin, direction))
    {
      IntersectFlat(shape, origin, direction, *this);
    }
    return;
  }
  const double square = glm::dot(direction, direction);
  if (shape.A == shape.B && shape.RadiusA == shape.RadiusB)
  {
    const glm::dvec3 center(shape.A);
    const double shift = glm::dot(center - origin, direction) / square;
    const glm::dvec3 x = origin + shift * direction - center;
    const double discriminant = static_cast<double>(shape.RadiusA) * shape.RadiusA - glm::dot(x, x);
    this->IsHit = discriminant >= 0.0;
    if (this->IsHit)
    {
      const double half = std::sqrt(discriminant / square);
      this->Enter = shift - half;
      this->Leave = shift + half;
    }
    return;
  }
  if (IsFar(shape, origin, direction))
  {
    return;
  }
  const TubeAxis axis(shape);
  const bool largerIsB = shape.RadiusB > shape.RadiusA;
  const glm::dvec3 ends[2] = { glm::dvec3(shape.A), glm::dvec3(shape.B) };
  const double radii[2] = { shape.RadiusA, shape.RadiusB };
  for (int end = 0; end < 2; ++end)
  {
    if (!axis.IsTube && end != (largerIsB ? 1 : 0))
    {
      continue;
    }
    const double shift = glm::dot(ends[end] - origin, direction) / square;
    const glm::dvec3 x = origin + shift * direction - ends[end];
    const double discriminant = radii[end] * radii[end] - glm::dot(x, x);
    if (!(discriminant >= 0.0))
    {
      continue;
    }
    const double half = std::sqrt(discriminant / square);
    for (const double t : { -half, half })
    {
      const double height = glm::dot(x + t * direction, axis.Direction);
      const double limit = -axis.Sine * radii[end];
      const double margin = Overlap * radii[end];
      if (!axis.IsTube || (end == 0 ? height <= limit + margin : height >= limit - margin))
      {
        Extend(*this, shift + t);
      }
    }
  }
  if (!axis.IsTube)
  {
    return;
  }
  // The side: |x perpendicular to the axis| = radius / cosine + tangent * height.
  const double shift = glm::dot(ends[0] - origin, direction) / square;
  const glm::dvec3 x = origin + shift * direction - ends[0];
  const double height = glm::dot(x, axis.Direction);
  const double rise = glm::dot(direction, axis.Direction);
  const glm::dvec3 across = x - height * axis.Direction;
  const glm::dvec3 slope = direction - rise * axis.Direction;
  const double tangent = axis.Sine / axis.Cosine;
  const double radius = radii[0] / axis.Cosine + tangent * height;
  const double a = glm::dot(slope, slope) - tangent * tangent * rise * rise;
  const double b = glm::dot(across, slope) - radius * tangent * rise;
  const double c = glm::dot(across, across) - radius * radius;
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0.0) || (a == 0.0 && b == 0.0))
  {
    return;
  }
  // The stable form of the two solutions of a t^2 + 2 b t + c = 0.
  const double q = b >= 0.0 ? -b - std::sqrt(discriminant) : -b + std::sqrt(discriminant);
  const double bottom = -radii[0] * axis.Sine - Overlap * radii[0];
  const double top = axis.Length - radii[1] * axis.Sine + Overlap * radii[1];
  for (const double t : { a != 0.0 ? q / a : std::numeric_limits<double>::quiet_NaN(),
         q != 0.0 ? c / q : std::numeric_limits<double>::quiet_NaN() })
  {
    const double y = height + t * rise;
    if (y >= bottom && y <= top && radii[0] / axis.Cosine + tangent * y >= 0.0)
    {
      Extend(*this, shift + t);
    }
  }
}

TouchingSphere::TouchingSphere(const RoundShape& shape, glm::dvec3 point)
{
  const glm::dvec3 a(shape.A);
  const glm::dvec3 b(shape.B);
  if (shape.HasFlatEnds)
  {
    const FlatAxis flat(shape);
    const glm::dvec3 x = point - a;
    const double height = glm::dot(x, flat.Direction);
    const double side = glm::length(x - height * flat.Direction) - shape.RadiusA;
    const bool isAtB = 2.0 * height > flat.Length;
    this->Radius = shape.RadiusA;
    this->U = flat.Length > 0.0 ? std::clamp(height / flat.Length, 0.0, 1.0) : 0.0;
    const bool isOnEnd = std::abs(isAtB ? height - flat.Length : height) < std::abs(side);
    this->Center = isOnEnd ? point + (isAtB ? -this->Radius : this->Radius) * flat.Direction
                           : a + this->U * (b - a);
    return;
  }
  const TubeAxis axis(shape);
  if (axis.IsTube)
  {
    const glm::dvec3 x = point - a;
    const double height = glm::dot(x, axis.Direction);
    const double across = glm::length(x - height * axis.Direction);
    this->U = std::clamp((height + across * axis.Sine / axis.Cosine) / axis.Length, 0.0, 1.0);
  }
  else
  {
    this->U = shape.RadiusB > shape.RadiusA ? 1.0 : 0.0;
  }
  this->Center = a + this->U * (b - a);
  this->Radius = (1.0 - this->U) * shape.RadiusA + this->U * shape.RadiusB;
}

}
