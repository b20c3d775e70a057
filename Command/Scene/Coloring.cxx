// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Coloring.h"

#include "Input/Surfaces.h"
#include "Options/Colormaps.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandError.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"

#include <algorithm>

namespace penumbra
{

namespace
{

using Mappers = std::vector<vtkPolyDataMapper*>;

vtkDataSetAttributes* Attributes(vtkPolyDataMapper* mapper, bool cells)
{
  vtkPolyData* mesh = mapper->GetInput();
  return cells ? static_cast<vtkDataSetAttributes*>(mesh->GetCellData()) : mesh->GetPointData();
}

/// Returns whether the file has the array.
bool IsOfFile(vtkDataArray* array)
{
  return array && array->GetName() && std::string(array->GetName()) != OriginalCellIds &&
    std::string(array->GetName()) != CurvedFaces;
}

/// Returns whether the array is a candidate for coloring; normals, texture coordinates and the marks of
/// ghosts must be named.
bool IsColorable(vtkDataSetAttributes* attributes, vtkDataArray* array)
{
  return IsOfFile(array) && array != attributes->GetNormals() &&
    array != attributes->GetTCoords() &&
    std::string(array->GetName()) != vtkDataSetAttributes::GhostArrayName();
}

bool HasArray(const Mappers& mappers, const std::string& name, bool cells)
{
  return std::any_of(mappers.begin(), mappers.end(), [&](vtkPolyDataMapper* mapper) {
    return IsOfFile(Attributes(mapper, cells)->GetArray(name.c_str()));
  });
}

std::vector<std::string> ArrayNames(const Mappers& mappers, bool cells)
{
  std::vector<std::string> names;
  for (vtkPolyDataMapper* mapper : mappers)
  {
    vtkDataSetAttributes* attributes = Attributes(mapper, cells);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = attributes->GetArray(i);
      if (IsColorable(attributes, array) &&
        !std::count(names.begin(), names.end(), array->GetName()))
      {
        names.emplace_back(array->GetName());
      }
    }
  }
  return names;
}

std::string List(const std::vector<std::string>& names)
{
  return names.empty() ? "none" : Join(names, ", ");
}

std::string ChooseArray(const Mappers& mappers, const ColoringOptions& options)
{
  const std::vector<std::string> names = ArrayNames(mappers, options.ByCells);
  const std::string exists = "point arrays: " + List(ArrayNames(mappers, false)) +
    "; cell arrays (--coloring-by-cells): " + List(ArrayNames(mappers, true));
  if (!options.Array.empty())
  {
    if (!HasArray(mappers, options.Array, options.ByCells))
    {
      throw CommandError(BadInput,
        std::string("--coloring-array: no ") + (options.ByCells ? "cell" : "point") + " array '" +
          options.Array + "'; " + exists);
    }
    return options.Array;
  }
  if (names.empty())
  {
    throw CommandError(BadInput,
      std::string("--scalar-coloring: the files have no ") + (options.ByCells ? "cell" : "point") +
        " array; " + exists);
  }
  for (vtkPolyDataMapper* mapper : mappers)
  {
    vtkDataSetAttributes* attributes = Attributes(mapper, options.ByCells);
    if (IsColorable(attributes, attributes->GetScalars()))
    {
      return attributes->GetScalars()->GetName();
    }
  }
  return names.front();
}

Mappers FindMappersWith(const Mappers& mappers, const std::string& name, bool cells)
{
  Mappers found;
  std::copy_if(mappers.begin(), mappers.end(), std::back_inserter(found),
    [&](vtkPolyDataMapper* mapper) { return Attributes(mapper, cells)->GetArray(name.c_str()); });
  return found;
}

bool AreColors(vtkDataArray* array, const ColoringOptions& options)
{
  const bool bytes =
    array->GetDataType() == VTK_UNSIGNED_CHAR && array->GetNumberOfComponents() >= 3;
  return options.Component == -2 || (options.Component == -1 && bytes);
}

void CheckComponent(vtkDataArray* array, const ColoringOptions& options)
{
  const int components = array->GetNumberOfComponents();
  if (options.Component >= components)
  {
    throw CommandError(BadInput,
      "--coloring-component " + std::to_string(options.Component) + ": the array '" +
        array->GetName() + "' has components 0 to " + std::to_string(components - 1));
  }
  if (options.Component == -2 && (components < 3 || components > 4))
  {
    throw CommandError(BadInput,
      std::string("--coloring-component -2: the array '") + array->GetName() + "' has " +
        std::to_string(components) + " components; colors have 3 or 4");
  }
}

void SetRange(vtkLookupTable* table, const Mappers& mappers, const std::string& name,
  const ColoringOptions& options)
{
  double range[2] = { Infinity, -Infinity };
  for (vtkPolyDataMapper* mapper : mappers)
  {
    double one[2];
    vtkDataArray* array = Attributes(mapper, options.ByCells)->GetArray(name.c_str());
    array->GetFiniteRange(one, array->GetNumberOfComponents() == 1 ? 0 : options.Component);
    range[0] = std::min(range[0], one[0]);
    range[1] = std::max(range[1], one[1]);
  }
  if (!options.Range.empty())
  {
    std::copy(options.Range.begin(), options.Range.end(), range);
  }
  if (range[0] > range[1])
  {
    throw CommandError(BadInput,
      "--scalar-coloring: the array '" + name +
        "' has no finite value; choose another with --coloring-array");
  }
  table->SetTableRange(range);
}

/// Returns the colors that the file gives to the values of an array (LOOKUP_TABLE of legacy VTK
/// files), else the colormap.
vtkSmartPointer<vtkLookupTable> ChooseTable(
  const Mappers& mappers, const std::string& name, const ColoringOptions& options)
{
  for (vtkPolyDataMapper* mapper : mappers)
  {
    vtkLookupTable* own =
      Attributes(mapper, options.ByCells)->GetArray(name.c_str())->GetLookupTable();
    if (own && own->GetNumberOfTableValues() > 0 && !options.HasColormap)
    {
      auto table = vtkSmartPointer<vtkLookupTable>::New();
      table->DeepCopy(own);
      return table;
    }
  }
  return MakeColormap(options.Colormap);
}

}

