// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionInstances.h"

#include "Scene.h"
#include "Surface.h"

#include "vtkCellArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace penumbra
{
namespace
{

/// Glyphs with fewer triangles altogether are copied: rays through copies are faster.
constexpr std::size_t MinimumInstancedTriangles = 200000;

/// Maximum condition of the transform of an instance. Rays are traced in coordinates of the shape
/// in single precision; flatter glyphs are copied.
constexpr double MaximumCondition = 1e3;
/// Bounds of the size of shapes in their own coordinates and of the scale of instances, so that
/// rays in these coordinates neither overflow nor underflow.
constexpr double MaximumSize = 1e9;

enum class Fates
{
  Instance,
  Copy,
  Clipped
};

double FrobeniusNorm(const glm::dmat3& m)
{
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

/// Decides how a glyph is drawn.
Fates FindFate(const DrawItem& item, const glm::dmat4x3& toWorld, const Scene& scene,
  const SurfaceInstances& shape)
{
  const glm::dmat4x3 toScene = SceneTransform(glm::dmat4(toWorld), scene).GetMatrix();
  const glm::dmat3 linear(toScene);
  const double scale = FrobeniusNorm(linear);
  const double inverse = FrobeniusNorm(glm::inverse(linear));
  const glm::dvec3 center = linear * shape.Center + toScene[3];
  // The comparisons are false for NaN.
  if (!(scale * inverse <= MaximumCondition && scale <= MaximumSize && inverse <= MaximumSize &&
        glm::length(center) <= MaximumSize))
  {
    return Fates::Copy;
  }
  const glm::dvec3 world = toWorld * glm::dvec4(shape.Center, 1.0);
  const double radius = FrobeniusNorm(glm::dmat3(toWorld)) * shape.Radius;
  Fates fate = Fates::Instance;
  for (const glm::dvec4& plane : item.ClippingPlanes)
  {
    const double distance = glm::dot(plane, glm::dvec4(world, 1.0));
    const double reach = radius * glm::length(glm::dvec3(plane));
    if (distance < -reach)
    {
      return Fates::Clipped;
    }
    fate = distance > reach ? fate : Fates::Copy;
  }
  return fate;
}

void Bound(const Surface& shape, SurfaceInstances& instances)
{
  AxisAlignedBox box;
  for (const glm::vec3& x : shape.Positions)
  {
    box.Add(x);
  }
  instances.Center = 0.5 * (glm::dvec3(box.Low) + glm::dvec3(box.High));
  instances.HalfSize = 0.5 * (glm::dvec3(box.High) - glm::dvec3(box.Low));
  for (const glm::vec3& x : shape.Positions)
  {
    instances.Radius = std::max(instances.Radius, glm::distance(glm::dvec3(x), instances.Center));
  }
}

/// Returns true if the shape is large enough and near enough to its own origin for single
/// precision.
bool IsSupported(const Surface& shape, const SurfaceInstances& bounds)
{
  return !shape.IsRound() && !shape.IsLineOrPoint && !shape.HidesLines && !shape.HasHiddenLines &&
    !shape.ColorTexture && shape.PointColors.empty() && shape.CellColors.empty() &&
    bounds.Radius >= 1.0 / MaximumSize && bounds.Radius <= MaximumSize &&
    glm::length(bounds.Center) <= 16.0 * bounds.Radius;
}

}

bool MayHaveInstances(const DrawItem& item)
{
  const vtkIdType perGlyph = item.Data->GetPolys()->GetNumberOfConnectivityIds() -
    2 * item.Data->GetPolys()->GetNumberOfCells() +
    item.Data->GetStrips()->GetNumberOfConnectivityIds();
  const auto triangles = static_cast<std::size_t>(std::max<vtkIdType>(perGlyph, 0));
  const std::size_t count = item.GlyphInstances->Transforms.size();
  return count > 1 && triangles * (count - 1) >= MinimumInstancedTriangles;
}

std::vector<std::size_t> AddInstances(const DrawItem& item, Surface&& shape, Scene& scene)
{
  Instances& glyphs = *item.GlyphInstances;
  const std::size_t count = glyphs.Transforms.size();
  std::vector<std::size_t> copied;
  SurfaceInstances bounds;
  Bound(shape, bounds);
  if (!IsSupported(shape, bounds))
  {
    copied.resize(count);
    std::iota(copied.begin(), copied.end(), std::size_t(0));
    return copied;
  }
  const float opacity = shape.Front.Opacity;
  shape.Front.Opacity = 1.f;
  shape.CellIds = {};
  shape.ScalarColoring = glyphs.ByScalars;
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Fates fate = FindFate(item, glyphs.Transforms[i], scene, bounds);
    if (fate != Fates::Clipped)
    {
      (fate == Fates::Copy ? copied : drawn).push_back(i);
    }
  }
  // Triangles of one surface have indices of 32 bits, the last of which means none.
  const std::size_t capacity =
    (std::numeric_limits<std::uint32_t>::max() - 1u) / shape.Triangles.size();
  for (std::size_t first = 0; first < drawn.size(); first += capacity)
  {
    const std::size_t size = std::min(capacity, drawn.size() - first);
    auto instances = std::make_shared<SurfaceInstances>(bounds);
    if (size == count)
    {
      instances->Transforms = std::move(glyphs.Transforms); // saves memory
    }
    instances->Transforms.resize(size);
    instances->Colors.resize(size);
    instances->Ids.resize(size);
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::size_t glyph = drawn[first + i];
      const glm::dmat4x3& toWorld =
        size == count ? instances->Transforms[i] : glyphs.Transforms[glyph];
      instances->Transforms[i] = SceneTransform(glm::dmat4(toWorld), scene).GetMatrix();
      const glm::vec4 color(glm::vec3(glyphs.Colors[glyph]) / 255.f,
        opacity * (static_cast<float>(glyphs.Colors[glyph].a) / 255.f));
      instances->Colors[i] = glm::u8vec4(color * 255.f + 0.5f);
      instances->Ids[i] = glyphs.Ids[glyph];
    }
    Surface surface = shape;
    surface.Front.DiffuseColor = glm::vec3(instances->Colors.front()) / 255.f;
    surface.Front.AmbientColor = surface.Front.DiffuseColor;
    surface.Positions.reserve(surface.Positions.size() + 1);
    surface.Triangles.reserve(surface.Triangles.size() + 1);
    surface.Instances = std::move(instances);
    scene.Surfaces.push_back(std::move(surface));
  }
  return copied;
}

}
