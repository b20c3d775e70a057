// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageRenderer.h"

#include "Overlay.h"
#include "Scene.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <numeric>

namespace penumbra
{
namespace
{

// Approximate number of pixels of a region. The regions of an image are rendered one after the
// other to bound memory. A region consists of whole rows of tiles.
constexpr int PixelsPerRegion = 1 << 22;
// Regions start at multiples of this number of pixels, the side of a tile in ImageRegion.cxx.
constexpr int Alignment = 32;

void AddFloatArray(vtkImageData* image, const char* name, int components)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
}

/// Copies one row of an array of floats and returns the sum of their squares.
double CopyRow(const float* from, int width, vtkFloatArray* array, vtkIdType to)
{
  double squares = 0.0;
  for (int x = 0; x < width; ++x)
  {
    array->SetValue(to + x, from[x]);
    squares += static_cast<double>(from[x]) * from[x];
  }
  return squares;
}

/// Copies the rows of `region` that lie in `image`, with `overlay` composited over them. Adds their
/// squared errors to `totals`.
void CopyRows(ImageRegion& region, const Overlay* overlay, vtkImageData* image, ImageTotals& totals)
{
  const auto find = [image](const char* name) {
    return vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(name));
  };
  vtkFloatArray* color = find("Color");
  vtkFloatArray* rays = find("Rays");
  vtkFloatArray* errors = find("EstimatedError");
  vtkFloatArray* lightErrors = find("EstimatedLightError");
  vtkFloatArray* occlusions = find("AmbientOcclusion");
  int extent[6];
  image->GetExtent(extent);
  const int width = extent[1] - extent[0] + 1;
  for (int y = std::max(region.Low.y, extent[2]); y < std::min(region.High.y, extent[3] + 1); ++y)
  {
    const std::size_t from = region.Index(extent[0], y);
    const vtkIdType to = static_cast<vtkIdType>(y - extent[2]) * width;
    if (overlay)
    {
      overlay->CompositeOver(extent[0], y, width, &region.Colors[from]);
    }
    std::copy_n(&region.Colors[from].x, 4 * width, color->GetPointer(4 * to));
    std::copy_n(&region.RaysPerPixel[from], width, rays->GetPointer(to));
    totals.SquaredError += CopyRow(&region.Errors[from], width, errors, to);
    if (occlusions)
    {
      std::copy_n(&region.Occlusions[from], width, occlusions->GetPointer(to));
    }
    if (lightErrors)
    {
      totals.SquaredLightError += CopyRow(&region.LightErrors[from], width, lightErrors, to);
    }
  }
}

}

std::vector<RegionBounds> SplitIntoRegions(const int* extent, const Camera& camera)
{
  const int left = extent[0] / Alignment * Alignment;
  const int right = std::min((extent[1] / Alignment + 1) * Alignment, camera.Width);
  const int bottom = extent[2] / Alignment * Alignment;
  const int top = std::min((extent[3] / Alignment + 1) * Alignment, camera.Height);
  const int rows = std::max(PixelsPerRegion / std::max(right - left, 1) / Alignment, 1) * Alignment;
  std::vector<RegionBounds> regions;
  for (int low = bottom; low <= extent[3]; low += rows)
  {
    regions.push_back({ { left, low }, { right, std::min(low + rows, top) } });
  }
  return regions;
}

void AddImageArrays(const RenderSettings& settings, vtkImageData* image)
{
  AddFloatArray(image, "Color", 4);
  AddFloatArray(image, "Rays", 1);
  AddFloatArray(image, "EstimatedError", 1);
  if (settings.HasLightErrors())
  {
    AddFloatArray(image, "EstimatedLightError", 1);
  }
  if (settings.KeepsOcclusion)
  {
    AddFloatArray(image, "AmbientOcclusion", 1);
  }
  image->GetPointData()->SetActiveScalars("Color");
}

void SumErrors(vtkImageData* image, ImageTotals& totals)
{
  int size[3];
  image->GetDimensions(size);
  const auto sum = [&](const char* name) {
    double squares = 0.0;
    auto* errors = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(name));
    for (int y = 0; errors && y < size[1]; ++y)
    {
      const float* const row = errors->GetPointer(static_cast<vtkIdType>(y) * size[0]);
      squares += std::accumulate(row, row + size[0], 0.0,
        [](double s, float error) { return s + static_cast<double>(error) * error; });
    }
    return squares;
  };
  totals.SquaredError = sum("EstimatedError");
  totals.SquaredLightError = sum("EstimatedLightError");
}

void CompositeOverlay(const Overlay& overlay, vtkImageData* image)
{
  int size[3];
  image->GetDimensions(size);
  auto* color = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("Color"));
  std::vector<glm::vec4> row(static_cast<std::size_t>(size[0]));
  for (int y = 0; y < size[1]; ++y)
  {
    float* const pixels = color->GetPointer(4 * static_cast<vtkIdType>(y) * size[0]);
    std::copy_n(pixels, 4 * size[0], &row[0].x);
    overlay.CompositeOver(0, y, size[0], row.data());
    std::copy_n(&row[0].x, 4 * size[0], pixels);
  }
}

void StoreRegion(
  ImageRegion& region, const Overlay* overlay, vtkImageData* image, ImageTotals& totals)
{
  CopyRows(region, overlay, image, totals);
  totals.Rays += region.Rays;
  totals.Pixels += region.Pixels;
  totals.Unfinished += region.Unfinished;
  totals.Edges += region.Edges;
}

bool RenderImage(const CameraRayTracer& tracer, const SceneEdges& sceneEdges,
  const RenderSettings& settings, const ProgressCallback& progress, vtkImageData* image,
  ImageTotals& totals)
{
  AddImageArrays(settings, image);
  const Scene& scene = tracer.GetScene();
  int extent[6];
  image->GetExtent(extent);
  const int height = extent[3] - extent[2] + 1;
  for (const RegionBounds& bounds : SplitIntoRegions(extent, scene.ViewCamera))
  {
    ImageRegion region;
    region.Low = bounds.Low;
    region.High = bounds.High;
    const double done = static_cast<double>(std::max(bounds.Low.y, extent[2]) - extent[2]) / height;
    const double fraction = static_cast<double>(bounds.High.y - bounds.Low.y) / height;
    const auto regionProgress = [&](double inRegion) {
      return progress(std::min(done + fraction * inRegion, 1.0));
    };
    if (settings.Limit)
    {
      settings.Limit->BeginPart(std::min(done + fraction, 1.0));
    }
    if (!RenderRegion(tracer, sceneEdges, settings, regionProgress, region))
    {
      return false;
    }
    StoreRegion(region, scene.OverlayImage.get(), image, totals);
  }
  return true;
}

}
