// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From a traced scene to the arrays of an image, part by part, so that memory stays bounded.
#ifndef penumbra_ImageRenderer_h
#define penumbra_ImageRenderer_h

#include "ImageRegion.h"

class vtkImageData;

namespace penumbra
{

/// Tiles of 16x16 pixels by the error that they are believed to have.
struct TileErrors
{
  vtkIdType Tiles = 0;
  vtkIdType Over = 0; ///< those above the limit
  double Worst = 0.0; ///< RMSE of the worst of all
};

/// Compares the tiles of a picture with `limit`.
TileErrors JudgeTiles(vtkImageData* image, double limit);

/**
 * Adds `Color`, `Rays` and `EstimatedError` to `image`, which has its extent, with what lies over the
 * picture. `totals` collects counts; `squaredError` the sum over all pixels. False when `progress`
 * stopped it.
 */
bool RenderImage(const CameraRayTracer& sampler, const SceneEdges& meshes,
  const RenderSettings& settings, const ProgressCallback& progress, vtkImageData* image,
  ImageRegion& totals, double& squaredError);

}
#endif
