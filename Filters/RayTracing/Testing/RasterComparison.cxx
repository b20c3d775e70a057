// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RasterComparison.h"

#include "Embree/RayScene.h"
#include "Import/SceneExtraction.h"
#include "Shading/Shading.h"
#include "Surface.h"

#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

using namespace penumbra;

namespace
{

/// Color at the center of a pixel: translucent layers from front to back, then the background.
struct Pixel
{
  glm::vec3 Color{ 0.f };
  std::vector<std::uint64_t> Layers; ///< surface and cell of each layer
};

Pixel Trace(const Scene& scene, const RayScene& rays, const Shading& shading, int i, int j)
{
  const glm::dvec2 center(i + .5, j + .5);
  Ray ray;
  ray.Origin = scene.ViewCamera.RayOrigin(center);
  ray.Direction = scene.ViewCamera.RayDirection(center);
  ray.Near = static_cast<float>(scene.ViewCamera.Near);
  Pixel pixel;
  float transmittance = 1.f;
  long long shadowRays = 0;
  for (int layer = 0; layer < 20; ++layer)
  {
    const Hit hit = rays.Intersect(ray);
    if (!hit.IsHit())
    {
      break;
    }
    const Surface& surface = scene.Surfaces[hit.Surface];
    // A cell may consist of several lines; each is a layer.
    const std::uint32_t cell =
      surface.IsLineOrPoint ? hit.Primitive / 2 : surface.GetCellId(hit.Primitive);
    pixel.Layers.push_back((std::uint64_t(hit.Surface) << 32) + cell);
    const ShadedHit at = shading.Shade(ray, hit, shadowRays);
    const glm::vec3 color = glm::clamp(glm::vec3(at.Color), 0.f, 1.f);
    pixel.Color += transmittance * at.Color.a * color;
    transmittance *= 1.f - at.Color.a;
    if (transmittance <= 0.f)
    {
      break;
    }
    ray.Near = hit.Distance * 1.00001f;
  }
  pixel.Color += transmittance * glm::vec3(shading.Background(center));
  return pixel;
}

}

RasterComparison::RasterComparison()
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(Size, Size);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(.2, .3, .4);
}

RasterComparison::Result RasterComparison::Compare()
{
  this->Window->Render();
  vtkNew<vtkUnsignedCharArray> raster;
  this->Window->GetPixelData(0, 0, Size - 1, Size - 1, 1, raster);

  ExtractionOptions options;
  options.Resolution[0] = options.Resolution[1] = Size;
  Result result;
  result.Scene = ExtractScene(this->Renderer, options);
  const RayScene rays(result.Scene, 1);
  const Shading shading(rays, false);
  std::vector<Pixel> pixels;
  for (int j = 0; j < Size; ++j)
  {
    for (int i = 0; i < Size; ++i)
    {
      pixels.push_back(Trace(result.Scene, rays, shading, i, j));
    }
  }
  const auto at = [&](int i, int j) -> const Pixel& { return pixels[j * Size + i]; };
  for (int j = 1; j + 1 < Size; ++j)
  {
    for (int i = 1; i + 1 < Size; ++i)
    {
      bool inside = !at(i, j).Layers.empty();
      for (int k = 0; k < 9; ++k)
      {
        inside = inside && at(i + k % 3 - 1, j + k / 3 - 1).Layers == at(i, j).Layers;
      }
      if (!inside)
      {
        continue;
      }
      ++result.Pixels;
      double difference = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        difference = std::max(
          difference, std::abs(255.0 * at(i, j).Color[k] - raster->GetComponent(j * Size + i, k)));
      }
      result.Different += difference > 2.0;
      if (difference > result.Largest)
      {
        result.Largest = difference;
        result.Where[0] = i;
        result.Where[1] = j;
      }
    }
  }
  return result;
}
