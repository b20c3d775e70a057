// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RankImages.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace penumbra;

/// Returns the pieces with colors of their points or cells.
vtkSmartPointer<vtkPolyData> MakeColored(int rank, int ranks, bool cells, int alpha)
{
  vtkSmartPointer<vtkPolyData> piece = MakePiece(rank, ranks, 10);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(4);
  const vtkIdType count = cells ? piece->GetNumberOfCells() : piece->GetNumberOfPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    colors->InsertNextTuple4(i * 37 % 256, i * 11 % 256, 100 + 50 * rank, i % 5 == 0 ? alpha : 255);
  }
  (cells ? static_cast<vtkFieldData*>(piece->GetCellData()) : piece->GetPointData())
    ->AddArray(colors);
  cells ? piece->GetCellData()->SetActiveScalars("Colors")
        : piece->GetPointData()->SetActiveScalars("Colors");
  return piece;
}

/// Returns some of the points or lines of a helix.
vtkSmartPointer<vtkPolyData> MakeHelix(int rank, int ranks, bool lines)
{
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  constexpr int All = 120;
  const int first = rank * All / ranks;
  const int last = (rank + 1) * All / ranks;
  for (int i = first; i <= last; ++i)
  {
    points->InsertNextPoint(std::cos(0.3 * i), 0.02 * i, std::sin(0.3 * i));
  }
  for (vtkIdType i = 0; i < last - first; ++i)
  {
    const vtkIdType ends[2] = { i, i + 1 };
    lines ? cells->InsertNextCell(2, ends) : cells->InsertNextCell(1, ends);
  }
  piece->SetPoints(points);
  lines ? piece->SetLines(cells) : piece->SetVerts(cells);
  return piece;
}

}

TEST(vtkPenumbraDistributedRayCaster, MatchesOneRank)
{
  for (const int ranks : { 1, 2, 3, 4, 5, 6, 7, 8 })
  {
    SCOPED_TRACE(ranks);
    const Image image = ExpectSameOnRanks(ranks, MakeCoarse, UseDefaults);
    EXPECT_GT(GetNumber(image, "Statistics/Pixels/SmallObject"), 20.0);
  }
}

TEST(vtkPenumbraDistributedRayCaster, MatchesOneRankWithTrianglesSmallerThanPixels)
{
  const MakeData make = [](int rank, int all) { return MakePiece(rank, all, 60); };
  const Image image = ExpectSameOnRanks(4, make, UseDefaults);
  EXPECT_GT(GetNumber(image, "Statistics/Pixels/Uniform"), 100.0);
}

TEST(vtkPenumbraDistributedRayCaster, MatchesOneRankForAllMethodsAndArrays)
{
  using Methods = CoverageMethods;
  for (const Methods method : { Methods::Subdivision, Methods::Uniform })
  {
    ExpectSameOnRanks(
      3, MakeCoarse, [=](Caster* caster) { caster->GetConstants().CoverageMethod = method; });
  }
  const Image image = ExpectSameOnRanks(3, MakeCoarse, [](Caster* caster) {
    caster->GeometryArraysOn();
    caster->GetConstants().OcclusionArray = false;
  });
  EXPECT_EQ(image.at("Depth").size(), 4u * Width * Height);
}

TEST(vtkPenumbraDistributedRayCaster, ExchangesColorsAndOpacity)
{
  for (const bool cells : { false, true })
  {
    for (const int alpha : { 255, 90 })
    {
      SCOPED_TRACE(testing::Message() << cells << " " << alpha);
      const MakeData make = [=](int rank, int ranks) {
        return MakeColored(rank, ranks, cells, alpha);
      };
      ExpectSameViewsOnRanks(3, make, KeepActor, UseDefaults);
    }
  }
  ExpectSameViewsOnRanks(
    8, MakeCoarse, [](vtkActor* actor) { actor->GetProperty()->SetOpacity(0.4); }, UseDefaults);
  ExpectSameViewsOnRanks(
    4, MakeCoarse, [](vtkActor* actor) { actor->GetProperty()->EdgeVisibilityOn(); }, UseDefaults);
}

TEST(vtkPenumbraDistributedRayCaster, ExchangesVerticesAndLinesAmongPolygons)
{
  const MakeData make = [](int rank, int ranks) {
    vtkSmartPointer<vtkPolyData> piece = MakePiece(rank, ranks, 10);
    piece->GetPointData()->Initialize(); // the new points have no normals
    for (int group = 8 * rank / ranks; group < 8 * (rank + 1) / ranks; ++group)
    {
      AddVerticesAndLines(piece, group, 6, -0.5);
    }
    return piece;
  };
  for (const int ranks : { 2, 4, 8 })
  {
    ExpectSameViewsOnRanks(ranks, make, KeepActor, UseDefaults);
  }
}

TEST(vtkPenumbraDistributedRayCaster, ExchangesPointsLinesSpheresAndTubes)
{
  for (const bool lines : { false, true })
  {
    const MakeData make = [=](int rank, int ranks) { return MakeHelix(rank, ranks, lines); };
    for (const double radius : { 0.0, 0.1 })
    {
      SCOPED_TRACE(testing::Message() << lines << " " << radius);
      const Image image = ExpectSameViewsOnRanks(
        3, make, [](vtkActor* actor) { actor->GetProperty()->SetLineWidth(3.0); },
        [=](Caster* caster) {
          caster->SetPointRadius(radius);
          caster->SetLineRadius(radius);
        });
      EXPECT_GT(GetNumber(image, "Statistics/Edges/Projected"), 100.0);
    }
  }
}

TEST(vtkPenumbraDistributedRayCaster, RendersWithRanksWithoutData)
{
  const MakeData make = [](int rank, int ranks) {
    return rank == 1 ? vtkSmartPointer<vtkPolyData>::New() : MakePiece(rank, ranks, 10);
  };
  ExpectSameOnRanks(3, make, UseDefaults);
  const MakeData none = [](int, int) { return vtkSmartPointer<vtkPolyData>::New(); };
  ExpectSameOnRanks(2, none, UseDefaults);
}

TEST(vtkPenumbraDistributedRayCaster, RendersBlocksAsOneSurface)
{
  const MakeData blocks = [](int rank, int ranks) {
    auto all = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    all->SetBlock(0, MakePiece(2 * rank, 2 * ranks, 10));
    all->SetBlock(1, MakePiece(2 * rank + 1, 2 * ranks, 10));
    return all;
  };
  const Image expected = RenderOnOne(4, MakeCoarse, UseDefaults);
  for (const Image& image : RenderOnRanks(2, blocks, UseDefaults))
  {
    ExpectSame(image, expected);
  }
}
