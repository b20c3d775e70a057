// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceExchange.h"

#include "Geometry/SurfaceGeometry.h"

#include "vtkAppendPolyData.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cmath>

namespace penumbra
{

namespace
{

vtkSmartPointer<vtkPolyData> ExtractLeafSurface(vtkDataObject* data)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  vtkDataSet* dataSet = vtkDataSet::SafeDownCast(data);
  if (dataSet && dataSet->GetNumberOfPoints() > 0)
  {
    const vtkSmartPointer<vtkPolyData> mesh = ExtractSurface(dataSet);
    surface->CopyStructure(mesh);
    surface->GetPointData()->SetNormals(mesh->GetPointData()->GetNormals());
    surface->GetCellData()->SetNormals(mesh->GetCellData()->GetNormals());
  }
  return surface;
}

vtkSmartPointer<vtkPolyData> AppendSurfaces(
  const std::vector<vtkSmartPointer<vtkDataObject>>& parts)
{
  vtkNew<vtkAppendPolyData> append;
  for (const vtkSmartPointer<vtkDataObject>& part : parts)
  {
    auto* surface = vtkPolyData::SafeDownCast(part);
    if (surface && surface->GetNumberOfPoints() > 0)
    {
      append->AddInputData(surface);
    }
  }
  if (append->GetNumberOfInputConnections(0) > 0)
  {
    append->Update();
  }
  return append->GetOutput();
}

/// Returns the polygons whose bounds intersect `box`, without attributes. Strips become triangles.
vtkSmartPointer<vtkPolyData> CropToBox(vtkPolyData* surface, const vtkBoundingBox& box)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  vtkNew<vtkCellArray> polygons;
  std::vector<vtkIdType> newIds(static_cast<std::size_t>(surface->GetNumberOfPoints()), -1);
  vtkNew<vtkIdList> corners;
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    const bool isStrip = cells == surface->GetStrips();
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(cell, corners);
      vtkBoundingBox bounds;
      for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
      {
        double x[3];
        surface->GetPoint(corners->GetId(i), x);
        bounds.AddPoint(x);
      }
      if (!bounds.Intersects(box))
      {
        continue;
      }
      for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
      {
        vtkIdType& newId = newIds[static_cast<std::size_t>(corners->GetId(i))];
        if (newId < 0)
        {
          double x[3];
          surface->GetPoint(corners->GetId(i), x);
          newId = points->InsertNextPoint(x);
        }
        corners->SetId(i, newId);
      }
      if (!isStrip)
      {
        polygons->InsertNextCell(corners);
        continue;
      }
      for (vtkIdType i = 2; i < corners->GetNumberOfIds(); ++i)
      {
        const vtkIdType triangle[3] = { corners->GetId(i - 2), corners->GetId(i - 1),
          corners->GetId(i) };
        polygons->InsertNextCell(3, triangle);
      }
    }
  }
  auto cropped = vtkSmartPointer<vtkPolyData>::New();
  cropped->SetPoints(points);
  cropped->SetPolys(polygons);
  return cropped;
}

}

vtkSmartPointer<vtkPolyData> ExtractCompositeSurface(vtkDataObject* data)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    return ExtractLeafSurface(data);
  }
  std::vector<vtkSmartPointer<vtkDataObject>> parts;
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    parts.push_back(ExtractLeafSurface(iterator->GetCurrentDataObject()));
  }
  return AppendSurfaces(parts);
}

std::vector<vtkBoundingBox> GatherBounds(vtkMultiProcessController* controller, vtkPolyData* local)
{
  double localBounds[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 }; // empty
  if (local->GetNumberOfPoints() > 0)
  {
    local->GetBounds(localBounds);
  }
  std::vector<double> allBounds(6 * static_cast<std::size_t>(controller->GetNumberOfProcesses()));
  controller->AllGather(localBounds, allBounds.data(), 6);
  std::vector<vtkBoundingBox> bounds;
  for (std::size_t i = 0; i < allBounds.size(); i += 6)
  {
    vtkBoundingBox box;
    if (allBounds[i] <= allBounds[i + 1])
    {
      box.SetBounds(allBounds.data() + i);
    }
    bounds.push_back(box);
  }
  return bounds;
}

vtkSmartPointer<vtkPolyData> GatherRemoteOccluders(vtkMultiProcessController* controller,
  vtkPolyData* local, const std::vector<vtkBoundingBox>& bounds, double radius)
{
  const int localRank = controller->GetLocalProcessId();
  vtkSmartPointer<vtkPolyData> result;
  for (int receiver = 0; receiver < controller->GetNumberOfProcesses(); ++receiver)
  {
    vtkBoundingBox box = bounds[receiver];
    const bool sends = receiver != localRank && box.IsValid();
    auto part = vtkSmartPointer<vtkPolyData>::New();
    if (sends && std::isfinite(radius))
    {
      box.Inflate(radius);
      part = CropToBox(local, box);
    }
    else if (sends)
    {
      part = ExtractLeafSurface(local);
      part->GetPointData()->Initialize();
    }
    std::vector<vtkSmartPointer<vtkDataObject>> parts;
    controller->Gather(part, parts, receiver);
    if (receiver == localRank)
    {
      result = AppendSurfaces(parts);
    }
  }
  return result;
}

}
