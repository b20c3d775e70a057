// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lines and points thinner than a pixel: their intensity matches their width and length, and lines
// have no gaps. Edges of a surface keep theirs on another surface in the same plane. At 72 dots per
// inch, widths in points are widths in pixels.
#include "BruteForce/ImageErrors.h"
#include "ClosedForms/ExactCoverage.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace penumbra;

namespace
{

constexpr int Size = 128;
constexpr double Pi = glm::pi<double>();

/// One polyline.
vtkSmartPointer<vtkPolyData> LineThrough(const std::vector<glm::dvec3>& positions)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(positions.size()));
  for (const glm::dvec3& position : positions)
  {
    lines->InsertCellPoint(points->InsertNextPoint(position.x, position.y, position.z));
  }
  auto line = vtkSmartPointer<vtkPolyData>::New();
  line->SetPoints(points);
  line->SetLines(lines);
  return line;
}

/// A white line on black. World x and y are image coordinates where z is 0.
vtkSmartPointer<vtkRenderer> NewLineRenderer(
  const std::vector<glm::dvec3>& positions, double width, bool parallel)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, LineThrough(positions), false)->GetProperty()->SetLineWidth(width);
  LookAtImage(renderer, Size, Size);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetParallelProjection(parallel);
  camera->SetViewAngle(2.0 * std::atan(0.5 * Size / 100.0) * 180.0 / Pi);
  return renderer;
}

/// Exact coverage of a straight line with butt ends.
std::vector<double> ComputeLineCoverage(glm::dvec2 from, glm::dvec2 to, double width)
{
  const glm::dvec2 along = glm::normalize(to - from);
  const glm::dvec2 offset = glm::dvec2(-along.y, along.x) * (0.5 * width);
  ExactCoverage coverage(Size, Size);
  coverage.AddPolygon({ from - offset, to - offset, to + offset, from + offset });
  return coverage.GetShares();
}

double Energy(const Answer& answer)
{
  return std::accumulate(answer.Colors.begin(), answer.Colors.end(), glm::dvec3(0.0)).x;
}

/// Returns a rectangle of the image, black and tilted by `slope` in y, of `columns` x `rows` polygons.
vtkActor* AddBlackRectangle(
  vtkRenderer* renderer, glm::dvec2 low, glm::dvec2 high, double slope, int columns, int rows)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(low.x, low.y, slope * low.y);
  plane->SetPoint1(high.x, low.y, slope * low.y);
  plane->SetPoint2(low.x, high.y, slope * high.y);
  plane->SetResolution(columns, rows);
  plane->Update();
  vtkActor* actor = AddMesh(renderer, plane->GetOutput(), false);
  actor->GetProperty()->SetColor(0.0, 0.0, 0.0);
  return actor;
}

/// Returns the fractions of the intervals [i, i + 1] that are within half the width of one of
/// `count` + 1 evenly spaced lines from `low` to `high`.
std::vector<double> ComputeStripes(double low, double high, int count, double width)
{
  std::vector<double> fractions(Size, 0.0);
  for (int line = 0; line <= count; ++line)
  {
    const double center = low + (high - low) * line / count;
    for (int i = 0; i < Size; ++i)
    {
      fractions[i] += std::max(
        0.0, std::min(i + 1.0, center + 0.5 * width) - std::max(i + 0.0, center - 0.5 * width));
    }
  }
  return fractions;
}

class ThinLines : public testing::TestWithParam<double>
{
};

}

TEST_P(ThinLines, MatchExactCoverageOfTheirWidth)
{
  const double width = GetParam();
  const glm::dvec2 ends[][2] = { { { 10.3, 20.7 }, { 115.2, 71.4 } },
    { { 30.9, 110.1 }, { 64.2, 9.7 } }, { { 10.4, 64.0 }, { 117.3, 64.0 } },
    { { 48.5, 11.2 }, { 48.5, 119.6 } }, { { 64.0, 12.0 }, { 64.0, 120.0 } },
    { { 8.0, 8.0 }, { 120.0, 120.0 } } };
  for (const auto& [from, to] : ends)
  {
    const std::vector<double> fractions = ComputeLineCoverage(from, to, width);
    for (bool parallel : { false, true })
    {
      const Answer answer =
        Cast(NewLineRenderer({ { from, 0.0 }, { to, 0.0 } }, width, parallel), Size, Size);
      const Errors errors =
        Compare(answer.Colors, WhiteOnBlack(fractions), PartlyCoveredPixels(fractions));
      EXPECT_LE(errors.Worst, 0.01)
        << "in pixel " << errors.WorstPixel % Size << ", " << errors.WorstPixel / Size << " from "
        << from.x << ", " << from.y << (parallel ? ", parallel" : ", perspective");
      const double energy = width * glm::distance(from, to);
      EXPECT_NEAR(Energy(answer), energy, 0.01 * energy);
    }
  }
}

TEST_P(ThinLines, HaveNoGaps)
{
  // A line with a small slope adds the same intensity to every column that it crosses.
  const double width = GetParam();
  const double slope = 0.29;
  const Answer answer = Cast(
    NewLineRenderer({ { -9.0, 30.3, 0.0 }, { 200.0, 30.3 + slope * 209.0, 0.0 } }, width, true),
    Size, Size);
  for (int i = 0; i < Size; ++i)
  {
    double light = 0.0;
    for (int j = 0; j < Size; ++j)
    {
      light += answer.Colors[j * Size + i].x;
    }
    EXPECT_NEAR(light, width * std::hypot(1.0, slope), 0.02 * width) << "column " << i;
  }
}

