// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RecordPolyData.h"

#include "SceneCoordinates.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <glm/gtc/constants.hpp>

namespace penumbra
{
namespace
{

/// Array of Record::IsValid. All records are valid if the array is missing.
constexpr const char* ValidName = "Serves";

/// Arrays in addition to the mean: name, number of components, and exponent of length in the unit.
struct Column
{
  const char* Name;
  int Components;
  bool PerChannel;
  int LengthPower;
};
constexpr Column Columns[] = {
  { "Normals", 3, false, 0 },
  { "Radius", 1, false, 1 },
  { "Lean", 1, false, 1 },
  { "TranslationGradient", 3, true, -1 },
  { "RotationGradient", 3, true, 0 },
  { "Tangent", 3, false, 0 },
  { "Clearance", HemisphereEstimate::Sectors, false, 1 },
  { "Bend", 1, false, -2 },
  { "StandardError", 1, false, 0 },
};
constexpr int ColumnCount = sizeof Columns / sizeof Columns[0];

const char* ValueName(Quantities quantity)
{
  return quantity == Quantities::Occlusion ? "AmbientOcclusion" : "Irradiance";
}

int Channels(Quantities quantity)
{
  return quantity == Quantities::Occlusion ? 1 : 3;
}

/// Returns the values of column `column` in scene units.
float* Numbers(Record& record, int column, int channel)
{
  switch (column)
  {
    case 0:
      return &record.Normal.x;
    case 1:
      return &record.Radius;
    case 2:
      return &record.MaximumPlaneDistance;
    case 3:
      return &record.Gathered.Translation[channel].x;
    case 4:
      return &record.Gathered.Rotation[channel].x;
    case 5:
      return &record.Tangent.x;
    case 6:
      return record.Gathered.Clearance.data();
    case 7:
      return &record.Gathered.HessianNorm;
    default:
      return &record.Gathered.Error;
  }
}

/// Returns the factor from scene units to the units of the array.
float FactorOf(const Column& column, Quantities quantity, double scale)
{
  const bool ofValue =
    column.PerChannel || column.LengthPower < 0 || &column == &Columns[ColumnCount - 1];
  const float value = ofValue && quantity == Quantities::Irradiance ? glm::pi<float>() : 1.f;
  return value * static_cast<float>(std::pow(scale, -column.LengthPower));
}

vtkFloatArray* AddArray(vtkPolyData* data, const char* name, int components, std::size_t count)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  data->GetPointData()->AddArray(array);
  return array;
}

bool IsSound(const Record& record)
{
  const float length = glm::length(record.Normal);
  return record.Radius > 0.f && std::isfinite(record.Radius) && std::abs(length - 1.f) < 1e-2f &&
    std::isfinite(record.Position.x + record.Position.y + record.Position.z) &&
    std::isfinite(record.Gathered.Mean.x + record.Gathered.Mean.y + record.Gathered.Mean.z);
}

}

bool HasRecords(vtkPolyData* data, Quantities quantity)
{
  return data->GetPointData()->HasArray(ValueName(quantity)) != 0;
}

void ToPolyData(const std::vector<Record>& records, Quantities quantity,
  const SceneCoordinates& coordinates, vtkPolyData* data)
{
  data->Initialize();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  for (const Record& record : records)
  {
    const glm::dvec3 world = coordinates.ToWorld(record.Position);
    const vtkIdType id = points->InsertNextPoint(world.x, world.y, world.z);
    vertices->InsertNextCell(1, &id);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);

  const int channels = Channels(quantity);
  vtkFloatArray* values = AddArray(data, ValueName(quantity), channels, records.size());
  const float unit = quantity == Quantities::Irradiance ? glm::pi<float>() : 1.f;
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    for (int c = 0; c < channels; ++c)
    {
      values->SetTypedComponent(static_cast<vtkIdType>(i), c, unit * records[i].Gathered.Mean[c]);
    }
  }
  for (int k = 0; k < ColumnCount; ++k)
  {
    const Column& column = Columns[k];
    const int repeats = column.PerChannel ? channels : 1;
    const float factor = FactorOf(column, quantity, coordinates.Scale);
    vtkFloatArray* array = AddArray(data, column.Name, column.Components * repeats, records.size());
    for (std::size_t i = 0; i < records.size(); ++i)
    {
      Record record = records[i];
      for (int n = 0; n < column.Components * repeats; ++n)
      {
        array->SetTypedComponent(static_cast<vtkIdType>(i), n,
          factor * Numbers(record, k, n / column.Components)[n % column.Components]);
      }
    }
  }
  vtkNew<vtkUnsignedCharArray> valid;
  valid->SetName(ValidName);
  for (const Record& record : records)
  {
    valid->InsertNextValue(record.IsValid ? 1 : 0);
  }
  data->GetPointData()->AddArray(valid);
  data->GetPointData()->SetActiveScalars(ValueName(quantity));
  data->GetPointData()->SetActiveNormals("Normals");
}

std::vector<Record> FromPolyData(
  vtkPolyData* data, Quantities quantity, const SceneCoordinates& coordinates, std::string& problem)
{
  const int channels = Channels(quantity);
  vtkDataArray* values = data->GetPointData()->GetArray(ValueName(quantity));
  if (!values || values->GetNumberOfComponents() != channels)
  {
    problem = std::string("the point array ") + ValueName(quantity) + " is missing";
    return {};
  }
  const float unit = quantity == Quantities::Irradiance ? glm::pi<float>() : 1.f;
  vtkDataArray* valid = data->GetPointData()->GetArray(ValidName);
  std::vector<Record> records(data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double x[3];
    data->GetPoint(i, x);
    records[i].IsValid = !valid || valid->GetComponent(i, 0) != 0.0;
    records[i].Position = coordinates.FromWorld(x);
    for (int c = 0; c < 3; ++c)
    {
      const double value = values->GetComponent(i, std::min(c, channels - 1));
      records[i].Gathered.Mean[c] = static_cast<float>(value) / unit;
    }
  }
  for (int k = 0; k < ColumnCount; ++k)
  {
    const Column& column = Columns[k];
    const int repeats = column.PerChannel ? channels : 1;
    vtkDataArray* array = data->GetPointData()->GetArray(column.Name);
    if (!array || array->GetNumberOfComponents() != column.Components * repeats)
    {
      problem = std::string("the point array ") + column.Name +
        " is missing or has the wrong number of components";
      return {};
    }
    const float factor = 1.f / FactorOf(column, quantity, coordinates.Scale);
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
      for (int n = 0; n < column.Components * (column.PerChannel ? 3 : 1); ++n)
      {
        const int from = n % (column.Components * repeats);
        Numbers(records[i], k, n / column.Components)[n % column.Components] =
          factor * static_cast<float>(array->GetComponent(i, from));
      }
    }
  }
  if (!std::all_of(records.begin(), records.end(), IsSound))
  {
    problem = "a radius, normal, position or value is invalid";
    return {};
  }
  return records;
}

}
