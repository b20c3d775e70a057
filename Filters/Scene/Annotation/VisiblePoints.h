// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Points of vtkSelectVisiblePoints, which compares points with the depth buffer of a window. Here the
// depths are those of rays.
#ifndef penumbra_VisiblePoints_h
#define penumbra_VisiblePoints_h

#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <functional>
#include <vector>

class vtkCamera;
class vtkPolyData;
class vtkSelectVisiblePoints;

namespace penumbra
{

struct Scene;

/// Returns the depth of the first opaque surface of a scene, in scene units along the view axis, at
/// points of its image; infinity where there is none.
using DepthQuery =
  std::function<std::vector<double>(const Scene& scene, const std::vector<glm::dvec2>& points)>;

/// Returns the output that `filter` has for an image of `scene`, or null if its input is no data set.
/// Depths are compared like values of the depth buffer of `camera`.
vtkSmartPointer<vtkPolyData> SelectVisiblePoints(vtkSelectVisiblePoints* filter, vtkCamera* camera,
  const Scene& scene, const DepthQuery& findDepths);

}
#endif
