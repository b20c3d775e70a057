// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GridOffset.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

vtkSmartPointer<vtkDoubleArray> Shift(vtkDataArray* coordinates, double offset)
{
  auto shifted = vtkSmartPointer<vtkDoubleArray>::New();
  shifted->SetNumberOfValues(coordinates->GetNumberOfTuples());
  for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
  {
    shifted->SetValue(i, coordinates->GetComponent(i, 0) - offset);
  }
  return shifted;
}

}

double FindRoundingStep(const double bounds[6])
{
  constexpr double VisibleFraction = 1.0 / 4096.0; // a quarter of a pixel of a usual image
  double extent = 0.0;
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    extent = std::max(extent, bounds[2 * axis + 1] - bounds[2 * axis]);
    largest = std::max({ largest, std::abs(bounds[2 * axis]), std::abs(bounds[2 * axis + 1]) });
  }
  const double step = std::ldexp(1.0, std::ilogb(std::max(largest, 1e-30)) - 23);
  return extent > 0.0 && step > VisibleFraction * extent ? step : 0.0;
}

GridOffset::GridOffset(vtkDataSet* data)
{
  if (!vtkImageData::SafeDownCast(data) && !vtkRectilinearGrid::SafeDownCast(data))
  {
    return;
  }
  double bounds[6];
  data->GetBounds(bounds);
  for (int axis = 0; axis < 3 && FindRoundingStep(bounds) > 0.0; ++axis)
  {
    this->Offset[axis] = bounds[2 * axis];
  }
}

bool GridOffset::IsZero() const
{
  return this->Offset == std::array<double, 3>{};
}

vtkSmartPointer<vtkDataSet> GridOffset::ToOrigin(vtkDataSet* data) const
{
  if (this->IsZero())
  {
    return data;
  }
  const auto moved = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  moved->ShallowCopy(data);
  if (auto* image = vtkImageData::SafeDownCast(moved))
  {
    double origin[3];
    image->GetOrigin(origin);
    image->SetOrigin(
      origin[0] - this->Offset[0], origin[1] - this->Offset[1], origin[2] - this->Offset[2]);
  }
  else if (auto* grid = vtkRectilinearGrid::SafeDownCast(moved))
  {
    grid->SetXCoordinates(Shift(grid->GetXCoordinates(), this->Offset[0]));
    grid->SetYCoordinates(Shift(grid->GetYCoordinates(), this->Offset[1]));
    grid->SetZCoordinates(Shift(grid->GetZCoordinates(), this->Offset[2]));
  }
  return moved;
}

CutList GridOffset::ToOrigin(CutList cuts) const
{
  for (Cut& cut : cuts.Cuts)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      cut.Plane[axis] -= this->Offset[axis];
    }
  }
  return cuts;
}

vtkSmartPointer<vtkPolyData> GridOffset::FromOrigin(vtkPolyData* mesh) const
{
  if (this->IsZero() || !mesh->GetPoints())
  {
    return mesh;
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    points->SetPoint(i, x[0] + this->Offset[0], x[1] + this->Offset[1], x[2] + this->Offset[2]);
  }
  auto moved = vtkSmartPointer<vtkPolyData>::New();
  moved->ShallowCopy(mesh);
  moved->SetPoints(points);
  return moved;
}

}
