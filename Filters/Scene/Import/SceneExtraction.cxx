// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtraction.h"

#include "Annotation/SceneExtractionOverlay.h"
#include "CoincidentTopology.h"
#include "CollectionItems.h"
#include "Features/SceneFeatures.h"
#include "Overlay.h"
#include "Scene.h"
#include "SceneExtractionActors.h"
#include "SceneExtractionAxes.h"
#include "SceneExtractionProps.h"
#include "SceneExtractionSky.h"
#include "SceneExtractionSplats.h"
#include "SceneExtractionView.h"
#include "SceneModificationTime.h"
#include "Surface.h"
#include "Tessellation/MemoryEstimate.h"
#include "Tessellation/SceneExtractionInstances.h"
#include "Tessellation/SurfaceSlopes.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkMath.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <optional>
#include <utility>

namespace penumbra
{
namespace
{

/// Sets the radii of spheres and tubes that `options` require.
void SetRadii(const ExtractionOptions& options, std::vector<DrawItem>& items)
{
  for (DrawItem& item : items)
  {
    item.PointRadius = options.PointRadius > 0.0 ? options.PointRadius : item.PointRadius;
    item.LineRadius = options.LineRadius > 0.0 ? options.LineRadius : item.LineRadius;
  }
}

/// Returns the width of a pixel in world units at the far end of `bounds`.
double FindPixelWidth(vtkCamera* camera, const double bounds[6], const ExtractionOptions& options)
{
  double height = 2.0 * camera->GetParallelScale();
  if (!camera->GetParallelProjection())
  {
    const vtkBoundingBox box(bounds);
    double center[3];
    box.GetCenter(center);
    const double distance =
      std::sqrt(vtkMath::Distance2BetweenPoints(center, camera->GetPosition())) +
      0.5 * box.GetDiagonalLength();
    height = 2.0 * distance * std::tan(glm::radians(camera->GetViewAngle()) / 2.0);
  }
  return height / options.Resolution[1];
}

/// Adds what other processes show.
void UniteExtent(const ExtractionOptions& options, double bounds[6], double& radius)
{
  if (options.UniteExtent)
  {
    options.UniteExtent(bounds, radius);
  }
}

/// Moves the sides of `bounds` outward.
void Inflate(double radius, double bounds[6])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] -= radius;
    bounds[2 * axis + 1] += radius;
  }
}

bool AreFinite(const double bounds[6])
{
  return std::all_of(bounds, bounds + 6, [](double x) { return std::isfinite(x); });
}

/// Computes the bounds of the props of all processes, with their spheres and tubes.
void ComputeSceneBounds(vtkRenderer* renderer, const std::vector<DrawItem>& items,
  const ExtractionOptions& options, double bounds[6])
{
  renderer->ComputeVisiblePropBounds(bounds);
  if (!AreFinite(bounds))
  {
    ComputeBounds(items, bounds);
  }
  double noRadius = 0.0;
  UniteExtent(options, bounds, noRadius);
  if (renderer->IsActiveCameraCreated() && vtkBoundingBox(bounds).IsValid())
  {
    // Rays must start in front of spheres and tubes.
    const double width = FindPixelWidth(renderer->GetActiveCamera(), bounds, options);
    double largest = FindLargestRadius(items, width * options.DPI / 72.0);
    UniteExtent(options, bounds, largest);
    Inflate(largest, bounds);
  }
}

/// Returns true if `renderer` shows a prop whose shape depends on the camera.
bool HasPropsOfView(vtkRenderer* renderer)
{
  const std::vector<vtkProp*> props = GetItems<vtkProp>(renderer->GetViewProps());
  return std::any_of(props.begin(), props.end(),
    [](vtkProp* prop) { return prop->GetVisibility() && (IsBillboard(prop) || IsCubeAxes(prop)); });
}

/// Extracts camera, lights and background.
void ExtractView(vtkRenderer* renderer, const double bounds[6], const ExtractionOptions& options,
  const glm::dmat4& distortion, Scene& scene)
{
  ExtractCamera(renderer, bounds, options, distortion, scene);
  scene.OverlayImage = std::make_shared<Overlay>(scene.ViewCamera.Width, scene.ViewCamera.Height);
  ExtractLights(renderer, options, distortion, scene);
  ExtractBackground(renderer, options, scene);
  ExtractEnvironmentLight(renderer, scene);
}

void AddDrawItems(
  const std::vector<DrawItem>& items, const ExtractionOptions& options, Scene& scene)
{
  for (const DrawItem& item : items)
  {
    ThrowIfStopped(options.Progress, 0.0);
    AddDrawItem(FaceCamera(item, scene), options.DPI / 72.0, scene);
  }
}

