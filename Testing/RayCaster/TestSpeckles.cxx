// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Watertight meshes on which ray casters often leave holes: rays exactly through vertices and
// edges, T-junctions, coplanar faces, slivers, the camera inside. Behind every white mesh is a red
// wall, which shows through any hole.
#include "BruteForce/ImageErrors.h"
#include "ClosedForms/ExactCoverage.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

using namespace penumbra;

namespace
{

constexpr int Size = 96;

/// Colors of white with the given coverage over a red wall.
std::vector<glm::dvec3> WhiteOverRed(const std::vector<double>& fractions)
{
  std::vector<glm::dvec3> colors;
  for (double share : fractions)
  {
    colors.emplace_back(1.0, share, share);
  }
  return colors;
}

/// A square larger than the view, behind all other objects.
vtkSmartPointer<vtkPolyData> Wall(double z)
{
  Shape shape;
  shape.Center = glm::dvec2(0.5 * Size);
  shape.Outline = { { -Size, -Size }, { 2 * Size, -Size }, { 2 * Size, 2 * Size },
    { -Size, 2 * Size } };
  vtkSmartPointer<vtkPolyData> mesh = MeshOf({ shape });
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    mesh->GetPoints()->SetPoint(i, x[0], x[1], z);
  }
  return mesh;
}

enum class View
{
  Parallel,
  Perspective
};

/// `mesh` in white in front of a red wall. Its x and y are image coordinates in both projections.
vtkSmartPointer<vtkRenderer> BeforeAWall(vtkPolyData* mesh, View view)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, Wall(-20.0), false)->GetProperty()->SetColor(1.0, 0.0, 0.0);
  AddMesh(renderer, mesh, false);
  LookAtImage(renderer, Size, Size);
  if (view == View::Perspective)
  {
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->ParallelProjectionOff();
    camera->SetViewAngle(2.0 * std::atan(0.5 * Size / 100.0) * 180.0 / std::acos(-1.0));
  }
  return renderer;
}

/// Compares images of `mesh`, whose exact coverage is `fractions`, in both projections.
void ExpectCoverage(vtkPolyData* mesh, const std::vector<double>& fractions, double bound)
{
  const std::vector<glm::dvec3> expected = WhiteOverRed(fractions);
  for (View view : { View::Parallel, View::Perspective })
  {
    const Answer answer = Cast(BeforeAWall(mesh, view), Size, Size);
    const Errors errors = Compare(answer.Colors, expected, PartlyCoveredPixels(fractions));
    const auto wrong =
      std::count_if(expected.begin(), expected.end(), [&](const glm::dvec3& color) {
        return std::abs(answer.Colors[&color - expected.data()].y - color.y) > bound;
      });
    EXPECT_LE(errors.Worst, bound)
      << wrong << " pixels are wrong, the worst is " << errors.WorstPixel % Size << ", "
      << errors.WorstPixel / Size << (view == View::Parallel ? ", parallel" : ", perspective");
  }
}

std::vector<double> ComputePolygonCoverage(const std::vector<glm::dvec2>& polygon)
{
  ExactCoverage coverage(Size, Size);
  coverage.AddPolygon(polygon);
  return coverage.GetShares();
}

/// A grid of `cells` x `cells` squares that starts at `first`, of quads or triangles.
vtkSmartPointer<vtkPolyData> Grid(glm::dvec2 first, double step, int cells, bool quads)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      points->InsertNextPoint(first.x + i * step, first.y + j * step, 0.0);
    }
  }
  vtkNew<vtkCellArray> faces;
  for (vtkIdType j = 0; j < cells; ++j)
  {
    for (vtkIdType i = 0; i < cells; ++i)
    {
      const vtkIdType a = j * (cells + 1) + i;
      const vtkIdType corners[4] = { a, a + 1, a + cells + 2, a + cells + 1 };
      if (quads)
      {
        faces->InsertNextCell(4, corners);
        continue;
      }
      const vtkIdType one[3] = { corners[0], corners[1], corners[2] };
      const vtkIdType other[3] = { corners[0], corners[2], corners[3] };
      faces->InsertNextCell(3, one);
      faces->InsertNextCell(3, other);
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(faces);
  return mesh;
}

struct GridRow
{
  std::string Name;
  double First; ///< image coordinate of the first vertex
  double Step;
  int Cells;
};

void PrintTo(const GridRow& row, std::ostream* out)
{
  *out << row.Name;
}

class AlignedGrids : public testing::TestWithParam<GridRow>
{
};

}

