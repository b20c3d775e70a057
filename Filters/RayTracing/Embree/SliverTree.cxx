// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SliverTree.h"

#include "AxisAlignedBox.h"
#include "BoxOverlap.h"
#include "Surface.h"

#include "vtkMath.h"

#include <algorithm>
#include <limits>

namespace penumbra
{

namespace
{

/// Area of boxes relative to that of triangles from which oriented boxes are tried; 2 to 5 for
/// equilateral triangles.
constexpr double MinimumThinness = 15.0;
/// Number of triangles, approximately, whose boxes are compared.
constexpr std::size_t MaximumTrianglesTried = 8192;
/// Ratio of the areas of axis-aligned and oriented leaves from which oriented boxes are used.
/// Embree tests boxes and triangles a few times faster.
constexpr double MinimumGain = 4.0;

/// Mean and covariance of points.
class Moments
{
public:
  void Add(const glm::dvec3& p)
  {
    const glm::dvec3 d = p - this->Origin;
    this->Sum += d;
    this->Squares += glm::dmat3(d * d.x, d * d.y, d * d.z);
    this->Count += 1.0;
  }

  explicit Moments(const glm::dvec3& origin)
    : Origin(origin)
  {
  }

  /// Returns the principal axes as columns, that of the largest variance first.
  glm::dmat3 ComputeAxes() const
  {
    const glm::dvec3 mean = this->Sum / this->Count;
    const glm::dmat3 products(mean * mean.x, mean * mean.y, mean * mean.z);
    double rows[3][3];
    double values[3];
    double vectors[3][3];
    double* matrix[3] = { rows[0], rows[1], rows[2] };
    double* axes[3] = { vectors[0], vectors[1], vectors[2] };
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        rows[i][j] = this->Squares[i][j] / this->Count - products[i][j];
      }
    }
    vtkMath::JacobiN(matrix, 3, values, axes);
    glm::dmat3 result;
    for (int i = 0; i < 3; ++i)
    {
      result[i] = { vectors[0][i], vectors[1][i], vectors[2][i] };
    }
    return result;
  }

private:
  glm::dvec3 Origin;
  glm::dvec3 Sum{ 0.0 };
  glm::dmat3 Squares{ 0.0 };
  double Count = 0.0;
};

glm::dvec3 GetCorner(const Surface& surface, std::uint32_t triangle, int corner)
{
  return glm::dvec3(surface.Positions[surface.Triangles[triangle][corner]]);
}

glm::dvec3 ComputeCentroid(const Surface& surface, std::uint32_t triangle)
{
  return (GetCorner(surface, triangle, 0) + GetCorner(surface, triangle, 1) +
           GetCorner(surface, triangle, 2)) /
    3.0;
}

}

SliverTree::SliverTree(const Surface& surface, std::size_t stride)
  : Mesh(surface)
{
  float extent = 0.f;
  for (const glm::vec3& p : surface.Positions)
  {
    extent = std::max({ extent, std::abs(p.x), std::abs(p.y), std::abs(p.z) });
  }
  this->Slack = std::max(1e-7 * extent, 1e-30);
  for (std::size_t i = 0; i < surface.Triangles.size(); i += stride)
  {
    this->Order.push_back(static_cast<std::uint32_t>(i));
  }
  if (!this->Order.empty())
  {
    this->Nodes.reserve(this->Order.size());
    this->Build(0, static_cast<std::uint32_t>(this->Order.size()));
    this->Nodes.shrink_to_fit();
  }
}

std::shared_ptr<const SliverTree> SliverTree::MakeIfUseful(
  const Surface& surface, const BoxOverlap& overlap)
{
  if (!overlap.IsLarge() || !(overlap.Thinness > MinimumThinness))
  {
    return nullptr;
  }
  const std::size_t stride = surface.Triangles.size() / MaximumTrianglesTried + 1;
  return SliverTree(surface, stride).ComputeGain() > MinimumGain
    ? std::make_shared<const SliverTree>(surface)
    : nullptr;
}

void SliverTree::Build(std::uint32_t first, std::uint32_t last)
{
  const std::size_t index = this->Nodes.size();
  Node node;
  this->Fit(node, first, last);
  this->Nodes.push_back(node);
  if (last - first <= LeafSize)
  {
    this->Nodes[index].First = first;
    this->Nodes[index].Count = last - first;
    return;
  }
  const std::uint32_t middle = this->Split(first, last);
  this->Build(first, middle);
  this->Nodes[index].First = static_cast<std::uint32_t>(this->Nodes.size());
  this->Build(middle, last);
}

template <typename Function>
void SliverTree::ForEachCorner(std::uint32_t first, std::uint32_t last, Function function) const
{
  for (std::uint32_t i = first; i < last; ++i)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      function(GetCorner(this->Mesh, this->Order[i], corner));
    }
  }
}

