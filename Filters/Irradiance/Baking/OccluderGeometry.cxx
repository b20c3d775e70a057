// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OccluderGeometry.h"

#include "Geometry/SurfaceGeometry.h"
#include "Scene.h"
#include "Surface.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTriangleFilter.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace penumbra
{

bool IsFinite(const double x[3])
{
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

std::vector<glm::uvec3> Triangulate(
  vtkPolyData* mesh, const std::vector<char>& finite, const ProgressCallback& progress)
{
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(mesh);
  filter->PassLinesOff();
  filter->PassVertsOff();
  UpdateStoppably(filter, progress);
  vtkCellArray* cells = filter->GetOutput()->GetPolys();
  std::vector<glm::uvec3> triangles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, ids);
    if (ids->GetNumberOfIds() != 3)
    {
      continue;
    }
    const glm::uvec3 corners(ids->GetId(0), ids->GetId(1), ids->GetId(2));
    if (finite[corners.x] && finite[corners.y] && finite[corners.z])
    {
      triangles.push_back(corners);
    }
  }
  return triangles;
}

void AddRoundOccluders(vtkPolyData* mesh, bool tubes, double radius, Scene& scene)
{
  vtkCellArray* cells = tubes ? mesh->GetLines() : mesh->GetVerts();
  if (!(radius > 0.0) || cells->GetNumberOfCells() == 0)
  {
    return;
  }
  Surface surface;
  surface.Radii = { static_cast<float>(radius * scene.Scale) };
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, ids);
    bool joins = false;
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      double x[3];
      mesh->GetPoint(ids->GetId(k), x);
      if (!IsFinite(x))
      {
        joins = false;
        continue;
      }
      const auto index = static_cast<std::uint32_t>(surface.Positions.size());
      surface.Positions.emplace_back(scene.FromWorld(x));
      if (tubes && joins)
      {
        surface.Segments.emplace_back(index - 1, index);
      }
      joins = true;
    }
  }
  if (tubes ? !surface.Segments.empty() : !surface.Positions.empty())
  {
    scene.Surfaces.push_back(std::move(surface));
  }
}

bool SetOpacity(vtkPolyData* data, const std::string& name, Surface& surface)
{
  vtkDataArray* opacities = data->GetPointData()->GetArray(name.c_str());
  if (name.empty() || !opacities || opacities->GetNumberOfComponents() != 1 ||
    opacities->GetNumberOfTuples() != static_cast<vtkIdType>(surface.Positions.size()))
  {
    return name.empty();
  }
  for (vtkIdType i = 0; i < opacities->GetNumberOfTuples(); ++i)
  {
    const double opacity = opacities->GetComponent(i, 0);
    if (!(opacity >= 0.0 && opacity <= 1.0))
    {
      surface.PointColors.clear();
      return false;
    }
    surface.PointColors.emplace_back(255, 255, 255, std::lround(255.0 * opacity));
  }
  return true;
}

void RejectOpacityArray(const std::string& name, const std::string& where)
{
  throw std::runtime_error("OpacityArray: " + name + where +
    " must be a point array with one component and values in [0, 1].");
}

}
