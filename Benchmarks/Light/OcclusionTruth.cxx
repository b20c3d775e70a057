// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTruth.h"

#include "Embree/RayScene.h"
#include "Import/SceneExtraction.h"
#include "Scene.h"
#include "SceneBounds.h"
#include "Shading/HemisphereSampling.h"
#include "Surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>

namespace penumbra
{
namespace
{

constexpr int PacketSize = 16;
/// Camera rays per pixel and estimate: a square grid; and rays over the hemisphere per camera ray.
constexpr int CameraSide = 16;
constexpr int HemisphereRays = 4;

Scene Extract(vtkRenderer* renderer, int width, int height)
{
  ExtractionOptions options;
  options.Resolution[0] = width;
  options.Resolution[1] = height;
  options.ClipToRange = false;
  return ExtractScene(renderer, options);
}

template <typename Visit>
bool VisitArrays(ReferenceLight& truth, const Visit& visit)
{
  return visit(truth.Means[0]) && visit(truth.Means[1]) && visit(truth.Coverage);
}

bool Read(const std::string& file, std::size_t pixels, ReferenceLight& truth)
{
  std::ifstream stream(file, std::ios::binary);
  return VisitArrays(truth, [&](std::vector<float>& values) {
    values.resize(pixels);
    stream.read(
      reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(pixels * sizeof(float)));
    return static_cast<bool>(stream);
  });
}

/// Traces the camera rays of one estimate of a pixel, and rays from their hits.
class PixelTracer
{
public:
  PixelTracer(const RayScene& rays, const ReferenceSettings& settings, std::uint32_t seed)
    : Rays(rays),
      Radius(static_cast<float>(settings.Radius * rays.GetScene().Scale)),
      Sun(settings.Sun[0], settings.Sun[1], settings.Sun[2]),
      Albedo(settings.Albedo),
      Generator(seed)
  {
  }

  float TraceMean(int x, int y, float& coverage)
  {
    const Camera& camera = this->Rays.GetScene().ViewCamera;
    const auto near = static_cast<float>(std::max(camera.Near - camera.DepthOfRayOrigins(), 0.0));
    double light = 0.0;
    int covered = 0;
    for (int first = 0; first < CameraSide * CameraSide; first += PacketSize)
    {
      Ray packet[PacketSize];
      Hit hits[PacketSize];
      for (int i = 0; i < PacketSize; ++i)
      {
        const int k = first + i;
        const glm::dvec2 p(x + (k % CameraSide + this->Random()) / CameraSide,
          y + (k / CameraSide + this->Random()) / CameraSide);
        packet[i].Origin = camera.RayOrigin(p);
        packet[i].Direction = camera.RayDirection(p);
        packet[i].Near = near;
      }
      this->Rays.Intersect16(packet, hits);
      for (int i = 0; i < PacketSize; ++i)
      {
        if (hits[i].IsHit())
        {
          ++covered;
          light += this->TraceLight(packet[i], hits[i]);
        }
      }
    }
    constexpr double Count = CameraSide * CameraSide;
    coverage += static_cast<float>(0.5 * covered / Count);
    return static_cast<float>(light / Count);
  }

private:
  double Random() { return this->Generator() * 0x1p-32; }

  SurfaceNormals FindNormals(const Ray& ray, const Hit& hit) const
  {
    glm::dvec3 geometric = glm::normalize(glm::dvec3(this->Rays.GetNormal(ray, hit)));
    geometric *= glm::dot(geometric, glm::dvec3(ray.Direction)) > 0.0 ? -1.0 : 1.0;
    return { this->Rays.GetSmoothNormal(hit, geometric), glm::vec3(geometric) };
  }

  /// Returns the normal (unit) of direct light, as VTK interpolates it: also where it is tangential or faces away.
  glm::vec3 FindLightingNormal(const Ray& ray, const Hit& hit) const
  {
    const glm::vec3 geometric(this->Rays.GetNormal(ray, hit));
    const float side = glm::dot(geometric, ray.Direction) > 0.f ? -1.f : 1.f;
    const Surface& surface = this->Rays.GetSurfaces()[hit.Surface];
    if (surface.Normals.empty())
    {
      return side * glm::normalize(geometric);
    }
    const std::array<glm::vec3, 3> normals = surface.GetNormals(hit.Primitive, surface.Normals);
    return side *
      glm::normalize((1.f - hit.U - hit.V) * normals[0] + hit.U * normals[1] + hit.V * normals[2]);
  }

  /// Returns the height of the curved surface of the normals above a point of its triangle [Hanika 2021]: the point
  /// moved to the tangent planes of the corners that it is below, blended.
  float FindCurvedHeight(const Hit& hit, glm::vec3 point, const SurfaceNormals& atPoint) const
  {
    const Surface& surface = this->Rays.GetSurfaces()[hit.Surface];
    const std::array<glm::vec3, 3> corners = surface.GetPoints(hit.Primitive);
    const std::array<glm::vec3, 3> normals = surface.GetNormals(hit.Primitive, surface.Normals);
    const float weights[] = { 1.f - hit.U - hit.V, hit.U, hit.V };
    const glm::vec3 mean =
      weights[0] * normals[0] + weights[1] * normals[1] + weights[2] * normals[2];
    const float side = glm::dot(mean, atPoint.Shading) < 0.f ? -1.f : 1.f;
    glm::vec3 moved(0.f);
    for (std::size_t i = 0; i < 3; ++i)
    {
      const glm::vec3 normal = side * glm::normalize(normals[i]);
      const bool isBehind = !(glm::dot(normal, atPoint.Geometric) > 0.f);
      const float height = isBehind ? 0.f : std::min(glm::dot(point - corners[i], normal), 0.f);
      moved += weights[i] * (point - height * normal);
    }
    return glm::dot(moved - point, atPoint.Geometric);
  }