// The axes are the principal axes of the corners. Sizes are computed with the rounded axes.
void SliverTree::Fit(Node& node, std::uint32_t first, std::uint32_t last) const
{
  const glm::dvec3 origin = GetCorner(this->Mesh, this->Order[first], 0);
  Moments moments(origin);
  this->ForEachCorner(first, last, [&](const glm::dvec3& p) { moments.Add(p); });
  const glm::dmat3 axes = moments.ComputeAxes();
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-low);
  const glm::dmat3 inverse = glm::transpose(axes);
  this->ForEachCorner(first, last, [&](const glm::dvec3& p) {
    const glm::dvec3 q = inverse * (p - origin);
    low = glm::min(low, q);
    high = glm::max(high, q);
  });
  node.Center = glm::vec3(origin + axes * (0.5 * (low + high)));
  glm::dvec3 half(0.0);
  this->ForEachCorner(first, last, [&](const glm::dvec3& p) {
    half = glm::max(half, glm::abs(inverse * (p - glm::dvec3(node.Center))));
  });
  half = 1.00001 * half + this->Slack;
  for (int i = 0; i < 3; ++i)
  {
    node.Axes[i] = glm::vec3(axes[i] / half[i]);
  }
  this->FitSlabs(node, first, last, axes[0]);
}

// The end of an oriented box is not parallel to the rim of slivers that are inclined to it: without
// slabs, rays along the rim cross the ends of a number of boxes proportional to that of the slivers.
// The slack also contains the rounding of slabs and shifts.
void SliverTree::FitSlabs(
  Node& node, std::uint32_t first, std::uint32_t last, const glm::dvec3& fallback) const
{
  const std::uint32_t middle = this->Order[first + (last - first) / 2];
  const glm::dvec3 corners[3] = { GetCorner(this->Mesh, middle, 0),
    GetCorner(this->Mesh, middle, 1), GetCorner(this->Mesh, middle, 2) };
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  for (int i = 0; i < Node::NumberOfSlabs; ++i)
  {
    const glm::dvec3 across = glm::cross(normal, corners[(i + 1) % 3] - corners[i]);
    const double length = glm::length(across);
    const glm::dvec3 axis = length > 0.0 ? across / length : fallback;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    this->ForEachCorner(first, last, [&](const glm::dvec3& p) {
      const double q = glm::dot(axis, p - glm::dvec3(node.Center));
      low = std::min(low, q);
      high = std::max(high, q);
    });
    const double thickness = 0.5 * 1.00001 * (high - low) + 4.0 * this->Slack;
    node.Slabs[i] = glm::vec3(axis / thickness);
    node.Shifts[i] = static_cast<float>(0.5 * (low + high) / thickness);
  }
}

// Splits at the median of the centroids along the axis of their largest variance.
std::uint32_t SliverTree::Split(std::uint32_t first, std::uint32_t last)
{
  Moments moments(ComputeCentroid(this->Mesh, this->Order[first]));
  for (std::uint32_t i = first; i < last; ++i)
  {
    moments.Add(ComputeCentroid(this->Mesh, this->Order[i]));
  }
  const glm::dvec3 axis = moments.ComputeAxes()[0];
  const std::uint32_t middle = first + (last - first) / 2;
  std::vector<std::pair<double, std::uint32_t>> keys;
  keys.reserve(last - first);
  for (std::uint32_t i = first; i < last; ++i)
  {
    keys.emplace_back(glm::dot(axis, ComputeCentroid(this->Mesh, this->Order[i])), this->Order[i]);
  }
  std::nth_element(keys.begin(), keys.begin() + (middle - first), keys.end());
  for (std::uint32_t i = first; i < last; ++i)
  {
    this->Order[i] = keys[i - first].second;
  }
  return middle;
}

double SliverTree::ComputeGain() const
{
  double aligned = 0.0;
  double oriented = 0.0;
  for (const Node& node : this->Nodes)
  {
    if (node.Count == 0)
    {
      continue;
    }
    AxisAlignedBox box;
    for (std::uint32_t i = 0; i < node.Count; ++i)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        box.Add(glm::vec3(GetCorner(this->Mesh, this->Order[node.First + i], corner)));
      }
    }
    const glm::dvec3 size(2.0 / glm::length(glm::dvec3(node.Axes[0])),
      2.0 / glm::length(glm::dvec3(node.Axes[1])), 2.0 / glm::length(glm::dvec3(node.Axes[2])));
    aligned += box.ComputeArea();
    oriented += 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
  }
  return oriented > 0.0 ? aligned / oriented : 0.0;
}

}