TEST_P(AlignedGrids, HaveNoHolesAtVerticesHitByRays)
{
  const GridRow& row = GetParam();
  const double last = row.First + row.Step * row.Cells;
  const std::vector<double> fractions = ComputePolygonCoverage(
    { { row.First, row.First }, { last, row.First }, { last, last }, { row.First, last } });
  for (bool quads : { false, true })
  {
    ExpectCoverage(Grid(glm::dvec2(row.First), row.Step, row.Cells, quads), fractions, 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(RayCaster, AlignedGrids,
  testing::Values(GridRow{ "OnPixelCorners", 8.0, 1.0, 80 },
    GridRow{ "OnEveryFourthPixelCorner", 8.0, 4.0, 20 }, GridRow{ "OnPixelCenters", 8.5, 1.0, 79 },
    GridRow{ "OnCornersAndCenters", 8.0, 0.5, 160 },
    GridRow{ "OnFourthsOfPixels", 20.0, 0.25, 160 },
    GridRow{ "OnThirdsOfPixels", 9.0, 1.0 / 3.0, 90 }, GridRow{ "BeyondTheImage", -2.0, 2.0, 50 }),
  [](const testing::TestParamInfo<GridRow>& row) { return row.param.Name; });

TEST(Checkerboards, HaveTheColorOfTheCellInEachPixel)
{
  // The cells of the grid start and end at pixel corners, as those of a raster image.
  for (int side : { 1, 4 })
  {
    const int cells = 80 / side;
    vtkSmartPointer<vtkPolyData> grid = Grid(glm::dvec2(8.0), side, cells, true);
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(3);
    for (int i = 0; i < cells * cells; ++i)
    {
      const unsigned char gray = (i % cells + i / cells) % 2 ? 255 : 51;
      colors->InsertNextTuple3(gray, gray, gray);
    }
    grid->GetCellData()->SetScalars(colors);
    for (View view : { View::Parallel, View::Perspective })
    {
      vtkSmartPointer<vtkRenderer> renderer = BeforeAWall(grid, view);
      renderer->GetActors()->GetLastActor()->GetMapper()->ScalarVisibilityOn();
      const Answer answer = Cast(renderer, Size, Size);
      for (int j = 8; j < 88; ++j)
      {
        for (int i = 8; i < 88; ++i)
        {
          const double expected = ((i - 8) / side + (j - 8) / side) % 2 ? 1.0 : 0.2;
          EXPECT_NEAR(answer.Colors[j * Size + i].y, expected, 0.001)
            << "pixel " << i << ", " << j << ", cells of " << side;
        }
      }
    }
  }
}

TEST(ClosedMeshes, HaveNoHolesAtPolesHitByRays)
{
  // A pole, where all triangles meet, projects exactly to a pixel corner.
  for (bool parallel : { false, true })
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(0.5 * Size, 0.5 * Size, 0.0);
    sphere->SetRadius(30.0);
    sphere->SetThetaResolution(64);
    sphere->SetPhiResolution(33);
    sphere->Update();
    const Answer answer = Cast(
      BeforeAWall(sphere->GetOutput(), parallel ? View::Parallel : View::Perspective), Size, Size);
    for (int j = 0; j < Size; ++j)
    {
      for (int i = 0; i < Size; ++i)
      {
        const double r = std::hypot(i + 0.5 - 0.5 * Size, j + 0.5 - 0.5 * Size);
        if (r < 28.0)
        {
          EXPECT_NEAR(answer.Colors[j * Size + i].y, 1.0, 1e-4) << "pixel " << i << ", " << j;
        }
      }
    }
  }
}

TEST(TJunctions, HaveNoHoles)
{
  // Adjacent strips, each divided at different heights and rotated by an angle, so that no vertex
  // of one lies exactly on the edge of the next.
  const glm::dvec2 along(std::cos(0.37), std::sin(0.37));
  const glm::dvec2 up(-along.y, along.x);
  const glm::dvec2 origin(30.1, 8.3);
  const auto at = [&](double x, double y) { return origin + x * along + y * up; };
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> quads;
  const double width = 60.0 / 7.0;
  for (int strip = 0; strip < 7; ++strip)
  {
    const int cuts = 3 + 4 * strip;
    for (int i = 0; i < cuts; ++i)
    {
      const double low = 60.0 * i / cuts;
      const double high = 60.0 * (i + 1) / cuts;
      vtkIdType corners[4];
      const glm::dvec2 positions[4] = { at(width * strip, low), at(width * (strip + 1), low),
        at(width * (strip + 1), high), at(width * strip, high) };
      for (int k = 0; k < 4; ++k)
      {
        corners[k] = points->InsertNextPoint(positions[k].x, positions[k].y, 0.0);
      }
      quads->InsertNextCell(4, corners);
    }
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(quads);
  ExpectCoverage(mesh,
    ComputePolygonCoverage({ at(0.0, 0.0), at(60.0, 0.0), at(60.0, 60.0), at(0.0, 60.0) }), 0.004);
}

TEST(CoplanarFaces, CoverPixelsOnce)
{
  const std::vector<Shape> shapes = { Disc({ 48.3, 47.9 }, 40.0, 60) };
  vtkSmartPointer<vtkPolyData> twice = MeshOf({ shapes[0], shapes[0] });
  ExpectCoverage(twice, SharesOf(shapes, Size, Size), 0.004);

  // The same surface with another triangulation: fans around another center.
  Shape other = shapes[0];
  other.Center += glm::dvec2(11.3, -7.1);
  ExpectCoverage(MeshOf({ shapes[0], other }), SharesOf(shapes, Size, Size), 0.004);
}

TEST(CoplanarFaces, ShowTheSameObjectEverywhere)
{
  const std::vector<Shape> shapes = { Disc({ 48.3, 47.9 }, 40.0, 60) };
  const std::vector<double> fractions = SharesOf(shapes, Size, Size);
  for (View view : { View::Parallel, View::Perspective })
  {
    vtkSmartPointer<vtkRenderer> renderer = BeforeAWall(MeshOf(shapes), view);
    AddMesh(renderer, MeshOf(shapes), false)->GetProperty()->SetColor(0.0, 1.0, 0.0);
    const Answer answer = Cast(renderer, Size, Size);
    const glm::dvec3 middle = answer.Colors[Size * Size / 2 + Size / 2];
    EXPECT_TRUE(middle.x < 1e-6 || middle.x > 1.0 - 1e-6);
    for (std::size_t i = 0; i < fractions.size(); ++i)
    {
      const glm::dvec3 expected = glm::mix(glm::dvec3(1.0, 0.0, 0.0), middle, fractions[i]);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(answer.Colors[i][c], expected[c], 0.004)
          << "pixel " << i % Size << ", " << i / Size;
      }
    }
  }
}

namespace
{

/// A sheet from (12.3, 10.2) to (72.3, 85.7), divided into vertical strips.
std::vector<Shape> Strips(int count)
{
  const double width = 60.0 / count;
  std::vector<Shape> strips;
  for (int i = 0; i < count; ++i)
  {
    const double x = 12.3 + width * i;
    Shape strip;
    strip.Outline = { { x, 10.2 }, { x + width, 10.2 }, { x + width, 85.7 }, { x, 85.7 } };
    strip.Center = { x + 0.5 * width, 40.0 };
    strips.push_back(strip);
  }
  return strips;
}

}

TEST(Slivers, MatchTheirExactCoverage)
{
  // 4000 triangles that share one point, and strips a tenth of a pixel wide.
  const std::vector<Shape> disc = { Disc({ 48.3, 47.9 }, 40.0, 4000) };
  ExpectCoverage(MeshOf(disc), SharesOf(disc, Size, Size), 0.004);
  ExpectCoverage(MeshOf(Strips(600)), SharesOf(Strips(600), Size, Size), 0.004);
}

TEST(Slivers, OfADenseMeshMatchSampledCoverage)
{
  // A mesh of more triangles than pixels is sampled where its strips are too narrow to be covered.
  ExpectCoverage(MeshOf(Strips(3000)), SharesOf(Strips(3000), Size, Size), 0.08);
  const std::vector<glm::dvec3> colors =
    Cast(BeforeAWall(MeshOf(Strips(3000)), View::Parallel), Size, Size).Colors;
  for (int j = 11; j < 85; ++j)
  {
    for (int i = 13; i < 72; ++i)
    {
      EXPECT_NEAR(colors[j * Size + i].y, 1.0, 1e-5) << "pixel " << i << ", " << j;
    }
  }
}

TEST(Slivers, WithoutWidthAreInvisible)
{
  std::vector<Shape> needles;
  for (int i = 0; i < 20; ++i)
  {
    const glm::dvec2 tip(10.3 + 3.7 * i, 90.1);
    needles.push_back({ { 48.1, 40.2 }, { { 48.1, 8.3 }, { 48.1 + 1e-7, 8.3 }, tip } });
    needles.back().Center = (needles.back().Outline[0] + needles.back().Outline[1] + tip) / 3.0;
  }
  ExpectCoverage(MeshOf(needles), std::vector<double>(Size * Size, 0.0), 1e-3);
}

TEST(CameraInside, FindsNoGapInAClosedMesh)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(48);
  sphere->SetPhiResolution(25);
  sphere->Update();
  for (glm::dvec3 direction :
    { glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.3, -0.5, 0.7) })
  {
    vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
    AddMesh(renderer, sphere->GetOutput(), false);
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->SetPosition(0.1, 0.05, -0.02);
    camera->SetFocalPoint(0.1 + direction.x, 0.05 + direction.y, -0.02 + direction.z);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetViewAngle(100.0);
    camera->SetClippingRange(0.001, 10.0);
    const Answer answer = Cast(renderer, Size, Size);
    for (std::size_t i = 0; i < answer.Colors.size(); ++i)
    {
      EXPECT_NEAR(answer.Colors[i].y, 1.0, 1e-4) << "pixel " << i % Size << ", " << i / Size;
    }
  }
}

