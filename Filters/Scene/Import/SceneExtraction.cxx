// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtraction.h"

#include "Annotation/SceneExtractionOverlay.h"
#include "DepthOffsets.h"
#include "Features/SceneFeatures.h"
#include "Scene.h"
#include "SceneExtractionActors.h"
#include "SceneExtractionAxes.h"
#include "SceneExtractionGlyphs.h"
#include "SceneExtractionProps.h"
#include "SceneExtractionSky.h"
#include "SceneExtractionSplats.h"
#include "SceneExtractionView.h"
#include "Surface.h"
#include "Tessellation/MemoryEstimate.h"
#include "Tessellation/SurfaceSlopes.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace penumbra
{
namespace
{

/// Extends `bounds` by the finite points of `item`, transformed by `toWorld`.
void AddBounds(const DrawItem& item, const glm::dmat4& toWorld, double bounds[6])
{
  for (vtkIdType i = 0; i < item.Data->GetNumberOfPoints(); ++i)
  {
    double x[3];
    item.Data->GetPoints()->GetPoint(i, x);
    const glm::dvec4 world = toWorld * glm::dvec4(x[0], x[1], x[2], 1.0);
    for (int k = 0; k < 3; ++k)
    {
      if (std::isfinite(world[k]))
      {
        bounds[2 * k] = std::min(bounds[2 * k], world[k]);
        bounds[2 * k + 1] = std::max(bounds[2 * k + 1], world[k]);
      }
    }
  }
}

void ComputeBounds(const std::vector<DrawItem>& items, double bounds[6])
{
  std::fill_n(bounds, 6, std::numeric_limits<double>::infinity());
  bounds[1] = bounds[3] = bounds[5] = -bounds[0];
  for (const DrawItem& item : items)
  {
    if (!item.GlyphInstances)
    {
      AddBounds(item, item.ToWorld, bounds);
      continue;
    }
    for (const glm::dmat4x3& transform : item.GlyphInstances->Transforms)
    {
      AddBounds(item, glm::dmat4(transform), bounds);
    }
  }
}

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

/// Moves the sides of `bounds` outward by the largest radius of a sphere or tube. `pointWidth` is the
/// width of 1/72 inch of the image, in world units.
void AddRadii(const std::vector<DrawItem>& items, double pointWidth, double bounds[6])
{
  double largest = 0.0;
  for (const DrawItem& item : items)
  {
    double radius = std::max(item.PointRadius, item.LineRadius);
    if (item.Property->GetRenderPointsAsSpheres())
    {
      radius = std::max(radius, 0.5 * item.Property->GetPointSize() * pointWidth);
    }
    if (item.Property->GetRenderLinesAsTubes())
    {
      radius = std::max(radius, 0.5 * item.Property->GetLineWidth() * pointWidth);
    }
    if (item.Radii)
    {
      double range[2];
      item.Radii->GetFiniteRange(range);
      radius = range[1] > 0.0 ? range[1] : 0.0;
    }
    largest = std::max(largest, radius);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] -= largest;
    bounds[2 * axis + 1] += largest;
  }
}

/// Returns true if the surfaces of `item` may depend on the camera: lines and points with a size in
/// pixels, images that face the camera, normals of wireframes.
bool DependsOnCamera(const DrawItem& item)
{
  vtkProperty* property = item.Property;
  const bool hasPoints = item.Data->GetVerts()->GetNumberOfCells() > 0;
  const bool hasLines = item.Data->GetLines()->GetNumberOfCells() > 0;
  return item.FacingSplats || !item.PolygonOffset.IsZero() ||
    property->GetRepresentation() != VTK_SURFACE || property->GetEdgeVisibility() ||
    property->GetVertexVisibility() || property->GetRenderPointsAsSpheres() ||
    property->GetRenderLinesAsTubes() || (hasPoints && !item.Radii && !(item.PointRadius > 0.0)) ||
    (hasLines && !(item.LineRadius > 0.0));
}

/// Returns true if `renderer` shows a prop whose shape depends on the camera.
bool HasPropsOfView(vtkRenderer* renderer)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  while (vtkProp* prop = props->GetNextProp(position))
  {
    if (prop->GetVisibility() && (IsBillboard(prop) || IsCubeAxes(prop)))
    {
      return true;
    }
  }
  return false;
}

/// Extracts camera, lights and background.
void ExtractView(vtkRenderer* renderer, const double bounds[6], const ExtractionOptions& options,
  const glm::dmat4& distortion, Scene& scene)
{
  ExtractCamera(renderer, bounds, options, distortion, scene);
  scene.OverlayImage = Overlay(scene.ViewCamera.Width, scene.ViewCamera.Height);
  ExtractLights(renderer, options, distortion, scene);
  ExtractBackground(renderer, options, scene);
  ExtractEnvironmentLight(renderer, scene);
}

