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
// Length in pixels of the pieces of a line, which have one color each.
constexpr double PieceLength = 16.0;
// Positions at which a piece of a stroke may be in front, as fractions of its length and, from its axis, of its width.
constexpr double AlongFractions[] = { 0.5, 0.05, 0.95, 0.25, 0.75 };
constexpr double SideFractions[] = { 0.0, -0.45, 0.45 };
// Most strokes of the same surface that are skipped in front of a stroke, and the distance behind each at which the
// next one is searched, as a fraction of the depth.
constexpr int MaximumStrokesInFront = 64;
constexpr float HitOffset = 1e-6f;
// Largest difference of the colors of pieces that are drawn as one.
constexpr float ColorPrecision = 0.5f / 255.f;

double ComputePixelSize(const Camera& camera, double depth)
{
  return camera.Parallel ? camera.PixelSize : camera.PixelSize * depth;
}

/// A line or point, which the scene contains as a quad of two triangles.
struct Stroke
{
  std::uint32_t Surface;
  std::uint32_t Triangle; ///< the first one
  glm::dvec2 From;
  glm::dvec2 To;
  double DepthFrom;
  double DepthTo;
  double Width;

  glm::dvec2 At(double t) const { return glm::mix(this->From, this->To, t); }
  double DepthAt(const Camera& camera, double t) const
  {
    return camera.Parallel ? glm::mix(this->DepthFrom, this->DepthTo, t)
                           : 1.0 / glm::mix(1.0 / this->DepthFrom, 1.0 / this->DepthTo, t);
  }
  bool IsHitBy(const Hit& hit) const
  {
    return hit.IsHit() && hit.Surface == this->Surface && hit.Primitive / 2 == this->Triangle / 2;
  }
};

/// Returns the lines and points, the farthest first.
std::vector<Stroke> FindStrokes(const Scene& scene)
{
  const Camera& camera = scene.ViewCamera;
  std::vector<Stroke> strokes;
  for (std::size_t i = 0; i < scene.Surfaces.size(); ++i)
  {
    const Surface& surface = scene.Surfaces[i];
    for (std::size_t j = 0; HasStrokes(surface) && j + 1 < surface.Triangles.size(); j += 2)
    {
      const glm::uvec3 corners = surface.Triangles[j];
      const glm::dvec3 a(surface.Positions[corners.x]);
      const glm::dvec3 b(surface.Positions[corners.y]);
      const glm::dvec3 c(surface.Positions[corners.z]);
      const glm::dvec3 d(surface.Positions[surface.Triangles[j + 1].z]);
      Stroke stroke{ static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
        0.5 * (camera.Project(a) + camera.Project(d)),
        0.5 * (camera.Project(b) + camera.Project(c)), 0.5 * (camera.Depth(a) + camera.Depth(d)),
        0.5 * (camera.Depth(b) + camera.Depth(c)),
        glm::length(camera.Project(a) - camera.Project(d)) };
      strokes.push_back(stroke);
    }
  }
  std::stable_sort(strokes.begin(), strokes.end(), [](const Stroke& x, const Stroke& y) {
    return x.DepthFrom + x.DepthTo > y.DepthFrom + y.DepthTo;
  });
  return strokes;
}

/// Narrows [low, high] to the part of the segment from a to b in the image, enlarged by `margin`.
bool ClipToImage(
  const Camera& camera, glm::dvec2 a, glm::dvec2 b, double margin, double& low, double& high)
{
  const glm::dvec2 size(camera.Width + margin, camera.Height + margin);
  for (int axis = 0; axis < 2; ++axis)
  {
    const double step = b[axis] - a[axis];
    const double first = (-margin - a[axis]) / step;
    const double last = (size[axis] - a[axis]) / step;
    if (step != 0.0)
    {
      low = std::max(low, std::min(first, last));
      high = std::min(high, std::max(first, last));
    }
    else if (a[axis] < -margin || a[axis] > size[axis])
    {
      return false;
    }
  }
  return low < high;
}

