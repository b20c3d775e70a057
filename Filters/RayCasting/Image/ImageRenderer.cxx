// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageRenderer.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

// Parts of a picture are rendered one after the other, so that memory stays bounded: whole rows of
// tiles with about this many pixels.
constexpr int PixelsPerPart = 1 << 22;
constexpr int Alignment = 32;

void AddFloatArray(vtkImageData* image, const char* name, int components)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
}

/// Those rows of `part` that belong to `image`, with `over` over them; the sum of their squared errors.
double CopyRows(ImageRegion& part, const Overlay& over, vtkImageData* image)
{
  const auto find = [image](const char* name) {
    return vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(name));
  };
  vtkFloatArray* color = find("Color");
  vtkFloatArray* rays = find("Rays");
  vtkFloatArray* errors = find("EstimatedError");
  int extent[6];
  image->GetExtent(extent);
  const int width = extent[1] - extent[0] + 1;
  double squaredError = 0.0;
  for (int y = std::max(part.Low.y, extent[2]); y < std::min(part.High.y, extent[3] + 1); ++y)
  {
    const std::size_t from = part.Index(extent[0], y);
    const vtkIdType to = static_cast<vtkIdType>(y - extent[2]) * width;
    over.CompositeOver(extent[0], y, width, &part.Colors[from]);
    std::copy_n(&part.Colors[from].x, 4 * width, color->GetPointer(4 * to));
    std::copy_n(&part.RayShares[from], width, rays->GetPointer(to));
    std::copy_n(&part.Errors[from], width, errors->GetPointer(to));
    for (int x = 0; x < width; ++x)
    {
      squaredError += static_cast<double>(part.Errors[from + x]) * part.Errors[from + x];
    }
  }
  return squaredError;
}

}

TileErrors JudgeTiles(vtkImageData* image, double limit)
{
  constexpr int Side = 16;
  vtkFloatArray* errors =
    vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("EstimatedError"));
  int extent[6];
  image->GetExtent(extent);
  const int width = extent[1] - extent[0] + 1;
  TileErrors judged;
  for (int y = extent[2] / Side * Side; y <= extent[3]; y += Side)
  {
    for (int x = extent[0] / Side * Side; x <= extent[1]; x += Side)
    {
      double squares = 0.0;
      int count = 0;
      for (int j = std::max(y, extent[2]); j <= std::min(y + Side - 1, extent[3]); ++j)
      {
        for (int i = std::max(x, extent[0]); i <= std::min(x + Side - 1, extent[1]); ++i)
        {
          const double error =
            errors->GetValue(static_cast<vtkIdType>(j - extent[2]) * width + i - extent[0]);
          squares += error * error;
          ++count;
        }
      }
      const double error = std::sqrt(squares / count);
      ++judged.Tiles;
      judged.Over += error > limit ? 1 : 0;
      judged.Worst = std::max(judged.Worst, error);
    }
  }
  return judged;
}

bool RenderImage(const CameraRayTracer& sampler, const SceneEdges& meshes,
  const RenderSettings& settings, const ProgressCallback& progress, vtkImageData* image,
  ImageRegion& totals, double& squaredError)
{
  AddFloatArray(image, "Color", 4);
  AddFloatArray(image, "Rays", 1);
  AddFloatArray(image, "EstimatedError", 1);
  image->GetPointData()->SetActiveScalars("Color");

  const Scene& scene = sampler.GetScene();
  int extent[6];
  image->GetExtent(extent);
  const int height = extent[3] - extent[2] + 1;
  const int left = extent[0] / Alignment * Alignment;
  const int right = std::min((extent[1] / Alignment + 1) * Alignment, scene.ViewCamera.Width);
  const int bottom = extent[2] / Alignment * Alignment;
  const int top = std::min((extent[3] / Alignment + 1) * Alignment, scene.ViewCamera.Height);
  const int rows = std::max(PixelsPerPart / std::max(right - left, 1) / Alignment, 1) * Alignment;
  for (int low = bottom; low <= extent[3]; low += rows)
  {
    ImageRegion part;
    part.Low = { left, low };
    part.High = { right, std::min(low + rows, top) };
    const double done = static_cast<double>(std::max(low, extent[2]) - extent[2]) / height;
    const double share = static_cast<double>(part.High.y - low) / height;
    const auto partProgress = [&](double inPart) {
      return progress(std::min(done + share * inPart, 1.0));
    };
    if (!RenderRegion(sampler, meshes, settings, partProgress, part))
    {
      return false;
    }
    squaredError += CopyRows(part, scene.OverlayImage, image);
    totals.Rays += part.Rays;
    totals.Pixels += part.Pixels;
    totals.Edges = std::max(totals.Edges, part.Edges);
  }
  return true;
}

}
