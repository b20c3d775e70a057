// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Converts vtkPointGaussianMapper: an image around each point that faces the camera.
#ifndef penumbra_SceneExtractionSplats_h
#define penumbra_SceneExtractionSplats_h

#include "SceneExtractionColors.h"
#include "Tessellation/SceneExtractionItem.h"

#include <string>
#include <vector>

class vtkPointGaussianMapper;

namespace penumbra
{

/// Adds a draw item for the points that `mapper` draws of `data` to `items`: splats, or points if
/// the scale factor is 0. `prototype` provides the transform and the property. Splats whose radius
/// is not finite are skipped with a warning; a scale or opacity array of the wrong length is
/// ignored with a warning.
void AddSplats(vtkPointGaussianMapper* mapper, vtkPolyData* data, const DrawItem& prototype,
  ScalarMapper* scalars, std::vector<DrawItem>& items, std::vector<std::string>& warnings);

/// Returns the splats of `item` as textured rectangles that face scene.ViewCamera, or `item` if it
/// has no splats. A splat is the perspective image of an ellipsoid, linearized at its center.
/// Source: Zwicker et al., EWA Volume Splatting, Visualization 2001, eqs. 22 to 26.
DrawItem FaceCamera(const DrawItem& item, const Scene& scene);

}
#endif
