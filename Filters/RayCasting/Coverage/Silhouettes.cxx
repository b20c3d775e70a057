// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Silhouettes.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Does the surface fold over at the edge, both its triangles on one side of it in the picture?
bool IsSilhouette(const Surface& surface, const MeshEdge& e, const Camera& camera)
{
  const glm::dvec3 a(surface.Positions[e.A]);
  const glm::dvec3 b(surface.Positions[e.B]);
  const glm::dvec3 view = camera.Parallel ? camera.Forward : a - camera.Position;
  const glm::dvec3 normal = glm::cross(view, b - a); // of the plane through eye and edge
  const double left = glm::dot(normal, glm::dvec3(surface.Positions[e.Left]) - a);
  const double right = glm::dot(normal, glm::dvec3(surface.Positions[e.Right]) - a);
  return !(left * right < 0.0);
}

/// Clips the segment to the rectangle; false when nothing is left.
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
  const ProjectedEdge whole = e;
  const double depth = whole.DepthB - whole.DepthA;
  if (enter > 0.0)
  {
    e.A = whole.A + enter * d;
    e.DepthA = whole.DepthA + enter * depth;
  }
  if (leave < 1.0)
  {
    e.B = whole.A + leave * d;
    e.DepthB = whole.DepthA + leave * depth;
  }
  return true;
}

/// Calls visit(cell) for every cell that the segment touches or passes within EdgeMargin.
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
  const int first = std::max(static_cast<int>(std::floor(a.x - margin)), 0);
  const int last = std::min(static_cast<int>(std::floor(b.x + margin)), cells.x - 1);
  const bool upright = !(b.x > a.x); // one that runs along a line between columns lies in both
  const double slope = upright ? 0.0 : (b.y - a.y) / (b.x - a.x);
  const double low = std::min(a.y, b.y);
  const double high = std::max(a.y, b.y);
  for (int column = first; column <= last; ++column)
  {
    double y0 = low;
    double y1 = high;
    if (last > first && !upright)
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

void BinEdges(const std::vector<ProjectedEdge>& edges, const std::uint32_t* subset,
  std::size_t count, glm::dvec2 origin, double size, glm::ivec2 cells, EdgeBins& lists)
{
  const auto edge = [&](
                      std::size_t i) { return subset ? subset[i] : static_cast<std::uint32_t>(i); };
  lists.Begin.assign(static_cast<std::size_t>(cells.x) * cells.y + 1, 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    VisitCells(edges[edge(i)], origin, size, cells, [&](int cell) { ++lists.Begin[cell + 1]; });
  }
  for (std::size_t cell = 1; cell < lists.Begin.size(); ++cell)
  {
    lists.Begin[cell] += lists.Begin[cell - 1];
  }
  lists.Edges.resize(lists.Begin.back());
  std::vector<std::uint32_t> next(lists.Begin.begin(), lists.Begin.end() - 1);
  for (std::size_t i = 0; i < count; ++i)
  {
    VisitCells(
      edges[edge(i)], origin, size, cells, [&](int cell) { lists.Edges[next[cell]++] = edge(i); });
  }
}

void ProjectEdges(const Surface& surface, const std::vector<MeshEdge>& mesh, const Camera& camera,
  glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges)
{
  low -= 2.0 * EdgeMargin;
  high += 2.0 * EdgeMargin;
  // Nothing is drawn nearer than this; a point on the eye's plane has no picture.
  const double near = std::max(camera.Near, camera.Parallel ? -1e300 : 1e-9);
  for (const MeshEdge& e : mesh)
  {
    if (!e.IsFeatureEdge && !IsSilhouette(surface, e, camera))
    {
      continue;
    }
    glm::dvec3 a(surface.Positions[e.A]);
    glm::dvec3 b(surface.Positions[e.B]);
    double depthA = camera.Depth(a);
    double depthB = camera.Depth(b);
    if (depthA < near && depthB < near)
    {
      continue;
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
}

}
