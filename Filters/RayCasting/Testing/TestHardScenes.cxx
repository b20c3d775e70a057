// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes with edges inside pixels that the corner rays do not detect. The error of every tile is
// below the tolerance, or its estimated error is not. The reference has 32 x 32 samples per pixel.
#include "BruteForce/StratifiedReference.h"
#include "Scenes/TestScene.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkMath.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

using namespace penumbra;

namespace
{

constexpr int Side = 96;
constexpr int ReferenceSamples = 32;

class Random
{
public:
  double operator()()
  {
    this->Sequence->Next();
    return this->Sequence->GetValue();
  }

private:
  vtkNew<vtkMinimalStandardRandomSequence> Sequence;
};

vtkActor* Add(vtkRenderer* renderer, vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  renderer->AddActor(actor);
  return actor;
}

/// Adds points at different depths, each 2 pixels wide.
void AddPoints(vtkRenderer* renderer)
{
  Random random;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (int i = 0; i < 1500; ++i)
  {
    const double x = random();
    const double y = random();
    const vtkIdType id = points->InsertNextPoint(x, y, random());
    cells->InsertNextCell(1, &id);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(cells);
  Add(renderer, data)->GetProperty()->SetPointSize(2.0f);
  renderer->GetActiveCamera()->ParallelProjectionOn();
}

/// Adds flat-shaded spheres that intersect each other.
void AddSpheres(vtkRenderer* renderer)
{
  Random random;
  for (int i = 0; i < 30; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    const double x = random();
    const double y = random();
    sphere->SetCenter(x, y, random());
    sphere->SetRadius(0.15 + 0.15 * random());
    sphere->SetThetaResolution(12);
    sphere->SetPhiResolution(12);
    sphere->Update();
    const double red = random();
    const double green = random();
    Add(renderer, sphere->GetOutput())->GetProperty()->SetColor(red, green, random());
  }
}

/// Adds triangles of three points each.
vtkActor* AddTriangles(vtkRenderer* renderer, vtkPoints* points)
{
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i + 2 < points->GetNumberOfPoints(); i += 3)
  {
    const vtkIdType ids[3] = { i, i + 1, i + 2 };
    cells->InsertNextCell(3, ids);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  return Add(renderer, data);
}

/// Adds small triangles that face the camera, one behind the other.
void AddFacingTriangles(vtkRenderer* renderer)
{
  Random random;
  for (int i = 0; i < 300; ++i)
  {
    vtkNew<vtkPoints> points;
    const double x = random();
    const double y = random();
    const double z = i / 300.0;
    for (int corner = 0; corner < 3; ++corner)
    {
      const double dx = 0.3 * (random() - 0.5);
      points->InsertNextPoint(x + dx, y + 0.3 * (random() - 0.5), z);
    }
    const double red = random();
    const double green = random();
    AddTriangles(renderer, points)->GetProperty()->SetColor(red, green, random());
  }
}

/// Adds random triangles.
void AddRandomTriangles(vtkRenderer* renderer)
{
  Random random;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 300; ++i)
  {
    const double x = random();
    const double y = random();
    const double z = random();
    for (int corner = 0; corner < 3; ++corner)
    {
      const double dx = 0.3 * (random() - 0.5);
      const double dy = 0.3 * (random() - 0.5);
      points->InsertNextPoint(x + dx, y + dy, z + 0.3 * (random() - 0.5));
    }
  }
  AddTriangles(renderer, points);
}

struct SceneRow
{
  std::string Name;
  std::function<void(vtkRenderer*)> AddProps;
  double ViewAngle = 30.0;
  double ReferenceError =
    0.0; ///< regular samples are least accurate for the axis-aligned edges of points
};

const SceneRow Rows[] = {
  { "PointsAtDifferentDepths", AddPoints, 30.0, 1.0 / 512.0 },
  { "IntersectingSpheres", AddSpheres },
  { "TrianglesFacingTheCamera", AddFacingTriangles },
  { "IntersectingTriangles", AddRandomTriangles },
  { "IntersectingTrianglesInANarrowView", AddRandomTriangles, 0.001 },
};

std::ostream& operator<<(std::ostream& os, const SceneRow& row)
{
  return os << row.Name;
}

std::string MakeName(const ::testing::TestParamInfo<SceneRow>& row)
{
  return row.param.Name;
}

vtkSmartPointer<vtkRenderer> MakeRenderer(const SceneRow& row)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  row.AddProps(renderer);
  renderer->SetBackground(0.2, 0.3, 0.4);
  renderer->ResetCamera();
  vtkCamera* camera = renderer->GetActiveCamera();
  const auto computeHalfWidth = [&]() {
    return std::tan(vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle()));
  };
  const double originalWidth = computeHalfWidth();
  camera->SetViewAngle(row.ViewAngle);
  camera->Dolly(computeHalfWidth() / originalWidth);
  renderer->ResetCameraClippingRange();
  return renderer;
}

Answer CastUniformly(vtkRenderer* renderer, int samples)
{
  return Cast(renderer, Side, Side, [samples](vtkPenumbraRayCaster* caster) {
    caster->GetConstants().CoverageMethod = CoverageMethods::Uniform;
    caster->GetConstants().UniformSamples = samples;
  });
}

class HardScenes : public ::testing::TestWithParam<SceneRow>
{
};

}

TEST_P(HardScenes, ReportEveryTileAboveTheTolerance)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(GetParam());
  double tolerance = 0.0;
  const Answer answer = Cast(renderer, Side, Side,
    [&](vtkPenumbraRayCaster* caster) { tolerance = caster->GetTolerance(); });
  double worst = 0.0;
  for (const TileAccuracy& tile :
    CompareTiles(answer, CastUniformly(renderer, ReferenceSamples), Side))
  {
    worst = std::max(worst, tile.Error);
    EXPECT_FALSE(tile.Error > tolerance + GetParam().ReferenceError && tile.Estimate < tolerance)
      << "error " << tile.Error << ", estimated " << tile.Estimate;
  }
  RecordProperty("WorstTile", std::to_string(worst));
}

TEST_P(HardScenes, HaveCalibratedErrorEstimatesWithUniformSamples)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(GetParam());
  const Answer reference = CastUniformly(renderer, ReferenceSamples);
  for (const int samples : { 2, 4, 8 })
  {
    std::vector<double> ratios;
    for (const TileAccuracy& tile : CompareTiles(CastUniformly(renderer, samples), reference, Side))
    {
      if (tile.Error > 1e-3)
      {
        ratios.push_back(tile.Estimate / tile.Error);
      }
    }
    ASSERT_FALSE(ratios.empty());
    std::sort(ratios.begin(), ratios.end());
    EXPECT_GE(ratios[ratios.size() / 20], 1.0) << samples;
    EXPECT_LE(ratios[ratios.size() / 2], 5.0) << samples;
  }
}

TEST(Tolerance, WarnsOnceIfItIsNotReached)
{
  vtkNew<vtkCallbackCommand> count;
  int warnings = 0;
  count->SetClientData(&warnings);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer({ "IntersectingSpheres", AddSpheres });
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Side, Side);
  caster->AddObserver(vtkCommand::WarningEvent, count);
  caster->Update();
  EXPECT_EQ(warnings, 0);
  caster->SetTolerance(1e-5);
  caster->Update();
  EXPECT_EQ(warnings, 1);
  caster->GetConstants().CoverageMethod = CoverageMethods::Uniform;
  caster->Update();
  EXPECT_EQ(warnings, 1);
}

INSTANTIATE_TEST_SUITE_P(RayCaster, HardScenes, ::testing::ValuesIn(Rows), MakeName);
