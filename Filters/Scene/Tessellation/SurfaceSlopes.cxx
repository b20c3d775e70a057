// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceSlopes.h"

#include "Scene.h"
#include "SceneExtractionSurfaces.h"
#include "Surface.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticCellLocator.h"

#include <algorithm>
#include <memory>

namespace penumbra
{
namespace
{

/// Distance in pixels within which a line or point lies on a surface, in spite of different
/// subdivisions of curved surfaces.
constexpr double MaximumDistance = 2.0;

}

SurfaceSlopes::SurfaceSlopes(const std::vector<DrawItem>& items, const Scene& scene)
  : View(scene.ViewCamera)
{
  Scene surfaces;
  surfaces.Origin = scene.Origin;
  surfaces.Scale = scene.Scale;
  for (const DrawItem& item : items)
  {
    if (!item.GlyphInstances && item.Property->GetRepresentation() == VTK_SURFACE)
    {
      DrawItem still = item;
      still.PolygonOffset = {};
      AddSurface(still, surfaces);
    }
  }
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const Surface& surface : surfaces.Surfaces)
  {
    const vtkIdType first = points->GetNumberOfPoints();
    for (const glm::vec3& x : surface.Positions)
    {
      points->InsertNextPoint(x.x, x.y, x.z);
    }
    for (const glm::uvec3& t : surface.Triangles)
    {
      const vtkIdType ids[3] = { first + t.x, first + t.y, first + t.z };
      cells->InsertNextCell(3, ids);
    }
  }
  this->Triangles->SetPoints(points);
  this->Triangles->SetPolys(cells);
  if (cells->GetNumberOfCells() > 0)
  {
    this->Locator->SetDataSet(this->Triangles);
    this->Locator->BuildLocator();
  }
}

SurfaceSlopes::~SurfaceSlopes() = default;

double SurfaceSlopes::Find(glm::dvec3 x) const
{
  if (this->Triangles->GetNumberOfCells() == 0)
  {
    return 0.0;
  }
  const double radius = MaximumDistance * ComputePixelSize(this->View, x);
  glm::dvec3 nearest;
  vtkIdType cell = -1;
  int part = 0;
  double squaredDistance = 0.0;
  // Not constant, but it changes only its scratch memory.
  vtkStaticCellLocator* locator = this->Locator;
  // Not a virtual call: the table of virtual functions differs between releases of VTK 9.7, with all
  // of which the modules of Python run.
  if (!locator->vtkAbstractCellLocator::FindClosestPointWithinRadius(
        &x.x, radius, &nearest.x, cell, part, squaredDistance))
  {
    return 0.0;
  }
  vtkNew<vtkIdList> ids;
  this->Triangles->GetPolys()->GetCellAtId(cell, ids);
  glm::dvec3 corners[3];
  for (int i = 0; i < 3; ++i)
  {
    this->Triangles->GetPoint(ids->GetId(i), &corners[i].x);
  }
  return ComputeSlopeOfPlane(
    this->View, x, glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

void FindSlopes(const Scene& scene, std::vector<DrawItem>& items)
{
  const bool isUsed = std::any_of(items.begin(), items.end(), [](const DrawItem& item) {
    return (item.Property->GetRepresentation() != VTK_SURFACE || HasLinesOrPoints(item)) &&
      (item.LineOffset.Factor != 0.0 || item.PointOffset.Factor != 0.0);
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

}
