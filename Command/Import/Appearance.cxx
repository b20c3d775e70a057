// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Appearance.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCleanPolyData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

namespace penumbra
{

std::vector<vtkDataSet*> FindDataSets(vtkDataObject* data)
{
  std::vector<vtkDataSet*> found;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      if (auto* leaf = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()))
      {
        found.push_back(leaf);
      }
    }
  }
  else if (auto* single = vtkDataSet::SafeDownCast(data))
  {
    found.push_back(single);
  }
  return found;
}

vtkSmartPointer<vtkPolyData> RemoveUnusedPoints(vtkPolyData* mesh)
{
  vtkNew<vtkCleanPolyData> compact;
  compact->SetInputData(mesh);
  compact->PointMergingOff();
  compact->ConvertLinesToPointsOff();
  compact->ConvertPolysToLinesOff();
  compact->ConvertStripsToPolysOff();
  compact->Update();
  return compact->GetOutput();
}

}
