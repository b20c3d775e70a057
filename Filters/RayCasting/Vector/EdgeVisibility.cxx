// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeVisibility.h"

#include "Edges/RoundOutlines.h"
#include "Edges/Silhouettes.h"
#include "FigureText.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

// Distance between tests of the visibility, in pixels.
constexpr double TestDistance = 0.5;
// Precision of the ends of visible parts, in pixels.
constexpr double EndPrecision = 1e-3;
// Most tests of a segment, before bisection.
constexpr double MaximumTests = 1e5;
// Depth by which edges are in front of the surfaces that they belong to, in pixel sizes.
constexpr double EdgeOffset = 2.0;

double ComputeDepth(const Camera& camera, const ProjectedEdge& edge, double t)
{
  const double value = glm::mix(edge.DepthA, edge.DepthB, t);
  return camera.Parallel ? value : 1.0 / value;
}

/// Appends the visible parts of an edge, and joins the first one to the last of `paths` if it is not
/// before `first` and ends there.
template <typename Function>
void AddVisibleParts(const ProjectedEdge& edge, const Function& isVisible, const FigurePath& pen,
  std::size_t first, std::vector<FigurePath>& paths)
{
  for (const auto& [from, to] : FindVisibleIntervals(glm::length(edge.B - edge.A), isVisible))
  {
    const glm::dvec2 begin = glm::mix(edge.A, edge.B, from);
    const glm::dvec2 end = glm::mix(edge.A, edge.B, to);
    if (paths.size() > first &&
      glm::length(paths.back().Points.back() - begin) <= 1.0 / UnitsPerPixel)
    {
      paths.back().Points.push_back(end);
      continue;
    }
    FigurePath path = pen;
    path.Points = { begin, end };
    paths.push_back(path);
  }
}

}

double ComputePixelSize(const Camera& camera, double depth)
{
  return camera.Parallel ? camera.PixelSize : camera.PixelSize * depth;
}

std::vector<std::pair<double, double>> FindVisibleIntervals(
  double length, const std::function<bool(double)>& isVisible)
{
  std::vector<std::pair<double, double>> intervals;
  if (!(length > 0.0))
  {
    return intervals;
  }
  const int tests =
    static_cast<int>(std::clamp(std::ceil(length / TestDistance), 1.0, MaximumTests));
  double last = 0.0;
  bool wasVisible = false;
  for (int i = 0; i < tests; ++i)
  {
    const double t = (i + 0.5) / tests;
    const bool visible = isVisible(t);
    if (visible != wasVisible || (visible && i == 0))
    {
      double low = last;
      double high = i == 0 ? 0.0 : t;
      while (i > 0 && (high - low) * length > EndPrecision)
      {
        const double middle = 0.5 * (low + high);
        (isVisible(middle) == visible ? high : low) = middle;
      }
      if (visible)
      {
        intervals.emplace_back(high, 1.0);
      }
      else
      {
        intervals.back().second = low;
      }
    }
    wasVisible = visible;
    last = t;
  }
  return intervals;
}

void AddVisibleOutlines(const CameraRayTracer& tracer,
  const std::vector<std::vector<MeshEdge>>& edges, const FigurePath& pen,
  std::vector<FigurePath>& paths)
{
  const Scene& scene = tracer.GetScene();
  const Camera& camera = scene.ViewCamera;
  const RayScene& rays = tracer.GetRays();
  const glm::dvec2 size(camera.Width, camera.Height);
  const ImagePart whole(camera, glm::ivec2(0), glm::ivec2(camera.Width, camera.Height));
  std::vector<ProjectedEdge> projected;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    if (!scene.Surfaces[i].IsLineOrPoint)
    {
      ProjectEdges(scene.Surfaces[i], edges[i], camera, whole, projected);
    }
  }
  for (const ProjectedEdge& edge : projected)
  {
    const auto isVisible = [&](double t) {
      const double depth = ComputeDepth(camera, edge, t);
      Ray ray = tracer.MakeRay(glm::mix(edge.A, edge.B, t));
      const double far =
        depth - EdgeOffset * ComputePixelSize(camera, depth) - camera.DepthOfRayOrigins();
      ray.Far = static_cast<float>(far);
      return !(far > ray.Near) || !rays.Occluded(ray);
    };
    AddVisibleParts(edge, isVisible, pen, paths.size(), paths);
  }
  for (std::size_t i = 0; i < scene.Surfaces.size(); ++i)
  {
    const Surface& surface = scene.Surfaces[i];
    for (std::uint32_t j = 0; surface.IsRound() && j < surface.GetNumberOfPrimitives(); ++j)
    {
      projected.clear();
      ProjectOutline(surface, j, camera, glm::dvec2(0.0), size, projected);
      const std::size_t first = paths.size();
      for (const ProjectedEdge& edge : projected)
      {
        // A chord is partly in front of its own shape, which is convex and does not hide it.
        const auto isVisible = [&](double t) {
          const Hit hit = tracer.TraceFirstHit(glm::mix(edge.A, edge.B, t));
          const double depth = ComputeDepth(camera, edge, t);
          return !hit.IsHit() || (hit.Surface == i && hit.Primitive == j) ||
            camera.DepthOfRayOrigins() + hit.Distance >
            depth - EdgeOffset * ComputePixelSize(camera, depth);
        };
        AddVisibleParts(edge, isVisible, pen, first, paths);
      }
    }
  }
}

}
