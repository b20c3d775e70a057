// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionImposters.h"

#include "Material.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cmath>

namespace penumbra
{
namespace
{

bool IsPositive(double x)
{
  return x > 0.0 && std::isfinite(x);
}

/// Returns a point array with at least the given number of components; null, with a warning, if
/// its size is wrong. A missing array has no warning.
vtkDataArray* FindArray(vtkPolyData* data, const std::string& name, int components,
  const std::string& prop, std::vector<std::string>& warnings)
{
  vtkDataArray* array = name.empty() ? nullptr : data->GetPointData()->GetArray(name.c_str());
  if (array &&
    (array->GetNumberOfTuples() != data->GetNumberOfPoints() ||
      array->GetNumberOfComponents() < components))
  {
    warnings.push_back(prop + ": the array " + name + " was ignored because it has " +
      std::to_string(array->GetNumberOfTuples()) + " values of " +
      std::to_string(array->GetNumberOfComponents()) + " components for " +
      std::to_string(data->GetNumberOfPoints()) + " points.");
    return nullptr;
  }
  return array;
}

/// Returns a copy of a property whose color is the one that VTK passes to the imposters: of 8 bits,
/// and the same for the ambient and the diffuse part.
vtkSmartPointer<vtkProperty> MakeImposterProperty(vtkProperty* from)
{
  auto property = vtkSmartPointer<vtkProperty>::New();
  property->DeepCopy(from);
  double color[3];
  from->GetColor(color);
  for (double& c : color)
  {
    c = std::floor(255.0 * c) / 255.0;
  }
  property->SetAmbientColor(color);
  property->SetDiffuseColor(color);
  property->SetRepresentationToSurface();
  property->EdgeVisibilityOff();
  property->VertexVisibilityOff();
  return property;
}

void MakeSpheres(const ImposterSettings& settings, vtkPolyData* data, DrawItem& item,
  std::vector<std::string>& warnings)
{
  item.Radii = FindArray(data, settings.ScaleArray, 1, item.Name, warnings);
  item.PointRadius = settings.Radius;
  if (!item.Radii && !IsPositive(settings.Radius))
  {
    warnings.push_back(item.Name +
      ": the spheres were skipped because their radius is not a positive finite number.");
    return;
  }
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  item.Data->SetPoints(data->GetPoints());
  item.Data->SetVerts(vertices);
}

void MakeSticks(const ImposterSettings& settings, vtkPolyData* data, DrawItem& item,
  std::vector<std::string>& warnings)
{
  vtkDataArray* sizes = FindArray(data, settings.ScaleArray, 2, item.Name, warnings);
  vtkDataArray* orientations = FindArray(data, settings.OrientationArray, 3, item.Name, warnings);
  if (!sizes || !orientations)
  {
    warnings.push_back(item.Name +
      ": the sticks were skipped because they need point arrays of their orientations and sizes.");
    return;
  }
  const glm::dmat3 toNormal = glm::transpose(glm::inverse(glm::dmat3(item.ToWorld)));
  vtkNew<vtkPoints> ends;
  ends->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkDoubleArray> radii;
  vtkNew<vtkIdTypeArray> ids;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(4);
  const bool isColored = item.Colors.Mode == Coloring::Modes::PerPoint;
  vtkIdType invalid = 0;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 axis;
    orientations->GetTuple(i, &axis.x);
    const double length = std::abs(sizes->GetComponent(i, 0)) * glm::length(axis);
    const double radius = sizes->GetComponent(i, 1);
    const double* x = data->GetPoint(i);
    const glm::dvec3 center(item.ToWorld * glm::dvec4(x[0], x[1], x[2], 1.0));
    const glm::dvec3 half = 0.5 * length * glm::normalize(toNormal * axis);
    if (!IsPositive(length) || !IsPositive(radius) ||
      !std::isfinite(glm::dot(half, half) + glm::dot(center, center)))
    {
      ++invalid;
      continue;
    }
    lines->InsertNextCell(2);
    for (const glm::dvec3& p : { center - half, center + half })
    {
      lines->InsertCellPoint(ends->InsertNextPoint(p.x, p.y, p.z));
      radii->InsertNextValue(radius);
    }
    ids->InsertNextValue(i);
    if (isColored)
    {
      colors->InsertNextTuple(i, item.Colors.Colors);
    }
  }
  if (invalid > 0)
  {
    warnings.push_back(item.Name + ": " + std::to_string(invalid) +
      " sticks were skipped because their position, size or orientation is not valid.");
  }
  item.Data->SetPoints(ends);
  item.Data->SetLines(lines);
  item.ToWorld = glm::dmat4(1.0);
  item.CellIds = ids;
  item.Radii = radii;
  item.LineRadius = 1.0; // requests tubes; Radii replaces the value
  item.HasFlatTubes = true;
  if (isColored)
  {
    item.Colors.Mode = Coloring::Modes::PerCell;
    item.Colors.Colors = colors;
  }
}

}

DrawItem MakeImposters(const ImposterSettings& settings, vtkPolyData* data,
  const DrawItem& prototype, const Coloring& colors, std::vector<std::string>& warnings)
{
  DrawItem item = prototype;
  item.Data = vtkSmartPointer<vtkPolyData>::New();
  item.Property = MakeImposterProperty(prototype.Property);
  item.BackProperty = nullptr;
  item.BaseColorTexture = nullptr;
  item.LitTexture = nullptr;
  item.DetailTextures = nullptr;
  const bool isPerPoint = colors.Mode == Coloring::Modes::PerPoint;
  item.Colors = isPerPoint || colors.Mode == Coloring::Modes::Single ? colors : Coloring();
  (settings.AreSticks ? MakeSticks : MakeSpheres)(settings, data, item, warnings);
  return item;
}

}