/// Adds the props whose surfaces depend on the camera and the size of the image. `firstObject`: id of the
/// first of them.
void AddViewProps(vtkRenderer* renderer, int firstObject, const ExtractionOptions& options,
  const glm::dmat4& distortion, Scene& scene)
{
  const std::vector<DrawItem> texts = MakeBillboards(renderer, options.DPI, firstObject, scene);
  AddDrawItems(texts, options, scene);
  const std::vector<DrawItem> axes =
    MakeCubeAxes(renderer, options.DPI, firstObject + static_cast<int>(texts.size()), scene);
  AddDrawItems(axes, options, scene);
  if (distortion != glm::dmat4(1.0) && (!texts.empty() || !axes.empty() || !options.ClipToRange))
  {
    scene.Warnings.emplace_back(
      "The transform of the camera does not distort billboards, cube axes, "
      "shadows and ambient occlusion. Use a rigid transform.");
  }
}

/// Returns true if the surfaces of the items are the same for other views and other props.
bool AreIndependent(const std::vector<DrawItem>& items)
{
  return std::none_of(items.begin(), items.end(),
    [](const DrawItem& item) { return DependsOnCamera(item) || DependsOnOthers(item); });
}

/// A prop that was read, now or before.
struct ReadProp
{
  bool IsNew = true;
  int FirstObject = 0; ///< id of its first object now
  PropRecord Record;
  std::vector<DrawItem> Items; ///< if it is new
};

/// Returns the bounds that `prop` contributes to those of the renderer.
vtkBoundingBox FindVisibleBounds(vtkProp* prop)
{
  vtkBoundingBox box;
  const double* bounds =
    prop->GetVisibility() && prop->GetUseBounds() ? prop->GetBounds() : nullptr;
  if (bounds && vtkMath::AreBoundsInitialized(bounds))
  {
    box.SetBounds(bounds);
  }
  return box;
}

ReadProp Read(
  vtkRenderer* renderer, vtkProp* prop, int firstObject, const ExtractionOptions& options)
{
  PropItems read = CollectPropItems(renderer, prop, firstObject, options.Progress);
  SetRadii(options, read.Items);
  ReadProp result;
  result.FirstObject = firstObject;
  result.Record.Prop = prop;
  result.Record.Bounds = FindVisibleBounds(prop);
  result.Record.Time = GetPropMTime(prop); // reading may have updated the mappers
  result.Record.FirstObject = firstObject;
  result.Record.NumberOfObjects = read.NumberOfObjects;
  result.Record.Warnings = std::move(read.Warnings);
  result.Record.LargestRadius = FindLargestRadius(read.Items, 0.0);
  result.Items = std::move(read.Items);
  return result;
}

/// Adds the surfaces of the items of a prop to `scene`, and their warnings and places to its record.
void AddProp(const std::vector<DrawItem>& items, const ExtractionOptions& options, Scene& scene,
  PropRecord& record)
{
  const auto warnings = static_cast<std::ptrdiff_t>(scene.Warnings.size());
  record.FirstSurface = scene.Surfaces.size();
  AddDrawItems(items, options, scene);
  record.NumberOfSurfaces = scene.Surfaces.size() - record.FirstSurface;
  std::move(
    scene.Warnings.begin() + warnings, scene.Warnings.end(), std::back_inserter(record.Warnings));
  scene.Warnings.resize(static_cast<std::size_t>(warnings));
}

/// Reads the props again that have changed since `record`; the others have no items. Returns nothing if the
/// surfaces cannot be updated in parts.
std::optional<std::vector<ReadProp>> ReadChangedProps(
  vtkRenderer* renderer, const ExtractionOptions& options, const SceneRecord& record)
{
  const std::vector<vtkProp*> props = GetItems<vtkProp>(renderer->GetViewProps());
  if (props.size() != record.Props.size())
  {
    return {};
  }
  std::vector<ReadProp> result;
  int nextObject = 0;
  for (std::size_t i = 0; i < props.size(); ++i)
  {
    const PropRecord& before = record.Props[i];
    const bool isRenamed = nextObject != before.FirstObject && !before.Warnings.empty();
    if (props[i] == before.Prop && GetPropMTime(props[i]) == before.Time && !isRenamed)
    {
      result.push_back({ false, nextObject, before, {} });
    }
    else
    {
      result.push_back(Read(renderer, props[i], nextObject, options));
      std::vector<DrawItem>& items = result.back().Items;
      MakeDepthOffsetsRelative(record.FarthestOffset, items);
      const bool keepsFarthest =
        record.FarthestOffset.IsZero() || std::any_of(items.begin(), items.end(), HasPolygons);
      if (!AreIndependent(items) || !keepsFarthest)
      {
        return {};
      }
      RequireMemoryForItems(items);
    }
    nextObject += result.back().Record.NumberOfObjects;
  }
  return result;
}

