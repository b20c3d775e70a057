// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GrowingImage.h"

#include "Scene.h"

namespace penumbra
{

GrowingImage::GrowingImage(
  const CameraRayTracer& tracer, const SceneEdges& sceneEdges, const RenderSettings& settings)
  : Settings(settings),
    RenderedScene(tracer.GetScene())
{
  const Camera& camera = this->RenderedScene.ViewCamera;
  const int extent[6] = { 0, camera.Width - 1, 0, camera.Height - 1, 0, 0 };
  for (const RegionBounds& bounds : SplitIntoRegions(extent, camera))
  {
    this->Regions.push_back(
      std::make_unique<RegionRenderer>(tracer, sceneEdges, settings, bounds.Low, bounds.High));
  }
}

// All regions run, so that each has at least its coarse image.
bool GrowingImage::Run(const ProgressCallback& progress)
{
  const double count = static_cast<double>(this->Regions.size());
  int finished = 0;
  for (std::size_t i = 0; i < this->Regions.size(); ++i)
  {
    finished += this->Regions[i]->Run([&, i](double fraction) {
      return progress && progress((static_cast<double>(i) + fraction) / count);
    });
  }
  return finished == static_cast<int>(this->Regions.size());
}

void GrowingImage::Store(vtkImageData* image, ImageTotals& totals) const
{
  AddImageArrays(this->Settings, image);
  for (const std::unique_ptr<RegionRenderer>& renderer : this->Regions)
  {
    ImageRegion region = renderer->CopyResult();
    StoreRegion(region, this->RenderedScene.OverlayImage.get(), image, totals);
  }
}

}
