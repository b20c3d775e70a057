// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionInstances.h"

#include "Scene.h"
#include "SceneExtractionLines.h"
#include "SceneExtractionSurfaces.h"
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

template <typename T>
void Append(std::vector<T>& to, const std::vector<T>& from)
{
  to.insert(to.end(), from.begin(), from.end());
}

/// Returns true if the surfaces can be merged when their colors are per cell.
bool AreMergeable(const Surface& a, const Surface& b)
{
  return a.IsRound() == b.IsRound() && a.Segments.empty() == b.Segments.empty() &&
    a.IsLineOrPoint == b.IsLineOrPoint && a.HidesLines == b.HidesLines &&
    a.EdgeWidth == b.EdgeWidth && a.NormalRule == b.NormalRule &&
    a.Normals.empty() == b.Normals.empty() &&
    a.TriangleNormals.empty() == b.TriangleNormals.empty() && a.LitTexture == b.LitTexture &&
    a.BaseColorTexture == b.BaseColorTexture && a.DetailTextures == b.DetailTextures &&
    a.Tangents.empty() == b.Tangents.empty() && a.Front.Lighting == b.Front.Lighting &&
    a.Front.Ambient == b.Front.Ambient && a.Front.Diffuse == b.Front.Diffuse;
}

/// Appends one instance to `into`, with the color of its material and the cell id `id`.
void MergeInstance(Surface&& instance, std::uint32_t id, Surface& into)
{
  const glm::u8vec4 color(
    glm::vec4(instance.Front.DiffuseColor, instance.Front.Opacity) * 255.f + 0.5f);
  instance.Front.Opacity = 1.f;
  instance.CellColors.assign(instance.GetNumberOfPrimitives(), color);
  instance.CellIds.assign(instance.GetNumberOfPrimitives(), id);
  if (instance.Radii.size() == 1)
  {
    instance.Radii.resize(instance.Positions.size(), instance.Radii.front());
  }
  if (into.Positions.empty())
  {
    into = std::move(instance);
    return;
  }
  const auto first = static_cast<std::uint32_t>(into.Positions.size());
  for (const glm::uvec3& triangle : instance.Triangles)
  {
    into.Triangles.push_back(triangle + first);
  }
  for (const glm::uvec2& segment : instance.Segments)
  {
    into.Segments.push_back(segment + first);
  }
  Append(into.Radii, instance.Radii);
  Append(into.Positions, instance.Positions);
  Append(into.CellIds, instance.CellIds);
  Append(into.CellColors, instance.CellColors);
  Append(into.Normals, instance.Normals);
  Append(into.Tangents, instance.Tangents);
  Append(into.TriangleNormals, instance.TriangleNormals);
  Append(into.TextureCoordinates, instance.TextureCoordinates);
}

/// Adds the polygons of a wireframe as an invisible surface that hides lines. As in VTK,
/// translucent wireframes keep their hidden lines. Returns true if a surface was added.
bool AddLineMask(const DrawItem& item, Scene& scene)
{
  const std::size_t before = scene.Surfaces.size();
  AddSurface(item, scene);
  if (scene.Surfaces.size() == before)
  {
    return false;
  }
  Surface& mask = scene.Surfaces.back();
  if (mask.IsTranslucent())
  {
    scene.Surfaces.pop_back();
    return false;
  }
  mask.HidesLines = true;
  mask.IsLineOrPoint = true; // casts no shadow
  mask.HasBackMaterial = false;
  mask.Front.Lighting = false;
  mask.Front.Opacity = 0.f;
  mask.PointColors.clear();
  mask.CellColors.clear();
  mask.ColorTexture = mask.LitTexture = mask.BaseColorTexture = nullptr;
  mask.DetailTextures = nullptr;
  return true;
}

void AddSurfaceAndLines(const DrawItem& item, double pixelsPerPoint, Scene& scene)
{
  const std::size_t before = scene.Surfaces.size();
  if (item.Property->GetRepresentation() == VTK_SURFACE)
  {
    AddSurface(item, scene);
  }
  const bool hidesLines = item.RemoveHiddenLines && AddLineMask(item, scene);
  AddLinesAndPoints(item, pixelsPerPoint, scene);
  for (std::size_t i = before; i < scene.Surfaces.size(); ++i)
  {
    Surface& surface = scene.Surfaces[i];
    surface.ForceOpaque = item.ForceOpaque;
    surface.HasHiddenLines = hidesLines && !surface.HidesLines;
  }
}

/// Returns the surfaces of the shape of a glyph in coordinates of its own, or none if its parts are
/// not only triangles.
std::vector<Surface> MakeShape(const DrawItem& item, double pixelsPerPoint, Scene& shape)
{
  DrawItem single = item;
  single.ToWorld = glm::dmat4(1.0);
  single.Colors.Mode = Coloring::Modes::Single;
  single.ClippingPlanes.clear();
  AddSurfaceAndLines(single, pixelsPerPoint, shape);
  return shape.Surfaces.size() == 1 ? std::move(shape.Surfaces) : std::vector<Surface>();
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

void AddDrawItem(const DrawItem& item, double pixelsPerPoint, Scene& scene)
{
  if (!item.GlyphInstances)
  {
    AddSurfaceAndLines(item, pixelsPerPoint, scene);
    return;
  }
  // An instance may consist of several surfaces (surface, lines, points, edges). Each merged
  // surface collects the matching ones of all instances.
  std::vector<Surface> merged;
  Scene instanceScene;
  instanceScene.Origin = scene.Origin;
  instanceScene.Scale = scene.Scale;
  instanceScene.ViewCamera = scene.ViewCamera;
  DrawItem instance = item;
  instance.Colors.Mode = Coloring::Modes::Single;
  std::vector<std::size_t> copied(item.GlyphInstances->Transforms.size());
  std::iota(copied.begin(), copied.end(), std::size_t(0));
  if (MayHaveInstances(item))
  {
    Scene shape;
    for (Surface& surface : MakeShape(item, pixelsPerPoint, shape))
    {
      copied = AddInstances(item, std::move(surface), scene);
    }
    instanceScene.Warnings = std::move(shape.Warnings);
  }
  for (const std::size_t i : copied)
  {
    instance.ToWorld = glm::dmat4(item.GlyphInstances->Transforms[i]);
    instance.Colors.SingleColor = item.GlyphInstances->Colors[i];
    AddSurfaceAndLines(instance, pixelsPerPoint, instanceScene);
    for (Surface& surface : instanceScene.Surfaces)
    {
      const auto match = std::find_if(merged.begin(), merged.end(),
        [&](const Surface& other) { return AreMergeable(surface, other); });
      Surface& into = match == merged.end() ? merged.emplace_back() : *match;
      MergeInstance(std::move(surface), item.GlyphInstances->Ids[i], into);
    }
    instanceScene.Surfaces.clear();
  }
  for (Surface& surface : merged)
  {
    surface.Positions.reserve(surface.Positions.size() + 1);
    surface.Triangles.reserve(surface.Triangles.size() + 1);
    surface.ScalarColoring = item.GlyphInstances->ByScalars;
    scene.Surfaces.push_back(std::move(surface));
  }
  // All instances share the shape and cause the same warnings.
  if (!instanceScene.Warnings.empty())
  {
    scene.Warnings.push_back(instanceScene.Warnings.front());
  }
}

}
