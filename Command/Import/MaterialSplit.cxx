// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialSplit.h"

#include "Appearance.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <map>

namespace penumbra
{

namespace
{

/// The cells of one material: those of each kind, and their ids.
struct Part
{
  vtkNew<vtkCellArray> Cells[3];
  vtkNew<vtkIdList> Ids;
};

/// Makes the mesh of a part, without the points that it does not use.
vtkSmartPointer<vtkPolyData> MakeMesh(vtkPolyData* whole, const Part& part)
{
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(whole->GetPoints());
  mesh->GetPointData()->ShallowCopy(whole->GetPointData());
  mesh->SetVerts(part.Cells[0]);
  mesh->SetLines(part.Cells[1]);
  mesh->SetPolys(part.Cells[2]);
  mesh->GetCellData()->CopyAllocate(whole->GetCellData(), part.Ids->GetNumberOfIds());
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(OriginalCellIds);
  for (vtkIdType i = 0; i < part.Ids->GetNumberOfIds(); ++i)
  {
    mesh->GetCellData()->CopyData(whole->GetCellData(), part.Ids->GetId(i), i);
    ids->InsertNextValue(part.Ids->GetId(i));
  }
  mesh->GetCellData()->AddArray(ids);
  return RemoveUnusedPoints(mesh);
}

}

std::vector<MaterialPart> SplitByMaterial(vtkPolyData* mesh, vtkDataArray* ids)
{
  std::map<int, Part> parts;
  vtkCellArray* kinds[3] = { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys() };
  vtkNew<vtkIdList> corners;
  vtkIdType cell = 0;
  for (int kind = 0; kind < 3; ++kind)
  {
    for (vtkIdType i = 0; i < kinds[kind]->GetNumberOfCells(); ++i, ++cell)
    {
      kinds[kind]->GetCellAtId(i, corners);
      Part& part = parts[static_cast<int>(ids->GetComponent(cell, 0))];
      part.Cells[kind]->InsertNextCell(corners);
      part.Ids->InsertNextId(cell);
    }
  }
  std::vector<MaterialPart> result;
  for (const auto& [id, part] : parts)
  {
    result.push_back({ id, MakeMesh(mesh, part) });
  }
  return result;
}

}
