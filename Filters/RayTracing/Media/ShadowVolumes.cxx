// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShadowVolumes.h"

#include "Light.h"
#include "Shading/RayTracingConstants.h"
#include "Surface.h"

#include <algorithm>

namespace penumbra
{

namespace
{

/// Splits a set of triangles recursively at the median along the longest side of its bounding box.
void SplitAtMedian(std::vector<AxisAlignedBox>& triangles, std::size_t begin, std::size_t end,
  int levels, std::vector<AxisAlignedBox>& boxes)
{
  if (begin == end)
  {
    return;
  }
  AxisAlignedBox whole = triangles[begin];
  for (std::size_t i = begin; i < end; ++i)
  {
    whole.Add(triangles[i]);
  }
  if (levels == 0 || end - begin == 1)
  {
    const glm::vec3 margin = ShadowVolumeMargin * (glm::abs(whole.Low) + glm::abs(whole.High));
    boxes.push_back({ whole.Low - margin, whole.High + margin });
    return;
  }
  const glm::vec3 size = whole.High - whole.Low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(triangles.begin() + begin, triangles.begin() + middle, triangles.begin() + end,
    [axis](const AxisAlignedBox& a, const AxisAlignedBox& b) {
      return a.Low[axis] + a.High[axis] < b.Low[axis] + b.High[axis];
    });
  SplitAtMedian(triangles, begin, middle, levels - 1, boxes);
  SplitAtMedian(triangles, middle, end, levels - 1, boxes);
}

}

std::vector<AxisAlignedBox> BoundOccluders(const std::vector<Surface>& surfaces)
{
  std::vector<AxisAlignedBox> triangles;
  for (const Surface& surface : surfaces)
  {
    if (surface.IsLineOrPoint)
    {
      continue;
    }
    for (std::size_t i = 0; surface.IsRound() && i < surface.GetNumberOfPrimitives(); ++i)
    {
      const RoundShape shape = surface.GetRoundShape(static_cast<std::uint32_t>(i));
      triangles.push_back({ glm::min(shape.A - shape.RadiusA, shape.B - shape.RadiusB),
        glm::max(shape.A + shape.RadiusA, shape.B + shape.RadiusB) });
    }
    for (std::size_t i = 0; surface.Instances && i < surface.Instances->GetCount(); ++i)
    {
      triangles.push_back(surface.Instances->GetBox(i));
    }
    for (std::size_t i = 0; !surface.Instances && i < surface.Triangles.size(); ++i)
    {
      const glm::uvec3 corners = surface.Triangles[i];
      const glm::vec3& a = surface.Positions[corners.x];
      const glm::vec3& b = surface.Positions[corners.y];
      const glm::vec3& c = surface.Positions[corners.z];
      triangles.push_back({ glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c) });
    }
  }
  std::vector<AxisAlignedBox> boxes;
  SplitAtMedian(triangles, 0, triangles.size(), ShadowVolumeLevels, boxes);
  return boxes;
}

ShadowVolumes::ShadowVolumes(const std::vector<AxisAlignedBox>& boxes, const Light& light)
{
  // The light in homogeneous coordinates: a position, or the direction toward the light.
  const glm::dvec4 source = light.Kind == Light::Kinds::Directional
    ? glm::dvec4(-glm::dvec3(light.Direction), 0.0)
    : glm::dvec4(glm::dvec3(light.Position), 1.0);
  for (const AxisAlignedBox& box : boxes)
  {
    Region region;
    for (int axis = 0; axis < 3; ++axis)
    {
      // The shadow volume begins at the lit faces of the box.
      glm::dvec3 normal(0.0);
      normal[axis] = 1.0;
      if (source[axis] > source.w * box.High[axis])
      {
        region.push_back({ normal, box.High[axis] });
      }
      if (source[axis] < source.w * box.Low[axis])
      {
        region.push_back({ -normal, -box.Low[axis] });
      }
      AddSides(region, axis, source, box);
    }
    this->Regions.push_back(std::move(region));
  }
}

/// Projected along one axis, the box is a rectangle, and its shadow lies between the two lines
/// through the light that touch the rectangle.
void ShadowVolumes::AddSides(Region& region, int axis, glm::dvec4 light, const AxisAlignedBox& box)
{
  const int i = (axis + 1) % 3;
  const int j = (axis + 2) % 3;
  for (int corner = 0; corner < 4; ++corner)
  {
    const double x = corner & 1 ? box.High[i] : box.Low[i];
    const double y = corner & 2 ? box.High[j] : box.Low[j];
    glm::dvec3 normal(0.0);
    normal[i] = light.w * y - light[j];
    normal[j] = light[i] - light.w * x;
    const double offset = normal[i] * x + normal[j] * y;
    double minimum = 0.0;
    double maximum = 0.0;
    for (int other = 0; other < 4; ++other)
    {
      const double height = normal[i] * (other & 1 ? box.High[i] : box.Low[i]) +
        normal[j] * (other & 2 ? box.High[j] : box.Low[j]) - offset;
      minimum = std::min(minimum, height);
      maximum = std::max(maximum, height);
    }
    const double rounding = 1e-12 * (maximum - minimum);
    if (maximum <= rounding && minimum < 0.0)
    {
      region.push_back({ normal, offset });
    }
    if (minimum >= -rounding && maximum > 0.0)
    {
      region.push_back({ -normal, -offset });
    }
  }
}

std::vector<RayInterval> ShadowVolumes::Along(
  glm::dvec3 origin, glm::dvec3 direction, double from, double to) const
{
  std::vector<RayInterval> intervals;
  for (const Region& region : this->Regions)
  {
    RayInterval interval{ from, to };
    for (const HalfSpace& half : region)
    {
      const double height = glm::dot(half.Normal, origin) - half.Offset;
      const double rise = glm::dot(half.Normal, direction);
      if (rise > 0.0)
      {
        interval.To = std::min(interval.To, -height / rise);
      }
      else if (rise < 0.0)
      {
        interval.From = std::max(interval.From, -height / rise);
      }
      else if (height > 0.0)
      {
        interval.To = interval.From;
      }
      if (!(interval.From < interval.To))
      {
        break;
      }
    }
    if (interval.From < interval.To)
    {
      intervals.push_back(interval);
    }
  }
  std::sort(intervals.begin(), intervals.end(),
    [](const RayInterval& a, const RayInterval& b) { return a.From < b.From; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < intervals.size(); ++i)
  {
    if (intervals[i].From <= intervals[last].To)
    {
      intervals[last].To = std::max(intervals[last].To, intervals[i].To);
    }
    else
    {
      intervals[++last] = intervals[i];
    }
  }
  intervals.resize(intervals.empty() ? 0 : last + 1);
  return intervals;
}

}
