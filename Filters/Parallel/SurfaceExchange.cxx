// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceExchange.h"

#include "Import/SurfaceGeometry.h"

#include "vtkAppendPolyData.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
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

vtkSmartPointer<vtkPolyData> SurfaceOfLeaf(vtkDataObject* data)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  vtkDataSet* dataSet = vtkDataSet::SafeDownCast(data);
  if (dataSet && dataSet->GetNumberOfPoints() > 0)
  {
    const vtkSmartPointer<vtkPolyData> mesh = ExtractSurface(dataSet);
    surface->CopyStructure(mesh);
    surface->GetPointData()->SetNormals(mesh->GetPointData()->GetNormals());
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

/// The polygons whose bounds meet `box`, with their points alone.
vtkSmartPointer<vtkPolyData> CropToBox(vtkPolyData* surface, const vtkBoundingBox& box)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  vtkNew<vtkCellArray> polygons;
  std::vector<vtkIdType> places(static_cast<std::size_t>(surface->GetNumberOfPoints()), -1);
  vtkNew<vtkIdList> corners;
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    const bool strips = cells == surface->GetStrips();
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
        vtkIdType& place = places[static_cast<std::size_t>(corners->GetId(i))];
        if (place < 0)
        {
          double x[3];
          surface->GetPoint(corners->GetId(i), x);
          place = points->InsertNextPoint(x);
        }
        corners->SetId(i, place);
      }
      if (!strips)
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
    return SurfaceOfLeaf(data);
  }
  std::vector<vtkSmartPointer<vtkDataObject>> parts;
  const auto each = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem())
  {
    parts.push_back(SurfaceOfLeaf(each->GetCurrentDataObject()));
  }
  return AppendSurfaces(parts);
}

std::vector<vtkBoundingBox> GatherBounds(vtkMultiProcessController* ranks, vtkPolyData* own)
{
  double mine[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 }; // none
  if (own->GetNumberOfPoints() > 0)
  {
    own->GetBounds(mine);
  }
  std::vector<double> all(6 * static_cast<std::size_t>(ranks->GetNumberOfProcesses()));
  ranks->AllGather(mine, all.data(), 6);
  std::vector<vtkBoundingBox> bounds;
  for (std::size_t i = 0; i < all.size(); i += 6)
  {
    vtkBoundingBox box;
    if (all[i] <= all[i + 1])
    {
      box.SetBounds(all.data() + i);
    }
    bounds.push_back(box);
  }
  return bounds;
}

vtkSmartPointer<vtkPolyData> GatherRemoteOccluders(vtkMultiProcessController* ranks,
  vtkPolyData* own, const std::vector<vtkBoundingBox>& bounds, double reach)
{
  const int self = ranks->GetLocalProcessId();
  vtkSmartPointer<vtkPolyData> result;
  for (int asking = 0; asking < ranks->GetNumberOfProcesses(); ++asking)
  {
    vtkBoundingBox box = bounds[asking];
    const bool sends = asking != self && box.IsValid();
    auto part = vtkSmartPointer<vtkPolyData>::New();
    if (sends && std::isfinite(reach))
    {
      box.Inflate(reach);
      part = CropToBox(own, box);
    }
    else if (sends)
    {
      part = SurfaceOfLeaf(own);
      part->GetPointData()->Initialize();
    }
    std::vector<vtkSmartPointer<vtkDataObject>> parts;
    ranks->Gather(part, parts, asking);
    if (asking == self)
    {
      result = AppendSurfaces(parts);
    }
  }
  return result;
}

vtkSmartPointer<vtkPolyData> AllGatherSurfaces(vtkMultiProcessController* ranks, vtkPolyData* own)
{
  std::vector<vtkSmartPointer<vtkDataObject>> parts;
  ranks->AllGather(own, parts);
  return AppendSurfaces(parts);
}

}
