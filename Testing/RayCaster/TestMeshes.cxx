// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit meshes against brute force and closed forms, and the same meshes in equivalent
// representations.
#include "BruteForce/ImageErrors.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCubeSource.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>

using namespace penumbra;

namespace
{

constexpr int Size = 96;

/// A copy in double without attributes, moved by `offset`.
vtkSmartPointer<vtkPolyData> CopyOf(vtkPolyData* mesh, glm::dvec3 offset = glm::dvec3(0.0))
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    points->InsertNextPoint(x[0] + offset.x, x[1] + offset.y, x[2] + offset.z);
  }
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->SetPoints(points);
  copy->SetPolys(mesh->GetPolys());
  return copy;
}

vtkSmartPointer<vtkPolyData> Sphere(int resolution)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  sphere->Update();
  return CopyOf(sphere->GetOutput());
}

/// A torus that occludes parts of itself, without seams.
vtkSmartPointer<vtkPolyData> Ring()
{
  constexpr int Around = 40;
  constexpr int Across = 16;
  const double pi = std::acos(-1.0);
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> quads;
  for (int i = 0; i < Around; ++i)
  {
    for (int j = 0; j < Across; ++j)
    {
      const double u = 2.0 * pi * i / Around;
      const double v = 2.0 * pi * j / Across;
      const double r = 1.0 + 0.4 * std::cos(v);
      points->InsertNextPoint(r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v));
      const vtkIdType next = (i + 1) % Around;
      const vtkIdType above = (j + 1) % Across;
      const vtkIdType quad[4] = { i * Across + j, next * Across + j, next * Across + above,
        i * Across + above };
      quads->InsertNextCell(4, quad);
    }
  }
  mesh->SetPoints(points);
  mesh->SetPolys(quads);
  return mesh;
}

/// Returns a mesh in which no triangles share points.
vtkSmartPointer<vtkPolyData> Soup(vtkPolyData* mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < mesh->GetPolys()->GetNumberOfCells(); ++i)
  {
    mesh->GetPolys()->GetCellAtId(i, corners);
    triangles->InsertNextCell(static_cast<int>(corners->GetNumberOfIds()));
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
    {
      triangles->InsertCellPoint(points->InsertNextPoint(mesh->GetPoint(corners->GetId(k))));
    }
  }
  auto soup = vtkSmartPointer<vtkPolyData>::New();
  soup->SetPoints(points);
  soup->SetPolys(triangles);
  return soup;
}

vtkSmartPointer<vtkRenderer> Lit(vtkPolyData* mesh, bool parallel = false)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, mesh, true)->GetProperty()->SetInterpolationToFlat();
  renderer->GetActiveCamera()->SetParallelProjection(parallel);
  LookAlong(renderer, { -0.3, 0.9, -0.5 }, { 0.0, 0.0, 1.0 }, Size, Size);
  return renderer;
}

/// Returns the largest difference of two images.
double Difference(const Answer& a, const Answer& b)
{
  return Compare(a.Colors, b.Colors, std::vector<bool>(a.Colors.size())).Worst;
}

struct MeshRow
{
  std::string Name;
  std::function<vtkSmartPointer<vtkPolyData>()> Make;
  double Edge;          ///< RMSE over silhouettes
  double Full = 0.0006; ///< RMSE over the image
};

void PrintTo(const MeshRow& row, std::ostream* out)
{
  *out << row.Name;
}

class LitMeshes : public testing::TestWithParam<MeshRow>
{
};

}

TEST_P(LitMeshes, MatchBruteForceInBothProjections)
{
  for (bool parallel : { false, true })
  {
    vtkSmartPointer<vtkRenderer> renderer = Lit(GetParam().Make(), parallel);
    const BruteForceImage reference =
      DrawByBruteForce(BruteForceOf(renderer, Size, Size), Size, Size, 16);
    const Answer answer = Cast(renderer, Size, Size);
    const Errors errors = Compare(answer.Colors, reference.Colors, SilhouettePixels(reference));
    EXPECT_GT(errors.EdgePixels, 100u);
    EXPECT_LE(errors.Edge, GetParam().Edge);
    EXPECT_LE(errors.Full, GetParam().Full);
    EXPECT_LE(errors.Worst, 0.02) << "in pixel " << errors.WorstPixel % Size << ", "
                                  << errors.WorstPixel / Size;
  }
}

TEST_P(LitMeshes, AreIndependentOfSharedPoints)
{
  vtkSmartPointer<vtkPolyData> mesh = GetParam().Make();
  const Answer shared = Cast(Lit(mesh), Size, Size);
  const Answer soup = Cast(Lit(Soup(mesh)), Size, Size);
  EXPECT_LE(Difference(shared, soup), 1e-3);
  EXPECT_LE(soup.RaysPerPixel, 1.01 * shared.RaysPerPixel);
}

TEST_P(LitMeshes, AreIndependentOfAnOffsetOfTenMillion)
{
  vtkSmartPointer<vtkPolyData> mesh = GetParam().Make();
  vtkSmartPointer<vtkRenderer> here = Lit(mesh);
  const glm::dvec3 offset(1e7, -2e7, 1.5e7);
  vtkSmartPointer<vtkRenderer> there = Lit(CopyOf(mesh, offset));
  vtkCamera* camera = there->GetActiveCamera();
  camera->DeepCopy(here->GetActiveCamera());
  double x[3];
  camera->GetFocalPoint(x);
  camera->SetFocalPoint(x[0] + offset.x, x[1] + offset.y, x[2] + offset.z);
  here->GetActiveCamera()->GetPosition(x);
  camera->SetPosition(x[0] + offset.x, x[1] + offset.y, x[2] + offset.z);
  // Doubles at that distance are 4e-9 apart, which is less than a millionth of a pixel.
  EXPECT_LE(Difference(Cast(here, Size, Size), Cast(there, Size, Size)), 0.004);
}

