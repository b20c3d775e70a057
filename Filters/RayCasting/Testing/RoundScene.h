// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A scene of points and lines that are rendered as spheres and tubes, and the coverage of pixels by
// closed forms.
#ifndef penumbra_RoundScene_h
#define penumbra_RoundScene_h

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace penumbra_testing
{

inline constexpr int Side = 256;

/// A camera at the origin that looks along -z, in the coordinates of the closed forms of the tests.
inline constexpr double ViewAngle = 40.0;

inline vtkSmartPointer<vtkPolyData> MakeCells(
  const std::vector<glm::dvec3>& points, const std::vector<std::vector<vtkIdType>>& lines)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> positions;
  positions->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const glm::dvec3& p : points)
  {
    const vtkIdType id = positions->InsertNextPoint(p.x, p.y, p.z);
    if (lines.empty())
    {
      cells->InsertNextCell(1, &id);
    }
  }
  for (const std::vector<vtkIdType>& line : lines)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
  }
  data->SetPoints(positions);
  lines.empty() ? data->SetVerts(cells) : data->SetLines(cells);
  return data;
}

/// A white scene on black.
struct RoundScene
{
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPenumbraRayCaster> Caster;
  vtkActor* Actor = nullptr;

  explicit RoundScene(vtkPolyData* data, bool lit = false)
  {
    this->Actor = this->Add(data, lit);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0.0, 0.0, 0.0);
    camera->SetFocalPoint(0.0, 0.0, -1.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetViewAngle(ViewAngle);
    camera->SetClippingRange(0.01, 1000.0);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(Side, Side);
  }

  vtkActor* Add(vtkPolyData* data, bool lit)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetLighting(lit);
    this->Renderer->AddActor(actor);
    return actor;
  }

  std::vector<double> RenderRed()
  {
    this->Caster->Update();
    vtkDataArray* colors = this->Caster->GetOutput()->GetPointData()->GetArray("Color");
    std::vector<double> red;
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      red.push_back(colors->GetComponent(i, 0) * colors->GetComponent(i, 3));
    }
    return red;
  }

  double Statistic(const char* name)
  {
    return this->Caster->GetStatistics()->GetArray(name)->GetComponent(0, 0);
  }
};

/// Returns the direction through image point (x, y).
inline glm::dvec3 Direction(double x, double y)
{
  const double pixel = 2.0 * std::tan(0.5 * ViewAngle * std::acos(-1.0) / 180.0) / Side;
  return glm::normalize(glm::dvec3((x - 0.5 * Side) * pixel, (y - 0.5 * Side) * pixel, -1.0));
}

using Inside = std::function<bool(glm::dvec3)>;

/// Returns the coverage of a pixel: the length of the covered part of `lines` horizontal lines,
/// whose ends are found by bisection.
inline double ComputeCoverage(int x, int y, const Inside& isInside, int lines)
{
  constexpr int Steps = 16;
  double sum = 0.0;
  for (int line = 0; line < lines; ++line)
  {
    const double at = y + (line + 0.5) / lines;
    bool before = isInside(Direction(x, at));
    for (int i = 0; i < Steps; ++i)
    {
      double low = x + static_cast<double>(i) / Steps;
      double high = x + static_cast<double>(i + 1) / Steps;
      const bool after = isInside(Direction(high, at));
      if (before == after)
      {
        sum += before ? 1.0 / Steps : 0.0;
      }
      else
      {
        const double from = low;
        const double to = high;
        for (int k = 0; k < 16; ++k) // to 1e-6 of a pixel
        {
          const double middle = 0.5 * (low + high);
          (isInside(Direction(middle, at)) == before ? low : high) = middle;
        }
        sum += before ? low - from : to - low;
      }
      before = after;
    }
  }
  return sum / lines;
}

/// Returns the RMSE of the pixels that an outline crosses.
inline double ComputeEdgeError(
  const std::vector<double>& image, const Inside& isInside, int stride = 5)
{
  constexpr int Width = 2 * Side + 1; // of the grid of corners, centers and middles of sides
  std::vector<char> grid;
  for (int i = 0; i < Width * Width; ++i)
  {
    grid.push_back(isInside(Direction(0.5 * (i % Width), 0.5 * (i / Width))) ? 1 : 0);
  }
  double squares = 0.0;
  int count = 0;
  for (int y = 0; y < Side; ++y)
  {
    for (int x = 0; x < Side; ++x)
    {
      int corners = 0;
      for (int i = 0; i < 9; ++i)
      {
        corners += grid[(2 * y + i / 3) * Width + 2 * x + i % 3];
      }
      if (corners == 0 || corners == 9)
      {
        EXPECT_NEAR(image[y * Side + x], corners / 9.0, 0.2) << x << " " << y;
      }
      else if (++count % stride == 0)
      {
        const double error = image[y * Side + x] - ComputeCoverage(x, y, isInside, 256);
        squares += error * error;
      }
    }
  }
  return std::sqrt(squares / (count / stride));
}

inline const std::vector<glm::dvec3> FiveCenters = { { 0.0, 0.0, -6.0 }, { 1.1, 0.9, -5.0 },
  { -1.4, 1.2, -7.0 }, { -1.3, -1.2, -5.5 }, { 1.2, -1.0, -6.5 } };

}
#endif