TEST_P(ThinLines, KeepTheirWidthInPerspective)
{
  const double width = GetParam();
  vtkSmartPointer<vtkRenderer> renderer =
    NewLineRenderer({ { 20.0, 20.0, 60.0 }, { 150.0, 190.0, -400.0 } }, width, false);
  renderer->GetActiveCamera()->SetClippingRange(1.0, 1000.0);
  const BruteForceScene scene = BruteForceOf(renderer, Size, Size);
  glm::dvec2 ends[2];
  for (int i = 0; i < 2; ++i)
  {
    const glm::dvec3& x = scene.Positions[i];
    const glm::dvec4 clip = scene.Projection * glm::dvec4(x, 1.0);
    ends[i] = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * double(Size);
  }
  const std::vector<double> fractions = ComputeLineCoverage(ends[0], ends[1], width);
  const Answer answer = Cast(renderer, Size, Size);
  const Errors errors =
    Compare(answer.Colors, WhiteOnBlack(fractions), PartlyCoveredPixels(fractions));
  EXPECT_LE(errors.Worst, 0.01) << "in pixel " << errors.WorstPixel % Size << ", "
                                << errors.WorstPixel / Size;
}

TEST_P(ThinLines, KeepTheirIntensityAlongACurve)
{
  const double width = GetParam();
  const double radius = 51.3;
  std::vector<glm::dvec3> circle;
  for (int i = 0; i <= 90; ++i)
  {
    const double angle = 2.0 * Pi * i / 90;
    circle.emplace_back(64.2 + radius * std::cos(angle), 63.9 + radius * std::sin(angle), 0.0);
  }
  const Answer answer = Cast(NewLineRenderer(circle, width, true), Size, Size);
  const double energy = width * 180.0 * radius * std::sin(Pi / 90.0);
  EXPECT_NEAR(Energy(answer), energy, 0.02 * energy);
}

TEST_P(ThinLines, MatchExactCoverageOfPoints)
{
  const double size = GetParam();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  ExactCoverage coverage(Size, Size);
  for (int i = 0; i < 100; ++i)
  {
    const glm::dvec2 x(10.25 + 11.125 * (i % 10), 9.75 + 10.875 * (i / 10.0));
    const vtkIdType id = points->InsertNextPoint(x.x, x.y, 0.0);
    vertices->InsertNextCell(1, &id);
    const double half = 0.5 * size;
    coverage.AddPolygon({ x + glm::dvec2(-half, -half), x + glm::dvec2(half, -half),
      x + glm::dvec2(half, half), x + glm::dvec2(-half, half) });
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  cloud->SetVerts(vertices);
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, cloud, false)->GetProperty()->SetPointSize(size);
  LookAtImage(renderer, Size, Size);
  const std::vector<double> fractions = coverage.GetShares();
  const Answer answer = Cast(renderer, Size, Size);
  const Errors errors =
    Compare(answer.Colors, WhiteOnBlack(fractions), PartlyCoveredPixels(fractions));
  EXPECT_LE(errors.Worst, 0.01) << "in pixel " << errors.WorstPixel % Size << ", "
                                << errors.WorstPixel / Size;
  EXPECT_NEAR(Energy(answer), 100.0 * size * size, size * size);
}

TEST_P(ThinLines, MatchExactCoverageAsEdgesOnASurfaceInTheSamePlane)
{
  const double width = GetParam();
  const glm::dvec2 low(20.3, 31.2);
  const glm::dvec2 high(100.9, 97.6);
  const std::vector<double> columns = ComputeStripes(low.x, high.x, 3, width);
  const std::vector<double> rows = ComputeStripes(low.y, high.y, 2, width);
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  for (const double slope : { 0.0, 0.6, 2.7, 7.0 })
  {
    for (const double offset : { 0.0, -1.0 }) // the surface with edges is drawn last, or is shifted
    {
      vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
      const auto addGround = [&] {
        AddBlackRectangle(renderer, { -10.0, -10.0 }, { 140.0, 140.0 }, slope, 1, 1);
      };
      if (offset == 0.0)
      {
        addGround();
      }
      vtkActor* actor = AddBlackRectangle(renderer, low, high, slope, 3, 2);
      actor->GetProperty()->EdgeVisibilityOn();
      actor->GetProperty()->SetEdgeColor(1.0, 1.0, 1.0);
      actor->GetProperty()->SetLineWidth(width);
      actor->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(offset, offset);
      if (offset != 0.0)
      {
        addGround();
      }
      LookAtImage(renderer, Size, Size);
      renderer->GetActiveCamera()->SetPosition(0.5 * Size, 0.5 * Size, 1000.0);
      renderer->ResetCameraClippingRange();
      const Answer answer = Cast(renderer, Size, Size);
      double worst = 0.0;
      for (int j = int(low.y) + 4; j < int(high.y) - 4; ++j)
      {
        for (int i = int(low.x) + 4; i < int(high.x) - 4; ++i)
        {
          const double exact = 1.0 - (1.0 - columns[i]) * (1.0 - rows[j]);
          worst = std::max(worst, std::abs(answer.Colors[j * Size + i].x - exact));
        }
      }
      EXPECT_LE(worst, 0.01) << "slope " << slope << ", offset " << offset;
    }
  }
  vtkMapper::SetResolveCoincidentTopologyToOff();
}

INSTANTIATE_TEST_SUITE_P(RayCaster, ThinLines, testing::Values(0.05, 0.2, 0.7, 1.0, 3.3));
