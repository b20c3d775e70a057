// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DataSurface.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkGeometryFilter.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

namespace penumbra
{

vtkSmartPointer<vtkPolyData> PolyDataOf(vtkDataSet* data)
{
  if (vtkPolyData* polygons = vtkPolyData::SafeDownCast(data))
  {
    return polygons;
  }
  vtkNew<vtkGeometryFilter> surface;
  surface->SetInputData(data);
  surface->PassThroughPointIdsOn();
  surface->PassThroughCellIdsOn();
  surface->Update();
  return surface->GetOutput();
}

vtkSmartPointer<vtkPolyData> WithoutMisfits(vtkPolyData* surface, std::vector<std::string>& left)
{
  struct Attribute
  {
    int Of;
    int Which;
    int Components; ///< 0: any
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
    vtkDataArray* array = surface->GetAttributes(attribute.Of)->GetAttribute(attribute.Which);
    const vtkIdType count = surface->GetNumberOfElements(attribute.Of);
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
    kept->GetAttributes(attribute.Of)->SetActiveAttribute(-1, attribute.Which);
    left.push_back(std::to_string(array->GetNumberOfTuples()) + " " + attribute.Name + ", where " +
      std::to_string(count) + " are needed, left out.");
  }
  return kept;
}

}
