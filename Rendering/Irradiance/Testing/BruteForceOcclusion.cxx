// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BruteForceOcclusion.h"

#include "Embree/RayScene.h"
#include "Import/SceneExtraction.h"
#include "Scene.h"
#include "Shading/HemisphereSampling.h"
#include "Surface.h"

std::vector<float> ComputeBruteForceOcclusion(
  vtkRenderer* renderer, int width, int height, double radius, int side)
{
  penumbra::ExtractionOptions options;
  options.Resolution[0] = width;
  options.Resolution[1] = height;
  const penumbra::Scene scene = penumbra::ExtractScene(renderer, options);
  const penumbra::RayScene rays(scene, 1);
  std::vector<float> image(static_cast<std::size_t>(width) * height, 0.f);
  for (std::size_t pixel = 0; pixel < image.size(); ++pixel)
  {
    const std::size_t line = pixel / width;
    const std::size_t column = pixel % width;
    const glm::dvec2 center(static_cast<double>(column) + .5, static_cast<double>(line) + .5);
    penumbra::Ray cameraRay;
    cameraRay.Origin = scene.ViewCamera.RayOrigin(center);
    cameraRay.Direction = scene.ViewCamera.RayDirection(center);
    const penumbra::Hit hit = rays.Intersect(cameraRay);
    if (!hit.IsHit())
    {
      continue;
    }
    const penumbra::Surface& surface = scene.Surfaces[hit.Surface];
    const std::array<glm::vec3, 3> points = surface.GetPoints(hit.Primitive);
    const glm::vec3 a = points[0];
    glm::vec3 normal = glm::normalize(glm::cross(points[1] - a, points[2] - a));
    normal = glm::dot(normal, cameraRay.Direction) > 0.f ? -normal : normal;
    const glm::vec3 point = cameraRay.Origin + hit.Distance * cameraRay.Direction;
    const glm::mat3 frame = penumbra::FrameFromNormal(normal);
    std::uint32_t state = penumbra::HashPoint(point, normal);
    penumbra::Ray occlusionRay;
    occlusionRay.Origin = point + penumbra::RayOriginOffset(point) * normal;
    occlusionRay.Far = static_cast<float>(radius * scene.Scale);
    int blocked = 0;
    for (int cell = 0; cell < side * side; ++cell)
    {
      const int row = cell / side;
      const float u = static_cast<float>(cell % side) + penumbra::NextFloat(state);
      const float v = static_cast<float>(row) + penumbra::NextFloat(state);
      const auto cells = static_cast<float>(side);
      occlusionRay.Direction = frame *
        penumbra::DiskToHemisphere(penumbra::SampleUniformDiskConcentric(u / cells, v / cells));
      blocked += rays.Occluded(occlusionRay);
    }
    image[pixel] = static_cast<float>(blocked) / static_cast<float>(side * side);
  }
  return image;
}