glm::vec4 ToStraight(glm::vec4 color)
{
  return color.a > 0.f ? glm::vec4(glm::vec3(color) / color.a, color.a) : color;
}

/// Returns a position where a piece of a stroke is in front, on its axis or beside it. Returns its middle if
/// there is none: strokes in front are drawn over all of the piece.
glm::dvec2 FindFront(const CameraRayTracer& tracer, const Stroke& stroke, double begin, double end)
{
  const glm::dvec2 step = stroke.To - stroke.From;
  const glm::dvec2 across = stroke.Width / glm::length(step) * glm::dvec2(-step.y, step.x);
  for (const double side : SideFractions)
  {
    for (const double t : AlongFractions)
    {
      const glm::dvec2 position = stroke.At(glm::mix(begin, end, t)) + side * across;
      if (stroke.IsHitBy(tracer.TraceFirstHit(position)))
      {
        return position;
      }
    }
  }
  return stroke.At(0.5 * (begin + end));
}

/// Adds a visible part of a stroke in pieces, whose colors are sampled.
void AddPieces(const CameraRayTracer& tracer, const Stroke& stroke, double from, double to,
  std::vector<FigurePath>& paths)
{
  const double length = (to - from) * glm::length(stroke.To - stroke.From);
  const int pieces = std::max(1, static_cast<int>(std::ceil(length / PieceLength)));
  RayCounts counts;
  for (int i = 0; i < pieces; ++i)
  {
    const double begin = glm::mix(from, to, static_cast<double>(i) / pieces);
    const double end = glm::mix(from, to, static_cast<double>(i + 1) / pieces);
    FigurePath path;
    path.Width = stroke.Width;
    path.Color =
      ToStraight(tracer.TraceSample(FindFront(tracer, stroke, begin, end), counts).Color);
    const glm::vec4 change = i > 0 ? glm::abs(path.Color - paths.back().Color) : glm::vec4(1.f);
    if (std::max({ change.r, change.g, change.b, change.a }) <= ColorPrecision)
    {
      paths.back().Points.back() = stroke.At(end);
      continue;
    }
    path.Points = { stroke.At(begin), stroke.At(end) };
    paths.push_back(path);
  }
}

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

bool HasStrokes(const Surface& surface)
{
  return surface.IsLineOrPoint && !surface.IsAdditive && !surface.HidesLines &&
    !surface.HasHiddenLines && !surface.LitTexture && !surface.IsRound() &&
    2 * surface.Triangles.size() == surface.Positions.size();
}

void AddVisibleLines(const CameraRayTracer& tracer, std::vector<FigurePath>& paths)
{
  const Scene& scene = tracer.GetScene();
  const Camera& camera = scene.ViewCamera;
  for (const Stroke& stroke : FindStrokes(scene))
  {
    double low = 0.0;
    double high = 1.0;
    if (!ClipToImage(camera, stroke.From, stroke.To, stroke.Width, low, high))
    {
      continue;
    }
    const auto isVisible = [&](double s) {
      const double t = glm::mix(low, high, s);
      const double depth = stroke.DepthAt(camera, t);
      const double own = depth - camera.DepthOfRayOrigins() -
        (stroke.Width + EdgeOffset) * ComputePixelSize(camera, depth);
      // Strokes of the same surface are drawn over those behind them, which may be wider than they hide.
      Ray ray = tracer.MakeRay(stroke.At(t));
      Hit hit = tracer.GetRays().Intersect(ray);
      for (int i = 0; i < MaximumStrokesInFront && hit.IsHit() && hit.Surface == stroke.Surface;
           ++i)
      {
        if (hit.Distance >= own)
        {
          return true;
        }
        ray.Near = hit.Distance + HitOffset * static_cast<float>(depth);
        hit = tracer.GetRays().Intersect(ray);
      }
      return false;
    };
    const double length = (high - low) * glm::length(stroke.To - stroke.From);
    for (const auto& [from, to] : FindVisibleIntervals(length, isVisible))
    {
      AddPieces(tracer, stroke, glm::mix(low, high, from), glm::mix(low, high, to), paths);
    }
  }
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
