// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Points, lines and polygons of one actor that coincide: as with VTK's depth test, the one that is
// drawn last is visible. The reference paints them in their order.
#include "BruteForce/StratifiedReference.h"
#include "Scenes/TestScene.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace penumbra;

namespace
{

constexpr int Side = 48;
constexpr double PointSize = 9.0;
constexpr double LineWidth = 4.0;

/// Cells in the plane of the image, in pixels.
struct Drawing
{
  std::vector<glm::dvec2> Points;
  std::vector<std::vector<vtkIdType>> Cells;
  std::vector<glm::u8vec3> Colors; ///< per cell
};

enum class Kinds
{
  Points,
  Lines,
  Wireframe,
  Polygons
};

struct Case
{
  std::string Name;
  Kinds Kind;
  int Count; ///< of cells
};

Drawing MakeDrawing(const Case& row)
{
  std::mt19937 generator(7);
  const auto random = [&] { return generator() * 0x1p-32; };
  Drawing drawing;
  const int corners = row.Kind == Kinds::Points ? 1 : row.Kind == Kinds::Lines ? 2 : 3;
  for (int cell = 0; cell < row.Count; ++cell)
  {
    drawing.Cells.emplace_back();
    for (int i = 0; i < corners; ++i)
    {
      // Every other cell of a wireframe has the corners of the one before in another order.
      if (row.Kind == Kinds::Wireframe && cell % 2 == 1)
      {
        drawing.Cells.back().push_back(drawing.Cells[cell - 1][(4 - i) % 3]);
        continue;
      }
      drawing.Cells.back().push_back(static_cast<vtkIdType>(drawing.Points.size()));
      const double x = Side * random();
      drawing.Points.emplace_back(x, Side * random());
    }
    const int red = static_cast<int>(256.0 * random());
    const int green = static_cast<int>(256.0 * random());
    drawing.Colors.emplace_back(red, green, cell % 256);
  }
  return drawing;
}

bool IsInSquare(glm::dvec2 p, glm::dvec2 center)
{
  const glm::dvec2 d = glm::abs(p - center);
  return std::max(d.x, d.y) < 0.5 * PointSize;
}

bool IsInStrip(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b)
{
  const glm::dvec2 d = (b - a) / glm::length(b - a);
  const double along = glm::dot(p - a, d);
  const double across = (p - a).x * d.y - (p - a).y * d.x;
  return along > 0.0 && along < glm::length(b - a) && std::abs(across) < 0.5 * LineWidth;
}

bool IsInTriangle(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c)
{
  const auto side = [=](glm::dvec2 q, glm::dvec2 r) {
    return (r - q).x * (p - q).y - (r - q).y * (p - q).x > 0.0;
  };
  return side(a, b) == side(b, c) && side(b, c) == side(c, a);
}

bool Covers(const Drawing& drawing, Kinds kind, std::size_t cell, glm::dvec2 p)
{
  const std::vector<vtkIdType>& ids = drawing.Cells[cell];
  const auto at = [&](std::size_t i) { return drawing.Points[ids[i % ids.size()]]; };
  switch (kind)
  {
    case Kinds::Points:
      return IsInSquare(p, at(0));
    case Kinds::Lines:
      return IsInStrip(p, at(0), at(1));
    case Kinds::Wireframe:
      return IsInStrip(p, at(0), at(1)) || IsInStrip(p, at(1), at(2)) || IsInStrip(p, at(2), at(3));
    default:
      return IsInTriangle(p, at(0), at(1), at(2));
  }
}

/// Paints the cells in their order on black, with `side` x `side` samples per pixel.
std::vector<glm::dvec3> Paint(const Drawing& drawing, Kinds kind, int side)
{
  const int width = Side * side;
  const double reach = std::max(PointSize, LineWidth);
  std::vector<glm::u8vec3> samples(static_cast<std::size_t>(width) * width, glm::u8vec3(0));
  for (std::size_t cell = 0; cell < drawing.Cells.size(); ++cell)
  {
    glm::dvec2 low(Side);
    glm::dvec2 high(0.0);
    for (const vtkIdType id : drawing.Cells[cell])
    {
      low = glm::min(low, drawing.Points[id] - reach);
      high = glm::max(high, drawing.Points[id] + reach);
    }
    const glm::ivec2 first(glm::max(low, 0.0) * double(side));
    const glm::ivec2 last(glm::min(high, double(Side)) * double(side));
    for (int y = first.y; y < last.y; ++y)
    {
      for (int x = first.x; x < last.x; ++x)
      {
        if (Covers(drawing, kind, cell, (glm::dvec2(x, y) + 0.5) / double(side)))
        {
          samples[static_cast<std::size_t>(y) * width + x] = drawing.Colors[cell];
        }
      }
    }
  }
  std::vector<glm::dvec3> image(Side * Side, glm::dvec3(0.0));
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const std::size_t x = i % width / side;
    image[i / width / side * Side + x] += glm::dvec3(samples[i]) / (255.0 * side * side);
  }
  return image;
}