/// Returns true if rays hit the same triangles, spheres or tubes of both surfaces, at the same points.
bool HaveSameHits(const Surface& a, const Surface& b)
{
  const auto areEqual = [](const auto& x, const auto& y) {
    return x.size() == y.size() &&
      (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
  };
  return !a.Instances && !b.Instances && areEqual(a.Positions, b.Positions) &&
    areEqual(a.Triangles, b.Triangles) && areEqual(a.Radii, b.Radii) &&
    areEqual(a.Segments, b.Segments) && a.HasFlatEnds == b.HasFlatEnds &&
    a.Frontfaces == b.Frontfaces && a.Backfaces == b.Backfaces &&
    a.IsLineOrPoint == b.IsLineOrPoint;
}

/// Replaces a surface. If rays hit the same, its arrays stay where they are, because the ray tracer shares
/// them. Returns true if rays do not.
bool Replace(Surface& surface, Surface next)
{
  const bool isMoved = !HaveSameHits(surface, next);
  if (!isMoved)
  {
    std::swap(surface.Positions, next.Positions);
    std::swap(surface.Triangles, next.Triangles);
    std::swap(surface.Radii, next.Radii);
    std::swap(surface.Segments, next.Segments);
  }
  surface = std::move(next);
  return isMoved;
}

/// Moves the surfaces of a prop from `next` to their former places in `scene`, if it was read again.
/// Former surfaces without a successor become empty. `record` is that of the prop in `scene`.
void ReplaceSurfaces(ReadProp& prop, Scene& next, PropRecord& record, Scene& scene,
  std::vector<SurfaceChange>& changes)
{
  for (std::size_t i = 0; i < record.NumberOfSurfaces; ++i)
  {
    const std::size_t place = record.FirstSurface + i;
    Surface& surface = scene.Surfaces[place];
    if (!prop.IsNew)
    {
      surface.ObjectId += prop.FirstObject - record.FirstObject;
      continue;
    }
    const bool remains = i < prop.Record.NumberOfSurfaces;
    const bool isMoved = Replace(
      surface, remains ? std::move(next.Surfaces[prop.Record.FirstSurface + i]) : Surface());
    changes.push_back({ static_cast<std::uint32_t>(place), isMoved });
  }
  prop.Record.FirstObject = prop.FirstObject;
  prop.Record.FirstSurface = record.FirstSurface;
  prop.Record.NumberOfSurfaces = record.NumberOfSurfaces;
  record = std::move(prop.Record);
}

/// Adds the 2-D props, and the warnings about the props.
void FinishScene(
  vtkRenderer* renderer, const ExtractionOptions& options, const SceneRecord& record, Scene& scene)
{
  for (const PropRecord& prop : record.Props)
  {
    scene.Warnings.insert(scene.Warnings.end(), prop.Warnings.begin(), prop.Warnings.end());
  }
  ExtractOverlay(renderer, options.DPI, options.FindDepths, scene);
  scene.Warnings = MergeWarnings(scene.Warnings);
}

}

Scene ExtractScene(
  vtkRenderer* renderer, const ExtractionOptions& options, SceneRecord* recordOrNull)
{
  SceneRecord record;
  std::vector<DrawItem> items;
  std::vector<std::size_t> ends; ///< of the items of each prop
  int nextObject = 0;
  for (vtkProp* prop : GetItems<vtkProp>(renderer->GetViewProps()))
  {
    ReadProp read = Read(renderer, prop, nextObject, options);
    std::move(read.Items.begin(), read.Items.end(), std::back_inserter(items));
    ends.push_back(items.size());
    nextObject += read.Record.NumberOfObjects;
    record.Props.push_back(std::move(read.Record));
  }
  record.FarthestOffset = FindFarthestOffset(items);
  MakeDepthOffsetsRelative(record.FarthestOffset, items);
  RequireMemoryForItems(items);
  double bounds[6];
  ComputeSceneBounds(renderer, items, options, bounds);
  Scene scene;
  const glm::dmat4 distortion = FindViewDistortion(renderer);
  ApplyViewDistortion(distortion, items, bounds, scene.Warnings);
  std::vector<glm::dvec4> range;
  if (options.ClipToRange)
  {
    range = FindClippingRange(renderer, bounds, distortion);
  }
  ExtractionOptions viewOptions = options;
  viewOptions.KeepOrigin = options.KeepOrigin && distortion == glm::dmat4(1.0) && range.empty() &&
    !HasPropsOfView(renderer) && std::none_of(items.begin(), items.end(), DependsOnCamera);
  ExtractView(renderer, bounds, viewOptions, distortion, scene);
  scene.ViewCamera.DepthUnit = ComputeDepthUnit(renderer, bounds, scene);
  for (DrawItem& item : items)
  {
    item.ClippingPlanes.insert(item.ClippingPlanes.end(), range.begin(), range.end());
  }
  FindSlopes(scene, items);
  const bool isIndependent = scene.HasFixedOrigin && AreIndependent(items);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < ends.size(); ++i)
  {
    // The items of a prop are released when they are surfaces.
    const std::vector<DrawItem> part(std::make_move_iterator(items.begin() + begin),
      std::make_move_iterator(items.begin() + ends[i]));
    AddProp(part, options, scene, record.Props[i]);
    begin = ends[i];
  }
  if (!range.empty() && !items.empty() && scene.Surfaces.empty())
  {
    scene.Warnings.emplace_back("The clipping range of the camera excludes the whole scene. Call "
                                "vtkRenderer::ResetCameraClippingRange().");
  }
  AddViewProps(renderer, items.empty() ? 0 : items.back().ObjectId + 1, options, distortion, scene);
  FinishScene(renderer, options, record, scene);
  if (recordOrNull)
  {
    *recordOrNull = isIndependent ? std::move(record) : SceneRecord();
  }
  return scene;
}

