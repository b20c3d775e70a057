// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lines and points thinner than a pixel: their intensity matches their width and length, and lines
// have no gaps. At 72 dots per inch, widths in points are widths in pixels.
#include "BruteForce/ImageErrors.h"
#include "ClosedForms/ExactCoverage.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

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

INSTANTIATE_TEST_SUITE_P(RayCaster, ThinLines, testing::Values(0.05, 0.2, 0.7, 1.0, 3.3));
