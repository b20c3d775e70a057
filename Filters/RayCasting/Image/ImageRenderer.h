// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders the arrays of an image, region by region, so that memory stays bounded.
#ifndef penumbra_ImageRenderer_h
#define penumbra_ImageRenderer_h

#include "ImageRegion.h"

#include "vtkType.h"

#include <cmath>
#include <vector>

class vtkImageData;

namespace penumbra
{

class Overlay;

/// Counts and errors of a whole image.
struct ImageTotals
{
  RayCounts Rays;
  PixelCounts Pixels;
  long long Edges = 0;            ///< number of projected edges
  long long Unfinished = 0;       ///< number of pixels whose work the limit ended
  double SquaredError = 0.0;      ///< sum of the squared estimated errors of the pixels
  double SquaredLightError = 0.0; ///< part that light effects cause

  double ComputeError(vtkIdType pixels) const { return std::sqrt(this->SquaredError / pixels); }
  double ComputeLightError(vtkIdType pixels) const
  {
    return std::sqrt(this->SquaredLightError / pixels);
  }
};

/// The pixels [Low, High) of a region.
struct RegionBounds
{
  glm::ivec2 Low, High;
};

/// Returns the regions that are rendered for the pixels of an extent, with whole tiles.
std::vector<RegionBounds> SplitIntoRegions(const int* extent, const Camera& camera);

/// Adds the arrays of RenderImage() to `image`, with undefined values.
void AddImageArrays(const RenderSettings& settings, vtkImageData* image);

/// Stores the pixels of `region` that lie in `image`, with `overlay`, which may be null, composited over them, and adds
/// their errors and the counts of the region to `totals`.
void StoreRegion(
  ImageRegion& region, const Overlay* overlay, vtkImageData* image, ImageTotals& totals);

/// Sets the squared errors of `totals` to those of the pixels of an image with these arrays.
void SumErrors(vtkImageData* image, ImageTotals& totals);

/// Composites `overlay` over the colors of an image of the whole extent.
void CompositeOverlay(const Overlay& overlay, vtkImageData* image);

/**
 * Adds the arrays `Color`, `Rays` and `EstimatedError` to `image`, whose extent is set, with light
 * effects also `EstimatedLightError`, if the settings say so `AmbientOcclusion`, and composites
 * the overlay of the scene over `Color`. Adds counts and errors to `totals`.
 * Returns false if `progress` requested a stop.
 */
bool RenderImage(const CameraRayTracer& tracer, const SceneEdges& sceneEdges,
  const RenderSettings& settings, const ProgressCallback& progress, vtkImageData* image,
  ImageTotals& totals);

}
#endif
