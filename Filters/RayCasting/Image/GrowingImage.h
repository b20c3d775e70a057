// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// An image that is rendered in several calls, each of which shows all that is known.
#ifndef penumbra_GrowingImage_h
#define penumbra_GrowingImage_h

#include "ImageRenderer.h"
#include "RegionRenderer.h"

#include <memory>
#include <vector>

namespace penumbra
{

class GrowingImage
{
public:
  /// Prepares the whole image of the camera. `settings` must have a limit. All arguments must outlive
  /// this object.
  GrowingImage(
    const CameraRayTracer& tracer, const SceneEdges& sceneEdges, const RenderSettings& settings);

  /// Works until the image is complete or the limit is reached; see RegionRenderer::Run().
  bool Run(const ProgressCallback& progress);

  /// Stores the image as far as it is known, as RenderImage() does. The extent of `image` must be set.
  void Store(vtkImageData* image, ImageTotals& totals) const;

private:
  const RenderSettings& Settings;
  const Scene& RenderedScene;
  std::vector<std::unique_ptr<RegionRenderer>> Regions;
};

}
#endif