bool UpdateScene(vtkRenderer* renderer, const ExtractionOptions& options, SceneRecord& record,
  Scene& scene, const std::function<void(const std::vector<SurfaceChange>&)>& update)
{
  if (record.Props.empty() || !options.KeepOrigin || !renderer->IsActiveCameraCreated() ||
    HasPropsOfView(renderer))
  {
    return false;
  }
  const glm::dmat4 distortion = FindViewDistortion(renderer);
  std::optional<std::vector<ReadProp>> props = ReadChangedProps(renderer, options, record);
  if (!props || distortion != glm::dmat4(1.0))
  {
    return false;
  }
  vtkBoundingBox box;
  double radius = 0.0;
  for (const ReadProp& prop : *props)
  {
    box.AddBox(prop.Record.Bounds);
    radius = std::max(radius, prop.Record.LargestRadius);
  }
  double bounds[6];
  box.GetBounds(bounds);
  if (!box.IsValid() || !AreFinite(bounds))
  {
    return false;
  }
  Inflate(radius, bounds);
  if (options.ClipToRange && !FindClippingRange(renderer, bounds, distortion).empty())
  {
    return false;
  }
  Scene next;
  next.EnvironmentReflections = scene.EnvironmentReflections;
  ExtractView(renderer, bounds, options, distortion, next);
  if (!next.HasFixedOrigin || next.Origin != scene.Origin || next.Scale != scene.Scale)
  {
    return false;
  }
  next.ViewCamera.DepthUnit = ComputeDepthUnit(renderer, bounds, next);
  for (std::size_t i = 0; i < props->size(); ++i)
  {
    ReadProp& prop = (*props)[i];
    if (prop.IsNew)
    {
      AddProp(prop.Items, options, next, prop.Record);
      if (prop.Record.NumberOfSurfaces > record.Props[i].NumberOfSurfaces)
      {
        return false;
      }
    }
  }
  std::vector<SurfaceChange> changes;
  for (std::size_t i = 0; i < props->size(); ++i)
  {
    ReplaceSurfaces((*props)[i], next, record.Props[i], scene, changes);
  }
  scene.ViewCamera = next.ViewCamera;
  scene.Lights = std::move(next.Lights);
  scene.BackgroundColors = std::move(next.BackgroundColors);
  scene.EnvironmentReflections = std::move(next.EnvironmentReflections);
  scene.OverlayImage = std::move(next.OverlayImage);
  scene.Warnings = std::move(next.Warnings);
  update(changes);
  FinishScene(renderer, options, record, scene);
  return true;
}

Scene ExtractScene(const std::vector<vtkDataObject*>& data, const ExtractionOptions& options)
{
  Scene scene;
  std::vector<DrawItem> items = CollectDrawItems(data, scene.Warnings, options.Progress);
  SetRadii(options, items);
  RequireMemoryForItems(items);
  double bounds[6];
  ComputeBounds(items, bounds);
  double noRadius = 0.0;
  UniteExtent(options, bounds, noRadius);
  ResetCamera(bounds, options, scene);
  scene.Lights = { MakeHeadlight(scene) };
  if (options.Background)
  {
    scene.BackgroundColors.First = scene.BackgroundColors.Second = glm::vec4(0.f, 0.f, 0.f, 1.f);
  }
  AddDrawItems(items, options, scene);
  scene.Warnings = MergeWarnings(scene.Warnings);
  return scene;
}

}
