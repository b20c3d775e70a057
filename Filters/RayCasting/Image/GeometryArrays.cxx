// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryArrays.h"

#include "Scene.h"
#include "Surface.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTypeInt64Array.h"

#include <limits>
#include <mutex>

namespace penumbra
{

namespace
{
template <typename Array>
void AddArray(Array* array, const char* name, int components, vtkImageData* image)
{
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
}
}

bool AddGeometryArrays(const CameraRayTracer& tracer, const ProgressCallback& progress,
  vtkImageData* image, RayCounts& counts)
{
  vtkNew<vtkFloatArray> depths;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkFloatArray> occlusions;
  vtkNew<vtkIntArray> objects;
  vtkNew<vtkTypeInt64Array> cells;
  AddArray(depths.Get(), "Depth", 1, image);
  AddArray(normals.Get(), "Normal", 3, image);
  AddArray(objects.Get(), "ObjectId", 1, image);
  AddArray(cells.Get(), "CellId", 1, image);
  vtkFloatArray* const means =
    vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("AmbientOcclusion"));
  if (!means)
  {
    AddArray(occlusions.Get(), "AmbientOcclusion", 1, image);
  }

  const Scene& scene = tracer.GetScene();
  int extent[6];
  image->GetExtent(extent);
  const int width = extent[1] - extent[0] + 1;
  std::mutex totalsMutex;
  return ParallelForWithProgress(extent[3] - extent[2] + 1, 0.0, 1.0, progress, [&](int row) {
    RayCounts rowCounts;
    for (int column = 0; column < width; ++column)
    {
      const vtkIdType id = static_cast<vtkIdType>(row) * width + column;
      const glm::dvec2 p(extent[0] + column + 0.5, extent[2] + row + 0.5);
      const Ray ray = tracer.MakeRay(p);
      const Hit hit = tracer.TraceFirstHit(p);
      ++rowCounts.Auxiliary;
      if (!hit.IsHit())
      {
        depths->SetValue(id, std::numeric_limits<float>::infinity());
        normals->SetTypedComponent(id, 0, 0.f);
        normals->SetTypedComponent(id, 1, 0.f);
        normals->SetTypedComponent(id, 2, 0.f);
        objects->SetValue(id, -1);
        cells->SetValue(id, -1);
        (means ? means : occlusions.Get())->SetValue(id, 0.f);
        continue;
      }
      const Surface& surface = scene.Surfaces[hit.Surface];
      const ShadedHit shaded = tracer.GetShading().Shade(ray, hit, rowCounts.Shadow);
      depths->SetValue(
        id, static_cast<float>((hit.Distance + scene.ViewCamera.Advance) / scene.Scale));
      for (int axis = 0; axis < 3; ++axis)
      {
        normals->SetTypedComponent(id, axis, shaded.Normal[axis]);
      }
      objects->SetValue(id, surface.ObjectId);
      cells->SetValue(id, surface.GetCellId(hit.Primitive));
      if (!means)
      {
        occlusions->SetValue(id,
          tracer.HasOcclusion() ? tracer.ComputeOcclusion(ray, hit, shaded, rowCounts)
                                : std::numeric_limits<float>::quiet_NaN());
      }
    }
    const std::lock_guard<std::mutex> lock(totalsMutex);
    counts.Auxiliary += rowCounts.Auxiliary + rowCounts.Shadow + rowCounts.Occlusion;
  });
}

}
