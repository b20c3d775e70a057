// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Cuts.h"

#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkContourFilter.h"
#include "vtkCutter.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTableBasedClipDataSet.h"
#include "vtkThreshold.h"
#include "vtkUnstructuredGrid.h"

#include <stdexcept>

namespace penumbra
{

namespace
{

/// An array and whether its values belong to cells.
struct FoundArray
{
  vtkDataArray* Array = nullptr;
  bool OfCells = false;
};

vtkDataArray* FindIn(vtkDataSetAttributes* attributes, const std::string& name)
{
  if (!name.empty())
  {
    return attributes->GetArray(name.c_str());
  }
  vtkDataArray* scalars = attributes->GetScalars();
  for (int i = 0; i < attributes->GetNumberOfArrays() && !scalars; ++i)
  {
    vtkDataArray* array = attributes->GetArray(i);
    const bool isValue = array && array->GetName() && array->GetNumberOfComponents() == 1 &&
      array != attributes->GetGlobalIds() && array != attributes->GetNormals() &&
      std::string(array->GetName()) != vtkDataSetAttributes::GhostArrayName();
    scalars = isValue ? array : nullptr;
  }
  return scalars;
}

FoundArray FindArray(vtkDataSet* data, const std::string& name, bool byCells)
{
  vtkDataArray* ofPoints = FindIn(data->GetPointData(), name);
  vtkDataArray* ofCells = FindIn(data->GetCellData(), name);
  if (ofCells && (byCells || !ofPoints))
  {
    return { ofCells, true };
  }
  return { ofPoints, false };
}

vtkSmartPointer<vtkPlane> MakePlane(const Cut& cut)
{
  auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetOrigin(cut.Plane.data());
  plane->SetNormal(cut.Plane.data() + 3);
  return plane;
}

vtkSmartPointer<vtkDataSet> Slice(vtkDataSet* data, const Cut& cut)
{
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(data);
  cutter->SetCutFunction(MakePlane(cut));
  cutter->Update();
  return cutter->GetOutput();
}

vtkSmartPointer<vtkDataSet> Clip(vtkDataSet* data, const Cut& cut)
{
  vtkNew<vtkTableBasedClipDataSet> clip;
  clip->SetInputData(data);
  clip->SetClipFunction(MakePlane(cut));
  clip->Update();
  return clip->GetOutput();
}

vtkSmartPointer<vtkDataSet> Contour(vtkDataSet* data, const Cut& cut, const FoundArray& found)
{
  const std::string name = found.Array->GetName();
  vtkSmartPointer<vtkDataSet> input = data;
  if (found.OfCells)
  {
    vtkNew<vtkCellDataToPointData> interpolate;
    interpolate->SetInputData(data);
    interpolate->PassCellDataOn();
    interpolate->Update();
    input = vtkDataSet::SafeDownCast(interpolate->GetOutputDataObject(0));
  }
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(input);
  contour->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name.c_str());
  contour->SetValue(0, cut.Values[0]);
  contour->Update();
  return contour->GetOutput();
}

vtkSmartPointer<vtkDataSet> Threshold(vtkDataSet* data, const Cut& cut, const FoundArray& found)
{
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputData(data);
  threshold->SetInputArrayToProcess(0, 0, 0,
    found.OfCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS
                  : vtkDataObject::FIELD_ASSOCIATION_POINTS,
    found.Array->GetName());
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_BETWEEN);
  threshold->SetLowerThreshold(cut.Values[0]);
  threshold->SetUpperThreshold(cut.Values[1]);
  threshold->Update();
  return threshold->GetOutput();
}

}

vtkSmartPointer<vtkDataSet> ApplyCuts(vtkDataSet* data, const CutList& list, std::string& missing)
{
  vtkSmartPointer<vtkDataSet> result = data;
  for (const Cut& cut : list.Cuts)
  {
    if (cut.Kind == Cut::Kinds::Slice || cut.Kind == Cut::Kinds::Clip)
    {
      result = cut.Kind == Cut::Kinds::Slice ? Slice(result, cut) : Clip(result, cut);
      continue;
    }
    const std::string name = cut.Array.empty() ? list.Array : cut.Array;
    const FoundArray found = FindArray(result, name, list.ByCells);
    if (!found.Array)
    {
      missing = name.empty() ? "any" : name;
      return vtkSmartPointer<vtkPolyData>::New();
    }
    if (found.Array->GetNumberOfComponents() > 1)
    {
      throw std::runtime_error(std::string("--contour and --threshold need an array with one "
                                           "component, which '") +
        found.Array->GetName() + "' is not");
    }
    result =
      cut.Kind == Cut::Kinds::Contour ? Contour(result, cut, found) : Threshold(result, cut, found);
  }
  return result;
}

}
