// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders the arrays of an image, region by region, so that memory stays bounded.
#ifndef penumbra_ImageRenderer_h
#define penumbra_ImageRenderer_h

#include "ImageRegion.h"

#include "vtkType.h"

class vtkImageData;

namespace penumbra
{

/// Estimated errors of the tiles of 16x16 pixels.
struct TileErrors
{
  vtkIdType Tiles = 0;          ///< number of tiles
  vtkIdType AboveTolerance = 0; ///< number of tiles whose estimated RMSE is above the limit
  double MaximumError = 0.0;    ///< largest estimated RMSE of a tile
};

/// Compares the estimated RMSE of the tiles of `image` (array `EstimatedError`) with `limit`.
TileErrors EvaluateTiles(vtkImageData* image, double limit);

/**
 * Adds the arrays `Color`, `Rays` and `EstimatedError` to `image`, whose extent is set, and
 * composites the overlay of the scene over `Color`. Adds counts to `totals` and the squared errors
 * of all pixels to `squaredError`. Returns false if `progress` requested a stop.
 */
bool RenderImage(const CameraRayTracer& tracer, const SceneEdges& sceneEdges,
  const RenderSettings& settings, const ProgressCallback& progress, vtkImageData* image,
  ImageRegion& totals, double& squaredError);

}
#endif