TEST(CameraInside, MatchesClosedFormShadingOfABox)
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, cube->GetOutput(), true)->GetProperty()->SetInterpolationToFlat();
  vtkCamera* camera = renderer->GetActiveCamera();
  const glm::dvec3 eye(0.1, -0.05, 0.2);
  const glm::dvec3 forward = glm::normalize(glm::dvec3(-0.6, 0.3, -0.7));
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetFocalPoint(eye.x + forward.x, eye.y + forward.y, eye.z + forward.z);
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetViewAngle(90.0);
  camera->SetClippingRange(0.001, 10.0);
  const Answer answer = Cast(renderer, Size, Size);

  // The headlight has the direction of projection. The color of a wall is the cosine between that
  // direction and its normal, and black if the cosine is negative.
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
  const glm::dvec3 up = glm::cross(right, forward);
  constexpr int Samples = 32;
  for (int j = 0; j < Size; ++j)
  {
    for (int i = 0; i < Size; ++i)
    {
      double sum = 0.0;
      for (int k = 0; k < Samples * Samples; ++k)
      {
        const double x = 2.0 * (i + (k % Samples + 0.5) / Samples) / Size - 1.0;
        const double y = 2.0 * (j + (k / Samples + 0.5) / Samples) / Size - 1.0;
        const glm::dvec3 ray = forward + x * right + y * up;
        double nearest = 1e9;
        double cosine = 0.0;
        for (int axis = 0; axis < 3; ++axis)
        {
          const double t = (std::copysign(0.5, ray[axis]) - eye[axis]) / ray[axis];
          if (t < nearest)
          {
            nearest = t;
            cosine = std::max(0.0, std::copysign(forward[axis], forward[axis] * ray[axis]));
          }
        }
        sum += cosine / (Samples * Samples);
      }
      EXPECT_NEAR(answer.Colors[j * Size + i].x, sum, 0.01) << "pixel " << i << ", " << j;
    }
  }
}
