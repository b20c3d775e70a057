// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshReaders.h"

#include "MeshArrays.h"
#include "TextFile.h"
#include "TextScanner.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace penumbra
{

namespace
{

constexpr int MaximumColumns = 7;

/// Reads the numbers of a line. Returns their number; further columns are ignored.
int ReadLine(
  const std::string& path, TextScanner& text, long long line, double values[MaximumColumns])
{
  int columns = 0;
  for (std::string_view word = text.WordInLine(); !word.empty() && columns < MaximumColumns;
       word = text.WordInLine())
  {
    if (!ParseNumber(word, values[columns++]))
    {
      ThrowDamaged(path,
        "line " + std::to_string(line) + ": '" + std::string(word.substr(0, 40)) +
          "' is not a number");
    }
  }
  text.Line();
  return columns;
}

}

vtkSmartPointer<vtkDataObject> ReadPts(const std::string& path)
{
  const TextFile file(path);
  TextScanner text(file.Begin(), file.End(), '#');
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> intensities;
  intensities->SetName("Intensities");
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Color");
  colors->SetNumberOfComponents(3);
  int columns = 0;
  double announced = -1.0; ///< number of points in the first line
  double values[MaximumColumns];
  for (long long line = 1; !text.AtEnd(); ++line)
  {
    const int count = ReadLine(path, text, line, values);
    const bool hasPoints = points->GetNumberOfPoints() > 0;
    if (count > 0 && hasPoints && count < columns && text.Peek().empty())
    {
      ThrowTruncated(path, "point");
    }
    if (count < 2) // empty, or the number of points that follow
    {
      announced = count == 1 && announced < 0.0 && !hasPoints ? values[0] : announced;
      continue;
    }
    columns = columns == 0 ? count : columns;
    if (count < columns || count == 2)
    {
      ThrowDamaged(path, "line " + std::to_string(line) + " has too few numbers");
    }
    points->InsertNextPoint(values);
    if (columns == 4 || columns == 7)
    {
      intensities->InsertNextValue(static_cast<float>(values[3]));
    }
    if (columns >= 6)
    {
      for (int c = 0; c < 3; ++c)
      {
        const double value = std::clamp(std::round(values[columns - 3 + c]), 0.0, 255.0);
        colors->InsertNextValue(static_cast<unsigned char>(value));
      }
    }
  }
  if (points->GetNumberOfPoints() == 0 ||
    static_cast<double>(points->GetNumberOfPoints()) < announced)
  {
    ThrowTruncated(path, "point");
  }
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetVerts(vertices);
  if (colors->GetNumberOfTuples() > 0)
  {
    mesh->GetPointData()->SetScalars(colors);
  }
  if (intensities->GetNumberOfTuples() > 0)
  {
    mesh->GetPointData()->AddArray(intensities);
  }
  return mesh;
}

}
