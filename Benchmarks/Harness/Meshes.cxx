// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes.h"

#include "vtkCellArray.h"
#include "vtkLoopSubdivisionFilter.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace penumbra
{

vtkSmartPointer<vtkPolyData> ReadOff(const std::string& path)
{
  std::ifstream file(path);
  std::string magic;
  vtkIdType numberOfPoints = 0;
  vtkIdType numberOfCells = 0;
  vtkIdType numberOfEdges = 0;
  file >> magic >> numberOfPoints >> numberOfCells >> numberOfEdges;
  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < numberOfPoints && file; ++i)
  {
    float x[3];
    file >> x[0] >> x[1] >> x[2];
    points->InsertNextPoint(x);
  }
  vtkNew<vtkCellArray> triangles;
  for (vtkIdType i = 0; i < numberOfCells && file; ++i)
  {
    vtkIdType count = 0;
    vtkIdType corners[3];
    file >> count >> corners[0] >> corners[1] >> corners[2];
    triangles->InsertNextCell(3, corners);
  }
  if (!file || magic != "OFF")
  {
    throw std::runtime_error("cannot read " + path);
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

vtkSmartPointer<vtkPolyData> Smooth(vtkPolyData* mesh)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(mesh);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkPolyData> Subdivide(vtkPolyData* mesh, int times)
{
  vtkNew<vtkLoopSubdivisionFilter> subdivision;
  subdivision->SetInputData(mesh);
  subdivision->SetNumberOfSubdivisions(times);
  subdivision->Update();
  return subdivision->GetOutput();
}

vtkSmartPointer<vtkPolyData> WavySheet(int side)
{
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(side) * side);
  for (int j = 0; j < side; ++j)
  {
    for (int i = 0; i < side; ++i)
    {
      const double x = 2.0 * i / (side - 1) - 1.0;
      const double y = 2.0 * j / (side - 1) - 1.0;
      points->SetPoint(static_cast<vtkIdType>(j) * side + i, x, y,
        0.1 * std::sin(9.0 * x + 4.0 * y) * std::cos(7.0 * y));
    }
  }
  vtkNew<vtkCellArray> triangles;
  const vtkIdType count = 2 * static_cast<vtkIdType>(side - 1) * (side - 1);
  triangles->AllocateExact(count, 3 * count);
  for (vtkIdType j = 0; j + 1 < side; ++j)
  {
    for (vtkIdType i = 0; i + 1 < side; ++i)
    {
      const vtkIdType corner = j * side + i;
      const vtkIdType lower[3] = { corner, corner + 1, corner + side + 1 };
      const vtkIdType upper[3] = { corner, corner + side + 1, corner + side };
      triangles->InsertNextCell(3, lower);
      triangles->InsertNextCell(3, upper);
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

}
