// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionReference.h"

#include "Embree/RayScene.h"
#include "Import/SceneExtraction.h"
#include "Scene.h"
#include "Shading/HemisphereSampling.h"
#include "Surface.h"

#include <cmath>

namespace penumbra
{

namespace
{

glm::vec3 NormalTowardCamera(const Scene& scene, const Hit& hit, glm::vec3 direction)
{
  const Surface& surface = scene.Surfaces[hit.Surface];
  const std::array<glm::vec3, 3> points = surface.GetPoints(hit.Primitive);
  const glm::vec3 a = points[0];
  const glm::vec3 normal = glm::normalize(glm::cross(points[1] - a, points[2] - a));
  return glm::dot(normal, direction) > 0.f ? -normal : normal;
}

/// The surfaces of a renderer, for tracing rays from their points.
struct ImageTracer
{
  ImageTracer(vtkRenderer* renderer, const int size[2], double radius)
    : Drawn(Extract(renderer, size)),
      Rays(this->Drawn, 1),
      Radius(static_cast<float>(radius * this->Drawn.Scale))
  {
  }

  static Scene Extract(vtkRenderer* renderer, const int size[2])
  {
    ExtractionOptions options;
    options.Resolution[0] = size[0];
    options.Resolution[1] = size[1];
    return ExtractScene(renderer, options);
  }

  /// Calls `visit(ray, random state)` for rays * rays cosine-distributed directions.
  template <typename Visit>
  void ForRaysFrom(const SeenPoint& seen, int rays, const Visit& visit) const
  {
    const Scene& scene = this->Drawn;
    const glm::dvec3 world(seen.Position[0], seen.Position[1], seen.Position[2]);
    const glm::vec3 point((world - scene.Origin) * scene.Scale);
    const glm::vec3 normal(seen.Normal[0], seen.Normal[1], seen.Normal[2]);
    const glm::mat3 frame = FrameFromNormal(normal);
    std::uint32_t state = HashPoint(point, normal);
    Ray probe;
    probe.Origin = point + RayOriginOffset(point) * normal;
    for (int ray = 0; ray < rays * rays; ++ray)
    {
      const float u =
        (static_cast<float>(ray % rays) + NextFloat(state)) / static_cast<float>(rays);
      const float v =
        (static_cast<float>(ray / rays) + NextFloat(state)) / static_cast<float>(rays);
      probe.Far = this->Radius;
      probe.Direction = frame * DiskToHemisphere(SampleUniformDiskConcentric(u, v));
      visit(probe, state);
    }
  }

  const Scene Drawn;
  const RayScene Rays;
  const float Radius;
};

}

std::vector<SeenPoint> PointsInImage(const RayScene& rays, int stride)
{
  const Scene& scene = rays.GetScene();
  std::vector<SeenPoint> points;
  for (int j = stride / 2; j < scene.ViewCamera.Height; j += stride)
  {
    for (int i = stride / 2; i < scene.ViewCamera.Width; i += stride)
    {
      Ray primary;
      primary.Origin = scene.ViewCamera.RayOrigin({ i + .5, j + .5 });
      primary.Direction = scene.ViewCamera.RayDirection({ i + .5, j + .5 });
      const Hit hit = rays.Intersect(primary);
      if (hit.IsHit())
      {
        const glm::dvec3 point = primary.Origin + hit.Distance * primary.Direction;
        const glm::dvec3 world = point / scene.Scale + scene.Origin;
        const glm::vec3 normal = NormalTowardCamera(scene, hit, primary.Direction);
        points.push_back({ j * scene.ViewCamera.Width + i, { world.x, world.y, world.z },
          { normal.x, normal.y, normal.z } });
      }
    }
  }
  return points;
}

OcclusionTruth TraceOcclusion(
  vtkRenderer* renderer, const int size[2], double radius, int stride, int rays)
{
  const ImageTracer tracer(renderer, size, radius);
  OcclusionTruth truth;
  truth.Width = size[0];
  for (const SeenPoint& seen : PointsInImage(tracer.Rays, stride))
  {
    double constant = 0.0;
    double linear = 0.0;
    tracer.ForRaysFrom(seen, rays, [&](Ray& probe, std::uint32_t&) {
      const Hit met = tracer.Rays.Intersect(probe);
      constant += met.IsHit();
      linear += met.IsHit() ? 1.0 - met.Distance / tracer.Radius : 0.0;
    });
    truth.Pixels.push_back(seen.Pixel);
    truth.Constant.push_back(static_cast<float>(constant / (rays * rays)));
    truth.Linear.push_back(static_cast<float>(linear / (rays * rays)));
  }
  return truth;
}

std::vector<float> TraceMisjudged(
  vtkRenderer* renderer, const int size[2], double radius, int stride, int rays)
{
  const ImageTracer tracer(renderer, size, radius);
  const Camera& eye = tracer.Drawn.ViewCamera;
  std::vector<float> shares;
  for (const SeenPoint& seen : PointsInImage(tracer.Rays, stride))
  {
    const glm::dvec2 pixel(seen.Pixel % size[0] + .5, seen.Pixel / size[0] + .5);
    int misjudged = 0;
    tracer.ForRaysFrom(seen, rays, [&](Ray& probe, std::uint32_t& state) {
      probe.Far = NextFloat(state) * tracer.Radius;
      const bool blocked = tracer.Rays.Intersect(probe).IsHit();
      Ray back;
      back.Origin = probe.Origin + probe.Far * probe.Direction;
      const glm::vec3 way = glm::vec3(eye.RayOrigin(pixel)) - back.Origin;
      back.Far = glm::length(way);
      back.Direction = way / back.Far;
      misjudged += tracer.Rays.Intersect(back).IsHit() != blocked;
    });
    shares.push_back(static_cast<float>(misjudged) / static_cast<float>(rays * rays));
  }
  return shares;
}

double Rmse(const OcclusionTruth& truth, Falloff falloff, const std::vector<float>& image)
{
  const std::vector<float>& values = falloff == Falloff::Constant ? truth.Constant : truth.Linear;
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double difference = static_cast<double>(image[truth.Pixels[i]]) - values[i];
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double Gain(const OcclusionTruth& truth, Falloff falloff, const std::vector<float>& image)
{
  const std::vector<float>& values = falloff == Falloff::Constant ? truth.Constant : truth.Linear;
  double product = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double value = image[truth.Pixels[i]];
    product += value * values[i];
    square += value * value;
  }
  return square > 0.0 ? product / square : 0.0;
}

}
