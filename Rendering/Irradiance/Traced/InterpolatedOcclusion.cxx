// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InterpolatedOcclusion.h"

#include "Execution/ParallelFor.h"
#include "Frame/ScreenTransform.h"
#include "Scene.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPenumbraIrradianceCache.h"

#include <atomic>

namespace penumbra
{

Camera CameraFromView(const ScreenTransform& view, const Scene& scene)
{
  Matrix eyeToWorld;
  vtkMatrix4x4::Invert(view.WorldToEye.data(), eyeToWorld.data());
  const auto column = [&](int index) {
    return glm::dvec3(eyeToWorld[index], eyeToWorld[4 + index], eyeToWorld[8 + index]);
  };
  Camera camera;
  camera.Parallel = view.Parallel;
  camera.Right = column(0);
  camera.Up = column(1);
  camera.Forward = -column(2);
  camera.Position = (column(3) - scene.Origin) * scene.Scale;
  camera.Width = view.Width;
  camera.Height = view.Height;
  camera.PixelSize = view.Scale[0] * (view.Parallel ? scene.Scale : 1.0);
  camera.Center = glm::dvec2(-view.Offset[0] / view.Scale[0], -view.Offset[1] / view.Scale[1]);
  return camera;
}

long long InterpolateOcclusion(const std::vector<SurfacePoint>& points, const RayScene& rays,
  double radius, double tolerance, std::vector<float>& means)
{
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->Begin(rays, radius, tolerance);
  const Scene& scene = rays.GetScene();
  std::atomic<long long> count{ 0 };
  ParallelFor<std::size_t>(0, points.size(), 0, [&](std::size_t i) {
    if (points[i].Normal != glm::vec3(0.f))
    {
      const glm::dvec3 position = glm::dvec3(points[i].Position) / scene.Scale + scene.Origin;
      const glm::dvec3 normal(points[i].Normal);
      const auto occlusion = cache->Occlusion(&position.x, &normal.x);
      means[i] = static_cast<float>(occlusion.Value);
      count += occlusion.Rays;
    }
  });
  vtkNew<vtkFieldData> statistics;
  cache->Report(statistics);
  vtkDataArray* gathered = statistics->GetArray("Rays/Gather");
  return count + (gathered ? static_cast<long long>(gathered->GetComponent(0, 0)) : 0);
}

}