ColorScale ColorByData(const Mappers& all, const ColoringOptions& options)
{
  const std::string name = ChooseArray(all, options);
  const Mappers mappers = FindMappersWith(all, name, options.ByCells);
  for (vtkPolyDataMapper* mapper : mappers)
  {
    CheckComponent(Attributes(mapper, options.ByCells)->GetArray(name.c_str()), options);
  }

  const vtkSmartPointer<vtkLookupTable> table = ChooseTable(mappers, name, options);
  SetRange(table, mappers, name, options);
  if (options.Component >= 0)
  {
    table->SetVectorModeToComponent();
    table->SetVectorComponent(options.Component);
  }
  else
  {
    table->SetVectorModeToMagnitude();
  }

  bool direct = false;
  for (vtkPolyDataMapper* mapper : mappers)
  {
    vtkDataArray* array = Attributes(mapper, options.ByCells)->GetArray(name.c_str());
    array->SetLookupTable(nullptr); // It would replace the table of the mapper.
    direct = AreColors(array, options);
    mapper->ScalarVisibilityOn();
    mapper->SetScalarMode(
      options.ByCells ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA : VTK_SCALAR_MODE_USE_POINT_FIELD_DATA);
    mapper->SelectColorArray(name.c_str());
    mapper->SetColorMode(direct ? VTK_COLOR_MODE_DIRECT_SCALARS : VTK_COLOR_MODE_MAP_SCALARS);
    mapper->SetLookupTable(table);
    mapper->UseLookupTableScalarRangeOn();
    mapper->SetInterpolateScalarsBeforeMapping(!direct && !options.ByCells);
  }
  if (options.ScalarBar && direct)
  {
    throw CommandError(BadInput,
      "--coloring-scalar-bar: the array '" + name +
        "' contains colors, which have no scalar bar; leave the option out");
  }
  return { table, name };
}

}