INSTANTIATE_TEST_SUITE_P(RayCaster, LitMeshes,
  testing::Values(MeshRow{ "CoarseSphere", [] { return Sphere(12); }, 0.0016 },
    // Facets of a few pixels are sampled to the tolerance of 1/256 unless they are exact at less cost.
    MeshRow{ "FineSphere", [] { return Sphere(64); }, 0.0045, 0.0012 },
    MeshRow{ "Ring", Ring, 0.0016 },
    MeshRow{ "Cube",
      [] {
        vtkNew<vtkCubeSource> cube;
        cube->Update();
        return CopyOf(cube->GetOutput());
      },
      0.0016 }),
  [](const testing::TestParamInfo<MeshRow>& row) { return row.param.Name; });

TEST(Blocks, HaveNoSeamsWhereTheyTouch)
{
  // Adjacent cubes from pixel corner to pixel corner, each a separate object. They must look like
  // one white square from the front, and like one large block in a tilted view.
  vtkSmartPointer<vtkRenderer> many = NewRenderer();
  for (int i = 0; i < 27; ++i)
  {
    vtkNew<vtkCubeSource> cube;
    cube->SetCenter(i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0);
    cube->Update();
    AddMesh(many, cube->GetOutput(), true)->GetProperty()->SetInterpolationToFlat();
  }
  vtkNew<vtkCubeSource> block;
  block->SetXLength(3.0);
  block->SetYLength(3.0);
  block->SetZLength(3.0);
  block->Update();
  vtkSmartPointer<vtkRenderer> one = NewRenderer();
  AddMesh(one, block->GetOutput(), true)->GetProperty()->SetInterpolationToFlat();
  for (const glm::dvec3& direction : { glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(-0.5, -0.4, -1.0) })
  {
    for (bool parallel : { false, true })
    {
      for (vtkRenderer* renderer : { many.Get(), one.Get() })
      {
        renderer->GetActiveCamera()->SetParallelProjection(parallel);
        LookAlong(renderer, direction, { 0.0, 1.0, 0.0 }, Size, Size);
        renderer->GetActiveCamera()->SetParallelScale(2.0);
      }
      EXPECT_LE(Difference(Cast(many, Size, Size), Cast(one, Size, Size)), 0.004)
        << (direction.x == 0.0 ? "from the front" : "tilted")
        << (parallel ? ", parallel" : ", perspective");
    }
  }
}

TEST(CoplanarSurfaces, ShowTheSameObjectEverywhereInATiltedView)
{
  // The same data in two actors. With different triangulations, rounding decides which is nearer.
  const std::vector<Shape> disc = { Disc({ 0.0, 0.0 }, 1.0, 60) };
  for (bool parallel : { false, true })
  {
    vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
    AddMesh(renderer, MeshOf(disc), false)->GetProperty()->SetColor(1.0, 0.0, 0.0);
    AddMesh(renderer, MeshOf(disc), false)->GetProperty()->SetColor(0.0, 1.0, 0.0);
    renderer->GetActiveCamera()->SetParallelProjection(parallel);
    LookAlong(renderer, { 0.4, 0.5, -1.0 }, { 0.0, 1.0, 0.0 }, Size, Size);
    const Answer answer = Cast(renderer, Size, Size);
    int reds = 0;
    int greens = 0;
    int mixed = 0;
    for (const glm::dvec3& color : answer.Colors)
    {
      reds += color.x > 0.999;
      greens += color.y > 0.999;
      mixed += color.x > 0.01 && color.y > 0.01;
    }
    EXPECT_GT(std::max(reds, greens), 1000);
    EXPECT_EQ(std::min(reds, greens), 0);
    EXPECT_EQ(mixed, 0);
  }
}

TEST(ParallelCamera, MatchesClosedFormShadingOfASphere)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(256);
  source->SetPhiResolution(128);
  source->Update();
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, source->GetOutput(), true);
  renderer->GetActiveCamera()->ParallelProjectionOn();
  LookAlong(renderer, { 0.3, 0.4, -1.0 }, { 0.0, 1.0, 0.0 }, Size, Size);
  renderer->GetActiveCamera()->SetParallelScale(1.25);
  const Answer answer = Cast(renderer, Size, Size);
  for (int j = 0; j < Size; ++j)
  {
    for (int i = 0; i < Size; ++i)
    {
      const double r2 =
        std::pow(2.5 * (i + 0.5) / Size - 1.25, 2) + std::pow(2.5 * (j + 0.5) / Size - 1.25, 2);
      if (r2 < 0.8)
      {
        EXPECT_NEAR(answer.Colors[j * Size + i].x, std::sqrt(1.0 - r2), 0.004)
          << "pixel " << i << ", " << j;
      }
      else if (r2 > 1.1)
      {
        EXPECT_EQ(answer.Colors[j * Size + i].x, 0.0) << "pixel " << i << ", " << j;
      }
    }
  }
}
