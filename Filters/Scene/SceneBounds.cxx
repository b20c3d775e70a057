// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneBounds.h"

#include "Execution/ParallelFor.h"
#include "Scene.h"
#include "Surface.h"

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

AxisAlignedBox ComputeTriangleBounds(const Surface& surface)
{
  const std::vector<std::size_t> boundaries = SplitIntoParts(surface.Triangles.size(), ArrayGrain);
  std::vector<AxisAlignedBox> parts(boundaries.size() - 1);
  ParallelFor<std::size_t>(0, parts.size(), 1, [&](std::size_t part) {
    AxisAlignedBox box;
    for (std::size_t i = boundaries[part]; i < boundaries[part + 1]; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        box.Add(surface.Positions[surface.Triangles[i][k]]);
      }
    }
    parts[part] = box;
  });
  AxisAlignedBox bounds;
  for (const AxisAlignedBox& part : parts)
  {
    bounds.Add(part);
  }
  return bounds;
}

AxisAlignedBox ComputeDrawnBounds(const Surface& surface)
{
  if (surface.Whole)
  {
    return surface.Whole->DrawnBounds;
  }
  // Positions that no triangle uses are not drawn.
  AxisAlignedBox box =
    surface.Instances ? ComputeInstanceBounds(surface) : ComputeTriangleBounds(surface);
  for (std::size_t i = 0; surface.IsRound() && i < surface.Positions.size(); ++i)
  {
    box.Add(surface.Positions[i] - surface.GetRadius(i));
    box.Add(surface.Positions[i] + surface.GetRadius(i));
  }
  return box;
}

double ComputeSceneDiagonal(const Scene& scene)
{
  vtkBoundingBox bounds;
  for (const Surface& surface : scene.Surfaces)
  {
    const AxisAlignedBox box = ComputeDrawnBounds(surface);
    if (!box.IsEmpty())
    {
      bounds.AddPoint(box.Low.x, box.Low.y, box.Low.z);
      bounds.AddPoint(box.High.x, box.High.y, box.High.z);
    }
  }
  return bounds.IsValid() ? bounds.GetDiagonalLength() / scene.Scale : 1.0;
}

}
