// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneBounds.h"

#include "Scene.h"

#include "vtkBoundingBox.h"

namespace penumbra
{

AxisAlignedBox ComputeInstanceBounds(const Surface& surface)
{
  AxisAlignedBox bounds;
  for (std::size_t i = 0; i < surface.Instances->GetCount(); ++i)
  {
    AxisAlignedBox extended = bounds;
    extended.Add(surface.Instances->GetBox(i));
    if (extended.Low == bounds.Low && extended.High == bounds.High)
    {
      continue; // few instances extend the bounds of those before
    }
    for (const glm::uvec3& triangle : surface.Triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        bounds.Add(surface.Instances->TransformPoint(i, surface.Positions[triangle[k]]));
      }
    }
  }
  return bounds;
}

double ComputeSceneDiagonal(const Scene& scene)
{
  vtkBoundingBox bounds;
  for (const Surface& surface : scene.Surfaces)
  {
    if (surface.Instances)
    {
      const AxisAlignedBox box = ComputeInstanceBounds(surface);
      bounds.AddPoint(box.Low.x, box.Low.y, box.Low.z);
      bounds.AddPoint(box.High.x, box.High.y, box.High.z);
      continue;
    }
    // Positions that no triangle uses are not drawn.
    for (const glm::uvec3& triangle : surface.Triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const glm::vec3& p = surface.Positions[triangle[k]];
        bounds.AddPoint(p.x, p.y, p.z);
      }
    }
    for (std::size_t i = 0; surface.IsRound() && i < surface.Positions.size(); ++i)
    {
      const glm::vec3 low = surface.Positions[i] - surface.GetRadius(i);
      const glm::vec3 high = surface.Positions[i] + surface.GetRadius(i);
      bounds.AddPoint(low.x, low.y, low.z);
      bounds.AddPoint(high.x, high.y, high.z);
    }
  }
  return bounds.IsValid() ? bounds.GetDiagonalLength() / scene.Scale : 1.0;
}

}