/// Finds the slopes of surfaces if the offset of a line or point depends on them.
void FindSlopes(const Scene& scene, std::vector<DrawItem>& items)
{
  const bool isUsed = std::any_of(items.begin(), items.end(), [](const DrawItem& item) {
    const bool hasLinesOrPoints = item.Property->GetRepresentation() != VTK_SURFACE ||
      item.Data->GetLines()->GetNumberOfCells() + item.Data->GetVerts()->GetNumberOfCells() > 0;
    return hasLinesOrPoints && (item.LineOffset.Factor != 0.0 || item.PointOffset.Factor != 0.0);
  });
  if (isUsed)
  {
    const auto slopes = std::make_shared<SurfaceSlopes>(items, scene);
    for (DrawItem& item : items)
    {
      item.Slopes = slopes;
    }
  }
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

}

Scene ExtractScene(vtkRenderer* renderer, const ExtractionOptions& options)
{
  Scene scene;
  std::vector<DrawItem> items = CollectDrawItems(renderer, scene.Warnings, options.Progress);
  SetRadii(options, items);
  MakeDepthOffsetsRelative(items);
  RequireMemoryForItems(items);
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  std::copy_n(bounds, 6, scene.VisibleBounds.begin());
  if (!std::all_of(bounds, bounds + 6, [](double x) { return std::isfinite(x); }))
  {
    ComputeBounds(items, bounds);
  }
  if (renderer->IsActiveCameraCreated() && vtkBoundingBox(bounds).IsValid())
  {
    // Rays must start in front of spheres and tubes.
    const double width = FindPixelWidth(renderer->GetActiveCamera(), bounds, options);
    AddRadii(items, width * options.DPI / 72.0, bounds);
  }
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
  std::copy_n(bounds, 6, scene.OriginBounds.begin());
  for (DrawItem& item : items)
  {
    item.ClippingPlanes.insert(item.ClippingPlanes.end(), range.begin(), range.end());
  }
  FindSlopes(scene, items);
  AddDrawItems(items, options, scene);
  if (!range.empty() && !items.empty() && scene.Surfaces.empty())
  {
    scene.Warnings.emplace_back("The clipping range of the camera excludes the whole scene. Call "
                                "vtkRenderer::ResetCameraClippingRange().");
  }
  // Parts that depend on the camera and the size of the image.
  int next = items.empty() ? 0 : items.back().ObjectId + 1;
  const std::vector<DrawItem> texts = MakeBillboards(renderer, options.DPI, next, scene);
  next += static_cast<int>(texts.size());
  AddDrawItems(texts, options, scene);
  const std::vector<DrawItem> axes = MakeCubeAxes(renderer, options.DPI, next, scene);
  AddDrawItems(axes, options, scene);
  if (distortion != glm::dmat4(1.0) && (!texts.empty() || !axes.empty() || !options.ClipToRange))
  {
    scene.Warnings.emplace_back(
      "The transform of the camera does not distort billboards, cube axes, "
      "shadows and ambient occlusion. Use a rigid transform.");
  }
  ExtractOverlay(renderer, options.DPI, options.FindDepths, scene);
  scene.Warnings = MergeWarnings(scene.Warnings);
  return scene;
}

bool UpdateView(vtkRenderer* renderer, const ExtractionOptions& options, Scene& scene)
{
  if (!scene.HasFixedOrigin || !options.KeepOrigin || !renderer->IsActiveCameraCreated())
  {
    return false;
  }
  double visible[6];
  renderer->ComputeVisiblePropBounds(visible);
  const double* bounds = scene.OriginBounds.data();
  const glm::dmat4 distortion = FindViewDistortion(renderer);
  if (!std::equal(visible, visible + 6, scene.VisibleBounds.begin()) ||
    distortion != glm::dmat4(1.0) ||
    (options.ClipToRange && !FindClippingRange(renderer, bounds, distortion).empty()))
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
  scene.ViewCamera = next.ViewCamera;
  scene.Lights = std::move(next.Lights);
  scene.BackgroundColors = std::move(next.BackgroundColors);
  scene.EnvironmentReflections = std::move(next.EnvironmentReflections);
  scene.OverlayImage = std::move(next.OverlayImage);
  scene.Warnings = std::move(next.Warnings);
  ExtractOverlay(renderer, options.DPI, options.FindDepths, scene);
  scene.Warnings = MergeWarnings(scene.Warnings);
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
