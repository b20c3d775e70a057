// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StratifiedReference.h"

#include "Embree/RayScene.h"
#include "Import/SceneExtraction.h"
#include "Sampling/EdgeBlending.h"
#include "Sampling/LayerOrder.h"
#include "Scene.h"
#include "Shading/Shading.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace penumbra
{
namespace
{

constexpr int PacketSize = 16;

/// Composites all layers behind a first hit as VTK does: edges and their faces are one layer, and
/// actors with ForceOpaque and surfaces that hide lines are drawn in their order. Returns the color
/// premultiplied by alpha. `kinds`: see LayerOrder.
glm::dvec4 ComputeColor(const RayScene& rays, const Shading& shading,
  const std::vector<LayerOrder::Kinds>& kinds, glm::dvec2 p, const Ray& ray, Hit hit)
{
  glm::dvec4 color(0.0);
  long long shadowRays = 0;
  LayerOrder order;
  EdgeBlending edges(rays.GetScene().ViewCamera);
  Ray rest = ray;
  while (hit.IsHit() && color.a < 1.0)
  {
    if (kinds.empty() || order.IsDrawn(kinds[hit.Surface], { hit.Surface, hit.Primitive }))
    {
      const Surface& surface = rays.GetSurfaces()[hit.Surface];
      const ShadedHit shaded = shading.Shade(ray, hit, shadowRays);
      const double opacity = edges.FindOpacity(surface, ray, hit, shaded);
      const double weight = (1.0 - color.a) * opacity;
      color += weight * glm::dvec4(glm::dvec3(shaded.Color), surface.IsAdditive ? 0.0 : 1.0);
      if (opacity >= 1.0 && !surface.IsAdditive)
      {
        return color;
      }
    }
    rest = ContinueBehind(rest, hit);
    hit = rays.Intersect(rest);
  }
  const glm::dvec4 c(shading.Background(p));
  return color + (1.0 - color.a) * c.a * glm::dvec4(glm::dvec3(c), 1.0);
}

}

StratifiedReference DrawStratified(
  vtkRenderer* renderer, int width, int height, int side, bool shadows)
{
  ExtractionOptions options;
  options.Resolution[0] = width;
  options.Resolution[1] = height;
  options.ClipToRange = !shadows; // as the ray caster does
  const Scene scene = ExtractScene(renderer, options);
  const RayScene rays(scene, 0);
  const Shading shading(rays, shadows);
  const std::vector<LayerOrder::Kinds> kinds = LayerOrder::FindKinds(scene.Surfaces);
  const Camera& camera = scene.ViewCamera;
  const auto near = static_cast<float>(std::max(camera.Near - camera.DepthOfRayOrigins(), 0.0));
  StratifiedReference reference;
  reference.Colors.resize(static_cast<std::size_t>(width) * height);
  reference.SquaredErrors.resize(reference.Colors.size());
  ParallelFor<int>(0, height, 1, [&](int y) {
    std::mt19937 generator(1234u + y);
    const auto random = [&] { return generator() * 0x1p-32; };
    for (int x = 0; x < width; ++x)
    {
      glm::dvec3 means[2] = {};
      for (glm::dvec3& mean : means)
      {
        for (int first = 0; first < side * side; first += PacketSize)
        {
          glm::dvec2 points[PacketSize];
          Ray packet[PacketSize];
          Hit hits[PacketSize];
          for (int i = 0; i < PacketSize; ++i)
          {
            const int k = std::min(first + i, side * side - 1);
            const double u = random();
            points[i] = { x + (k % side + u) / side, y + (k / side + random()) / side };
            packet[i].Origin = camera.RayOrigin(points[i]);
            packet[i].Direction = camera.RayDirection(points[i]);
            packet[i].Near = near;
          }
          rays.Intersect16(packet, hits);
          for (int i = 0; i < std::min(PacketSize, side * side - first); ++i)
          {
            mean += glm::dvec3(ComputeColor(rays, shading, kinds, points[i], packet[i], hits[i]));
          }
        }
        mean /= side * side;
      }
      const std::size_t index = static_cast<std::size_t>(y) * width + x;
      const glm::dvec3 difference = means[0] - means[1];
      reference.Colors[index] = 0.5 * (means[0] + means[1]);
      reference.SquaredErrors[index] = glm::dot(difference, difference) / 12.0;
    }
  });
  return reference;
}

namespace
{

/// Compares the tiles of an image; squaredErrorOf(i) returns that of a pixel.
template <typename SquaredError>
std::vector<TileAccuracy> CompareTiles(
  const std::vector<double>& estimates, int width, const SquaredError& squaredErrorOf)
{
  constexpr int Side = 16;
  const int height = static_cast<int>(estimates.size()) / width;
  std::vector<TileAccuracy> tiles;
  for (int low = 0; low < height; low += Side)
  {
    for (int left = 0; left < width; left += Side)
    {
      double error = 0.0;
      double estimate = 0.0;
      int count = 0;
      for (int y = low; y < std::min(low + Side, height); ++y)
      {
        for (int x = left; x < std::min(left + Side, width); ++x, ++count)
        {
          const std::size_t i = static_cast<std::size_t>(y) * width + x;
          error += squaredErrorOf(i);
          estimate += estimates[i] * estimates[i];
        }
      }
      tiles.push_back({ std::sqrt(std::max(error, 0.0) / count), std::sqrt(estimate / count) });
    }
  }
  return tiles;
}

}

std::vector<TileAccuracy> CompareTiles(
  const Answer& answer, const StratifiedReference& reference, int width)
{
  return CompareTiles(answer.Estimates, width, [&](std::size_t i) {
    const glm::dvec3 d = answer.Colors[i] * answer.Alphas[i] - reference.Colors[i];
    return glm::dot(d, d) / 3.0 - reference.SquaredErrors[i];
  });
}

std::vector<TileAccuracy> CompareTiles(const Answer& answer, const Answer& exact, int width)
{
  return CompareTiles(answer.Estimates, width, [&](std::size_t i) {
    const glm::dvec3 d = answer.Colors[i] - exact.Colors[i];
    return glm::dot(d, d) / 3.0;
  });
}

}
