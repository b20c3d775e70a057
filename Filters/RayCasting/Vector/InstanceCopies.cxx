// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InstanceCopies.h"

#include "Surface.h"

#include <utility>

namespace penumbra
{
namespace
{

/// Replaces `values` by `count` copies of them, each changed by convert(copy, value).
template <typename T, typename Convert>
void Repeat(std::vector<T>& values, std::size_t count, Convert convert)
{
  std::vector<T> repeated;
  repeated.reserve(values.size() * count + 1); // see Surface
  for (std::size_t i = 0; i < count; ++i)
  {
    for (const T& value : values)
    {
      repeated.push_back(convert(i, value));
    }
  }
  values = std::move(repeated);
}

void CopyInstances(Surface& surface)
{
  const std::shared_ptr<const SurfaceInstances> instances = std::move(surface.Instances);
  surface.Instances = nullptr;
  const std::size_t count = instances->GetCount();
  const auto points = static_cast<std::uint32_t>(surface.Positions.size());
  const auto keep = [](std::size_t, glm::vec2 value) { return value; };
  const auto transformNormal = [&](std::size_t i, glm::vec3 normal) {
    return glm::vec3(instances->GetNormalMatrix(i) * glm::dvec3(normal));
  };
  surface.CellColors.clear();
  surface.CellIds.clear();
  for (std::size_t i = 0; i < count; ++i)
  {
    surface.CellColors.insert(
      surface.CellColors.end(), surface.Triangles.size(), instances->Colors[i]);
    surface.CellIds.insert(surface.CellIds.end(), surface.Triangles.size(), instances->Ids[i]);
  }
  Repeat(surface.Positions, count,
    [&](std::size_t i, glm::vec3 x) { return instances->TransformPoint(i, x); });
  Repeat(surface.Triangles, count, [&](std::size_t i, glm::uvec3 triangle) {
    return triangle + static_cast<std::uint32_t>(i) * points;
  });
  Repeat(surface.Normals, count, transformNormal);
  Repeat(surface.TriangleNormals, count, transformNormal);
  Repeat(surface.Tangents, count, transformNormal);
  Repeat(surface.TextureCoordinates, count, keep);
  Repeat(surface.ColorCoordinates, count, keep);
}

}

void CopyInstances(std::vector<Surface>& surfaces)
{
  for (Surface& surface : surfaces)
  {
    if (surface.Instances)
    {
      CopyInstances(surface);
    }
  }
}

}
