// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Silhouettes.h"

#include "Execution/ParallelFor.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace penumbra
{

namespace
{

/// Returns true if both triangles of the edge project to the same side of it.
bool IsSilhouette(const Surface& surface, const MeshEdge& e, const Camera& camera)
{
  const glm::dvec3 a(surface.Positions[e.A]);
  const glm::dvec3 b(surface.Positions[e.B]);
  const glm::dvec3 view = camera.Parallel ? camera.Forward : a - camera.Position;
  const glm::dvec3 normal = glm::cross(view, b - a); // of the plane through the camera and the edge
  const double left = glm::dot(normal, glm::dvec3(surface.Positions[e.Left]) - a);
  const double right = glm::dot(normal, glm::dvec3(surface.Positions[e.Right]) - a);
  return !(left * right < 0.0);
}

/// Calls visit(cell) for every cell whose distance to the edge is EdgeMargin at most.
template <typename Visit>
void VisitCells(
  const ProjectedEdge& e, glm::dvec2 origin, double size, glm::ivec2 cells, Visit visit)
{
  const double margin = EdgeMargin / size;
  glm::dvec2 a = (e.A - origin) / size;
  glm::dvec2 b = (e.B - origin) / size;
  if (a.x > b.x)
  {
    std::swap(a, b);
  }
  const double from = std::floor(a.x - margin);
  const double to = std::floor(b.x + margin);
  const int first = static_cast<int>(std::max(from, 0.0));
  const int last = static_cast<int>(std::min(to, cells.x - 1.0));
  const bool vertical = !(b.x > a.x); // on the line between two columns, the edge is in both
  const double slope = vertical ? 0.0 : (b.y - a.y) / (b.x - a.x);
  const double low = std::min(a.y, b.y);
  const double high = std::max(a.y, b.y);
  for (int column = first; column <= last; ++column)
  {
    double y0 = low;
    double y1 = high;
    if (to > from && !vertical) // not only in these cells, so that the grid does not matter
    {
      const double u = a.y + slope * (column - margin - a.x);
      const double v = a.y + slope * (column + 1 + margin - a.x);
      y0 = std::max(low, std::min(u, v));
      y1 = std::min(high, std::max(u, v));
    }
    const int bottom = std::max(static_cast<int>(std::floor(y0 - margin)), 0);
    const int top = std::min(static_cast<int>(std::floor(y1 + margin)), cells.y - 1);
    for (int row = bottom; row <= top; ++row)
    {
      visit(row * cells.x + column);
    }
  }
}

}

bool ClipToRectangle(ProjectedEdge& e, glm::dvec2 low, glm::dvec2 high)
{
  double enter = 0.0;
  double leave = 1.0;
  const glm::dvec2 d = e.B - e.A;
  for (int axis = 0; axis < 2; ++axis)
  {
    if (d[axis] == 0.0)
    {
      if (e.A[axis] < low[axis] || e.A[axis] > high[axis])
      {
        return false;
      }
      continue;
    }
    const double t0 = (low[axis] - e.A[axis]) / d[axis];
    const double t1 = (high[axis] - e.A[axis]) / d[axis];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  if (!(enter <= leave))
  {
    return false;
  }
  const ProjectedEdge original = e;
  const double depth = original.DepthB - original.DepthA;
  if (enter > 0.0)
  {
    e.A = original.A + enter * d;
    e.DepthA = original.DepthA + enter * depth;
  }
  if (leave < 1.0)
  {
    e.B = original.A + leave * d;
    e.DepthB = original.DepthA + leave * depth;
  }
  return true;
}

void BinEdges(const std::vector<ProjectedEdge>& edges, const std::uint32_t* subset,
  std::size_t count, glm::dvec2 origin, double size, glm::ivec2 cells, EdgeBins& bins)
{
  bins.Fill(count, static_cast<std::size_t>(cells.x) * cells.y,
    [&](std::size_t first, std::size_t last, const auto& add) {
      for (std::size_t i = first; i < last; ++i)
      {
        const std::uint32_t edge = subset ? subset[i] : static_cast<std::uint32_t>(i);
        VisitCells(edges[edge], origin, size, cells, [&](int cell) { add(cell, edge); });
      }
    });
}

void ProjectEdge(glm::dvec3 a, glm::dvec3 b, const Camera& camera, glm::dvec2 low, glm::dvec2 high,
  std::vector<ProjectedEdge>& edges)
{
  // Points nearer than this are clipped. In perspective projection, points at depth 0 cannot be
  // projected.
  const double near = std::max(camera.Near, camera.Parallel ? -1e300 : 1e-9);
  double depthA = camera.Depth(a);
  double depthB = camera.Depth(b);
  if (depthA < near && depthB < near)
  {
    return;
  }
  if (depthA < near || depthB < near)
  {
    const glm::dvec3 cut = a + (b - a) * ((near - depthA) / (depthB - depthA));
    (depthA < near ? a : b) = cut;
    (depthA < near ? depthA : depthB) = near;
  }
  ProjectedEdge projected{ camera.Project(a), camera.Project(b),
    camera.Parallel ? depthA : 1.0 / depthA, camera.Parallel ? depthB : 1.0 / depthB };
  if (ClipToRectangle(projected, low, high))
  {
    edges.push_back(projected);
  }
}

ImagePart::ImagePart(const Camera& camera, glm::ivec2 low, glm::ivec2 high)
  : ImageLow(-2.0 * EdgeMargin),
    ImageHigh(glm::dvec2(camera.Width, camera.Height) + 2.0 * EdgeMargin),
    Low(low),
    High(high)
{
}

long long ImagePart::Select(std::size_t first, std::vector<ProjectedEdge>& edges) const
{
  long long count = 0;
  const auto isOutside = [&](const ProjectedEdge& edge) {
    const glm::dvec2 begin =
      glm::clamp(edge.A, glm::dvec2(0.0), this->ImageHigh - 3.0 * EdgeMargin);
    count += glm::all(glm::greaterThanEqual(begin, this->Low)) &&
      glm::all(glm::lessThan(begin, this->High));
    ProjectedEdge clipped = edge;
    return !ClipToRectangle(clipped, this->Low - 2.0 * EdgeMargin, this->High + 2.0 * EdgeMargin);
  };
  edges.erase(
    std::remove_if(edges.begin() + static_cast<std::ptrdiff_t>(first), edges.end(), isOutside),
    edges.end());
  return count;
}

long long ProjectEdges(const Surface& surface, const std::vector<MeshEdge>& mesh,
  const Camera& camera, const ImagePart& part, std::vector<ProjectedEdge>& edges)
{
  const std::vector<std::size_t> boundaries = SplitIntoParts(mesh.size(), ArrayGrain);
  const std::size_t parts = boundaries.size() - 1;
  std::vector<std::vector<ProjectedEdge>> projected(parts);
  std::vector<long long> counts(parts, 0);
  ParallelFor<std::size_t>(0, parts, 1, [&](std::size_t k) {
    for (std::size_t i = boundaries[k]; i < boundaries[k + 1]; ++i)
    {
      const MeshEdge& e = mesh[i];
      if (e.IsFeatureEdge || IsSilhouette(surface, e, camera))
      {
        ProjectEdge(glm::dvec3(surface.Positions[e.A]), glm::dvec3(surface.Positions[e.B]), camera,
          part.ImageLow, part.ImageHigh, projected[k]);
      }
    }
    counts[k] = part.Select(0, projected[k]);
  });
  for (const std::vector<ProjectedEdge>& inPart : projected)
  {
    edges.insert(edges.end(), inPart.begin(), inPart.end());
  }
  return std::accumulate(counts.begin(), counts.end(), 0LL);
}

}
