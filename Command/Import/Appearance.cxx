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

namespace
{

bool HasElements(vtkDataObject* data)
{
  for (int type = 0; type < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++type)
  {
    if (type != vtkDataObject::FIELD && data->GetNumberOfElements(type) > 0)
    {
      return true;
    }
  }
  return false;
}

}

std::vector<vtkDataSet*> FindDataSets(vtkDataObject* data, std::set<std::string>* others)
{
  std::vector<vtkDataSet*> found;
  const auto add = [&](vtkDataObject* leaf) {
    if (auto* dataSet = vtkDataSet::SafeDownCast(leaf))
    {
      found.push_back(dataSet);
    }
    else if (leaf && others && HasElements(leaf))
    {
      others->insert(leaf->GetClassName());
    }
  };
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      add(iterator->GetCurrentDataObject());
    }
  }
  else
  {
    add(data);
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
