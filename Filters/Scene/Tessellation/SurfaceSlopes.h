// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Slopes of the surfaces that lines and points lie on. Where polygons are offset by their slope, the
// lines and points on them are offset by the same amount in the other direction.
#ifndef penumbra_SurfaceSlopes_h
#define penumbra_SurfaceSlopes_h

#include "SceneExtractionItem.h"

#include "vtkNew.h"

#include <vector>

class vtkPolyData;
class vtkStaticCellLocator;

namespace penumbra
{

class SurfaceSlopes
{
public:
  /// Collects the polygons of `items`, without those of glyphs.
  SurfaceSlopes(const std::vector<DrawItem>& items, const Scene& scene);
  ~SurfaceSlopes();
  SurfaceSlopes(const SurfaceSlopes&) = delete;
  SurfaceSlopes& operator=(const SurfaceSlopes&) = delete;

  /// Returns the depth that the nearest polygon traverses per pixel, in pixels; 0 if none is within
  /// a few pixels of x.
  double Find(glm::dvec3 x) const;

private:
  const Camera View;
  vtkNew<vtkPolyData> Triangles;
  vtkNew<vtkStaticCellLocator> Locator;
};

/// Sets the slopes of all items if the offset of a line or point depends on them.
void FindSlopes(const Scene& scene, std::vector<DrawItem>& items);

}
#endif
