// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CoincidentTopology.h"

#include "CollectionItems.h"
#include "Scene.h"

#include "vtkActor.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <limits>

namespace penumbra
{
namespace
{

/// Number of depths that VTK's shaders assume a depth buffer to distinguish.
constexpr double DepthsOfBuffer = 65000.0;
/// Minimum ratio of the near and the far plane that vtkRenderer chooses for 16 bits of depth.
constexpr double MinimumNearRatio = 0.01;
/// Units per z-shift in VTK's shaders.
constexpr double UnitsPerShift = 4.0;

}

bool HasPolygons(const DrawItem& item)
{
  return item.Property->GetRepresentation() == VTK_SURFACE &&
    item.Data->GetPolys()->GetNumberOfCells() + item.Data->GetStrips()->GetNumberOfCells() > 0;
}

void ReadDepthOffsets(vtkActor* actor, DrawItem& item)
{
  vtkMapper* mapper = actor->GetMapper();
  vtkProperty* property = actor->GetProperty();
  const int mode = vtkMapper::GetResolveCoincidentTopology();
  if (mode == VTK_RESOLVE_SHIFT_ZBUFFER)
  {
    item.PolygonOffset.Units = UnitsPerShift * vtkMapper::GetResolveCoincidentTopologyZShift();
  }
  if (mode == VTK_RESOLVE_POLYGON_OFFSET ||
    (property->GetEdgeVisibility() && property->GetRepresentation() == VTK_SURFACE))
  {
    DepthOffset& polygon = item.PolygonOffset;
    mapper->GetCoincidentTopologyPolygonOffsetParameters(polygon.Factor, polygon.Units);
    mapper->GetCoincidentTopologyLineOffsetParameters(
      item.LineOffset.Factor, item.LineOffset.Units);
    mapper->GetCoincidentTopologyPointOffsetParameter(item.PointOffset.Units);
  }
}

DepthOffset FindFarthestOffset(const std::vector<DrawItem>& items)
{
  DepthOffset farthest;
  bool isFirst = true;
  for (const DrawItem& item : items)
  {
    if (HasPolygons(item) && (isFirst || item.PolygonOffset.GetRank() > farthest.GetRank()))
    {
      farthest = item.PolygonOffset;
      isFirst = false;
    }
  }
  return farthest;
}

void MakeDepthOffsetsRelative(DepthOffset farthest, std::vector<DrawItem>& items)
{
  for (DrawItem& item : items)
  {
    for (DepthOffset* offset : { &item.PolygonOffset, &item.LineOffset, &item.PointOffset })
    {
      *offset = *offset - farthest;
    }
  }
}

// VTK counts units in its depth buffer between the clipping planes. Where these are far from the
// scene, the planes of vtkRenderer::ResetCameraClippingRange() are used, so that surfaces do not
// show through others.
double ComputeDepthUnit(vtkRenderer* renderer, const double bounds[6], const Scene& scene)
{
  const Camera& camera = scene.ViewCamera;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int i = 0; i < 8; ++i)
  {
    const double corner[3] = { bounds[i & 1], bounds[2 + (i >> 1 & 1)], bounds[4 + (i >> 2)] };
    const double depth = camera.Depth(scene.FromWorld(corner));
    low = std::min(low, depth);
    high = std::max(high, depth);
  }
  if (camera.Parallel)
  {
    return high > low ? (high - low) / DepthsOfBuffer : 0.0;
  }
  if (renderer->IsActiveCameraCreated())
  {
    const double* range = renderer->GetActiveCamera()->GetClippingRange();
    low = std::max(low, range[0] * scene.Scale);
    high = std::min(high, range[1] * scene.Scale);
  }
  low = std::max(low, MinimumNearRatio * high);
  return high > low ? (1.0 / low - 1.0 / high) / DepthsOfBuffer : 0.0;
}

std::vector<double> GetDepthOffsetSettings(vtkRenderer* renderer)
{
  std::vector<double> settings;
  for (vtkProp* prop : GetItems<vtkProp>(renderer->GetViewProps()))
  {
    if (!prop->GetVisibility())
    {
      continue;
    }
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      auto* actor = vtkActor::SafeDownCast(path->GetLastNode()->GetViewProp());
      if (actor && actor->GetMapper())
      {
        DrawItem item;
        ReadDepthOffsets(actor, item);
        for (const DepthOffset& offset : { item.PolygonOffset, item.LineOffset, item.PointOffset })
        {
          settings.push_back(offset.Factor);
          settings.push_back(offset.Units);
        }
      }
    }
  }
  const bool isDefault =
    std::all_of(settings.begin(), settings.end(), [](double x) { return x == 0.0; });
  return isDefault ? std::vector<double>() : settings;
}

}
