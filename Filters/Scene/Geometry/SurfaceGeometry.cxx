// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceGeometry.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"

#include <glm/glm.hpp>

#include <stdexcept>

namespace penumbra
{
namespace
{

constexpr const char* OriginalPointIdsName = "vtkOriginalPointIds";
constexpr const char* OriginalCellIdsName = "vtkOriginalCellIds";

glm::dvec3 ComputeMean(vtkPoints* points)
{
  glm::dvec3 sum(0.0);
  const vtkIdType count = points->GetNumberOfPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    sum += glm::dvec3(x[0], x[1], x[2]);
  }
  return sum / static_cast<double>(count);
}

/// Minimum sine of the angle between a face and the direction from the cell's center to the face's
/// center. Below, rounding errors decide on which side of the face the center is.
constexpr double MinimumHeight = 1e-6;

/// Returns true if the normal of `polygon` points toward the center of its volumetric `cell`.
bool FacesInward(vtkGenericCell* cell, vtkCell* polygon)
{
  if (cell->GetCellDimension() != 3)
  {
    return false;
  }
  double n[3];
  vtkPolygon::ComputeNormal(polygon->GetPoints(), n);
  const glm::dvec3 outward = ComputeMean(polygon->GetPoints()) - ComputeMean(cell->GetPoints());
  return glm::dot(glm::dvec3(n[0], n[1], n[2]), outward) < -MinimumHeight * glm::length(outward);
}

}

void UpdateStoppably(vtkAlgorithm* filter, const ProgressCallback& progress)
{
  struct AbortState
  {
    const ProgressCallback& Progress;
    bool IsAborted;
  };
  AbortState state{ progress, false };
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&state);
  observer->SetCallback([](vtkObject* caller, unsigned long, void* data, void*) {
    auto& self = *static_cast<AbortState*>(data);
    self.IsAborted = self.IsAborted || (self.Progress && self.Progress(0.0));
    if (self.IsAborted)
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, observer);
  filter->Update();
  filter->RemoveObserver(tag);
  if (state.IsAborted)
  {
    throw Stopped();
  }
}

vtkSmartPointer<vtkPolyData> ExtractSurface(vtkDataSet* data, const ProgressCallback& progress)
{
  if (vtkPolyData* polygons = vtkPolyData::SafeDownCast(data))
  {
    return polygons;
  }
  vtkNew<vtkGeometryFilter> surface;
  surface->SetInputData(data);
  surface->PassThroughPointIdsOn();
  surface->PassThroughCellIdsOn();
  UpdateStoppably(surface, progress);
  return surface->GetOutput();
}

std::vector<vtkIdType> OriginalIds(vtkPolyData* surface, vtkDataSet* data, int type)
{
  if (vtkPolyData::SafeDownCast(data) || surface->GetNumberOfElements(type) == 0)
  {
    return {};
  }
  const char* name = type == vtkDataObject::POINT ? OriginalPointIdsName : OriginalCellIdsName;
  vtkDataArray* array = surface->GetAttributes(type)->GetArray(name);
  const vtkIdType count = surface->GetNumberOfElements(type);
  if (!array || array->GetNumberOfTuples() != count)
  {
    throw std::runtime_error(
      std::string("The surface of vtkGeometryFilter does not have the array ") + name);
  }
  const vtkIdType end = data->GetNumberOfElements(type);
  std::vector<vtkIdType> ids(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    const auto id = static_cast<vtkIdType>(array->GetComponent(i, 0));
    ids[static_cast<std::size_t>(i)] = id >= 0 && id < end ? id : -1;
  }
  return ids;
}

vtkSmartPointer<vtkPolyData> FacingOutwards(
  vtkPolyData* surface, vtkDataSet* data, const ProgressCallback& progress)
{
  const std::vector<vtkIdType> ids = OriginalIds(surface, data, vtkDataObject::CELL);
  vtkSmartPointer<vtkPolyData> reversed = surface;
  vtkNew<vtkGenericCell> cell;
  vtkNew<vtkGenericCell> polygon;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    const auto index = static_cast<vtkIdType>(i);
    if (i % StoppableCells == 0)
    {
      ThrowIfStopped(progress, 0.0);
    }
    surface->GetCell(index, polygon);
    if (ids[i] < 0 || polygon->GetCellDimension() != 2)
    {
      continue;
    }
    data->GetCell(ids[i], cell);
    if (!FacesInward(cell, polygon))
    {
      continue;
    }
    if (reversed == surface)
    {
      reversed = vtkSmartPointer<vtkPolyData>::New();
      reversed->ShallowCopy(surface);
      vtkNew<vtkCellArray> polygons;
      polygons->DeepCopy(surface->GetPolys());
      reversed->SetPolys(polygons);
      reversed->BuildCells();
    }
    reversed->ReverseCell(index);
  }
  return reversed;
}

vtkSmartPointer<vtkPolyData> DropMismatchedAttributes(
  vtkPolyData* surface, std::vector<std::string>& messages)
{
  struct Attribute
  {
    int Association;
    int Type;
    int Components; ///< required number; 0: any
    const char* Name;
  };
  static constexpr Attribute attributes[] = {
    { vtkDataObject::POINT, vtkDataSetAttributes::NORMALS, 3, "normals of points" },
    { vtkDataObject::CELL, vtkDataSetAttributes::NORMALS, 3, "normals of cells" },
    { vtkDataObject::POINT, vtkDataSetAttributes::TCOORDS, 0, "texture coordinates" },
  };
  vtkSmartPointer<vtkPolyData> kept = surface;
  for (const Attribute& attribute : attributes)
  {
    vtkDataArray* array =
      surface->GetAttributes(attribute.Association)->GetAttribute(attribute.Type);
    const vtkIdType count = surface->GetNumberOfElements(attribute.Association);
    if (!array ||
      (array->GetNumberOfTuples() == count &&
        (attribute.Components == 0 || array->GetNumberOfComponents() == attribute.Components)))
    {
      continue;
    }
    if (kept == surface)
    {
      kept = vtkSmartPointer<vtkPolyData>::New();
      kept->ShallowCopy(surface);
    }
    kept->GetAttributes(attribute.Association)->SetActiveAttribute(-1, attribute.Type);
    messages.push_back(std::to_string(array->GetNumberOfTuples()) + " " + attribute.Name +
      " were ignored because " + std::to_string(count) + " are required.");
  }
  return kept;
}

}