/// Shows the drawing with one unit per pixel. The plane of the image has a general orientation in the
/// world.
vtkSmartPointer<vtkRenderer> MakeRenderer(const Drawing& drawing, Kinds kind)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkTransform> turn;
  turn->RotateWXYZ(50.0, 0.3, 0.8, 0.4);
  for (const glm::dvec2& p : drawing.Points)
  {
    const double at[3] = { p.x, p.y, 0.0 };
    points->InsertNextPoint(turn->TransformPoint(at));
  }
  data->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (std::size_t cell = 0; cell < drawing.Cells.size(); ++cell)
  {
    cells->InsertNextCell(
      static_cast<vtkIdType>(drawing.Cells[cell].size()), drawing.Cells[cell].data());
    const glm::u8vec3 c = drawing.Colors[cell];
    colors->InsertNextTuple3(c.r, c.g, c.b);
  }
  kind == Kinds::Points    ? data->SetVerts(cells)
    : kind == Kinds::Lines ? data->SetLines(cells)
                           : data->SetPolys(cells);
  data->GetCellData()->SetScalars(colors);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetPointSize(PointSize);
  actor->GetProperty()->SetLineWidth(LineWidth);
  if (kind == Kinds::Wireframe)
  {
    actor->GetProperty()->SetRepresentationToWireframe();
  }
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  renderer->AddActor(actor);
  LookAtImage(renderer, Side, Side);
  renderer->GetActiveCamera()->ApplyTransform(turn);
  renderer->ResetCameraClippingRange();
  return renderer;
}

}

class DrawingOrder : public ::testing::TestWithParam<Case>
{
};

TEST_P(DrawingOrder, DecidesWhatIsVisibleOfCoincidentCells)
{
  const Drawing drawing = MakeDrawing(GetParam());
  const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(drawing, GetParam().Kind);
  double tolerance = 0.0;
  const Answer answer = Cast(renderer, Side, Side,
    [&](vtkPenumbraRayCaster* caster) { tolerance = caster->GetTolerance(); });
  Answer painted;
  painted.Colors = Paint(drawing, GetParam().Kind, 24);
  for (const TileAccuracy& tile : CompareTiles(answer, painted, Side))
  {
    EXPECT_LE(tile.Error, 1.5 * tolerance) << "painted";
  }
  const StratifiedReference samples = DrawStratified(renderer, Side, Side, 8, false);
  for (const TileAccuracy& tile : CompareTiles(answer, samples, Side))
  {
    EXPECT_LE(tile.Error, std::max(tolerance, tile.Estimate)) << "rays";
  }
}

INSTANTIATE_TEST_SUITE_P(RayCaster, DrawingOrder,
  ::testing::Values(Case{ "FewPoints", Kinds::Points, 30 }, Case{ "Points", Kinds::Points, 400 },
    Case{ "ManyPoints", Kinds::Points, 1500 }, Case{ "Lines", Kinds::Lines, 40 },
    Case{ "ManyLines", Kinds::Lines, 600 }, Case{ "Wireframe", Kinds::Wireframe, 20 },
    Case{ "ManyWires", Kinds::Wireframe, 200 }, Case{ "Polygons", Kinds::Polygons, 12 },
    Case{ "ManyPolygons", Kinds::Polygons, 400 }),
  [](const ::testing::TestParamInfo<Case>& row) { return row.param.Name; });
