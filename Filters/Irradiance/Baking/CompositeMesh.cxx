// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CompositeMesh.h"

#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkUnstructuredGrid.h"

namespace penumbra
{
namespace
{

vtkSmartPointer<vtkCompositeDataIterator> Leaves(vtkCompositeDataSet* data)
{
  return vtkSmartPointer<vtkCompositeDataIterator>::Take(data->NewIterator());
}

/// Copies `count` tuples, starting at `first`, of every array of `baked` that `merged` lacks.
void CopyNewArrays(vtkDataSetAttributes* baked, vtkDataSetAttributes* merged, vtkIdType first,
  vtkIdType count, vtkDataSetAttributes* block)
{
  for (int i = 0; i < baked->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = baked->GetArray(i);
    if (array && !merged->HasArray(array->GetName()))
    {
      auto part = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
      part->SetName(array->GetName());
      part->SetNumberOfComponents(array->GetNumberOfComponents());
      part->SetNumberOfTuples(count);
      part->InsertTuples(0, count, first, array);
      block->AddArray(part);
    }
  }
}

}

CompositeMesh::CompositeMesh(vtkCompositeDataSet* data)
  : Data(data),
    Merged(vtkSmartPointer<vtkUnstructuredGrid>::New())
{
  vtkNew<vtkAppendFilter> append;
  vtkSmartPointer<vtkCompositeDataIterator> leaf = Leaves(data);
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    auto* points = vtkPointSet::SafeDownCast(leaf->GetCurrentDataObject());
    if (points && points->GetNumberOfPoints() > 0)
    {
      append->AddInputData(points);
    }
    this->SkippedBlocks += points == nullptr;
  }
  if (append->GetNumberOfInputConnections(0) > 0)
  {
    append->Update();
    this->Merged = append->GetOutput();
  }
}

void CompositeMesh::Distribute(vtkPointSet* baked, vtkCompositeDataSet* output) const
{
  output->CopyStructure(this->Data);
  vtkIdType point = 0;
  vtkIdType cell = 0;
  vtkSmartPointer<vtkCompositeDataIterator> leaf = Leaves(this->Data);
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataObject* block = leaf->GetCurrentDataObject();
    auto copy = vtkSmartPointer<vtkDataObject>::Take(block->NewInstance());
    copy->ShallowCopy(block);
    auto* points = vtkPointSet::SafeDownCast(copy);
    if (points && points->GetNumberOfPoints() > 0)
    {
      const vtkIdType pointCount = points->GetNumberOfPoints();
      const vtkIdType cellCount = points->GetNumberOfCells();
      CopyNewArrays(baked->GetPointData(), this->Merged->GetPointData(), point, pointCount,
        points->GetPointData());
      CopyNewArrays(
        baked->GetCellData(), this->Merged->GetCellData(), cell, cellCount, points->GetCellData());
      point += pointCount;
      cell += cellCount;
    }
    output->SetDataSet(leaf, copy);
  }
}

}