  double TraceSun(const Ray& ray, const Hit& hit) const
  {
    const SurfaceNormals normals(
      this->FindLightingNormal(ray, hit), this->FindNormals(ray, hit).Geometric);
    const double cosine = glm::dot(normals.Shading, this->Sun);
    const float slope = glm::dot(normals.Geometric, this->Sun);
    glm::vec3 start = ray.Origin + hit.Distance * ray.Direction;
    glm::vec3 up = normals.Geometric;
    // Light that is nearly along the triangle, or behind it, starts at the curved surface; from .2 to .1 partly.
    const float part = std::min(std::max(2.f - slope / 0.1f, 0.f), 1.f);
    if (part > 0.f && !this->Rays.GetSurfaces()[hit.Surface].Normals.empty() &&
      glm::dot(normals.Shading, normals.Geometric) > 0.f)
    {
      Ray lift;
      lift.Origin = start + RayOriginOffset(start) * up;
      lift.Direction = up;
      lift.Far = part * this->FindCurvedHeight(hit, start, normals);
      if (!(lift.Far > 0.f) || !this->Rays.Intersect(lift).IsHit())
      {
        start = lift.Origin + lift.Far * up;
        up = normals.Shading;
      }
    }
    if (!(cosine > 0.0) || !(glm::dot(up, this->Sun) > 0.f))
    {
      return 0.0;
    }
    Ray shadow;
    shadow.Origin = start + RayOriginOffset(start) * up;
    shadow.Direction = this->Sun;
    return this->Rays.Intersect(shadow).IsHit() ? 0.0 : cosine;
  }

  double TraceLight(const Ray& ray, const Hit& hit)
  {
    const SurfaceNormals normals = this->FindNormals(ray, hit);
    const glm::mat3 frame = FrameFromNormal(normals.Shading);
    const glm::vec3 point = ray.Origin + hit.Distance * ray.Direction;
    Ray rays[PacketSize];
    const double turn = this->Random();
    for (int i = 0; i < PacketSize; ++i)
    {
      const double square = (i + this->Random()) / HemisphereRays;
      const double angle = 6.283185307179586 * (i * 0.6180339887498949 + turn);
      const glm::vec2 disk(std::sqrt(square) * glm::dvec2(std::cos(angle), std::sin(angle)));
      rays[i].Origin = point + RayOriginOffset(point) * normals.Geometric;
      rays[i].Direction = normals.ReflectAbove(frame * DiskToHemisphere(disk));
      const float end = this->Radius > 0.f ? this->Radius : std::numeric_limits<float>::infinity();
      rays[i].Far = i < HemisphereRays ? end : -1.f;
    }
    if (this->Radius > 0.f)
    {
      bool occluded[PacketSize];
      this->Rays.Occluded16(rays, occluded);
      return 1.0 - std::count(occluded, occluded + HemisphereRays, true) / double(HemisphereRays);
    }
    Hit hits[PacketSize];
    this->Rays.Intersect16(rays, hits);
    double sum = 0.0;
    for (int i = 0; i < HemisphereRays; ++i)
    {
      sum += hits[i].IsHit() ? this->TraceSun(rays[i], hits[i]) : 1.0;
    }
    return this->TraceSun(ray, hit) + this->Albedo * sum / HemisphereRays;
  }

  const RayScene& Rays;
  float Radius;
  glm::vec3 Sun;
  double Albedo;
  std::mt19937 Generator;
};

}

double FindDefaultRadius(vtkRenderer* renderer)
{
  return DefaultRadiusFraction * ComputeSceneDiagonal(Extract(renderer, 64, 64));
}

ReferenceLight FindLightTruth(vtkRenderer* renderer, int width, int height,
  const ReferenceSettings& settings, const std::string& file)
{
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  ReferenceLight truth;
  if (!file.empty() && Read(file, pixels, truth))
  {
    return truth;
  }
  const Scene scene = Extract(renderer, width, height);
  const RayScene rays(scene, 0);
  VisitArrays(truth, [&](std::vector<float>& values) {
    values.assign(pixels, 0.f);
    return true;
  });
  ParallelFor<int>(0, height, 1, [&](int y) {
    PixelTracer tracer(rays, settings, 1234u + y);
    for (int x = 0; x < width; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      for (std::vector<float>& means : truth.Means)
      {
        means[i] = tracer.TraceMean(x, y, truth.Coverage[i]);
      }
    }
  });
  if (!file.empty())
  {
    std::ofstream stream(file, std::ios::binary);
    VisitArrays(truth, [&](std::vector<float>& values) {
      stream.write(reinterpret_cast<const char*>(values.data()),
        static_cast<std::streamsize>(pixels * sizeof(float)));
      return true;
    });
  }
  return truth;
}

}
