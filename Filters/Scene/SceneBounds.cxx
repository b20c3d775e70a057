// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneBounds.h"

#include "Scene.h"

#include "vtkBoundingBox.h"

namespace penumbra
{

double ComputeSceneDiagonal(const Scene& scene)
{
  vtkBoundingBox bounds;
  for (const Surface& surface : scene.Surfaces)
  {
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
